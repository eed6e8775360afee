// SPDX-License-Identifier: BSD-3-Clause
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() {
  std::vector<std::string> texts = files_of_cases(".csv");
  texts.emplace_back(
      "# from here\n\"t\",z [mm],\"phi\",width (mm),sigma\r\n0,0.5,0.25,0.1,0.01\n1,0.5,NA,0.1,\n");
  texts.emplace_back("z,t,M,sigma,who\n0.5,0,0.25,1e-3,\"a, \"\"b\"\"\"\n1,0,0.5,1e-3,\n");
  return texts;
}

std::vector<std::string> words() {
  return {",",
          "\n",
          "\r\n",
          "#",
          "\"",
          "\"\"",
          " ",
          "\t",
          "t",
          "z",
          "phi",
          "M",
          "width",
          "sigma",
          "t,z,phi\n",
          "[mm]",
          "(s)",
          "[",
          ")",
          "NA",
          "nan",
          "-inf",
          "1e400",
          "1e-400",
          "-0",
          "0.5",
          "5e-324",
          "1e308",
          "0,0.5",
          "1,0.5",
          "0.1,0.5",
          "%",
          "+",
          "-",
          ";",
          "0x1",
          "\xff",
          "\xc3",
          "\xe2\x80\xae",
          "\xef\xbb\xbf",
          std::string("\0", 1),
          "phi_small",
          "Sigma"};
}

}  // namespace shearfront::fuzz
