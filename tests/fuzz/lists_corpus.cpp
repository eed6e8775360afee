// SPDX-License-Identifier: BSD-3-Clause
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() {
  return {"0.5,6", "0:1:11", "steady", "0:1:11,2,steady",
          "1e-3",  "-1:1:3", "12",     "point,bin:0.05,cumulative"};
}

std::vector<std::string> words() {
  return {",",
          ":",
          "steady",
          "nan",
          "inf",
          "-inf",
          "1e400",
          "1e-400",
          "-0",
          "0:1:2",
          "0:1:1",
          "1:0:5",
          "::",
          "1:2:999999999999",
          "1e308:-1e308:3",
          "0:5e-324:7",
          "+1",
          " ",
          "0x10",
          std::string("\0", 1),
          "\xff",
          "\n"};
}

}  // namespace shearfront::fuzz
