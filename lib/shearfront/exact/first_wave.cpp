// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/first_wave.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <algorithm>

namespace shearfront::exact {

namespace {

/// Search for the first wave at one interface that is at rest with flux H0.
template <Real Scalar>
class Arrival {
 public:
  Arrival(const LayeredMedium<Scalar>& medium, std::size_t i, const Scalar& mass)
      : g_(medium.geometry()),
        cells_(medium.cells()),
        medium_(medium),
        i_(i),
        at_(cells_.first[i]),
        mass_(mass) {
    z_ = g_.layers.boundary(i);
    M0_ = cells_.M[at_];
    tie_ = Scalar(64) * unit_roundoff<Scalar>() * (g_.layers.top() - g_.layers.bottom());
  }

  std::optional<Scalar> find() {
    if (!at_rest(at_)) return Scalar(0);
    H0_ = std::min(cell_flux(at_ - 1), cell_flux(at_));
    for (const bool upward : {true, false}) {
      const std::size_t end = follow(upward);
      if (!(H0_ > 0)) continue;  // nothing is slower than H = 0
      fans(upward, end);
      states(upward, end);
    }
    if (H0_ > 0) {
      waits();
      walls();
    }
    if (!is_finite(first_)) return std::nullopt;
    return first_;
  }

 private:
  Scalar cell_flux(std::size_t c) const {
    return g_.rate[cells_.layer[c]] * cells_.phi[c] * (Scalar(1) - cells_.phi[c]);
  }
  /// No moving wave leaves this inner point at t = 0. Fluxes computed from the data may differ by rounding.
  bool at_rest(std::size_t point) const {
    const Scalar half(0.5), one(1);
    const Scalar& b = cells_.phi[point - 1];
    const Scalar& a = cells_.phi[point];
    const Scalar& r_b = g_.rate[cells_.layer[point - 1]];
    const Scalar& r_a = g_.rate[cells_.layer[point]];
    if (r_b == r_a && b == a) return true;
    const Scalar pb = std::max(b, half), pa = std::min(a, half);
    const Scalar flux = std::min(Scalar(r_b * pb * (one - pb)), Scalar(r_a * pa * (one - pa)));
    const Scalar slack = Scalar(8) * unit_roundoff<Scalar>() * std::min(r_a, r_b);
    const auto equal = [&](const Scalar& H) { return H - flux <= slack && flux - H <= slack; };
    return equal(cell_flux(point - 1)) && equal(cell_flux(point));
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
      const Scalar& phi = cells_.phi[c];
      const Scalar q = upward ? phi + (phi - Scalar(1)) : (Scalar(1) - phi) - phi;
      if (!(q > 0)) return point;
      time += (cells_.x[c + 1] - cells_.x[c]) / (g_.rate[cells_.layer[c]] * q);
      upward ? --point : ++point;
      const bool wall = point == 0 || point + 1 == cells_.x.size();
      if (wall && phi == Scalar(upward ? 1 : 0)) return point;  // the wall's own state: never a wave
      if (wall || !at_rest(point)) {
        arrive(time);
        return point;
      }
    }
  }

  /// sum d q over the layers between z_i and x at H0; nothing if one of them cannot carry H0.
  std::optional<Scalar> path_Q(const Scalar& x, const Scalar& H) const {
    const Scalar& lo = std::min(x, z_);
    const Scalar& hi = std::max(x, z_);
    Scalar Q(0);
    for (std::size_t k = g_.layers.layer_at(lo); k < g_.layers.n_layers() && g_.layers.boundary(k) < hi;
         ++k) {
      const Scalar d = std::min(hi, g_.layers.boundary(k + 1)) - std::max(lo, g_.layers.boundary(k));
      if (!(d > 0)) continue;
      if (!(Scalar(4) * H < g_.rate[k])) return std::nullopt;
      Q += d * momentum_root<Scalar>(g_.rate[k] - Scalar(4) * H, g_.inverse_rate[k]);
    }
    return Q;
  }

  void fans(bool upward, std::size_t ray_end) {
    const std::size_t own = upward ? i_ - 1 : i_;
    Sweep<Scalar> sweep{upward, own, own, g_.height[own]};
    std::size_t point = at_;
    const std::size_t n = cells_.x.size();
    for (;;) {
      upward ? --point : ++point;
      if (point == 0 || point + 1 == n) return;
      const std::size_t layer = upward ? cells_.layer[point] : cells_.layer[point - 1];
      while (sweep.start != layer) sweep.cross(g_, g_.height[sweep.start]);
      if (!(sweep.T0 < first_)) return;
      const bool on_ray = upward ? point >= ray_end : point <= ray_end;
      if (!on_ray && medium_.emits(point, upward)) fan(sweep, point);
    }
  }

