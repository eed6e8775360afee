// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "shearfront/exact/geometry.hpp"
#include "shearfront/exact/inverse_flux.hpp"

/// What the fluxes of a stack of layers are, as the search for paths and their derivatives need them. A law is a
/// Geometry with, for layer k and a direction,
///
///   q(k, upward, r - h)      twice the distance of the momentum from the peak at the H with 4 H = h
///   steepness(k, upward, q)  w = (de/dq) / 2, the speed over the rate: T = d / (r w)
///   bend(k, upward, q)       dw/dq
///   excess(k, phi, upward)   q of the state phi, negative if its waves go the other way
///   lack(k, upward, q)       e
///   momentum, loss           p, and 1 - p going up, p going down, of the path with this q and H
///   peaks(x, z)              int_x^z peak dz, negative for z < x
///   solve_fan                the H with T(H) = t
///
/// kMovesAtCapacity: w may be > 0 at e = 0 (a kink); kSlack: rounding of the peak.
namespace shearfront::exact {

/// Parabolas in all layers: q = w = sqrt(e), peak 1/2, in closed form.
template <Real Scalar>
struct ParabolaLaw : Geometry<Scalar> {
  static constexpr bool kMovesAtCapacity = false, kIsSymmetric = true;
  static constexpr double kSlack = 0;

  using Geometry<Scalar>::Geometry;

  /// 0 beyond the capacity.
  [[nodiscard]] Scalar q(std::size_t k, bool /*upward*/, const Scalar& r_minus_h) const {
    using std::sqrt;
    return r_minus_h > 0 ? Scalar(sqrt(Scalar(r_minus_h * this->inverse_rate[k]))) : Scalar(0);
  }
  [[nodiscard]] Scalar q_on(std::size_t k, bool upward, const Scalar& reference, const Scalar& x) const {
    const Scalar& r = this->rate[k];
    return r == reference ? x : q(k, upward, Scalar((r - reference) + reference * x * x));
  }
  [[nodiscard]] static const Scalar& steepness(std::size_t, bool, const Scalar& q) { return q; }
  [[nodiscard]] static Scalar bend(std::size_t, bool, const Scalar&) { return Scalar(1); }
  [[nodiscard]] static Scalar lack(std::size_t, bool, const Scalar& q) { return q * q; }
  /// x with lack = x^2.
  [[nodiscard]] static const Scalar& root_lack(std::size_t, bool, const Scalar& q) { return q; }
  [[nodiscard]] static Scalar excess(std::size_t, const Scalar& phi, bool upward) {
    const Scalar one(1);
    return upward ? Scalar(phi + (phi - one)) : Scalar((one - phi) - phi);
  }
  [[nodiscard]] Scalar h_of(std::size_t k, const Scalar& phi) const {
    return Scalar(4) * this->rate[k] * phi * (Scalar(1) - phi);
  }
  [[nodiscard]] const Scalar& pure_slowness(std::size_t k, bool) const { return this->inverse_rate[k]; }
  [[nodiscard]] static Scalar peaks(const Scalar& x, const Scalar& z) { return (z - x) / Scalar(2); }
  /// (1 - q) / 2 without cancellation.
  [[nodiscard]] Scalar loss(std::size_t k, bool /*upward*/, const Scalar& q, const Scalar& H) const {
    return Scalar(2) * H * this->inverse_rate[k] / (Scalar(1) + q);
  }
  [[nodiscard]] Scalar momentum(std::size_t k, bool upward, const Scalar& q, const Scalar& H) const {
    return upward ? Scalar((Scalar(1) + q) / Scalar(2)) : loss(k, upward, q, H);
  }
  /// Differences over the interface between layers b and a = b + 1, in conjugate form, so that nearly equal layers
  /// lose nothing: q_b - q_a, and 1 / (r w) of b less that of a, times `fastest`.
  [[nodiscard]] Scalar q_change(std::size_t b, std::size_t a, bool /*upward*/, const Scalar& q_b,
                                const Scalar& q_a, const Scalar& H) const {
    return Scalar(4) * (H * this->inverse_rate[a]) *
           ((this->rate[b] - this->rate[a]) * this->inverse_rate[b]) / (q_a + q_b);
  }
  [[nodiscard]] Scalar slowness_change(std::size_t b, std::size_t a, bool /*upward*/, const Scalar& q_b,
                                       const Scalar& q_a) const {
    const Scalar &r_b = this->rate[b], &r_a = this->rate[a], &ir_b = this->inverse_rate[b];
    const Scalar two(2), s_b = this->fastest * ir_b / q_b;
    if (r_a > two * r_b || r_b > two * r_a) return s_b - this->fastest * this->inverse_rate[a] / q_a;
    const Scalar ratio = r_a * ir_b;  // of order 1, as is everything below
    return s_b * ((r_a - r_b) * ir_b) * (ratio + q_b * q_b) / (ratio * q_a * (ratio * q_a + q_b));
  }

