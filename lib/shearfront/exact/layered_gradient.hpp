// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/law.hpp"
#include "shearfront/exact/medium.hpp"

namespace shearfront::exact {

/// Sums over the layers a path crosses.
///
/// In a layer T = d / (r w); with b = bend and e = lack at its q, all derivatives of T here are multiplied by the
/// fastest rate (their ratios are what counts), so that with steep = fastest d b / (r^2 w^3)
///
///     T_H = 2 steep,   T_r = -fastest d / (r^2 w) - steep (1 - e) / 2,   d(path in the layer) = 1 / (r w).
template <Real Scalar, class Law>
class LayeredLegs {
 public:
  LayeredLegs(const Law& law, const Path<Scalar>& path, std::size_t end, PathGradient<Scalar>& out)
      : law_(law), path_(path), end_(end), out_(out) {}

  [[nodiscard]] Scalar q(std::size_t k, bool upward) const {
    return law_.q(k, upward,
                  Scalar((law_.rate[k] - path_.r_reference) + path_.r_reference * path_.x * path_.x));
  }

  /// Adds the run between two heights: dM/dr_k, and into the phi entries dT/d(.), to be turned into dphi
  /// later.
  void add(const Scalar& from, const Scalar& to) {
    const bool up = from < to;
    std::size_t below = kNone;
    Scalar q_below(0);
    law_.for_each_layer(from, to, [&](const Scalar& d, std::size_t k) {
      const Scalar& ir = law_.inverse_rate[k];
      const Scalar qk = q(k, up), w = law_.steepness(k, up, qk), slowness = ir / w;
      const Scalar e = law_.lack(k, up, qk);
      // d / (r^2 w^3) times the fastest rate; a path at the capacity of a smooth flux has none of it.
      const Scalar per_bend = d * slowness * (law_.fastest * ir) / (w * w);
      const Scalar steep = per_bend * law_.bend(k, up, qk);
      auto& number = out_.pieces[k - out_.first];
      // Where the path is at the capacity of the layer, its rest there accounts for the rate.
      if (e > 0 || path_.kind == PathKind::constant) {
        time += d * slowness;
        number.M += d * slowness * path_.H * ir;
      }
      number.phi -= per_bend * (w * w) + steep * (Scalar(1) - e) / Scalar(2);
      (k == end_ ? steep_end : steep_others) += steep;
      if (k == end_) time_end = d * slowness;
      if (below != kNone) {
        auto& boundary = out_.boundaries[k - out_.first];
        boundary.M += law_.q_change(below, k, up, q_below, qk, path_.H) / Scalar(2);
        boundary.phi += law_.slowness_change(below, k, up, q_below, qk);
      }
      below = k;
      q_below = qk;
    });
  }
  [[nodiscard]] Scalar T_H() const { return Scalar(2) * (steep_end + steep_others); }
  /// Momentum of a path that leaves a height in layer k upwards (downwards).
  [[nodiscard]] StartMomentum<Scalar> momentum(std::size_t k, bool upward) const {
    const Scalar qk = q(k, upward);
    const Scalar p = law_.momentum(k, upward, qk, path_.H);
    return {p, upward ? law_.loss(k, true, qk, path_.H) : Scalar(Scalar(1) - p)};
  }
  /// dp/dH at a place in layer k; 0 at the peak of a smooth flux, where p stays.
  [[nodiscard]] Scalar p_H(std::size_t k, bool upward) const {
    const Scalar w = law_.steepness(k, upward, q(k, upward));
    if (!(w > 0)) return Scalar(0);
    const Scalar slowness = law_.inverse_rate[k] / w;
    return upward ? Scalar(-slowness) : slowness;
  }
  /// Forgets dT: the H of the path does not come from T(H) = t.
  void clear_phi() {
    for (auto& pair : out_.pieces) pair.phi = Scalar(0);
    for (auto& pair : out_.boundaries) pair.phi = Scalar(0);
  }
  /// H is the capacity of layer `slow`, where the path spends the time the rest of it leaves.
  void add_rest(std::size_t slow, const Scalar& t) {
    clear_phi();
    out_.pieces[slow - out_.first].M += (t - time) / Scalar(4);
    const Scalar by_H = p_H(end_, path_.upward);
    out_.pieces[slow - out_.first].phi += by_H / Scalar(4);
    out_.pieces[end_ - out_.first].phi -= by_H * (path_.H * law_.inverse_rate[end_]);
  }

