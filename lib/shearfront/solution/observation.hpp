// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace shearfront {

/// What a measured number is.
enum class Quantity {
  point,       ///< phi(z, t)
  bin,         ///< mean of phi over [z - width/2, z + width/2]
  cumulative,  ///< M(z, t) = int_bottom^z phi
  bed_height   ///< H(t), the height of the bed (solution/bed_height.hpp)
};

[[nodiscard]] constexpr std::string_view name_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::point:
      return "point";
    case Quantity::bin:
      return "bin";
    case Quantity::cumulative:
      return "cumulative";
    case Quantity::bed_height:
      return "bed-height";
  }
  return "unknown";
}

/// One measured number with its place. Time >= 0 and z in the units of the scene; sigma > 0 is the standard
/// deviation of its noise, NaN where the file gives none; width > 0 for bins, 0 otherwise. A height of the
/// bed has no place of its own: z is then 0.
struct Observation {
  double t = 0, z = 0, value = 0, width = 0;
  double sigma = std::numeric_limits<double>::quiet_NaN();
};

/// The interval a bin averages over.
struct BinEdges {
  double below = 0, above = 0;
  [[nodiscard]] double width() const { return above - below; }
};

/// Most by which z -+ width/2 can differ from an edge that was meant to be an end of the domain. With
/// u = eps/2, rounding z and width to double moves the edge by u |z| + u width/2, the sum by u |edge|, and
/// the end of the domain is itself rounded by u |end|. The two last are at most |z| + width/2 to first order,
/// so all is below u (3 |z| + 3 width/2) < 2 eps (|z| + width/2).
[[nodiscard]] inline double bin_edge_rounding(double z, double width) {
  return 2 * std::numeric_limits<double>::epsilon() * (std::abs(z) + width / 2);
}

/// Whether the bin lies in the domain, up to bin_edge_rounding(). Ends may be infinite, edges may not.
[[nodiscard]] inline bool is_bin_inside(double z, double width, double bottom, double top) {
  const double below = z - width / 2, above = z + width / 2, rounding = bin_edge_rounding(z, width);
  return std::isfinite(below) && std::isfinite(above) && below >= bottom - rounding &&
         above <= top + rounding;
}

/// A bin narrower than this part of |z| has edges that are not resolved: z -+ width/2 are rounded by eps |z|,
/// so at 1e-8 the width is right to 2e-8, which is less than any measurement notices.
inline constexpr double kLeastBinWidth = 1e-8;

[[nodiscard]] inline bool is_bin_resolved(double z, double width) {
  return width >= kLeastBinWidth * std::abs(z) && z + width / 2 > z - width / 2;
}

/// [z - width/2, z + width/2], cut off at the ends of the domain, which it may pass by rounding.
[[nodiscard]] inline BinEdges bin_edges(double z, double width, double bottom, double top) {
  return {std::max(z - width / 2, bottom), std::min(z + width / 2, top)};
}

/// Units of the numbers, empty where none is given. A file read for a scene with units is converted to them; otherwise
/// they are kept as they stand in its header. A width has the unit of z, a sigma that of the value.
struct ObservationUnits {
  std::string t, z, value;
  bool is_chute = false;  ///< t is the distance x along a steady chute, and is called so in files
  friend bool operator==(const ObservationUnits&, const ObservationUnits&) = default;
};

/// The measurements a fit works on: all of one quantity, in the order of their file, no place twice.
struct Observations {
  Quantity quantity = Quantity::point;
  std::vector<Observation> rows;
  std::size_t n_missing = 0;          ///< rows of the file without a value, left out here
  std::vector<std::string> comments;  ///< comment lines of the file without their #
  ObservationUnits units;
  std::string understood;          ///< how the file was read, in one line; empty for what comes from no file
  std::vector<std::string> notes;  ///< what a user should be told about the file, one line each

  /// Whether every row has its sigma (a file gives it for all rows or for none).
  [[nodiscard]] bool has_sigma() const { return !rows.empty() && rows.front().sigma > 0; }
};

}  // namespace shearfront
