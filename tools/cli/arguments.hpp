// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/complaint.hpp"

/// Values of command-line options. They arrive as text and are converted here, strictly and independently of
/// the locale, so that every refusal has the same form: `--resolution = -1; must be > 0 and <= 1`.
namespace shearfront::tools {

/// Errors: InputError in that form; the value is quoted unless it is a number.
[[noreturn]] void refuse(std::string_view option, std::string_view value, std::string_view constraint);

/// The parts between separators; one more than there are separators.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// An interval of numbers; an end may be excluded.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  [[nodiscard]] bool contains(double x) const { return (low_excluded ? x > low : x >= low) && x <= high; }
};

[[nodiscard]] double number_option(std::string_view option, std::string_view value, Bounds bounds,
                                   std::string_view constraint);
[[nodiscard]] unsigned long long count_option(std::string_view option, std::string_view value,
                                              unsigned long long low, unsigned long long high);
/// The position of the value in `names`; refuses other names, listing the known ones.
[[nodiscard]] std::size_t choice_option(std::string_view option, std::string_view value,
                                        const std::vector<std::string>& names);

enum class Steady { refused, allowed };

/// A LIST: numbers and start:stop:count (both ends included), separated by commas. The word "steady" stands
/// for +infinity where it is allowed.
[[nodiscard]] std::vector<double> list_option(std::string_view option, std::string_view value, Bounds bounds,
                                              std::string_view constraint, Steady steady);

/// n numbers from start to stop, both included, as decimal as they are: 0:1:11 contains 0.3, not
/// 0.30000000000000004.
[[nodiscard]] std::vector<double> equally_spaced(double start, double stop, std::size_t n);

}  // namespace shearfront::tools