  /// Solves T(H) = t for a path that covers d in the layer sweep.start and everything the sweep has crossed.
  ///
  /// With y = 1 / q of the slowest layer, T is increasing and CONCAVE in y (each term is
  /// c y / sqrt(rho + (1 - rho) y^2), rho = r_min / r_k), so Newton from y = 1 increases monotonically to the
  /// root without a bracket; it is exact in one step for one layer. Every iterate is dual feasible: `base` +
  /// its cost bounds the candidate from below, and the iteration stops (pruned) as soon as that exceeds
  /// `upper`. Needs t >= T(H = 0), otherwise reachable is false. Cost: 3 to 6 iterations of O(layers crossed).
  [[nodiscard]] FanState<Scalar> solve_fan(const Sweep<Scalar>& sweep, const Scalar& d, const Scalar& t,
                                           const Scalar& base, const Scalar& upper) const {
    const std::size_t j = sweep.start;
    const Scalar& ir = this->inverse_rate[j];
    const Scalar c = d * ir;
    const Scalar T0 = sweep.T0 + c;
    FanState<Scalar> fan;
    if (!(t >= T0) || !(T0 > 0)) return fan;
    fan.reachable = true;
    const bool own_slowest = d > 0 && this->rate[j] <= sweep.r_min;
    const Scalar r_min = own_slowest ? this->rate[j] : sweep.r_min;
    fan.r_min = r_min;
    const Scalar quarter = r_min / Scalar(4);
    // y - 1 is iterated, so that H keeps its relative accuracy near the edge of the fan.
    Scalar w = (t - T0) / ((r_min / this->fastest) * (sweep.S + c * (this->fastest * ir)));
    const auto evaluate = [&](Scalar& time, Scalar& slope, Scalar& Q) {
      Scalar slowest(0), rest(0), rest_slope(0);
      Q = Scalar(0);
      const Scalar x2r = r_min * fan.x * fan.x;
      const auto add = [&](const Scalar& dk, std::size_t k) {
        const Scalar& r = this->rate[k];
        const Scalar ck = dk * this->inverse_rate[k];
        if (r == r_min) {
          slowest += ck;
          Q += fan.x * dk;
          return;
        }
        const Scalar q2 = ((r - r_min) + x2r) * this->inverse_rate[k];
        using std::sqrt;
        const Scalar qk = sqrt(q2);
        const Scalar term = ck / qk;
        rest += term;
        rest_slope += term * (r_min * this->inverse_rate[k]) / q2;
        Q += qk * dk;
      };
      sweep.for_each_crossed(*this, add);
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
          fan.Q += q_on(k, sweep.upward, r_min, fan.x) * dk;
        };
        sweep.for_each_crossed(*this, add);
        if (d > 0) add(d, j);
        break;
      }
    }
    return fan;
  }
};

