// SPDX-License-Identifier: BSD-3-Clause
// Derivatives along one path of a general medium.
#include <algorithm>

#include "shearfront/exact/path_gradient.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

namespace {

/// What a path does in one layer: with e' and e'' of the layer's law at its state, C the capacity, and the
/// time T = d / (C e'),  T_H = T e'' / (C e'^2),  T_C = -T (1 / C + e'' H / (C e')^2),  d(distance)/dH = -1 /
/// (C e').
template <Real Scalar>
struct Pass {
  Scalar lack, p, slope, bend, C;
  bool up;

  Pass(const GeneralMedium<Scalar>& medium, const Path<Scalar>& path, std::size_t k, bool upward)
      : lack(medium.lack(k, path.r_reference / Scalar(4), path.x)), C(medium.capacity(k)), up(upward) {
    const auto& law = medium.law(k);
    const Scalar distance = law.inverse(lack, up);
    p = law.state(distance, up);
    slope = law.slope(distance, up);
    bend = law.bend(distance, up);
  }
  [[nodiscard]] Scalar slowness() const { return Scalar(1) / (C * slope); }
  /// dp/dH; 0 at the peak of a smooth flux, where p stays.
  [[nodiscard]] Scalar p_H() const {
    if (!(slope > 0)) return Scalar(0);
    return up ? Scalar(-slowness()) : slowness();
  }
  /// dp/dC at fixed H.
  [[nodiscard]] Scalar p_C(const Scalar& H) const { return -p_H() * (H / C); }
  [[nodiscard]] StartMomentum<Scalar> momentum() const { return {p, Scalar(1) - p}; }
};

/// Sums over the layers a path crosses.
template <Real Scalar>
class Run {
 public:
  Run(const GeneralMedium<Scalar>& medium, const Path<Scalar>& path, LayeredGradient<Scalar>& out)
      : medium_(medium), path_(path), out_(out) {}

  /// Adds the run between two heights: dM/dr_k, and into the phi entries dT/d(.), to be turned into dphi
  /// later.
  void add(const Scalar& from, const Scalar& to) {
    const auto& layers = medium_.layers();
    const Scalar& lo = std::min(from, to);
    const Scalar& hi = std::max(from, to);
    const bool up = from < to;
    const Pass<Scalar>* below = nullptr;
    std::vector<Pass<Scalar>> passes;
    passes.reserve(out_.rates.size() + 1);
    for (std::size_t k = layers.layer_at(lo); k < layers.n_layers() && layers.boundary(k) < hi; ++k) {
      const Scalar d = std::min(hi, layers.boundary(k + 1)) - std::max(lo, layers.boundary(k));
      if (!(d > 0)) continue;
      passes.emplace_back(medium_, path_, k, up);
      const Pass<Scalar>& pass = passes.back();
      const Scalar T = d * pass.slowness();
      // Where the path is at the capacity of the layer, its rest there accounts for the rate.
      if (pass.lack > 0 || path_.kind == PathKind::constant) {
        time += T;
        out_.rates[k - out_.first].M += T * path_.H / pass.C / Scalar(4);
      }
      T_H += T * pass.bend * pass.slowness() / pass.slope;
      out_.rates[k - out_.first].phi -=
          T * (Scalar(1) / pass.C + pass.bend * path_.H * pass.slowness() * pass.slowness()) / Scalar(4);
      if (below != nullptr) {
        auto& boundary = out_.boundaries[k - out_.first];
        boundary.M += up ? Scalar(below->p - pass.p) : Scalar(pass.p - below->p);
        boundary.phi += below->slowness() - pass.slowness();
      }
      below = &pass;
    }
  }
  Scalar time{0}, T_H{0};

