// SPDX-License-Identifier: BSD-3-Clause
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() { return files_of_cases("fit.toml"); }

std::vector<std::string> words() {
  return {"[",
          "]",
          "=",
          ",",
          "\n",
          "#",
          "\"",
          "nan",
          "-inf",
          "1e400",
          "-0.0",
          "0x10",
          "1e6",
          "99999999999999999999",
          "true",
          "\"shear_rate.values\"",
          "\"initial.breaks[0]\"",
          "shear_rate.scale",
          "start = [2, 1]\n",
          "lower = [0, -inf]\n",
          "upper = [inf, 3]\n",
          "shape = \"convex\"\n",
          "[forward]\n",
          "method = \"godunov\"\n",
          "cells = 100\n",
          "[misfit]\n",
          "quantity = \"bin\"\n",
          "two_stage = false\n",
          "loss_scale = 2\n",
          "[search]\n",
          "starts = 3\n",
          "settings = \"paper\"\n",
          "[uncertainty]\n",
          "bootstrap = 10\n",
          "[prior]\n",
          "shear_rate.values = { lognormal = [1, 0.5] }\n",
          "\"shear_rate.values[0]\" = { normal = [2.4, 0.1] }\n",
          "{ uniform = [0, 1] }",
          "[compare]\nlayers = [1, 2]\n",
          "[columns]\n",
          "[format]\n",
          "scene.toml",
          "data.csv",
          std::string("\0", 1),
          "\xff",
          "\xe2\x80\xae"};
}

}  // namespace shearfront::fuzz
