// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <string>

#include "report.hpp"
#include "shearfront/digits/real110.hpp"
#include "shearfront/io/scene_file.hpp"

/// Property of the scene reader: any bytes give a valid scene, or a FileError that can be shown as it is.
namespace {

using namespace shearfront;

constexpr std::size_t kLongestForMultiprecision = 4096;

template <Real S>
void check(const std::string& text) {
  try {
    const Scene<S> scene = parse_scene<S>(text, "fuzz.toml");
    fuzz::require(find_complaints(scene.spec()).empty(), "an accepted scene is valid");
  } catch (const FileError& error) {
    fuzz::check_report(error, "fuzz.toml");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check<double>(text);
  if (size <= kLongestForMultiprecision) check<Real110>(text);
  return 0;
}
