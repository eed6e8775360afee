// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/track/pieces.hpp"
#include "shearfront/track/solid_profile.hpp"

namespace shearfront {

/// The initial state of a scene cut at jumps and interfaces: for each piece its layer, its top and phi / c.
template <Real Scalar>
struct InitialPieces {
  std::vector<LayerState<Scalar>> states;  ///< one per piece, bottom to top
  std::vector<Scalar> tops;
};

/// A smooth start as steps of the states of a grid.
template <Real Scalar>
struct StartSteps {
  std::vector<Piece<Scalar>> pieces;
  InitialPieces<Scalar> initial;  ///< the same by their shares
  Scalar distance{0};             ///< int |phi of the start - phi of the steps| dz
};

/// Calls found(layer, lo, hi) for every stretch of the bed, bottom to top, in which the start and its slope are monotone.
template <Real Scalar, class Found>
void for_stretches(const Scene<Scalar>& scene, const LayerStack<Scalar>& stack, const Found& found) {
  const std::vector<Scalar> knots = scene.initial_knots();
  auto knot = knots.begin();
  for (std::size_t k = 0; k < stack.n_layers(); ++k) {
    Scalar from = stack.boundary(k);
    for (; knot != knots.end() && *knot < stack.boundary(k + 1); ++knot) {
      if (*knot > from) found(k, from, *knot);
      from = std::max(from, *knot);
    }
    found(k, from, stack.boundary(k + 1));
  }
}

/// States that a smooth start has on a whole stretch: a grid should have them. Cost: O(layers + knots).
template <Real Scalar>
[[nodiscard]] std::vector<LayerState<Scalar>> plateaus(const Scene<Scalar>& scene,
                                                       const LayerStack<Scalar>& stack) {
  std::vector<LayerState<Scalar>> all;
  for_stretches(scene, stack, [&](std::size_t k, const Scalar& lo, const Scalar& hi) {
    const Scalar share = scene.initial_share(lo);
    if (share != scene.initial_share(hi)) return;
    if (all.empty() || all.back().layer != k || all.back().phi != share) all.push_back({k, share});
  });
  return all;
}

/// The start by steps between neighbouring states of the grid.
///
/// Where phi runs from one state of the grid to the next, over a height w, one step stands for it, at the height at which it
/// holds the same amount of grains. So the steps have the mass of the start to rounding; they differ from it by at most the
/// spacing of the states, in L1 by at most a half of that times the height of the bed, and in M by at most the spacing times
/// w / 4. Entropy solutions do not move apart in L1: what the distance is at the start bounds it for ever.
/// Cost: O((steps + layers + knots) * log states).
template <Real Scalar, class Grid>
class StartStepper {
 public:
  StartStepper(const Scene<Scalar>& scene, const LayerStack<Scalar>& stack, const Grid& grid)
      : scene_(scene), stack_(stack), grid_(grid), has_smooth_c_(has_smooth_solid_fraction(scene)) {}

  [[nodiscard]] StartSteps<Scalar> run() {
    for_stretches(scene_, stack_, [&](std::size_t k, const Scalar& lo, const Scalar& hi) {
      if (k != layer_ || result_.pieces.empty()) set_layer(k);
      stretch(lo, hi);
    });
    result_.distance = distance_.value();
    return std::move(result_);
  }

 private:
  void set_layer(std::size_t k) {
    layer_ = k;
    c_ = stack_.solid_fraction(k);
    const State last = grid_.n_states(k) - 1;
    is_falling_ = grid_.phi(k, 0) > grid_.phi(k, last);
    // A grid may have indices beyond the ends of the range of states; they repeat the end.
    first_ = 0;
    last_ = last;
    State beyond = last;
    while (beyond - first_ > 1) {
      const State i = first_ + (beyond - first_) / 2;
      (grid_.phi(k, i) == grid_.phi(k, 0) ? first_ : beyond) = i;
    }
    State before = first_;
    while (last_ - before > 1) {
      const State i = before + (last_ - before) / 2;
      (grid_.phi(k, i) == grid_.phi(k, last) ? last_ : before) = i;
    }
  }
  [[nodiscard]] Scalar phi(State i) const { return grid_.phi(layer_, i); }
  [[nodiscard]] Scalar share(State i) const { return phi(i) / c_; }
  [[nodiscard]] Scalar start(const Scalar& z) const { return c_ * scene_.initial_share(z); }
  /// The state next to phi, none less (or none more) than it.
  [[nodiscard]] State beside(const Scalar& value, bool is_above) const {
    // By ranks that rise with phi.
    const auto index = [&](State rank) { return is_falling_ ? last_ - (rank - first_) : rank; };
    State lo = first_, hi = last_;
    if (!(value > phi(index(lo)))) return index(lo);
    if (!(value < phi(index(hi)))) return index(hi);
    while (hi - lo > 1) {
      const State rank = lo + (hi - lo) / 2;
      const Scalar here = phi(index(rank));
      if (here == value) return index(rank);
      (here < value ? lo : hi) = rank;
    }
    return index(is_above ? hi : lo);
  }

