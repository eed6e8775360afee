// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "../cli/case_file.hpp"
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> files_of_cases(const std::string& extension) {
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::directory_iterator(SHEARFRONT_SOURCE_DIR "/tests/cli")) {
    if (entry.path().extension() != ".txt" || entry.path().filename() == "CMakeLists.txt") continue;
    for (const auto& c : cli_tests::read_cases(entry.path().string()))
      for (const auto& s : c.sections) {
        if (!s.argument.ends_with(extension)) continue;
        if (s.kind == "file") texts.push_back(s.text);
        if (s.kind == "raw-file") texts.push_back(cli_tests::unescaped(s.text));
      }
  }
  std::sort(texts.begin(), texts.end());  // directory order differs between machines
  return texts;
}

}  // namespace shearfront::fuzz
