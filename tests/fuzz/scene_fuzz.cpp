// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "shearfront/io/scene_file.hpp"

/// Property of the scene reader: any bytes give a valid scene, or a FileError that can be shown as it is.
namespace {

using namespace shearfront;

constexpr std::size_t kLongestForMultiprecision = 4096;

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "property violated: %s\n", what);
  std::abort();
}

/// One line per problem, each with the file's name, in ascending order of lines, printable.
void check_report(const FileError& error) {
  const std::string report = error.what();
  require(!report.empty() && !error.problems().empty(), "a report that says something");
  long last = 0;
  std::size_t begin = 0, n_lines = 0;
  while (begin < report.size()) {
    const std::size_t end = std::min(report.find('\n', begin), report.size());
    const std::string line = report.substr(begin, end - begin);
    require(line.starts_with("fuzz.toml:"), "a line that starts with the name of the file");
    const long number = std::strtol(line.c_str() + 10, nullptr, 10);
    require(number >= last, "problems in the order of the file");
    last = number;
    for (const char c : line) require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "a printable line");
    begin = end + 1;
    ++n_lines;
  }
  require(n_lines == error.problems().size(), "one line per problem");
}

template <Real S>
void check(const std::string& text) {
  try {
    const Scene<S> scene = parse_scene<S>(text, "fuzz.toml");
    require(find_problems(scene.spec()).empty(), "an accepted scene is valid");
  } catch (const FileError& error) {
    check_report(error);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check<double>(text);
  if (size <= kLongestForMultiprecision) check<Real50>(text);
  return 0;
}
