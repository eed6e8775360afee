// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>

#include "shearfront/exact/layered_medium.hpp"

namespace shearfront::exact {

/// Whether two fluxes computed from data are equal up to their rounding, to which each is known however small it is: traces of grains
/// move.
template <Real Scalar>
[[nodiscard]] bool is_same_flux(const Scalar& a, const Scalar& b) {
  const Scalar slack = Scalar(32) * unit_roundoff<Scalar>() * std::min(a, b);
  return a - b <= slack && b - a <= slack;
}

/// Search for the first wave at one interface.
template <Real Scalar, class Law>
class Arrival {
 public:
  Arrival(const LayeredMedium<Scalar, Law>& medium, std::size_t i)
      : medium_(medium),
        law_(medium.law()),
        cells_(medium.cells()),
        i_(i),
        at_(cells_.first[i]),
        z_(law_.boundary(i)),
        M0_(cells_.M[at_]),
        tie_(Scalar(64) * unit_roundoff<Scalar>() * (law_.top() - law_.bottom())) {}

  std::optional<Scalar> find() {
    if (cells_.is_curved(at_ - 1) || cells_.is_curved(at_) || !at_rest(at_)) return Scalar(0);
    H0_ = std::min(flux(at_ - 1), flux(at_));
    for (const bool upward : {true, false}) {
      const std::size_t end = follow(upward);
      if (!(H0_ > 0)) continue;  // nothing is slower than H = 0
      if (cells_.shape) continue;
      fans(upward, end);
      states(upward, end);
    }
    if (H0_ > 0) {
      if (!cells_.shape) waits();
      walls();
      if (cells_.shape) look_for_shocks();
    }
    if (!is_finite(first_)) return std::nullopt;
    return first_;
  }

 private:
  [[nodiscard]] Scalar flux(std::size_t cell) const { return medium_.h_cell(cell) / Scalar(4); }
  /// Of a state, positive if its waves go in the direction.
  [[nodiscard]] Scalar excess(std::size_t cell, bool upward) const {
    return law_.excess(cells_.layer[cell], cells_.phi[cell], upward);
  }
  [[nodiscard]] Scalar speed(std::size_t cell, bool upward, const Scalar& over) const {
    const std::size_t k = cells_.layer[cell];
    return law_.rate[k] * law_.steepness(k, upward, over);
  }
  /// No moving wave leaves this inner point at t = 0.
  [[nodiscard]] bool at_rest(std::size_t point) const {
    const std::size_t b = point - 1, a = point;
    const Scalar &r_b = law_.rate[cells_.layer[b]], &r_a = law_.rate[cells_.layer[a]];
    const bool is_same_layer = cells_.layer[b] == cells_.layer[a] || (!Law::kMovesAtCapacity && r_b == r_a);
    const Scalar &phi_b = cells_.beside(point, false), &phi_a = cells_.beside(point, true);
    if (is_same_layer && phi_b == phi_a) return true;
    const Scalar h_b = law_.h_of(cells_.layer[b], phi_b), h_a = medium_.h_cell(a);
    const Scalar sent = law_.excess(cells_.layer[b], phi_b, true) > 0 ? h_b : r_b,
                 taken = excess(a, false) > 0 ? h_a : r_a;
    const Scalar passing = std::min(sent, taken);
    return is_same_flux<Scalar>(h_b, passing) && is_same_flux<Scalar>(h_a, passing);
  }
  void arrive(const Scalar& t) {
    if (t < first_) first_ = t;
  }

  /// Follows the characteristic that brings the state of one side, back to the first point that is not at
  /// rest. Returns that point (the interface itself if the state is not brought from there).
  std::size_t follow(bool upward) {
    Scalar time(0);
    std::size_t point = at_;
    for (;;) {
      const std::size_t c = upward ? point - 1 : point;
      if (cells_.is_curved(c)) {
        arrive(time);
        return point;
      }
      const Scalar over = excess(c, upward);
      if (!(over > 0)) return point;
      time += (cells_.x[c + 1] - cells_.x[c]) / speed(c, upward, over);
      upward ? --point : ++point;
      const bool wall = point == 0 || point + 1 == cells_.x.size();
      if (wall && cells_.phi[c] == Scalar(upward ? 1 : 0))
        return point;  // the wall's own state: never a wave
      if (wall || !at_rest(point)) {
        arrive(time);
        return point;
      }
    }
  }

