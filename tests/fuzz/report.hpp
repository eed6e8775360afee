// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "shearfront/io/file_error.hpp"

/// Properties of every reader.
namespace shearfront::fuzz {

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "property violated: %s\n", what);
  std::abort();
}

/// One line per problem shown, each with the file's name, in ascending order of lines, printable.
inline void check_report(const FileError& error, const std::string& file) {
  const std::string report = error.what();
  require(!report.empty() && !error.complaints().empty(), "a report that says something");
  long last = 0;
  std::size_t begin = 0, n_lines = 0;
  while (begin < report.size()) {
    const std::size_t end = std::min(report.find('\n', begin), report.size());
    const std::string line = report.substr(begin, end - begin);
    require(line.starts_with(file + ":"), "a line that starts with the name of the file");
    if (line.starts_with(file + ": and ")) {
      require(end == report.size(), "the number of further problems at the end");
      break;
    }
    const long number = std::strtol(line.c_str() + file.size() + 1, nullptr, 10);
    require(number >= last, "problems in the order of the file");
    last = number;
    for (const char c : line) require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "a printable line");
    begin = end + 1;
    ++n_lines;
  }
  require(n_lines == error.complaints().size(), "one line per problem");
}

}  // namespace shearfront::fuzz
