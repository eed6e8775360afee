// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace shearfront {

/// What a measured number is.
enum class Quantity {
  point,      ///< phi(z, t)
  bin,        ///< mean of phi over [z - width/2, z + width/2]
  cumulative  ///< M(z, t) = int_bottom^z phi
};

[[nodiscard]] constexpr std::string_view name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::point:
      return "point";
    case Quantity::bin:
      return "bin";
    case Quantity::cumulative:
      return "cumulative";
  }
  return "unknown";
}

/// One measured number with its place. Time >= 0 and z in the units of the scene; sigma > 0 is the standard
/// deviation of its noise, NaN where the file gives none; width > 0 for bins, 0 otherwise.
struct Observation {
  double t = 0, z = 0, value = 0, width = 0;
  double sigma = std::numeric_limits<double>::quiet_NaN();
};

/// The measurements a fit works on: all of one quantity, in the order of their file, no place twice.
struct Observations {
  Quantity quantity = Quantity::point;
  std::vector<Observation> rows;
  std::size_t n_missing = 0;           ///< rows of the file without a value, left out here
  std::vector<std::string> comments;  ///< comment lines of the file without their #

  /// Whether every row has its sigma (a file gives it for all rows or for none).
  [[nodiscard]] bool has_sigma() const { return !rows.empty() && rows.front().sigma > 0; }
};

}  // namespace shearfront