  void fans(bool upward, std::size_t ray_end) {
    const std::size_t own = upward ? i_ - 1 : i_;
    Sweep<Scalar> sweep{upward, own, own, law_.height[own]};
    std::size_t point = at_;
    const std::size_t n = cells_.x.size();
    for (;;) {
      upward ? --point : ++point;
      if (point == 0 || point + 1 == n) return;
      const std::size_t layer = upward ? cells_.layer[point] : cells_.layer[point - 1];
      while (sweep.start != layer) sweep.cross(law_, law_.height[sweep.start]);
      if (!(sweep.T0 < first_)) return;
      const bool on_ray = upward ? point >= ray_end : point <= ray_end;
      if (!on_ray && medium_.emits(point, upward)) fan(sweep, point);
    }
  }

  /// A fan's value is convex in t with slope H(t): it dips below M0 + H0 t only if it is below it where H(t) = H0.
  void fan(const Sweep<Scalar>& sweep, std::size_t point) {
    const Scalar& x = cells_.x[point];
    const Scalar base = cells_.M[point] + law_.peaks(x, z_);
    const Leg<Scalar> bound = leg_between<Scalar>(law_, x, z_, H0_);
    if (is_passable(x, H0_) && base + bound.Q / Scalar(2) - M0_ >= -tie_) return;  // never below the line
    const std::size_t j = sweep.start;
    const Scalar d = sweep.upward ? law_.boundary(j + 1) - x : x - law_.boundary(j);
    Scalar t = sweep.T0 + d * law_.pure_slowness(j, sweep.upward);
    constexpr int kMaxIterations = 200;
    for (int n = 0; n < kMaxIterations; ++n) {
      if (!(t < first_)) return;
      const FanState<Scalar> state = law_.solve_fan(sweep, d, t, base, infinity<Scalar>());
      const Scalar H = state.reachable ? state.H : Scalar(0);
      const Scalar Q = state.reachable ? state.Q : leg_between<Scalar>(law_, x, z_, Scalar(0)).Q;
      const Scalar gap = base + Q / Scalar(2) + H * t - M0_ - H0_ * t;
      if (!(gap > 0) || !(H < H0_)) break;
      const Scalar step = gap / (H0_ - H);
      t += step;
      if (step <= Scalar(4) * unit_roundoff<Scalar>() * t) break;
    }
    arrive(t);
  }

  /// Constant states with a flux below H0: value - (M0 + H0 t) is linear while the foot crosses the cell.
  void states(bool upward, std::size_t ray_end) {
    std::size_t point = at_;
    for (;;) {
      if (point == (upward ? 0 : cells_.n_cells())) return;
      const std::size_t c = upward ? point - 1 : point;
      upward ? --point : ++point;
      if (upward ? c >= ray_end : c < ray_end) continue;
      const Scalar over = excess(c, upward), H = flux(c);
      if (!(over > 0) || !(H < H0_)) continue;
      const Scalar& near = upward ? cells_.x[c + 1] : cells_.x[c];
      const Scalar& far = upward ? cells_.x[c] : cells_.x[c + 1];
      const Scalar width = cells_.x[c + 1] - cells_.x[c];
      const Leg<Scalar> beyond = leg_between<Scalar>(law_, near, z_, H);
      const Scalar t1 = H > 0 ? beyond.time : pure_travel_time<Scalar>(law_, near, z_);
      if (!is_finite(t1)) continue;
      const Scalar t2 = t1 + width / speed(c, upward, over);
      const Scalar gap =
          (upward ? cells_.M[c + 1] : cells_.M[c]) + (law_.peaks(near, z_) + beyond.Q / Scalar(2)) - M0_;
      const Scalar far_gap = (upward ? cells_.M[c] : cells_.M[c + 1]) +
                             (law_.peaks(far, z_) + (beyond.Q + width * over) / Scalar(2)) - M0_;
      // On the window the gap is linear with slope H - H0; evaluated at its ends, then intersected.
      const Scalar g1 = gap - (H0_ - H) * t1, g2 = far_gap - (H0_ - H) * t2;
      if (g1 >= -tie_ && g2 < -tie_) arrive(g1 > 0 ? Scalar(t1 + (t2 - t1) * (g1 / (g1 - g2))) : t1);
    }
  }

