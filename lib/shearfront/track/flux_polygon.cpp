// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/flux_polygon.hpp"

#include <algorithm>
#include <utility>

#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
namespace {

constexpr int kSlopeRoundings = 8;  // of a secant, in units of its last place

}  // namespace

template <Real S>
FluxPolygon<S>::FluxPolygon(const Flux<S>& flux, std::vector<S> share, State first, State last,
                            bool is_reversed)
    : share_(std::move(share)) {
  for (std::size_t i = 0; i + 1 < share_.size(); ++i) slope_.push_back(flux.secant(share_[i], share_[i + 1]));
  straighten(index(first), index(last));
  find_vertices(index(first), index(last));
  if (flux.curvature() != (is_reversed ? Curvature::concave : Curvature::convex)) return;
  convex_to_.clear(), concave_to_.clear();
  convex_to_.shrink_to_fit(), concave_to_.shrink_to_fit();
}

template <Real S>
S FluxPolygon<S>::steepest() const {
  S steepest(0);
  for (const S& v : slope_) steepest = std::max(steepest, v < 0 ? S(-v) : v);
  return steepest;
}

/// Slopes that differ by no more than rounding made equal: fronts on a straight branch of the flux never
/// meet.
template <Real S>
void FluxPolygon<S>::straighten(std::size_t first, std::size_t last) {
  constexpr double kLargestSlack = 1e-6;
  const S steep = steepest();
  for (std::size_t i = first + 1; i < last; ++i) {
    // A secant of states that are off by a rounding each.
    const auto width = [](const S& a, const S& b) { return a < b ? S(b - a) : S(a - b); };
    const S step = std::min(width(share_[i], share_[i + 1]), width(share_[i - 1], share_[i]));
    const S slack =
        std::min(S(S(kSlopeRoundings) * unit_roundoff<S>() * steep / step), S(steep * S(kLargestSlack)));
    const S bend = slope_[i] - slope_[i - 1];
    if (bend <= slack && bend >= -slack) slope_[i] = slope_[i - 1];
  }
}

template <Real S>
void FluxPolygon<S>::find_vertices(std::size_t first, std::size_t last) {
  const std::size_t n = share_.size();
  const S slack = S(kSlopeRoundings) * unit_roundoff<S>() * steepest();
  next_.resize(n), previous_.resize(n), convex_to_.resize(n), concave_to_.resize(n);
  const auto state = [](std::size_t i) { return static_cast<State>(i); };
  for (std::size_t i = 0; i < n; ++i) next_[i] = previous_[i] = convex_to_[i] = concave_to_[i] = state(i);
  for (std::size_t i = first + 1; i <= last; ++i)
    previous_[i] = i == first + 1 || slope_[i - 2] != slope_[i - 1] ? state(i - 1) : previous_[i - 1];
  for (std::size_t i = last; i-- > first;) {
    const bool is_last = i + 1 == last;
    next_[i] = is_last || slope_[i] != slope_[i + 1] ? state(i + 1) : next_[i + 1];
    convex_to_[i] = !is_last && slope_[i + 1] >= slope_[i] - slack ? convex_to_[i + 1] : state(i + 1);
    concave_to_[i] = !is_last && slope_[i + 1] <= slope_[i] + slack ? concave_to_[i + 1] : state(i + 1);
  }
}

template class FluxPolygon<Instantiated>;

}  // namespace shearfront
