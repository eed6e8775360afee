// SPDX-License-Identifier: BSD-3-Clause
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() {
  return {R"toml(scene = "scene.toml"
[[vary]]
entry = "shear_rate.values[0]"
list = [1, 2, 3]
[[vary]]
entry = "shear_rate.values[1]"
range = [0.1, 1]
count = 3
[outputs]
events = ["t_0", "t_1", "t*"]
)toml",
          R"toml(scene = "scene.toml"
[[vary]]
entry = "shear_rate.values[0]"
log_uniform = [0.5, 2]
[[vary]]
entry = "initial.breaks[0]"
normal = [0.5, 0.01]
[[vary]]
entry = "shear_rate.values[1]"
lognormal = [1, 0.1]
[design]
kind = "sobol"
runs = 16
seed = 3
[forward]
method = "front-tracking"
resolution = 0.1
[outputs]
events = ["t*", "t_c(1)"]
quantities = ["phi", "M", "mixing", "H"]
times = [0.5, 2]
heights = [0.25, 0.75]
)toml",
          R"toml(fit = "fit.toml"
[design]
kind = "fit"
runs = 10
)toml"};
}

std::vector<std::string> words() {
  return {"[",
          "]",
          "{",
          "}",
          "=",
          ",",
          "\n",
          "#",
          "\"",
          "nan",
          "-inf",
          "1e400",
          "-0.0",
          "1e-320",
          "1e308",
          "99999999999999999999",
          "true",
          "count = 0",
          "count = 1e9",
          "runs = 18446744073709551615",
          "-1",
          "range",
          "log_range",
          "log-range",
          "normal",
          "lognormal",
          "uniform",
          "\"shear_rate.scale\" = [1, 2]\n",
          "[vary]",
          "[[vary]]",
          "[outputs]",
          "[design]\n",
          "kind = \"grid\"\n",
          "kind = \"latin-hypercube\"\n",
          "kind = \"random\"\n",
          "kind = \"sobol-indices\"\n",
          "events",
          "quantities = [\"phi\"]\n",
          "[[vary]]\nentry = \"domain.top\"\nlist = [1, 2]\n",
          "height",
          "mixing",
          "t_c(1)",
          std::string("\0", 1),
          "\xff",
          "\xe2\x80\xae"};
}

}  // namespace shearfront::fuzz
