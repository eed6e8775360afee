// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/face_rule.hpp"

#include <algorithm>

namespace shearfront::fv {
namespace {

double godunov(const FaceSide& below, const FaceSide& above) {
  if (!below.flux->has_one_extremum()) {
    const auto [least, most] = below.flux->extent(below.x, above.x);
    return below.coefficient * (below.x < above.x ? least : most);
  }
  const double from_below = below.coefficient * below.upward, from_above = above.coefficient * above.downward;
  return below.flux->is_minimum ? std::max(from_below, from_above) : std::min(from_below, from_above);
}

double engquist_osher(const FaceSide& below, const FaceSide& above, double coefficient) {
  if (below.flux != above.flux) return godunov(below, above);
  const std::vector<double>& values = below.flux->turn_values;
  const double constant = below.flux->has_one_extremum() ? -values[1] : values[0];
  return coefficient * (below.upward + (above.downward + constant));
}

/// The own flux of the side from which the jump comes, by the sign of its speed: of two fluxes the smaller
/// one where phi rises across the face, the larger one where it falls.
double upwind(const FaceSide& below, const FaceSide& above) {
  const double from_below = below.coefficient * below.flux->value(below.x);
  const double from_above = above.coefficient * above.flux->value(above.x);
  const bool rises = below.solid_fraction * below.x <= above.solid_fraction * above.x;
  return rises ? std::min(from_below, from_above) : std::max(from_below, from_above);
}

double classical_godunov(const FaceSide& below, const FaceSide& above) {
  const double flux = upwind(below, above);
  const bool is_minimum = below.flux->is_minimum;
  const double lower = is_minimum ? below.x : above.x, upper = is_minimum ? above.x : below.x;
  const bool rises = below.solid_fraction * below.x <= above.solid_fraction * above.x;
  if (rises != is_minimum || !(lower < below.flux->extremum() && below.flux->extremum() < upper)) return flux;
  const double extremum = below.flux->turn_values[1];  // the same f on both sides, not the same k
  const double largest = std::max(below.coefficient, above.coefficient) * extremum;
  return is_minimum ? std::min(flux, largest) : std::max(flux, largest);
}

}  // namespace

FaceSide face_side(const FluxBranches& flux, double coefficient, double solid_fraction, double x) {
  FaceSide side{&flux, coefficient, solid_fraction, x, 0, 0};
  if (!flux.has_one_extremum()) {
    const auto [rise, fall] = flux.parts(x);
    side.upward = rise;
    side.downward = fall;
    return side;
  }
  const double at_extremum = flux.turn_values[1], at_x = flux.value(x);
  const bool is_upward = (x > flux.extremum()) == flux.is_minimum;
  side.upward = is_upward ? at_x : at_extremum;
  side.downward = is_upward ? at_extremum : at_x;
  return side;
}

double face_flux(FaceRule rule, const FaceSide& below, const FaceSide& above, double face_coefficient) {
  switch (rule) {
    case FaceRule::godunov:
      return godunov(below, above);
    case FaceRule::engquist_osher:
      return engquist_osher(below, above, face_coefficient);
    case FaceRule::classical_godunov:
      return classical_godunov(below, above);
    case FaceRule::upwind:
      return upwind(below, above);
  }
  return 0;
}

}  // namespace shearfront::fv
