// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "shearfront/model/flux/flux.hpp"

namespace shearfront {

/// Both branches of a flux g(u), 0 <= u <= 1, with one maximum g(m) = 1, -g strictly convex and g = 0 at both ends, as functions of
/// w = sqrt(1 - x), x = g: the distance of u from the pure state of its side is
///
///     lack / 2,   lack(w) = x shape(w),   spread - lack = 2 |u - m|,   spread = 2 m (low side) or 2 (1 - m).
///
/// shape is a smooth function of w, also at the maximum (w = 0), where u has a square root in x, and at the pure state; for
/// the parabola it is 1 / (1 + w). It and its primitives are tabulated by polynomials of degree 10 in panels of w, cut at the
/// joints of the flux and halved until the polynomials meet the flux to rounding: error() is what is left, measured between the
/// nodes. Cost: some 1e5 evaluations of the flux at most, once; then a polynomial per value.
class FluxBranches {
 public:
  /// Precondition: suits(flux).
  explicit FluxBranches(const Flux<double>& flux);
  /// Whether a flux is convex or concave and nowhere straight, with one extremum inside its range and 0 at both ends. (Along a
  /// straight piece all characteristics run in parallel, and one contact carries them: layers are exact there.)
  [[nodiscard]] static bool suits(const Flux<double>& flux);

  /// u = (phi - end) / slope, such that g has a maximum: the pure state u = 0 is phi = `end`.
  [[nodiscard]] double end() const { return end_; }
  [[nodiscard]] double slope() const { return slope_; }
  [[nodiscard]] double top() const { return top_; }
  /// g(u): small ones, and 1 - g = root_of(u)^2, to all their digits.
  [[nodiscard]] double value(double u) const;
  [[nodiscard]] double root_of(double u) const;
  /// |g'(u)|.
  [[nodiscard]] double steepness(double u) const;

  [[nodiscard]] double spread(bool is_high) const { return side(is_high).spread; }
  /// 2 / |g'| at the pure state: what `shape` is there.
  [[nodiscard]] double pure_shape(bool is_high) const { return side(is_high).pure_shape; }
  [[nodiscard]] double shape(bool is_high, double w) const { return evaluate(side(is_high), kShape, w); }
  /// Twice the distance from the pure state. x = 1 - w^2, known better than from w where it is small.
  [[nodiscard]] double lack(bool is_high, double w, double x) const { return x * shape(is_high, w); }
  /// - d(lack)/dw / (2 w) = d(lack)/dx.
  [[nodiscard]] double lack_slope(bool is_high, double w, double x) const;
  /// int shape dx, and int (shape - pure shape) / x dx, from x = 1 - to^2 to 1 - from^2, which is `dx` higher. Without
  /// cancellation where they are near to each other.
  [[nodiscard]] double shape_integral(bool is_high, double from, double to, double dx) const {
    return integral(side(is_high), kShape, kShapeIntegral, from, to, dx);
  }
  [[nodiscard]] double rest_integral(bool is_high, double from, double to, double dx) const {
    return integral(side(is_high), kRest, kRestIntegral, from, to, dx);
  }
  /// Largest difference between table and flux that was met between the nodes, relative to the distance from the pure state.
  [[nodiscard]] double error() const { return error_; }

 private:
  static constexpr std::size_t kCoefficients = 11, kBins = 32;
  enum Function : std::size_t { kShape, kRest, kShapeIntegral, kRestIntegral };
  using Polynomial = std::array<double, kCoefficients>;  ///< in -1 ... 1 across a panel
  struct Side {
    double spread = 0, pure_shape = 0;
    std::vector<double> ends;                          ///< of panels, ascending, the last one 1
    std::array<std::size_t, kBins + 1> first{};        ///< panel at the lower end of a bin
    std::array<std::vector<Polynomial>, 4> functions;  ///< of w
  };

  void build(const Flux<double>& flux, bool is_high);
  [[nodiscard]] const Side& side(bool is_high) const { return sides_[is_high ? 1 : 0]; }
  [[nodiscard]] static std::size_t panel_of(const Side& side, double w) {
    std::size_t panel = side.first[static_cast<std::size_t>(w * kBins)];
    while (w > side.ends[panel]) ++panel;
    return panel;
  }
  [[nodiscard]] static double evaluate(const Side& side, Function function, double w);
  [[nodiscard]] static double integral(const Side& side, Function function, Function primitive, double from,
                                       double to, double dx);

  Flux<double> flux_;
  double end_, slope_, top_, extremum_;  ///< |f| of the extremum
  std::array<Side, 2> sides_;            ///< low and high u
  double error_ = 0;
};

/// g(u) of a flux, 4 u (1 - u) if there is none given.
[[nodiscard]] inline double relative_flux(const FluxBranches* flux, double u) {
  return flux ? flux->value(u) : 4 * u * (1 - u);
}
[[nodiscard]] inline double top_of(const FluxBranches* flux) { return flux ? flux->top() : 0.5; }

}  // namespace shearfront
