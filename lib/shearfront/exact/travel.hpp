// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/layer_stack.hpp"

/// Travel times and costs of paths with constant H in a stack of layers.
///
/// In layer k, with rate r_k = s a_k and h = 4 H:  q_k = sqrt(1 - h / r_k), speed r_k q_k,
/// T = sum d_k / (r_k q_k), cost = H T + (z - x) / 2 + sum q_k d_k / 2 (z - x signed, up positive).
namespace shearfront::exact {

/// The layers with what every path needs.
template <Real Scalar>
struct Geometry {
  LayerStack<Scalar> layers;
  std::vector<Scalar> rate, inverse_rate, height;  ///< r_k, 1 / r_k, thickness of layer k
  Scalar fastest{0};  ///< largest r_k: 1 / r^2 alone would overflow for tiny rates

  explicit Geometry(LayerStack<Scalar> stack) : layers(std::move(stack)) {
    for (std::size_t k = 0; k < layers.n_layers(); ++k) {
      rate.push_back(layers.rate(k));
      inverse_rate.push_back(Scalar(1) / rate.back());
      fastest = std::max(fastest, rate.back());
      height.push_back(layers.boundary(k + 1) - layers.boundary(k));
    }
  }
};

/// q = sqrt(1 - h / r), with r - h given so that nothing cancels near the capacity; 0 beyond it.
template <Real Scalar>
[[nodiscard]] Scalar momentum_root(const Scalar& r_minus_h, const Scalar& inverse_r) {
  using std::sqrt;
  return r_minus_h > 0 ? Scalar(sqrt(Scalar(r_minus_h * inverse_r))) : Scalar(0);
}

/// Time between two heights with conserved H; +infinity if a layer on the way has no more capacity than H.
/// Cost: O(layers crossed).
template <Real Scalar>
[[nodiscard]] Scalar travel_time(const Geometry<Scalar>& g, const Scalar& z1, const Scalar& z2,
                                 const Scalar& H) {
  const Scalar& lo = std::min(z1, z2);
  const Scalar& hi = std::max(z1, z2);
  const Scalar h = Scalar(4) * H;
  Scalar time(0);
  for (std::size_t k = g.layers.layer_at(lo); k < g.layers.n_layers() && g.layers.boundary(k) < hi; ++k) {
    const Scalar d = std::min(hi, g.layers.boundary(k + 1)) - std::max(lo, g.layers.boundary(k));
    if (!(d > 0)) continue;
    if (!(h < g.rate[k])) return infinity<Scalar>();
    const Scalar q = momentum_root<Scalar>(g.rate[k] - h, g.inverse_rate[k]);
    time += d * g.inverse_rate[k] / q;
  }
  return time;
}

/// The layers between a query height and the layer j in which starts are looked for. Moved outwards layer by
/// layer with running sums, so that each start costs one Newton iteration per layer and no set-up.
template <Real Scalar>
struct Sweep {
  bool upward;                        ///< paths arrive from below: starts lie below the query height
  std::size_t own;                    ///< layer of the query height
  std::size_t start;                  ///< layer of the starts
  Scalar d_own;                       ///< distance covered in the own layer when start != own
  Scalar T0{0};                       ///< time through everything between, H = 0
  Scalar S{0};                        ///< sum d fastest / r^2 of the same
  Scalar r_min = infinity<Scalar>();  ///< smallest rate of the same

  /// A value of 4 H for lower bounds (negative: none) and sum q d of everything between at that H.
  Scalar h_dual{-1}, Q_dual{0};

  /// Calls f(d, k) for every layer between, the start layer excluded, the own layer included if crossed.
  template <class F>
  void for_each_crossed(const Geometry<Scalar>& g, F&& f) const {
    if (start == own) return;
    if (d_own > 0) f(d_own, own);
    if (upward) {
      for (std::size_t k = own; k-- > start + 1;) f(g.height[k], k);
    } else {
      for (std::size_t k = own + 1; k < start; ++k) f(g.height[k], k);
    }
  }
  /// Appends the layer `start` (over the distance d) to what lies between and moves on.
  void cross(const Geometry<Scalar>& g, const Scalar& d) {
    if (d > 0) {
      T0 += d * g.inverse_rate[start];
      S += d * g.inverse_rate[start] * (g.fastest * g.inverse_rate[start]);
      r_min = std::min(r_min, g.rate[start]);
      if (!(h_dual < g.rate[start])) {
        h_dual = Scalar(-1);
      } else if (h_dual >= 0) {
        Q_dual += d * momentum_root<Scalar>(g.rate[start] - h_dual, g.inverse_rate[start]);
      }
    }
    upward ? --start : ++start;
  }
};

/// Duality: H' t + (z - x) / 2 + sum q_k(H') d_k / 2 bounds the cost from below for every H' up to the
/// capacity of the layers crossed. Here at the H' of the sweep, for a path that covers d in its start layer
/// and x -> z = `rise` in all; 0 if there is no such H'.
template <Real Scalar>
[[nodiscard]] Scalar dual_bound(const Geometry<Scalar>& g, const Sweep<Scalar>& sweep, const Scalar& d,
                                const Scalar& rise, const Scalar& t) {
  if (sweep.h_dual < 0 || !(sweep.h_dual < g.rate[sweep.start])) return Scalar(0);
  const Scalar q = momentum_root<Scalar>(g.rate[sweep.start] - sweep.h_dual, g.inverse_rate[sweep.start]);
  return sweep.h_dual * t / Scalar(4) + (rise + sweep.Q_dual + q * d) / Scalar(2);
}

/// A path with T(H) = t, or a lower bound on its cost when `pruned`.
template <Real Scalar>
struct FanState {
  Scalar x{0};      ///< q of the slowest layer crossed
  Scalar r_min{0};  ///< its rate; 4 H = r_min (1 - x^2)
  Scalar H{0};
  Scalar Q{0};  ///< sum q_k d_k
  bool reachable = false, pruned = false;

