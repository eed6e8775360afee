// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/path_gradient.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/exact/exponential_path.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

namespace {

/// One straight run of a layered path through consecutive layers.
template <Real Scalar>
class Legs {
 public:
  Legs(const Geometry<Scalar>& g, const Path<Scalar>& path, std::size_t end, LayeredGradient<Scalar>& out)
      : g_(g), path_(path), end_(end), out_(out) {}

  [[nodiscard]] Scalar q(std::size_t k) const {
    return momentum_root<Scalar>((g_.rate[k] - path_.r_reference) + path_.r_reference * path_.x * path_.x,
                                 g_.inverse_rate[k]);
  }

  /// Adds the run between two heights: dM/dr_k, and into the phi entries dT/d(.), to be turned into dphi
  /// later.
  void add(const Scalar& z1, const Scalar& z2) {
    const Scalar& lo = std::min(z1, z2);
    const Scalar& hi = std::max(z1, z2);
    std::size_t below = kNone;
    for (std::size_t k = g_.layers.layer_at(lo); k < g_.layers.n_layers() && g_.layers.boundary(k) < hi;
         ++k) {
      const Scalar d = std::min(hi, g_.layers.boundary(k + 1)) - std::max(lo, g_.layers.boundary(k));
      if (!(d > 0)) continue;
      const Scalar& ir = g_.inverse_rate[k];
      const Scalar qk = q(k), slowness = ir / qk;
      // d / (r^2 q^3) times the fastest rate, as all derivatives of T here: their ratios are what counts.
      const Scalar steep = d * slowness * (g_.fastest * ir) / (qk * qk);
      auto& rate = out_.rates[k - out_.first];
      rate.M += d * slowness * path_.H * ir;
      rate.phi -= steep * (Scalar(1) + qk * qk) / Scalar(2);
      (k == end_ ? steep_end : steep_others) += steep;
      time += d * slowness;
      if (below != kNone) cross(below, k);
      below = k;
    }
  }
  [[nodiscard]] Scalar T_H() const { return Scalar(2) * (steep_end + steep_others); }
  /// Momentum of a path that leaves a height in layer k upwards (downwards).
  [[nodiscard]] StartMomentum<Scalar> momentum(std::size_t k, bool upward) const {
    const Scalar qk = q(k), large = (Scalar(1) + qk) / Scalar(2);
    const Scalar small = Scalar(2) * path_.H * g_.inverse_rate[k] / (Scalar(1) + qk);
    return upward ? StartMomentum<Scalar>{large, small} : StartMomentum<Scalar>{small, large};
  }

  Scalar steep_end{0}, steep_others{0}, time{0};