  void fan(const Sweep<Scalar>& sweep, std::size_t point) {
    const Scalar& x = cells_.x[point];
    const Scalar base = cells_.M[point] + (z_ - x) / Scalar(2);
    if (const auto Q = path_Q(x, H0_); Q && base + *Q / Scalar(2) - M0_ >= -tie_)
      return;  // never below the line
    const std::size_t j = sweep.start;
    const Scalar d = sweep.upward ? g_.layers.boundary(j + 1) - x : x - g_.layers.boundary(j);
    Scalar t = sweep.T0 + d * g_.inverse_rate[j];
    constexpr int kMaxIterations = 200;
    for (int n = 0; n < kMaxIterations; ++n) {
      if (!(t < first_)) return;
      const FanState<Scalar> state = solve_fan(g_, sweep, d, t, base, infinity<Scalar>());
      const Scalar H = state.reachable ? state.H : Scalar(0);
      const Scalar Q = state.reachable ? state.Q : (sweep.upward ? z_ - x : x - z_);
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
      const Scalar& phi = cells_.phi[c];
      const Scalar q = upward ? phi + (phi - Scalar(1)) : (Scalar(1) - phi) - phi;
      const Scalar H = cell_flux(c);
      if (!(q > 0) || !(H < H0_)) continue;
      const Scalar& near = upward ? cells_.x[c + 1] : cells_.x[c];
      const Scalar& far = upward ? cells_.x[c] : cells_.x[c + 1];
      const auto Q = path_Q(near, H);
      if (!Q) continue;
      const Scalar t1 = exact::travel_time(g_, near, z_, H);
      const Scalar t2 = t1 + (cells_.x[c + 1] - cells_.x[c]) / (g_.rate[cells_.layer[c]] * q);
      const Scalar gap = (upward ? cells_.M[c + 1] : cells_.M[c]) + ((z_ - near) + *Q) / Scalar(2) - M0_;
      const Scalar far_gap = (upward ? cells_.M[c] : cells_.M[c + 1]) +
                             ((z_ - far) + *Q + (cells_.x[c + 1] - cells_.x[c]) * q) / Scalar(2) - M0_;
      // On the window the gap is linear with slope H - H0; evaluated at its ends, then intersected.
      const Scalar g1 = gap - (H0_ - H) * t1, g2 = far_gap - (H0_ - H) * t2;
      if (g1 >= -tie_ && g2 < -tie_) arrive(g1 > 0 ? Scalar(t1 + (t2 - t1) * (g1 / (g1 - g2))) : t1);
    }
  }

  void waits() {
    for (std::size_t w = 1; w < g_.layers.n_layers(); ++w) {
      const Scalar H = std::min(g_.rate[w - 1], g_.rate[w]) / Scalar(4);
      if (w == i_ || !(H < H0_)) continue;
      const Scalar& z_w = g_.layers.boundary(w);
      const auto Q = path_Q(z_w, H);
      if (!Q) continue;
      const Scalar tau = exact::travel_time(g_, z_w, z_, H);
      for (const auto& entry : medium_.waiting().entries(w)) {
        const Scalar gap = entry.A + ((z_ - z_w) + *Q) / Scalar(2) - M0_;
        arrive(std::max(Scalar(gap / (H0_ - H)), Scalar(entry.tau + tau)));
      }
    }
  }

  void walls() {
    const Scalar& bottom = g_.layers.bottom();
    const Scalar& top = g_.layers.top();
    arrive(std::max(Scalar(((z_ - bottom) - M0_) / H0_), exact::travel_time(g_, bottom, z_, Scalar(0))));
    arrive(std::max(Scalar((mass_ - M0_) / H0_), exact::travel_time(g_, z_, top, Scalar(0))));
  }

  const Geometry<Scalar>& g_;
  const Cells<Scalar>& cells_;
  const LayeredMedium<Scalar>& medium_;
  std::size_t i_, at_;
  Scalar mass_, z_, M0_, tie_, H0_{0};
  Scalar first_ = infinity<Scalar>();
};

}  // namespace

template <Real Scalar>
std::optional<Scalar> first_wave(const LayeredMedium<Scalar>& medium, std::size_t i, const Scalar& mass) {
  return Arrival<Scalar>(medium, i, mass).find();
}

template std::optional<Instantiated> first_wave(const LayeredMedium<Instantiated>&, std::size_t,
                                                const Instantiated&);

}  // namespace shearfront::exact