  /// q of a layer of rate r at this H.
  [[nodiscard]] Scalar q(const Scalar& r, const Scalar& inverse_r) const {
    return r == r_min ? x : momentum_root<Scalar>((r - r_min) + r_min * x * x, inverse_r);
  }
};

/// Solves T(H) = t for a path that covers d in the layer sweep.start and everything the sweep has crossed.
///
/// With y = 1 / q of the slowest layer, T is increasing and CONCAVE in y (each term is
/// c y / sqrt(rho + (1 - rho) y^2), rho = r_min / r_k), so Newton from y = 1 increases monotonically to the
/// root without a bracket; it is exact in one step for one layer. Every iterate is dual feasible: `base` +
/// its cost bounds the candidate from below, and the iteration stops (pruned) as soon as that exceeds
/// `upper`. Needs t >= T(H = 0), otherwise reachable is false. Cost: 3 to 6 iterations of O(layers crossed).
template <Real Scalar>
[[nodiscard]] FanState<Scalar> solve_fan(const Geometry<Scalar>& g, const Sweep<Scalar>& sweep,
                                         const Scalar& d, const Scalar& t, const Scalar& base,
                                         const Scalar& upper) {
  const std::size_t j = sweep.start;
  const Scalar& ir = g.inverse_rate[j];
  const Scalar c = d * ir;
  const Scalar T0 = sweep.T0 + c;
  FanState<Scalar> fan;
  if (!(t >= T0) || !(T0 > 0)) return fan;
  fan.reachable = true;
  const bool own_slowest = d > 0 && g.rate[j] <= sweep.r_min;
  const Scalar r_min = own_slowest ? g.rate[j] : sweep.r_min;
  fan.r_min = r_min;
  const Scalar quarter = r_min / Scalar(4);
  // y - 1 is iterated, so that H keeps its relative accuracy near the edge of the fan.
  Scalar w = (t - T0) / ((r_min / g.fastest) * (sweep.S + c * (g.fastest * ir)));
  const auto evaluate = [&](Scalar& time, Scalar& slope, Scalar& Q) {
    Scalar slowest(0), rest(0), rest_slope(0);
    Q = Scalar(0);
    const Scalar x2r = r_min * fan.x * fan.x;
    const auto add = [&](const Scalar& dk, std::size_t k) {
      const Scalar& r = g.rate[k];
      const Scalar ck = dk * g.inverse_rate[k];
      if (r == r_min) {
        slowest += ck;
        Q += fan.x * dk;
        return;
      }
      const Scalar q2 = ((r - r_min) + x2r) * g.inverse_rate[k];
      using std::sqrt;
      const Scalar q = sqrt(q2);
      const Scalar term = ck / q;
      rest += term;
      rest_slope += term * (r_min * g.inverse_rate[k]) / q2;
      Q += q * dk;
    };
    sweep.for_each_crossed(g, add);
    if (d > 0) add(d, j);
    time = slowest / fan.x + rest;
    slope = slowest + rest_slope * fan.x * fan.x * fan.x;
  };
  const Scalar tolerance = Scalar(1) / Scalar(1 << 4) * [] {
    using std::sqrt;
    static const Scalar root = sqrt(std::numeric_limits<Scalar>::epsilon());
    return root;
  }();
  constexpr int kMaxIterations = 200;  // never reached: the increase is at least geometric
  for (int n = 0; n < kMaxIterations; ++n) {
    const Scalar y = Scalar(1) + w;
    fan.x = Scalar(1) / y;
    fan.H = quarter * (w / y) * (Scalar(1) + fan.x);
    if (sweep.start == sweep.own) {  // one layer: 1 / T is linear in x
      fan.Q = fan.x * d;
      break;
    }
    Scalar time, slope;
    evaluate(time, slope, fan.Q);
    if (base + fan.Q / Scalar(2) + fan.H * t > upper) {
      fan.pruned = true;
      return fan;
    }
    const Scalar step = (t - time) / slope;
    if (!(step > 0)) break;
    w += step;
    if (step <= tolerance * w) {
      const Scalar y_last = Scalar(1) + w;
      fan.x = Scalar(1) / y_last;
      fan.H = quarter * (w / y_last) * (Scalar(1) + fan.x);
      fan.Q = Scalar(0);
      const auto add = [&](const Scalar& dk, std::size_t k) {
        fan.Q += fan.q(g.rate[k], g.inverse_rate[k]) * dk;
      };
      sweep.for_each_crossed(g, add);
      if (d > 0) add(d, j);
      break;
    }
  }
  return fan;
}

}  // namespace shearfront::exact
