// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/face_flux.hpp"

#include <algorithm>
#include <cmath>

namespace shearfront::fv {

FluxShape::FluxShape(const Flux<double>& model) : flux(model) {
  constexpr int kSlopeSamples = 4096;  // both ends included, where a convex or concave f is steepest
  lo = flux.range().lowest;
  hi = flux.range().highest;
  turns = flux.extrema();
  is_parabola = flux.is_parabola();
  for (int i = 0; i <= kSlopeSamples; ++i)
    largest_slope = std::max(largest_slope, std::abs(flux.derivative(lo + (hi - lo) * i / kSlopeSamples)));
  turns.insert(turns.begin(), lo);
  turns.push_back(hi);
  for (const double x : turns) turn_values.push_back(value(x));
  if (has_one_extremum() && turn_values[1] > turn_values[0]) sign = -1;
  if (has_two_branches()) turn = turning_state(flux);
  vanishes = turn_values.front() == 0 && turn_values.back() == 0;
}

FluxShape::Extent FluxShape::extent(double a, double b) const {
  const double at_a = value(a), at_b = value(b);
  Extent extent{std::min(at_a, at_b), std::max(at_a, at_b)};
  for (std::size_t i = 1; i + 1 < turns.size(); ++i)
    if (std::min(a, b) < turns[i] && turns[i] < std::max(a, b)) {
      extent.least = std::min(extent.least, turn_values[i]);
      extent.most = std::max(extent.most, turn_values[i]);
    }
  return extent;
}

FluxShape::Parts FluxShape::parts(double x) const {
  Parts parts{0, 0};
  double last = turn_values[0];
  const auto go = [&](double to) {
    (to > last ? parts.rise : parts.fall) += to - last;
    last = to;
  };
  for (std::size_t i = 1; i + 1 < turns.size() && turns[i] < x; ++i) go(turn_values[i]);
  go(value(x));
  return parts;
}

namespace {

double godunov(const FaceSide& below, const FaceSide& above) {
  const FluxShape &f_l = *below.flux, &f_r = *above.flux;
  if (!f_l.has_two_branches()) {
    const auto [least, most] = f_l.extent(below.x, above.x);
    return below.coefficient * (below.x < above.x ? least : most);
  }
  const bool is_minimum = f_l.sign > 0;
  const double l = is_minimum ? std::max(below.x, f_l.extremum()) : std::min(below.x, f_l.extremum());
  const double r = is_minimum ? std::min(above.x, f_r.extremum()) : std::max(above.x, f_r.extremum());
  const double from_below = below.coefficient * f_l.value(l), from_above = above.coefficient * f_r.value(r);
  return is_minimum ? std::max(from_below, from_above) : std::min(from_below, from_above);
}

/// The own flux of the side from which the jump comes, by the sign of its speed.
double upwind(const FaceSide& below, const FaceSide& above) {
  const double from_below = below.coefficient * below.flux->value(below.x);
  const double from_above = above.coefficient * above.flux->value(above.x);
  const bool rises = below.solid_fraction * below.x <= above.solid_fraction * above.x;
  return rises ? std::min(from_below, from_above) : std::max(from_below, from_above);
}

double classical_godunov(const FaceSide& below, const FaceSide& above) {
  const double flux = upwind(below, above), m = below.flux->extremum();
  const bool is_minimum = below.flux->sign > 0;
  const bool rises = below.solid_fraction * below.x <= above.solid_fraction * above.x;
  const double lower = is_minimum ? below.x : above.x, upper = is_minimum ? above.x : below.x;
  if (rises != is_minimum || !(lower < m && m < upper)) return flux;
  // The same f on both sides, not the same k.
  const double largest = std::max(below.coefficient, above.coefficient) * below.flux->turn_values[1];
  return is_minimum ? std::min(flux, largest) : std::max(flux, largest);
}

}  // namespace

double face_flux(Rule rule, const FaceSide& below, const FaceSide& above, double face_coefficient) {
  switch (rule) {
    case Rule::godunov:
      return godunov(below, above);
    case Rule::engquist_osher: {
      if (below.flux != above.flux || below.flux->is_monotone()) return godunov(below, above);
      const FluxShape& f = *below.flux;
      return face_coefficient * (f.turn_values[0] + f.parts(below.x).rise + f.parts(above.x).fall);
    }
    case Rule::classical_godunov:
      return classical_godunov(below, above);
    case Rule::upwind:
      return upwind(below, above);
  }
  return 0;
}

}  // namespace shearfront::fv
