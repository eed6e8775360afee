// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>

#include "shearfront/exact/first_wave.hpp"
#include "shearfront/exact/sloped_medium.hpp"

namespace shearfront::exact {

/// First time at which phi next to boundary i of sloped pieces (1 <= i < pieces) leaves its initial states phi_b | phi_a.
///
///   * 0 if the boundary sends out a wave, or if a state next to it is neither 0 nor 1 and its piece is not flat: there it
///     changes at once.
///   * Between pure states at rest nothing is faster than H = 0: the travel time of the nearest other state on the side that a
///     state comes from.
///   * Between flat pieces M(z_i, t) = M0 + H0 t until the edge of a fan comes, the characteristic of a state followed back to
///     the first point that is not at rest, or a shock, which makes M less than that.
///
/// Empty if nothing ever comes. Error: a few u; of a shock u (top - bottom) over the change of H, unless one comes, leaves and comes back
/// within a 2^-7 part of the time.
template <Real Scalar>
class SlopedArrival {
 public:
  SlopedArrival(const SlopedMedium<Scalar>& medium, std::size_t i)
      : medium_(medium), cells_(medium.cells()), at_(cells_.first[i]), z_(cells_.x[at_]) {}

  [[nodiscard]] std::optional<Scalar> find() const {
    if (!is_at_rest(at_)) return Scalar(0);
    const bool is_pure = h(at_ - 1) == 0;
    const Scalar first = is_pure ? of_pure_states() : of_flat_pieces();
    if (!is_finite(first)) return std::nullopt;
    return first;
  }

 private:
  [[nodiscard]] bool is_flat(std::size_t cell) const {
    const std::size_t k = cells_.layer[cell];
    return medium_.pieces().low[k] == medium_.pieces().high[k];
  }
  [[nodiscard]] Scalar rate(std::size_t cell, bool is_high) const {
    const std::size_t k = cells_.layer[cell];
    return medium_.pieces().rate(k, cells_.x[is_high ? cell + 1 : cell]);
  }
  /// Positive if its waves go up.
  [[nodiscard]] const Scalar& q(std::size_t cell) const { return medium_.view(false).q0[cell]; }
  /// 4 H of a state that keeps it: pure, or in a flat piece.
  [[nodiscard]] Scalar h(std::size_t cell) const { return medium_.view(false).h(cell, rate(cell, false)); }
  [[nodiscard]] bool stays(std::size_t cell) const {
    return !cells_.is_curved(cell) && (cells_.phi[cell] == 0 || cells_.phi[cell] == 1 || is_flat(cell));
  }
  /// No wave leaves this inner point at t = 0, and the states beside it stay what they are.
  [[nodiscard]] bool is_at_rest(std::size_t point) const {
    const std::size_t b = point - 1, a = point;
    if (!stays(b) || !stays(a)) return false;
    const Scalar r_b = rate(b, true), r_a = rate(a, false), h_b = h(b), h_a = h(a);
    if (!medium_.view(false).is_jump(point) && cells_.phi[b] == cells_.phi[a]) return true;
    const Scalar passing = std::min(q(b) > 0 ? h_b : r_b, q(a) < 0 ? h_a : r_a);
    return is_same_flux<Scalar>(h_b, passing) && is_same_flux<Scalar>(h_a, passing);
  }

  [[nodiscard]] Scalar of_pure_states() const {
    Scalar first = infinity<Scalar>();
    if (cells_.phi[at_ - 1] == 1) {
      std::size_t c = at_ - 1;
      while (c > 0 && cells_.phi[c - 1] == 1 && !cells_.is_curved(c - 1)) --c;
      if (c > 0) first = medium_.pure_travel_time(cells_.x[c], z_);
    }
    if (cells_.phi[at_] == 0) {
      std::size_t c = at_;
      while (c + 1 < cells_.n_cells() && cells_.phi[c + 1] == 0 && !cells_.is_curved(c + 1)) ++c;
      if (c + 1 < cells_.n_cells()) first = std::min(first, medium_.pure_travel_time(cells_.x[c + 1], z_));
    }
    return first;
  }