  Scalar steep_end{0}, steep_others{0}, time{0}, time_end{0};

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const Law& law_;
  const Path<Scalar>& path_;
  std::size_t end_;
  PathGradient<Scalar>& out_;
};

/// Derivatives along a path through layers. Cost: O(layers touched).
template <Real Scalar, class Law>
[[nodiscard]] PathGradient<Scalar> layered_gradient(const Law& law, const Cells<Scalar>& cells,
                                                    const Path<Scalar>& path, const Scalar& z,
                                                    const Scalar& t) {
  using Pair = typename PathGradient<Scalar>::Pair;
  PathGradient<Scalar> out;
  if (path.kind == PathKind::bottom_wall || path.kind == PathKind::top_wall || path.kind == PathKind::none)
    return out;
  const std::size_t end = law.layer_at(z), foot = law.layer_at(path.foot);
  std::size_t lowest = std::min(end, foot), highest = std::max(end, foot);
  if (path.kind == PathKind::waiting) {
    lowest = std::min(lowest, path.interface - 1);
    highest = std::max(highest, path.interface);
  }
  if (lowest > 0 && (path.foot == law.boundary(lowest) || z == law.boundary(lowest))) --lowest;
  out.first = lowest;
  out.pieces.resize(highest - lowest + 1);
  out.boundaries.resize(highest - lowest + 1);
  LayeredLegs<Scalar, Law> legs(law, path, end, out);
  const bool up = path.upward;
  const Scalar& r_end = law.rate[end];

  if (path.kind == PathKind::waiting) {
    const std::size_t w = path.interface;
    const Scalar& z_w = law.boundary(w);
    legs.add(path.foot, z_w);
    legs.add(z_w, z);
    legs.add_rest(law.rate[w] <= law.rate[w - 1] ? w : w - 1, t);
    const bool comes = path.foot != z_w, goes = z != z_w;
    const bool from_below = path.foot<z_w, goes_up = z> z_w;
    // Next to the interface, on the side the path comes from and the one it goes to.
    const auto beside = [&](bool above, bool upward) { return legs.momentum(above ? w : w - 1, upward); };
    if (comes) {
      out.start = legs.momentum(cells.layer[from_below ? path.source : path.source - 1], from_below);
      if (goes) {
        const auto in = beside(!from_below, from_below), back = beside(goes_up, goes_up);
        out.boundaries[w - lowest].M += from_below ? Scalar((Scalar(1) - back.p) - in.missing)
                                                   : Scalar((in.p - Scalar(1)) + back.missing);
      }
    } else if (goes) {  // a source at the interface itself: the start of the way back is what moves
      out.start = beside(goes_up, goes_up);
    }
    return out;
  }
  if (path.kind == PathKind::constant) {
    const std::size_t c = cells.layer[path.source];
    // Between the two speeds of a kinked peak a state may be as slow as it likes.
    const Scalar tie = Scalar(64) * unit_roundoff<Scalar>();
    const bool is_still = cells.is_curved(path.source) && law.steepness(c, up, Scalar(0)) > 0 &&
                          !(Scalar(4) * path.H < law.rate[c] * (Scalar(1) - tie));
    if (c == end) {  // one layer; H is that of the state also where the path stands still, at the peak
      out.pieces[c - lowest].M = path.H * law.inverse_rate[c] * t;
      out.phi_state = Scalar(1);
      if (!cells.is_curved(path.source)) return out;
      if (is_still) {  // at the peak
        out.phi_state = Scalar(0);
        return out;
      }
      // z = y + r v(u0(y)) t, v = -+steepness.
      const Scalar over = law.excess(c, cells.state(path.source, path.foot), up),
                   w = law.steepness(c, up, over), steep = t * cells.slope(path.source, path.foot),
                   v = up ? w : Scalar(-w);
      const Scalar all = Scalar(1) + steep * law.rate[c] * (Scalar(2) * law.bend(c, up, over));
      out.phi_state = Scalar(1) / all;
      out.pieces[c - lowest].phi = -steep * v / all;
      out.phi_log_scale = -steep * law.rate[c] * v / all;
      return out;
    }
    legs.add(path.foot, z);
    if (is_still) {
      legs.add_rest(c, t);
      return out;
    }
    const Scalar by_H = legs.p_H(end, up), over = law.excess(c, cells.state(path.source, path.foot), up);
    const Scalar H_state = law.rate[c] * law.steepness(c, up, over);
    // From a smooth start dH = dH at y + A (T_H dH + dT - dt), A = -u0' H_state^2.
    const Scalar A = -cells.slope(path.source, path.foot) * H_state * H_state,
                 all = Scalar(1) - A * legs.T_H() / law.fastest, turn = by_H * A / all;
    for (Pair& pair : out.pieces) pair.phi *= turn / law.fastest;
    for (Pair& pair : out.boundaries) pair.phi *= turn / law.fastest;
    out.pieces[c - lowest].phi += by_H / all * (path.H * law.inverse_rate[c]);
    out.pieces[end - lowest].phi -= by_H * (path.H * law.inverse_rate[end]);
    out.phi_state = by_H / all * (up ? Scalar(-H_state) : H_state);
    out.phi_log_scale = -turn * t;
    return out;
  }
  const std::size_t start = cells.layer[up ? path.source : path.source - 1];
  out.start = legs.momentum(start, up);
  if (path.foot == z) {  // a jump inside a layer, seen from its place: the path rests
    out.pieces[end - lowest].M = t * path.H * law.inverse_rate[end];
    if (!Law::kMovesAtCapacity) out.phi_start = Scalar(-1) / (Scalar(2) * r_end * t);
    return out;
  }
  legs.add(path.foot, z);
  if (path.x == 0) {  // faster than t even at the least capacity
    std::size_t slow = end;
    for (std::size_t k = std::min(start, end); k <= std::max(start, end); ++k)
      if (law.rate[k] < law.rate[slow]) slow = k;
    legs.add_rest(slow, t);
    return out;
  }
  const Scalar by_H = legs.p_H(end, up), T_H = legs.T_H();
  const Scalar turn = T_H > 0 ? Scalar(-by_H / T_H) : Scalar(0);  // dH = -dT / T_H
  const Scalar q_start = legs.q(start, up);
  const Scalar slowness = law.fastest * law.inverse_rate[start] / law.steepness(start, up, q_start);
  out.phi_start = (up ? Scalar(-slowness) : slowness) * turn;
  out.phi_log_scale = -turn * law.fastest * t;
  for (Pair& pair : out.pieces) pair.phi *= turn;
  for (Pair& pair : out.boundaries) pair.phi *= turn;
  // dp through H and through r_end itself nearly cancel where the end layer is close to its capacity. Their sum is
  // dp/dH (T_end fastest - 2 H steep_others) / (r_end T_H).
  if (T_H > 0)
    out.pieces[end - lowest].phi =
        by_H * (legs.time_end * law.fastest - Scalar(2) * path.H * legs.steep_others) / (r_end * T_H);
  return out;
}

}  // namespace shearfront::exact
