// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

/// Travel times and costs of paths with constant H in a stack of layers.
///
/// In layer k, with rate r_k = 4 (its capacity) and h = 4 H, a path lacks e = 1 - h / r_k to the capacity and has the
/// momentum p = peak +- q / 2, + going up. With w = (de/dq) / 2 it moves at the speed r_k w; for a parabola
/// q = w = sqrt(e). So
///
///     T = sum d_k / (r_k w_k),     cost = H T + int_x^z peak dz + Q / 2,     Q = sum q_k d_k.
///
/// What q, w and peak are is the law's matter (exact/law.hpp).
namespace shearfront::exact {

/// The layers with what every path needs.
template <Real Scalar>
struct Geometry {
  std::vector<Scalar> boundaries;                  ///< bottom, interfaces, top
  std::vector<Scalar> rate, inverse_rate, height;  ///< r_k, 1 / r_k, thickness of layer k
  Scalar fastest{0};  ///< largest r_k: 1 / r^2 alone would overflow for tiny rates

  Geometry(std::vector<Scalar> heights, std::vector<Scalar> rates)
      : boundaries(std::move(heights)), rate(std::move(rates)) {
    for (std::size_t k = 0; k < n_layers(); ++k) {
      inverse_rate.push_back(Scalar(1) / rate[k]);
      fastest = std::max(fastest, rate[k]);
      height.push_back(boundaries[k + 1] - boundaries[k]);
    }
  }

  [[nodiscard]] std::size_t n_layers() const { return rate.size(); }
  [[nodiscard]] const Scalar& boundary(std::size_t k) const { return boundaries[k]; }
  [[nodiscard]] const Scalar& bottom() const { return boundaries.front(); }
  [[nodiscard]] const Scalar& top() const { return boundaries.back(); }
  /// An interface belongs to the layer above it, the top to the last layer.
  [[nodiscard]] std::size_t layer_at(const Scalar& z) const {
    const auto it = std::upper_bound(boundaries.begin() + 1, boundaries.end() - 1, z);
    return static_cast<std::size_t>(it - boundaries.begin()) - 1;
  }
  /// Calls f(d, k) for every layer between two heights, bottom to top, d > 0 the distance covered in it.
  template <class F>
  void for_each_layer(const Scalar& z1, const Scalar& z2, F&& f) const {
    const Scalar& lo = std::min(z1, z2);
    const Scalar& hi = std::max(z1, z2);
    for (std::size_t k = layer_at(lo); k < n_layers() && boundaries[k] < hi; ++k) {
      const Scalar d = std::min(hi, boundaries[k + 1]) - std::max(lo, boundaries[k]);
      if (d > 0) f(d, k);
    }
  }
};

/// Travel time and Q = sum q d of a part of a path; the time is +infinity where it cannot go.
template <Real Scalar>
struct Leg {
  Scalar time{0}, Q{0};
};

/// Adds the distance d in layer k, for a path that lacks r_minus_h = r_k - 4 H to its capacity there.
template <Real Scalar, class Law>
void add_layer(const Law& law, const Scalar& d, std::size_t k, bool upward, const Scalar& r_minus_h,
               Leg<Scalar>& leg) {
  const Scalar q = law.q(k, upward, r_minus_h);
  leg.time += d * law.inverse_rate[k] / law.steepness(k, upward, q);
  leg.Q += d * q;
}

/// The part between two heights with conserved H. Cost: O(layers crossed).
template <Real Scalar, class Law>
[[nodiscard]] Leg<Scalar> leg_between(const Law& law, const Scalar& from, const Scalar& to, const Scalar& H) {
  const Scalar h = Scalar(4) * H;
  Leg<Scalar> leg;
  law.for_each_layer(from, to, [&](const Scalar& d, std::size_t k) {
    if (law.rate[k] < h)
      leg.time = infinity<Scalar>();
    else
      add_layer(law, d, k, from < to, Scalar(law.rate[k] - h), leg);
  });
  return leg;
}

/// Travel time of a pure state, H = 0.
template <Real Scalar, class Law>
[[nodiscard]] Scalar pure_travel_time(const Law& law, const Scalar& from, const Scalar& to) {
  Scalar time(0);
  law.for_each_layer(from, to,
                     [&](const Scalar& d, std::size_t k) { time += d * law.pure_slowness(k, from < to); });
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
  template <class Law>
  void cross(const Law& law, const Scalar& d) {
    if (d > 0) {
      T0 += d * law.pure_slowness(start, upward);
      S += d * law.inverse_rate[start] * (law.fastest * law.inverse_rate[start]);
      r_min = std::min(r_min, law.rate[start]);
      if (!(h_dual < law.rate[start])) {
        h_dual = Scalar(-1);
      } else if (h_dual >= 0) {
        Q_dual += d * law.q(start, upward, Scalar(law.rate[start] - h_dual));
      }
    }
    upward ? --start : ++start;
  }
  /// Makes 4 H of a path the h_dual of later lower bounds.
  template <class Law>
  void set_dual(const Law& law, const Scalar& h) {
    h_dual = h;
    Q_dual = Scalar(0);
    for_each_crossed(law, [&](const Scalar& d, std::size_t k) {
      Q_dual += d * law.q(k, upward, Scalar(law.rate[k] - h_dual));
    });
  }
  /// Height at which paths leave the start layer (or the query height itself, in the own layer).
  [[nodiscard]] const Scalar& exit(const Geometry<Scalar>& g, const Scalar& z) const {
    if (start == own) return z;
    return g.boundary(upward ? start + 1 : start);
  }
};

/// Duality: H' t + int_x^z peak dz + sum q_k(H') d_k / 2 bounds the cost from below for every H' up to the capacity of
/// the layers crossed. Here at the H' of the sweep, for a path that covers d in its start layer, with `lean` = int peak
/// dz; 0 if there is no such H'.
template <Real Scalar, class Law>
[[nodiscard]] Scalar dual_bound(const Law& law, const Sweep<Scalar>& sweep, const Scalar& d,
                                const Scalar& lean, const Scalar& t) {
  if (sweep.h_dual < 0 || !(sweep.h_dual < law.rate[sweep.start])) return Scalar(0);
  const Scalar q = law.q(sweep.start, sweep.upward, Scalar(law.rate[sweep.start] - sweep.h_dual));
  return sweep.h_dual * t / Scalar(4) + (lean + (sweep.Q_dual + q * d) / Scalar(2));
}

/// A path with T(H) = t, or a lower bound on its cost when `pruned`.
template <Real Scalar>
struct FanState {
  Scalar x{0};      ///< 4 H = r_min (1 - x^2)
  Scalar r_min{0};  ///< rate of the slowest layer crossed
  Scalar H{0};
  Scalar Q{0};  ///< sum q_k d_k
  bool reachable = false, pruned = false;
};

}  // namespace shearfront::exact
