// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() {
  std::vector<std::string> texts = files_of_cases(".toml");
  texts.emplace_back();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SHEARFRONT_SOURCE_DIR "/datasets")) {
    if (entry.path().filename() != "scene.toml") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  std::sort(texts.begin(), texts.end());
  return texts;
}

std::vector<std::string> words() {
  return {"[",
          "]",
          "[[",
          "]]",
          "{",
          "}",
          "=",
          ",",
          ".",
          "\n",
          "\r\n",
          "#",
          "\"",
          "'",
          "\"\"\"",
          "'''",
          "\\",
          "\\u0041",
          "nan",
          "-inf",
          "1e400",
          "1e-400",
          "-0.0",
          "0x7fffffff",
          "1_0",
          "2010-05-27",
          "true",
          "99999999999999999999",
          "0.5",
          "values",
          "breaks",
          "[shear_rate]",
          "[initial]",
          "[domain]",
          "model = \"table\"",
          "z = [0, 1]",
          "top = ",
          "a.a.a.a.a.a.a.a.a.a.a.a.",
          "[[[[[[[[[[[[[[[[[[[[",
          "{a={a={a={a={a={a=",
          "scale = ",
          "[velocity]",
          "[slab]",
          "length = 1",
          "model = \"block\"",
          "model = \"bagnold\"",
          "model = \"kinetic\"",
          "model = \"scaling-velocity\"",
          "file = \"a.csv\"",
          std::string("\0", 1),
          "\xff",
          "\xc3",
          "\xe2\x80\xae",
          "\xef\xbb\xbf"};
}

}  // namespace shearfront::fuzz