 private:
  /// The boundary between layers b and a = b + 1: differences of q and of 1 / (r q) in conjugate form, so
  /// that nearly equal layers lose nothing.
  void cross(std::size_t b, std::size_t a) {
    const Scalar &r_b = g_.rate[b], &r_a = g_.rate[a], &ir_b = g_.inverse_rate[b], &ir_a = g_.inverse_rate[a];
    const Scalar q_b = q(b), q_a = q(a), two(2);
    auto& boundary = out_.boundaries[a - out_.first];
    boundary.M += two * (path_.H * ir_a) * ((r_b - r_a) * ir_b) / (q_a + q_b);
    const Scalar s_b = g_.fastest * ir_b / q_b, s_a = g_.fastest * ir_a / q_a;
    if (r_a > two * r_b || r_b > two * r_a) {
      boundary.phi += s_b - s_a;
    } else {
      const Scalar ratio = r_a * ir_b;  // of order 1, as is everything below
      boundary.phi += s_b * ((r_a - r_b) * ir_b) * (ratio + q_b * q_b) / (ratio * q_a * (ratio * q_a + q_b));
    }
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const Geometry<Scalar>& g_;
  const Path<Scalar>& path_;
  std::size_t end_;
  LayeredGradient<Scalar>& out_;
};

}  // namespace

template <Real Scalar>
LayeredGradient<Scalar> path_gradient(const LayeredMedium<Scalar>& medium, const Path<Scalar>& path,
                                      const Scalar& z, const Scalar& t) {
  using Pair = typename LayeredGradient<Scalar>::Pair;
  LayeredGradient<Scalar> out;
  if (path.kind == PathKind::bottom_wall || path.kind == PathKind::top_wall || path.kind == PathKind::none)
    return out;
  const Geometry<Scalar>& g = medium.geometry();
  const std::size_t end = g.layers.layer_at(z);
  const bool waits = path.kind == PathKind::waiting;
  std::size_t lowest = std::min(end, g.layers.layer_at(path.foot)),
              highest = std::max(end, g.layers.layer_at(path.foot));
  if (waits) {
    lowest = std::min(lowest, path.interface - 1);
    highest = std::max(highest, path.interface);
  }
  if (lowest > 0 && (path.foot == g.layers.boundary(lowest) || z == g.layers.boundary(lowest))) --lowest;
  out.first = lowest;
  out.rates.resize(highest - lowest + 1);
  out.boundaries.resize(highest - lowest + 1);
  Legs<Scalar> legs(g, path, end, out);
  const Scalar& r_end = g.rate[end];
  const Scalar q_end = legs.q(end), half(0.5);
  const Scalar sign = path.upward ? half : -half;  // phi = 1/2 + sign q_end
  // d phi = sign dq, 2 q dq = -4 dH / r + 4 H dr / r^2.
  const Scalar from_H = q_end > 0 ? Scalar(-Scalar(2) * sign / (r_end * q_end)) : Scalar(0);
  const Scalar from_r = -from_H * path.H / r_end;

  if (waits) {
    const std::size_t w = path.interface;
    const Scalar& z_w = g.layers.boundary(w);
    legs.add(path.foot, z_w);
    legs.add(z_w, z);
    for (Pair& pair : out.rates) pair.phi = Scalar(0);
    for (Pair& pair : out.boundaries) pair.phi = Scalar(0);
    const std::size_t slow = g.rate[w] <= g.rate[w - 1] ? w : w - 1, fast = slow == w ? w - 1 : w;
    out.rates[slow - lowest].M += (t - legs.time) / Scalar(4);
    out.rates[slow - lowest].phi += from_H / Scalar(4);
    out.rates[end - lowest].phi += from_r;
    const Scalar q = legs.q(fast), outwards = fast < w ? Scalar(1) : Scalar(-1);
    const bool comes = path.foot != z_w, goes = z != z_w;
    if (comes && goes) out.boundaries[w - lowest].M += outwards * q;
    if (comes) {
      const std::size_t from = medium.cells().layer[fast < w ? path.source : path.source - 1];
      out.start = legs.momentum(from, fast < w);
    }
    // A source at the interface itself: the start of the way back is what moves.
    if (!comes && goes) out.start = legs.momentum(fast, fast > w - 1);
    return out;
  }
  if (path.kind == PathKind::constant) {
    const std::size_t cell = path.source, c = medium.cells().layer[cell];
    const Scalar& phi0 = medium.cells().phi[cell];
    legs.add(path.foot, z);
    for (Pair& pair : out.rates) pair.phi = Scalar(0);
    for (Pair& pair : out.boundaries) pair.phi = Scalar(0);
    if (c == end) {
      // One layer: dM/dr with phi0 (1 - phi0) t also where the path stands still, phi0 = 1/2.
      out.rates[c - lowest].M = phi0 * (Scalar(1) - phi0) * t;
      out.phi_state = Scalar(1);
    } else {
      out.rates[c - lowest].phi += from_H * phi0 * (Scalar(1) - phi0);
      out.rates[end - lowest].phi += from_r;
      out.phi_state = from_H * g.rate[c] * ((Scalar(1) - phi0) - phi0);
    }
    return out;
  }
  const std::size_t i = path.source;
  const std::size_t start = path.upward ? medium.cells().layer[i] : medium.cells().layer[i - 1];
  if (start == end) {  // one layer: phi = 1/2 + (z - x) / (2 r t)
    const Scalar v = (z - path.foot) / (r_end * t);
    out.rates[end - lowest].M = t * path.H / r_end;
    out.rates[end - lowest].phi = -v / (Scalar(2) * r_end);
    out.start = legs.momentum(start, path.upward);
    out.phi_start = Scalar(-1) / (Scalar(2) * r_end * t);
    out.phi_log_scale = -v / Scalar(2);
    return out;
  }
  legs.add(path.foot, z);
  out.start = legs.momentum(start, path.upward);
  const Scalar T_H = legs.T_H(), turn = -from_H / T_H;  // dH = -dT / T_H
  const Scalar direction = path.upward ? Scalar(1) : Scalar(-1);
  out.phi_start = -direction * (g.fastest * g.inverse_rate[start]) / legs.q(start) * turn;
  out.phi_log_scale = (from_H * g.fastest) * (t / T_H);
  for (Pair& pair : out.rates) pair.phi *= turn;
  for (Pair& pair : out.boundaries) pair.phi *= turn;
  // dq through H and through r_end itself nearly cancel where the end layer is close to its capacity: their
  // sum is 2 q dq = ((1 - q^2) (steep of the others) - 2 q^2 steep_end) / (r_end steep) dr_end.
  if (q_end > 0)
    out.rates[end - lowest].phi =
        sign *
        (Scalar(4) * path.H / r_end * (legs.steep_others / q_end) - Scalar(2) * q_end * legs.steep_end) /
        (r_end * T_H);
  return out;
}

namespace {

/// (1 + x) log(1 + x) - x for x >= -1 without cancellation: sum (-1)^n x^n / (n (n - 1)), n >= 2.
template <Real Scalar>
Scalar entropy_excess(const Scalar& x) {
  using std::log1p;
  const Scalar size = x < 0 ? Scalar(-x) : x;
  if (size > Scalar(0.125)) {
    if (!(x > -1)) return Scalar(1);
    return (Scalar(1) + x) * log1p(x) - x;
  }
  Scalar power = x * x, sum(0);
  for (int n = 2; n < 400; ++n) {
    const Scalar term = power / Scalar(n * (n - 1));
    sum += term;
    const Scalar term_size = term < 0 ? Scalar(-term) : term;
    if (term_size <= unit_roundoff<Scalar>() * sum * Scalar(0.25)) break;
    power *= -x;
  }
  return sum;
}

}  // namespace

template <Real Scalar>
ExponentialGradient<Scalar> path_gradient(const ExponentialMedium<Scalar>& medium, const Path<Scalar>& path,
                                          const Scalar& z, const Scalar& t) {
  using std::expm1;
  ExponentialGradient<Scalar> out;
  if (path.kind != PathKind::fan && path.kind != PathKind::constant) return out;
  const Scalar one(1), two(2), four(4);
  const Scalar& lambda = medium.decay();
  const Scalar& x = path.foot;
  const Scalar B = medium.rate_at(x) * t / lambda;
  Scalar p0, one_minus_p0;
  if (path.kind == PathKind::fan) {
    const Scalar log_E = (z - x) / lambda, e = expm1(log_E);
    const FanMomenta<Scalar> fan(B, log_E, e);
    const Scalar& E = fan.E;
    p0 = fan.p0;
    one_minus_p0 = fan.one_minus_p0;
    // p = 1/2 + (E - S) / B: with d p / d log B = E (1 - S) / (S B) the sum of both logarithmic derivatives
    // is E / (2 S B), which keeps them apart from their rounding.
    const Scalar by_B = -E * ((e / B + B / four) / fan.S / (one + fan.S));
    const Scalar by_both = E / (two * B) / fan.S;
    out.start = {p0, one_minus_p0};
    out.phi_start = -by_both / lambda;
    out.phi_log_rate = by_B;
    out.phi_decay = (by_B * (z - lambda) - by_both * (z - x)) / (lambda * lambda);
  } else {
    p0 = medium.cells().phi[path.source];
    one_minus_p0 = one - p0;
    const Scalar b = medium.rate_at(z) * t / lambda, h = p0 * one_minus_p0, twist = p0 + (p0 - one);
    const FootRoot<Scalar> root(b, p0);
    const Scalar& E = root.E;
    const Scalar F_E = two * b * b * h * E + (one - b * twist);
    const Scalar F_b = two * b * h * E * E - twist * E;
    const Scalar F_p = -b * b * twist * E * E - two * b * E;
    const Scalar p_b = -h * (E - b * F_b / F_E);  // p = p0 - b E h
    out.phi_log_rate = p_b * b;
    out.phi_decay = p_b * b * (z - lambda) / (lambda * lambda);
    // 1 + b E twist, by the equation of E without cancellation, and the change of E.
    out.phi_state = E + h * (b * E) * (b * E) + h * b * F_p / F_E;
  }
  const Scalar Ht = path.H * t;
  out.M_log_rate = Ht;
  // int z dt along the path, times H / lambda^2 = d(rate)/d(lambda) / rate integrated.
  const Scalar alpha = std::min(one, Scalar(B * one_minus_p0));
  out.M_decay = Ht * x / (lambda * lambda) -
                (p0 * entropy_excess(Scalar(-alpha)) - one_minus_p0 * entropy_excess(Scalar(B * p0)));
  return out;
}

#define SHEARFRONT_INSTANTIATE(Scalar)                                                                      \
  template LayeredGradient<Scalar> path_gradient(const LayeredMedium<Scalar>&, const Path<Scalar>&,         \
                                                 const Scalar&, const Scalar&);                             \
  template ExponentialGradient<Scalar> path_gradient(const ExponentialMedium<Scalar>&, const Path<Scalar>&, \
                                                     const Scalar&, const Scalar&);
SHEARFRONT_INSTANTIATE(Instantiated)
#undef SHEARFRONT_INSTANTIATE

}  // namespace shearfront::exact