  void stretch(const Scalar& lo, const Scalar& hi) {
    const Scalar low = start(lo), high = start(hi);
    const bool rises = high > low;
    if (low == high) {
      const State below = beside(low, false), above = beside(low, true);
      return add_level(lo, hi, low - phi(below) < phi(above) - low ? below : above);
    }
    State state = beside(low, !rises);
    const State end = beside(high, rises);
    const State next = (end > state) ? 1 : -1;
    if (state == end) return add_level(lo, hi, state);
    Scalar from = lo;
    while (state != end) {
      const State beyond = state + next;
      const Scalar to = beyond == end ? hi : std::max(from, where(phi(beyond), from, hi, rises));
      step(from, to, state, beyond);
      from = to;
      state = beyond;
    }
  }
  /// Where the start, monotone on (lo, hi), has a value.
  [[nodiscard]] Scalar where(const Scalar& value, Scalar lo, Scalar hi, bool rises) const {
    for (;;) {
      const Scalar z = lo + (hi - lo) / Scalar(2);
      if (!(z > lo && z < hi)) return hi;
      const Scalar here = start(z);
      if (here == value) return z;
      ((here < value) == rises ? lo : hi) = z;
    }
  }
  /// One state from `lo` to `hi`, for a start that is on one side of it.
  void add_level(const Scalar& lo, const Scalar& hi, State i) {
    const Scalar more = scene_.initial_amount(lo, hi) - share(i) * scene_.solid(lo, hi);
    distance_ += more < 0 ? Scalar(-more) : more;
    add(place_of(hi), i);
  }
  /// From state i at `lo` to state k at `hi`: share_i S_i + share_k (S - S_i) = amount, S what the bed holds.
  void step(const Scalar& lo, const Scalar& hi, State i, State k) {
    if (!(hi > lo)) return;
    const Scalar below = share(i), above = share(k), amount = scene_.initial_amount(lo, hi),
                 solid = scene_.solid(lo, hi);
    const Scalar part = std::clamp(Scalar((above - amount / solid) / (above - below)), Scalar(0), Scalar(1));
    const Scalar z = std::clamp(Scalar(lo + (hi - lo) * part), lo, hi);  // to the second order where c varies
    const Scalar more = scene_.initial_amount(lo, z) - below * scene_.solid(lo, z);
    distance_ += Scalar(2) * (more < 0 ? Scalar(-more) : more);
    const Scalar from = place_of(lo), to = place_of(hi);
    add(std::clamp(Scalar(from + (to - from) * part), from, to), i);
    add(to, k);
  }
  /// Where the tracker has a height, its layer having the mean of c: below it the layer holds as much as the bed does.
  [[nodiscard]] Scalar place_of(const Scalar& z) const {
    const Scalar &bottom = stack_.boundary(layer_), &top = stack_.boundary(layer_ + 1);
    if (!has_smooth_c_ || !(z < top) || !(z > bottom)) return z;
    return std::clamp(Scalar(bottom + scene_.solid(bottom, z) / c_), bottom, top);
  }
  void add(const Scalar& top, State i) {
    auto& pieces = result_.pieces;
    if (!(top > (pieces.empty() ? stack_.bottom() : pieces.back().top))) return;
    if (!pieces.empty() && pieces.back().layer == layer_ && pieces.back().state == i) {
      pieces.back().top = top;
      result_.initial.tops.back() = top;
      return;
    }
    pieces.push_back({layer_, top, i});
    result_.initial.states.push_back({layer_, share(i)});
    result_.initial.tops.push_back(top);
  }

  const Scene<Scalar>& scene_;
  const LayerStack<Scalar>& stack_;
  const Grid& grid_;
  std::size_t layer_ = 0;
  Scalar c_{1};
  bool has_smooth_c_, is_falling_ = false;
  State first_ = 0, last_ = 0;
  StartSteps<Scalar> result_;
  CompensatedSum<Scalar> distance_;
};

}  // namespace shearfront