  void waits() {
    for (std::size_t w = 1; w < law_.n_layers(); ++w) {
      const Scalar H = std::min(law_.rate[w - 1], law_.rate[w]) / Scalar(4);
      if (w == i_ || !(H < H0_)) continue;
      const Scalar& z_w = law_.boundary(w);
      const Leg<Scalar> way = leg_between<Scalar>(law_, z_w, z_, H);
      if (!is_finite(way.time)) continue;
      for (const auto& entry : medium_.waiting().entries(w)) {
        const Scalar gap = entry.A + (law_.peaks(z_w, z_) + way.Q / Scalar(2)) - M0_;
        arrive(std::max(Scalar(gap / (H0_ - H)), Scalar(entry.tau + way.time)));
      }
    }
  }

  void walls() {
    arrive(std::max(Scalar(((z_ - law_.bottom()) - M0_) / H0_),
                    pure_travel_time<Scalar>(law_, law_.bottom(), z_)));
    arrive(std::max(Scalar((medium_.mass() - M0_) / H0_), pure_travel_time<Scalar>(law_, law_.top(), z_)));
  }

  /// Of paths from curved cells: where M is first less than M0 + H0 t. Some may leave again between two samples.
  void look_for_shocks() {
    if (!is_finite(first_)) return;
    const auto is_changed = [&](const Scalar& t) {
      return medium_.best_path(z_, t).value < M0_ + H0_ * t - tie_;
    };
    constexpr int kSamples = 200;
    for (int n = 1; n <= kSamples; ++n) {
      Scalar hi = first_ * (Scalar(n) / Scalar(kSamples)), lo = first_ * (Scalar(n - 1) / Scalar(kSamples));
      if (!(hi > 0) || !is_changed(hi)) continue;
      while (hi - lo > Scalar(4) * unit_roundoff<Scalar>() * hi) {
        const Scalar t = lo + (hi - lo) / Scalar(2);
        if (!(t > lo && t < hi)) break;
        (is_changed(t) ? hi : lo) = t;
      }
      return arrive(hi);
    }
  }

  [[nodiscard]] bool is_passable(const Scalar& x, const Scalar& H) const {
    bool passable = true;
    law_.for_each_layer(
        x, z_, [&](const Scalar&, std::size_t k) { passable = passable && !(law_.rate[k] < Scalar(4) * H); });
    return passable;
  }

  const LayeredMedium<Scalar, Law>& medium_;
  const Law& law_;
  const Cells<Scalar>& cells_;
  std::size_t i_, at_;
  Scalar z_, M0_, tie_, H0_{0};
  Scalar first_ = infinity<Scalar>();
};

/// First time at which phi next to interface i (1 <= i < n_layers) leaves its initial states phi_b | phi_a.
///
///   * 0 if the Riemann problem of the two states sends out a wave, i.e. unless both have the flux
///     H0 = min(what the lower layer can send up, what the upper one can take).
///   * Otherwise M(z_i, t) = M0 + H0 t until the first of
///       - the edge of a fan: the characteristic of the state itself, followed back through interfaces at rest to the
///         first point that is not, a travel time in closed form;
///       - a shock: the first root of value(t) = M0 + H0 t over all other paths, for fans by Newton from their first
///         arrival, which increases to the root.
/// Empty if nothing ever arrives. Error: a few u. Cost: O(layers) per point.
template <Real Scalar, class Law>
[[nodiscard]] std::optional<Scalar> first_wave(const LayeredMedium<Scalar, Law>& medium, std::size_t i) {
  return Arrival<Scalar, Law>(medium, i).find();
}

}  // namespace shearfront::exact
