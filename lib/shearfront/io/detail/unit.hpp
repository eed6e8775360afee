// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string_view>
#include <utility>

/// Units of lengths, times and fractions by their usual names; no system of dimensions. A name that is not in the
/// table is kept as it is and can be compared, not converted.
namespace shearfront::detail {

/// What a unit measures.
enum class UnitKind { length, time, fraction };

struct Unit {
  UnitKind kind;
  double size;  ///< in m, s, or parts of 1
};

/// Lengths: um, µm, mm, cm, dm, m, km, in, ft, mi. Times: us, µs, ms, s, sec, min, h, hr, d. Fractions: %, percent,
/// vol%, vol.%, ppm, 1, -. Names are case-sensitive (m is no M). Nothing for any other text.
[[nodiscard]] std::optional<Unit> unit_of(std::string_view name);

/// By what a number in `from` is multiplied to be one in `to`: 1 where the names are equal, nothing where they differ
/// and one of them is not known or they measure different things. The factor is that of the table in one rounding:
/// 10 for cm to mm, 0.1 for mm to cm.
[[nodiscard]] std::optional<double> unit_factor(std::string_view from, std::string_view to);

/// The same as a numerator and a denominator, whole numbers both: for scalars that round less than a double.
[[nodiscard]] std::optional<std::pair<double, double>> unit_ratio(std::string_view from, std::string_view to);

}  // namespace shearfront::detail
