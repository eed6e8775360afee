// SPDX-License-Identifier: BSD-3-Clause
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() {
  std::vector<std::string> texts = files_of_cases(".csv");
  texts.emplace_back(
      "# from here\n\"t\",z [mm],\"phi\",width (mm),sigma\r\n0,0.5,0.25,0.1,0.01\n1,0.5,NA,0.1,\n");
  texts.emplace_back("z,t,M,sigma,who\n0.5,0,0.25,1e-3,\"a, \"\"b\"\"\"\n1,0,0.5,1e-3,\n");
  texts.emplace_back("Zeit;H\xf6he;c\n[s];[mm];[%]\n0;0,5;12,5\n1;0,25;n/a\n");
  texts.emplace_back("t\\z [mm],0.1,0.5,0.9\n0,0,0.5,1\n1,0.25,-,0.75\n");
  texts.emplace_back("z,0 s,1 s\n0.1,0,0.5\n0.9,1,0.5\n");
  texts.emplace_back(
      "# Chunk-averaged data for fix profile\n# Timestep Number-of-chunks Total-count\n"
      "# Chunk Coord1 Ncount c_phi\n100 2 20\n  1 0.25 10 0.5\n  2 0.75 10 0.25\n");
  texts.emplace_back(std::string("\xff\xfet\0,\0z\0,\0p\0h\0i\0\n\0000\0,\0000\0,\0001\0\n\0", 28));
  texts.emplace_back("t,z,phi\n0,0.5,0.25\n0,0.5,0.75\n1,0.5,0.5\n");
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
          "Sigma",
          "time",
          "height",
          "phi_large",
          "H",
          "stderr",
          "0,5;",
          "[%]",
          "# Timestep Number-of-chunks Total-count\n",
          "\xff\xfe",
          "\xfe\xff"};
}

}  // namespace shearfront::fuzz