/// Any convex flux with one extremum in each layer (the canonical form of a scene), by its inverse branches
/// (exact/inverse_flux.hpp): a fan is a root of T, about ten times the cost of a parabola's.
template <Real Scalar>
struct UnimodalLaw : Geometry<Scalar> {
  static constexpr bool kMovesAtCapacity = true, kIsSymmetric = false;
  static constexpr double kSlack = 1.0 / (1 << 20);

  UnimodalLaw(std::vector<Scalar> heights, std::vector<Scalar> rates, std::vector<InverseFlux<Scalar>> fluxes,
              std::vector<std::size_t> flux_of)
      : Geometry<Scalar>(std::move(heights), std::move(rates)),
        fluxes_(std::move(fluxes)),
        flux_of_(std::move(flux_of)),
        peaks_{Scalar(0)} {
    for (std::size_t k = 0; k < this->n_layers(); ++k) {
      for (const bool upward : {false, true})
        pure_slowness_[upward].push_back(this->inverse_rate[k] /
                                         steepness(k, upward, q(k, upward, this->rate[k])));
      peaks_.push_back(peaks_.back() + flux(k).peak() * this->height[k]);
    }
  }

  [[nodiscard]] const InverseFlux<Scalar>& flux(std::size_t k) const { return fluxes_[flux_of_[k]]; }
  [[nodiscard]] Scalar q(std::size_t k, bool upward, const Scalar& r_minus_h) const {
    return Scalar(2) * flux(k).inverse(Scalar(r_minus_h * this->inverse_rate[k]), upward);
  }
  [[nodiscard]] Scalar q_on(std::size_t k, bool upward, const Scalar& reference, const Scalar& x) const {
    return q(k, upward, Scalar((this->rate[k] - reference) + reference * x * x));
  }
  [[nodiscard]] Scalar steepness(std::size_t k, bool upward, const Scalar& q) const {
    return flux(k).slope(Scalar(q / Scalar(2)), upward) / Scalar(4);
  }
  [[nodiscard]] Scalar bend(std::size_t k, bool upward, const Scalar& q) const {
    return flux(k).bend(Scalar(q / Scalar(2)), upward) / Scalar(8);
  }
  [[nodiscard]] Scalar lack(std::size_t k, bool upward, const Scalar& q) const {
    return flux(k).lack(Scalar(q / Scalar(2)), upward);
  }
  [[nodiscard]] Scalar root_lack(std::size_t k, bool upward, const Scalar& q) const {
    using std::sqrt;
    return sqrt(lack(k, upward, q));
  }
  [[nodiscard]] Scalar excess(std::size_t k, const Scalar& phi, bool upward) const {
    const Scalar over = Scalar(2) * (phi - flux(k).peak());
    return upward ? over : Scalar(-over);
  }
  [[nodiscard]] Scalar h_of(std::size_t k, const Scalar& phi) const {
    if (phi == Scalar(0) || phi == Scalar(1)) return Scalar(0);
    const Scalar over = excess(k, phi, true);
    const bool up = over > 0;
    const Scalar e = lack(k, up, up ? over : Scalar(-over));
    if (e + e > Scalar(1)) return this->rate[k] * flux(k).flux_beside(up ? Scalar(Scalar(1) - phi) : phi, up);
    return this->rate[k] * (Scalar(1) - e);
  }
  [[nodiscard]] const Scalar& pure_slowness(std::size_t k, bool upward) const {
    return pure_slowness_[upward][k];
  }
  [[nodiscard]] Scalar peaks(const Scalar& x, const Scalar& z) const { return peaks_to(z) - peaks_to(x); }
  /// From H where the state is nearly pure, for q has lost the digits.
  [[nodiscard]] Scalar loss(std::size_t k, bool upward, const Scalar& q, const Scalar& H) const {
    const Scalar G = Scalar(4) * H * this->inverse_rate[k];
    if (G + G < Scalar(1)) return flux(k).distance_beside(G, upward);
    return std::max(Scalar(0), Scalar(flux(k).reach(upward) - q / Scalar(2)));
  }
  [[nodiscard]] Scalar momentum(std::size_t k, bool upward, const Scalar& q, const Scalar& /*H*/) const {
    return flux(k).state(Scalar(q / Scalar(2)), upward);
  }
  /// Change of twice the distance from 1/2, so that p_b - p_a = +- this / 2.
  [[nodiscard]] Scalar q_change(std::size_t b, std::size_t a, bool upward, const Scalar& q_b,
                                const Scalar& q_a, const Scalar& /*H*/) const {
    const Scalar shift = Scalar(2) * (flux(b).peak() - flux(a).peak());
    return (q_b - q_a) + (upward ? shift : Scalar(-shift));
  }
  [[nodiscard]] Scalar slowness_change(std::size_t b, std::size_t a, bool upward, const Scalar& q_b,
                                       const Scalar& q_a) const {
    return this->fastest * (this->inverse_rate[b] / steepness(b, upward, q_b) -
                            this->inverse_rate[a] / steepness(a, upward, q_a));
  }