  [[nodiscard]] Scalar of_flat_pieces() const {
    const Scalar H0 = h(at_ - 1) / Scalar(4);
    // M is no more than either final amount.
    Scalar first = (std::min(Scalar(z_ - medium_.bottom()), medium_.mass()) - cells_.M[at_]) / H0;
    for (const bool is_upward : {true, false}) first = std::min(first, edge(is_upward));
    const Scalar tie = Scalar(64) * unit_roundoff<Scalar>() * (medium_.top() - medium_.bottom());
    const auto is_changed = [&](const Scalar& z, const Scalar& t) {
      const Scalar change = medium_.best_path(z, t).value - (cells_.cumulative(z) + H0 * t);
      return change > tie || change < -tie;  // more is where the states at rest do not come from any longer
    };
    // What changes z comes from an end of the flat pieces at rest around it. Starts do not cross: between z and a place that has not changed at
    // a time nothing has, and from beyond nothing is faster than a pure state. So z is known to stay for a while; how near such places
    // are found decides how long.
    const Scalar &lowest = cells_.x[end_of_rest(false)], &highest = cells_.x[end_of_rest(true)];
    const Scalar half(0.5), one(1), narrow = first / Scalar(1 << 14);
    Scalar t(0), part = one;
    constexpr int kMost = 2000, kSamples = 200;
    for (int n = 0; n < kMost && t < first; ++n) {
      Scalar stays = infinity<Scalar>();
      bool is_kept = true;
      for (const Scalar* end : {&lowest, &highest}) {
        const Scalar place = z_ + (*end - z_) * part;
        is_kept = is_kept && !(t > 0 && is_changed(place, t));
        stays = std::min(stays, medium_.pure_travel_time(place, z_));
      }
      if (is_kept) {
        t += stays;
        part = std::min(one, Scalar(part + part));
        continue;
      }
      part *= half;
      if (stays > narrow) continue;
      // Nearly there.
      Scalar lo = t, hi = t;
      for (Scalar by = stays; by < first / Scalar(128); by += by) {
        hi = std::min(first, Scalar(hi + by));
        if (is_changed(z_, hi)) return crossing(lo, hi, is_changed);
        lo = hi;
      }
    }
    // Next to a shock that hardly moves.
    const Scalar rest = std::max(Scalar(0), Scalar(first - t)) / Scalar(kSamples);
    for (int n = 0; n < kSamples && rest > 0; ++n, t += rest)
      if (is_changed(z_, Scalar(t + rest))) return crossing(t, Scalar(t + rest), is_changed);
    return first;
  }
  /// The outermost point of the flat pieces at rest on one side.
  [[nodiscard]] std::size_t end_of_rest(bool is_above) const {
    std::size_t point = at_;
    do {
      is_above ? ++point : --point;
    } while (point > 0 && point + 1 < cells_.x.size() && is_at_rest(point));
    return point;
  }
  template <class IsChanged>
  [[nodiscard]] Scalar crossing(Scalar lo, Scalar hi, const IsChanged& is_changed) const {
    while (hi - lo > Scalar(4) * unit_roundoff<Scalar>() * hi) {
      const Scalar t = lo + (hi - lo) / Scalar(2);
      if (!(t > lo && t < hi)) break;
      (is_changed(z_, t) ? hi : lo) = t;
    }
    return hi;
  }
  /// When the end of the state on one side comes; never if the state does not come from there.
  [[nodiscard]] Scalar edge(bool is_upward) const {
    Scalar time(0);
    for (std::size_t point = at_;;) {
      const std::size_t c = is_upward ? point - 1 : point;
      const Scalar over = is_upward ? q(c) : Scalar(-q(c));
      if (!(over > 0)) return point == at_ ? infinity<Scalar>() : time;
      time += (cells_.x[c + 1] - cells_.x[c]) / medium_.speed(c, rate(c, false));
      is_upward ? --point : ++point;
      if (point == 0 || point + 1 == cells_.x.size() || !is_at_rest(point)) return time;
    }
  }

  const SlopedMedium<Scalar>& medium_;
  const Cells<Scalar>& cells_;
  std::size_t at_;
  Scalar z_;
};

}  // namespace shearfront::exact
