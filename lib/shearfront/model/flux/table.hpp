// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/model.hpp"

namespace shearfront {

/// A measured flux: the monotone cubic through the points (phi[i], values[i]).
///
/// Between two points f is a cubic with the slopes of Fritsch & Butland at its ends: the weighted harmonic
/// mean of the two adjoining secants, 0 where they differ in sign. So f is monotone between points, all its
/// extrema are points, and it bends no more than they do. The ends of level pieces count as extrema.
/// Domain: at least two points, phi strictly increasing; states [phi.front(), phi.back()]. Cost of a value:
/// O(log points). Source: Fritsch & Butland (1984), SIAM J. Sci. Stat. Comput. 5, 300-304.
template <Real Scalar>
struct FluxTable {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kFormula = "monotone cubic through the points (phi[i], values[i])";
  static constexpr std::string_view kStates = "phi[0] <= phi <= phi[last]";
  static constexpr bool kIsParabola = false;
  static constexpr int kDegree = 3;

  std::vector<Scalar> phi, values;

  [[nodiscard]] StateRange<Scalar> range() const { return {phi.front(), phi.back()}; }
  [[nodiscard]] std::vector<Scalar> extrema() const {
    std::vector<Scalar> all;
    for (std::size_t i = 1; i + 1 < phi.size(); ++i)
      if (turns_at(i)) all.push_back(phi[i]);
    return all;
  }
  [[nodiscard]] Curvature curvature() const {
    bool is_convex = true, is_concave = true;
    for (std::size_t i = 0; i + 1 < phi.size(); ++i)
      for (const Scalar& bend : bends(i)) {
        is_convex = is_convex && !(bend < 0);
        is_concave = is_concave && !(bend > 0);
      }
    return is_convex ? Curvature::convex : is_concave ? Curvature::concave : Curvature::mixed;
  }
  [[nodiscard]] Scalar value(const Scalar& x) const {
    const std::size_t i = segment(x);
    const Piece piece = piece_of(i);
    const Scalar d = x - piece.begin, e = x - phi[i + 1];
    if (d + e <= 0) return piece.value + d * (piece.slope + d * (piece.square + d * piece.cube));
    // From the nearer end: next to a zero that is a point f keeps its sign.
    const Scalar square = piece.square + Scalar(3) * piece.cube * (phi[i + 1] - phi[i]);
    return values[i + 1] + e * (slope(i + 1) + e * (square + e * piece.cube));
  }
  [[nodiscard]] Scalar derivative(const Scalar& x) const {
    const Piece piece = piece_at(x);
    const Scalar d = x - piece.begin;
    return piece.slope + d * (Scalar(2) * piece.square + d * (Scalar(3) * piece.cube));
  }
  [[nodiscard]] Scalar second_derivative(const Scalar& x) const {
    const Piece piece = piece_at(x);
    return Scalar(2) * piece.square + Scalar(6) * piece.cube * (x - piece.begin);
  }
  /// Between them f is a cubic.
  [[nodiscard]] std::vector<Scalar> joints() const { return {phi.begin() + 1, phi.end() - 1}; }
  [[nodiscard]] Scalar secant(const Scalar& p, const Scalar& q) const {
    const Scalar& lo = std::min(p, q);
    const Scalar& hi = std::max(p, q);
    const std::size_t i = segment(lo);
    if (i + 2 < phi.size() && hi > phi[i + 1]) return (value(hi) - value(lo)) / (hi - lo);
    const Piece piece = piece_of(i);  // both in one piece: the divided difference of its cubic
    const Scalar x = lo - piece.begin, y = hi - piece.begin;
    return piece.slope + (piece.square * (x + y) + piece.cube * (x * x + (x * y + y * y)));
  }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "phi", .measure = Measure::state, .also = "ascending"}, self.phi);
    visit(FieldInfo{.key = "values", .measure = Measure::flux}, self.values);
  }
  void check(const std::string& prefix, Complaints& complaints) const {
    if (phi.size() < 2)
      complaints.push_back(wrong_length(prefix + "phi", phi.size(), "must have at least 2 entries"));
    if (values.size() != phi.size())
      complaints.push_back(
          wrong_length(prefix + "values", values.size(),
                       "must have as many entries as phi (" + std::to_string(phi.size()) + ")"));
    for (std::size_t i = 1; i < phi.size(); ++i)
      if (is_finite(phi[i]) && is_finite(phi[i - 1]) && !(phi[i] > phi[i - 1]))
        complaints.push_back({prefix + "phi[" + std::to_string(i) + "]", number_text(phi[i]),
                              "must be greater than the entry before it (" + number_text(phi[i - 1]) + ")"});
  }

  static std::vector<FluxTable> samples() {
    const auto numbers = [](std::initializer_list<double> xs) {
      return std::vector<Scalar>(xs.begin(), xs.end());
    };
    return {{numbers({0, 0.25, 0.5, 0.75, 1}), numbers({0, -0.1875, -0.25, -0.1875, 0})},
            {numbers({0, 0.1, 0.4, 0.7, 1}), numbers({0, -0.125, -0.25, -0.0625, 0})},
            {numbers({0, 0.25, 0.5, 0.75, 1}), numbers({0, -0.25, -0.125, -0.25, 0})}};
  }

 private:
  /// f = value + slope d + square d^2 + cube d^3, d = phi - begin.
  struct Piece {
    Scalar begin, value, slope, square, cube;
  };

  [[nodiscard]] std::size_t segment(const Scalar& x) const {
    const auto it = std::upper_bound(phi.begin() + 1, phi.end() - 1, x);
    return static_cast<std::size_t>(it - phi.begin()) - 1;
  }
  [[nodiscard]] Scalar secant_of(std::size_t i) const {
    return (values[i + 1] - values[i]) / (phi[i + 1] - phi[i]);
  }
  /// An extremum, or an end of a level piece: between those f rises, falls or is constant.
  [[nodiscard]] bool turns_at(std::size_t i) const {
    const Scalar below = secant_of(i - 1), above = secant_of(i);
    return (below < 0) != (above < 0) || (below > 0) != (above > 0);
  }
  [[nodiscard]] Scalar slope(std::size_t i) const {
    if (i == 0) return end_slope(0, 1);
    if (i + 1 == phi.size()) return end_slope(i - 1, i - 2);
    const Scalar below = secant_of(i - 1), above = secant_of(i);
    if (!(below * above > 0)) return Scalar(0);
    const Scalar h_below = phi[i] - phi[i - 1], h_above = phi[i + 1] - phi[i];
    const Scalar w_below = Scalar(2) * h_above + h_below, w_above = h_above + Scalar(2) * h_below;
    return (w_below + w_above) / (w_below / below + w_above / above);
  }
  /// Slope at an end: of the parabola through three points, limited so that the outermost piece stays
  /// monotone. `outer` and `inner` are the outermost piece and the one beside it.
  [[nodiscard]] Scalar end_slope(std::size_t outer, std::size_t inner) const {
    const Scalar s_outer = secant_of(outer);
    if (phi.size() == 2) return s_outer;
    const Scalar h_outer = phi[outer + 1] - phi[outer], h_inner = phi[inner + 1] - phi[inner];
    const Scalar s_inner = secant_of(inner);
    const Scalar slope = s_outer + (s_outer - s_inner) * (h_outer / (h_outer + h_inner));
    if (!(slope * s_outer > 0)) return Scalar(0);
    const bool turns = !(s_outer * s_inner > 0);
    const Scalar most = Scalar(3) * s_outer;
    return turns && (most > 0 ? slope > most : slope < most) ? most : slope;
  }
  [[nodiscard]] Piece piece_of(std::size_t i) const {
    const Scalar h = phi[i + 1] - phi[i], s = secant_of(i), a = slope(i), b = slope(i + 1);
    return {phi[i], values[i], a, (Scalar(3) * s - Scalar(2) * a - b) / h, (a + b - Scalar(2) * s) / (h * h)};
  }
  [[nodiscard]] Piece piece_at(const Scalar& x) const { return piece_of(segment(x)); }
  /// f'' at both ends of a piece, between which it is linear.
  [[nodiscard]] std::array<Scalar, 2> bends(std::size_t i) const {
    const Piece piece = piece_of(i);
    const Scalar square = Scalar(2) * piece.square;
    return {square, square + Scalar(6) * piece.cube * (phi[i + 1] - phi[i])};
  }
};

}  // namespace shearfront
