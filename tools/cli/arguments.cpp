// SPDX-License-Identifier: BSD-3-Clause
#include "cli/arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

constexpr unsigned long long kLongestList = 10'000'000;

/// The decimal number of 15 digits that x differs from by rounding only, otherwise x: 0.01:0.99:99 contains
/// 0.6, not 0.6000000000000001, which would lie on the other side of an interface at 0.6.
double without_rounding(double x, double scale) {
  constexpr double kUlps = 4;
  const double decimal = parse_number(fmt::format("{:.15g}", x)).value_or(x);
  return std::abs(decimal - x) <= kUlps * std::numeric_limits<double>::epsilon() * scale ? decimal : x;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t cut = text.find(separator);
    parts.push_back(text.substr(0, cut));
    if (cut == std::string_view::npos) return parts;
    text.remove_prefix(cut + 1);
  }
}

void refuse(std::string_view option, std::string_view value, std::string_view constraint) {
  throw InputError(std::string(option), parse_number(value) ? std::string(value) : quoted_text(value),
                   std::string(constraint));
}

double number_option(std::string_view option, std::string_view value, Bounds bounds,
                     std::string_view constraint) {
  const auto x = parse_number(value);
  if (!x) refuse(option, value, fmt::format("must be a number {}", constraint));
  if (!bounds.contains(*x)) refuse(option, value, fmt::format("must be {}", constraint));
  return *x;
}

unsigned long long count_option(std::string_view option, std::string_view value, unsigned long long low,
                                unsigned long long high) {
  const auto n = parse_count(value);
  if (!n || *n < low || *n > high)
    refuse(option, value, fmt::format("must be a whole number from {} to {}", low, high));
  return *n;
}

std::size_t choice_option(std::string_view option, std::string_view value,
                          const std::vector<std::string>& names) {
  const auto it = std::find(names.begin(), names.end(), value);
  if (it == names.end()) refuse(option, value, fmt::format("must be one of: {}", fmt::join(names, ", ")));
  return static_cast<std::size_t>(it - names.begin());
}

std::vector<double> equally_spaced(double start, double stop, std::size_t n) {
  std::vector<double> xs(n, start);
  const double scale = std::max(std::abs(start), std::abs(stop)), last = static_cast<double>(n) - 1;
  const bool is_huge = !std::isfinite((stop - start) * last);
  for (std::size_t i = 1; i < n; ++i) {
    const double k = static_cast<double>(i);
    xs[i] = i + 1 == n ? stop
            : is_huge  ? std::lerp(start, stop, k / last)
                       : without_rounding(start + (stop - start) * k / last, scale);
  }
  return xs;
}

std::vector<double> list_option(std::string_view option, std::string_view value, Bounds bounds,
                                std::string_view constraint, Steady steady) {
  std::vector<double> xs;
  const auto refuse_item = [&](std::string_view item, std::string_view why) {
    if (item == value) refuse(option, value, why);
    refuse(option, value, fmt::format("{} in every item (here {})", why, quoted_text(item)));
  };
  const std::string allowed = fmt::format("must be a number {}{} or start:stop:count", constraint,
                                          steady == Steady::allowed ? ", steady" : "");
  for (const std::string_view item : split(value, ',')) {
    if (item == "steady" && steady == Steady::allowed) {
      xs.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    const auto parts = split(item, ':');
    if (parts.size() != 1 && parts.size() != 3) refuse_item(item, allowed);
    const auto start = parse_number(parts[0]);
    const auto stop = parse_number(parts.size() == 3 ? parts[1] : parts[0]);
    if (!start || !stop) refuse_item(item, allowed);
    if (!bounds.contains(*start) || !bounds.contains(*stop))
      refuse_item(item, fmt::format("must be {}", constraint));
    if (parts.size() == 1) {
      xs.push_back(*start);
      continue;
    }
    const auto n = parse_count(parts[2]);
    const unsigned long long least = *start == *stop ? 1 : 2;
    if (!n || *n < least || *n > kLongestList)
      refuse_item(item, fmt::format("must have a count from {} to {}", least, kLongestList));
    const auto range = equally_spaced(*start, *stop, static_cast<std::size_t>(*n));
    xs.insert(xs.end(), range.begin(), range.end());
    if (xs.size() > kLongestList)
      refuse(option, value, fmt::format("must stand for at most {} numbers", kLongestList));
  }
  return xs;
}

}  // namespace shearfront::tools
