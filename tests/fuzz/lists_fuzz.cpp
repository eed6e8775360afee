// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "cli/arguments.hpp"
#include "report.hpp"

/// Property of the values of command-line options: any bytes give numbers within the bounds, or one printable line.
namespace {

using namespace shearfront;

template <class Read>
void check(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string report = error.what();
    fuzz::require(report.starts_with("--option"), "a line that names the option");
    for (const char c : report)
      fuzz::require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "a printable line");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check([&] {
    const auto list = tools::list_option("--option", text, {0}, "must be >= 0", tools::Steady::allowed);
    fuzz::require(!list.empty(), "a list that has numbers");
    for (const double t : list) fuzz::require(t >= 0, "numbers within the bounds");
  });
  check([&] {
    for (const double z : tools::list_option("--option", text, {}, "must be finite", tools::Steady::refused))
      fuzz::require(!std::isnan(z), "numbers");
  });
  check([&] {
    const double x = tools::number_option("--option", text, {0, 1, true}, "must be > 0 and <= 1");
    fuzz::require(x > 0 && x <= 1, "a number within the bounds");
  });
  check([&] {
    const auto n = tools::count_option("--option", text, 1, 1000);
    fuzz::require(n >= 1 && n <= 1000, "a count within the bounds");
  });
  return 0;
}