  /// The same as ParabolaLaw::solve_fan, by bracketing; where T is less than t even at the least capacity the path
  /// rests there, or moves more slowly than its states do at no extra cost, in a flux with a kink: x = 0.
  [[nodiscard]] FanState<Scalar> solve_fan(const Sweep<Scalar>& sweep, const Scalar& d, const Scalar& t,
                                           const Scalar& /*base*/, const Scalar& /*upper*/) const {
    const std::size_t j = sweep.start;
    FanState<Scalar> fan;
    const Scalar T0 = sweep.T0 + d * pure_slowness(j, sweep.upward);
    if (!(t >= T0) || !(T0 > 0)) return fan;
    fan.reachable = true;
    fan.r_min = d > 0 ? std::min(this->rate[j], sweep.r_min) : sweep.r_min;
    const auto at = [&](const Scalar& x) {
      Leg<Scalar> leg;
      const auto add = [&](const Scalar& dk, std::size_t k) {
        add_layer(*this, dk, k, sweep.upward, Scalar((this->rate[k] - fan.r_min) + fan.r_min * x * x), leg);
      };
      sweep.for_each_crossed(*this, add);
      if (d > 0) add(d, j);
      return leg;
    };
    Leg<Scalar> leg = at(Scalar(0));
    if (leg.time > t) {
      fan.x = Scalar(1);
      const Scalar low = is_finite(leg.time) ? Scalar(t / leg.time - Scalar(1)) : Scalar(-1);
      const Scalar high = t / T0 - Scalar(1);
      if (high > 0) {
        std::uintmax_t most = 300;
        const Scalar u = unit_roundoff<Scalar>();
        // t / T(x) is nearly linear: linear for one layer of a parabola.
        const auto [a, b] = boost::math::tools::toms748_solve(
            [&](const Scalar& x) { return Scalar(t / at(x).time - Scalar(1)); }, Scalar(0), Scalar(1), low,
            high, [&](const Scalar& x, const Scalar& y) { return y - x <= Scalar(2) * u * y; }, most);
        fan.x = a + (b - a) / Scalar(2);
      }
      leg = at(fan.x);
    }
    fan.H = fan.r_min / Scalar(4) * ((Scalar(1) - fan.x) * (Scalar(1) + fan.x));
    fan.Q = leg.Q;
    return fan;
  }

 private:
  [[nodiscard]] Scalar peaks_to(const Scalar& z) const {
    const std::size_t k = this->layer_at(z);
    return peaks_[k] + flux(k).peak() * (z - this->boundary(k));
  }

  std::vector<InverseFlux<Scalar>> fluxes_;
  std::vector<std::size_t> flux_of_;
  std::vector<Scalar> peaks_;             ///< int of the peak from the bottom, per boundary
  std::vector<Scalar> pure_slowness_[2];  ///< per layer, down and up
};

}  // namespace shearfront::exact