 private:
  const GeneralMedium<Scalar>& medium_;
  const Path<Scalar>& path_;
  LayeredGradient<Scalar>& out_;
};

/// Forgets dT: the path's H does not come from T(H) = t.
template <Real Scalar>
void clear_phi(LayeredGradient<Scalar>& out) {
  for (auto& pair : out.rates) pair.phi = Scalar(0);
  for (auto& pair : out.boundaries) pair.phi = Scalar(0);
}

/// H is the capacity of layer `slow`, where the path spends the time the rest of it leaves.
template <Real Scalar>
void add_rest(const Pass<Scalar>& last, std::size_t slow, std::size_t end, const Scalar& H,
              const Scalar& time, LayeredGradient<Scalar>& out) {
  clear_phi(out);
  out.rates[slow - out.first].M += time / Scalar(4);
  if (slow == end) return;  // at the peak, which stays
  out.rates[slow - out.first].phi += last.p_H() / Scalar(4);
  out.rates[end - out.first].phi += last.p_C(H) / Scalar(4);
}

/// A path that rests at an interface: H is its capacity.
template <Real Scalar>
void add_waiting(const GeneralMedium<Scalar>& medium, const Path<Scalar>& path, const Scalar& z,
                 const Scalar& t, Run<Scalar>& run, const Pass<Scalar>& last, LayeredGradient<Scalar>& out) {
  const std::size_t end = medium.layers().layer_at(z);
  const std::size_t w = path.interface;
  const Scalar& z_w = medium.layers().boundary(w);
  run.add(path.foot, z_w);
  run.add(z_w, z);
  const std::size_t slow = medium.capacity(w) <= medium.capacity(w - 1) ? w : w - 1;
  add_rest(last, slow, end, path.H, Scalar(t - run.time), out);
  const bool comes = path.foot != z_w, goes = z != z_w;
  const auto pass = [&](bool above, bool up) { return Pass<Scalar>(medium, path, above ? w : w - 1, up); };
  if (comes) {
    const bool from_below = path.foot < z_w;
    const std::size_t k = medium.cells().layer[from_below ? path.source : path.source - 1];
    out.start = Pass<Scalar>(medium, path, k, from_below).momentum();
    if (goes) out.boundaries[w - out.first].M += pass(!from_below, from_below).p - pass(z > z_w, z > z_w).p;
  } else if (goes) {
    out.start = pass(z > z_w, z > z_w).momentum();
  }
}

/// The characteristic of a constant state: H is its flux.
template <Real Scalar>
void add_constant(const GeneralMedium<Scalar>& medium, const Path<Scalar>& path, const Scalar& z,
                  const Scalar& t, Run<Scalar>& run, const Pass<Scalar>& last, LayeredGradient<Scalar>& out) {
  const Scalar four(4);
  const std::size_t end = medium.layers().layer_at(z);
  const std::size_t cell = path.source, c = medium.cells().layer[cell];
  if (c == end) {
    out.rates[c - out.first].M = path.H * t / medium.capacity(c) / four;
    out.phi_state = Scalar(1);
    return;
  }
  run.add(path.foot, z);
  clear_phi(out);
  const Pass<Scalar> first(medium, path, c, path.upward);
  out.rates[c - out.first].phi += last.p_H() * (path.H / first.C) / four;
  out.rates[end - out.first].phi += last.p_C(path.H) / four;
  out.phi_state = first.C * first.slope * last.slowness();
}

}  // namespace

template <Real Scalar>
LayeredGradient<Scalar> path_gradient(const GeneralMedium<Scalar>& medium, const Path<Scalar>& path,
                                      const Scalar& z, const Scalar& t) {
  LayeredGradient<Scalar> out;
  if (path.kind == PathKind::bottom_wall || path.kind == PathKind::top_wall || path.kind == PathKind::none)
    return out;
  const auto& layers = medium.layers();
  const std::size_t end = layers.layer_at(z), foot = layers.layer_at(path.foot);
  std::size_t lowest = std::min(end, foot), highest = std::max(end, foot);
  if (path.kind == PathKind::waiting) {
    lowest = std::min(lowest, path.interface - 1);
    highest = std::max(highest, path.interface);
  }
  if (lowest > 0 && (path.foot == layers.boundary(lowest) || z == layers.boundary(lowest))) --lowest;
  out.first = lowest;
  out.rates.resize(highest - lowest + 1);
  out.boundaries.resize(highest - lowest + 1);
  Run<Scalar> run(medium, path, out);
  const Pass<Scalar> last(medium, path, end, path.upward);
  const Scalar four(4);
  if (path.kind == PathKind::waiting) {
    add_waiting(medium, path, z, t, run, last, out);
    return out;
  }
  if (path.kind == PathKind::constant) {
    add_constant(medium, path, z, t, run, last, out);
    return out;
  }
  const std::size_t start = medium.cells().layer[path.upward ? path.source : path.source - 1];
  const Pass<Scalar> first(medium, path, start, path.upward);
  out.start = first.momentum();
  if (path.foot == z) {  // a jump inside a layer, seen from its place: the path rests
    out.rates[end - lowest].M = t / four;
    return out;
  }
  run.add(path.foot, z);
  if (path.x == 0) {  // faster than t even at the least capacity
    std::size_t slow = end;
    for (std::size_t k = std::min(start, end); k <= std::max(start, end); ++k)
      if (medium.capacity(k) < medium.capacity(slow)) slow = k;
    add_rest(last, slow, end, path.H, Scalar(t - run.time), out);
    return out;
  }
  const Scalar turn = run.T_H > 0 ? Scalar(-last.p_H() / run.T_H) : Scalar(0);  // dH = -dT / T_H
  out.phi_start = (path.upward ? Scalar(-first.slowness()) : first.slowness()) * turn;
  for (auto& pair : out.rates) pair.phi *= turn;
  for (auto& pair : out.boundaries) pair.phi *= turn;
  out.rates[end - lowest].phi += last.p_C(path.H) / four;
  out.phi_log_scale = -turn * t;
  return out;
}

template LayeredGradient<Instantiated> path_gradient(const GeneralMedium<Instantiated>&,
                                                     const Path<Instantiated>&, const Instantiated&,
                                                     const Instantiated&);

}  // namespace shearfront::exact
