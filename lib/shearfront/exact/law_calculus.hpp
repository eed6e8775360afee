// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "shearfront/exact/law_run.hpp"
#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_calculus.hpp"

namespace shearfront::exact {

/// As ParabolaCalculus, for any flux with one extremum. With the slowness s = 4 / (r G') of a path and m as in
/// exact/law_run.hpp, over a run from r1 to r2, w the rise of r (of log r where it is exponential, and then T_i over r_i)
///
///     T_2 = (s_2 d - T) / w,   T_1 = (T - s_1 d) / w,   J_i = int hat_i / r dt, an integral over m,
///     linear: T_h = (r_1 s_1 - r_2 s_2) d / (h w),   exponential: T_h = ((s_1 - s_2) / k - T) / h,
///
/// and where the ends of a run are nearly the same these are integrals of the derivatives of s.
template <Real Scalar>
class LawCalculus {
 public:
  LawCalculus(const PieceFluxes<Scalar>& fluxes, const SlopedPieces<Scalar>& pieces, const Path<Scalar>& path)
      : fluxes_(fluxes), pieces_(pieces), path_(path), h_(Scalar(4) * path.H) {}

  /// Distance from the pure state of its side.
  [[nodiscard]] Scalar less(std::size_t k, const Scalar& r, bool is_up) const {
    return state(k, r, is_up).from_pure;
  }
  /// What p loses (going up) or gains over an interface to the layer above it.
  [[nodiscard]] Scalar change(std::size_t below, std::size_t above, bool is_up) const {
    return less(above, pieces_.low[above], is_up) - less(below, pieces_.high[below], is_up);
  }
  [[nodiscard]] bool is_jump(std::size_t below, std::size_t above) const {
    return pieces_.high[below] != pieces_.low[above] || fluxes_.of_piece[below] != fluxes_.of_piece[above];
  }
  [[nodiscard]] bool is_at_peak(std::size_t k, const Scalar& r, bool is_up) const {
    return !(state(k, r, is_up).from_peak > 0);
  }
  [[nodiscard]] Scalar slowness(std::size_t k, const Scalar& r, bool is_up) const {
    return Scalar(4) / (r * slope(k, state(k, r, is_up), is_up));
  }
  /// G of a state, |dG/dp| and the side it is on.
  [[nodiscard]] Scalar height(std::size_t k, const Scalar& p0) const { return fluxes_.flux(k).height_of(p0); }
  [[nodiscard]] Scalar height_slope(std::size_t k, const Scalar& p0, bool is_set_up) const {
    using std::sqrt;
    const Scalar& peak = fluxes_.flux(k).peak();
    const bool is_up = p0 == peak ? is_set_up : p0 > peak;
    const Scalar by = std::max(Scalar(sqrt(unit_roundoff<Scalar>())),
                               fluxes_.flux(k).slope(is_up ? Scalar(p0 - peak) : Scalar(peak - p0), is_up));
    return is_up ? Scalar(-by) : by;
  }
  /// Of a pure state by itself from piece to piece.
  [[nodiscard]] Scalar pure_ratio(std::size_t from, std::size_t to, bool is_up) const {
    const auto of = [&](std::size_t k) { return fluxes_.flux(k).slope(fluxes_.flux(k).reach(is_up), is_up); };
    return of(from) / of(to);
  }
  /// d phi / d (its height) at a source in a flat piece, times r t.
  [[nodiscard]] Scalar at_source(std::size_t k) const {
    const InverseFlux<Scalar>& flux = fluxes_.flux(k);
    return flux.slope(Scalar(0), true) > 0 ? Scalar(0) : Scalar(Scalar(-4) / flux.bend(Scalar(0), true));
  }

  [[nodiscard]] RunParts<Scalar> run(std::size_t k, bool is_up, const Scalar& d, const Scalar& r1,
                                     const Scalar& r2) const {
    const LawSide<Scalar> side = fluxes_.side(k, is_up);
    const RateForm form = pieces_.form[k];
    const Scalar &bend = pieces_.bend[k], zero(0), half(0.5), one(1);
    const LawState<Scalar> s1 = state(k, r1, is_up), s2 = state(k, r2, is_up);
    RunParts<Scalar> by{};
    by.T = LawRun<Scalar>(side, form, bend, d, r1, s1, r2, s2, h_).T;
    if (h_ == 0) {
      by.T1 = by.T2 = by.J1 = by.J2 = by.T_h = zero;
      return by;
    }
    // J_2 by the mean of the part of the way, or of the rise.
    const Scalar &m1 = s1.from_pure, &m2 = s2.from_pure;
    const Scalar all = m2 - m1, chord = side.chord(s1, s2), G2 = h_ / r2;
    const Scalar part =
        all == 0 ? half : side.mean(m1, m2, [&](const Scalar& to_pure, const Scalar&, const Scalar& m) {
          using std::log1p;
          const Scalar G = to_pure * m;
          if (form == RateForm::linear)
            return Scalar(G2 / G * ((m - m1) / all) * (side.chord_between(m1, m) / chord));
          const Scalar rise = side.chord_between(m1, m) * (m1 - m) / G;
          return Scalar(log1p(rise) / (bend * d));
        });
    if (form == RateForm::linear) {
      const Scalar all_rates = Scalar(4) * rho(side, k, d, r1, s1, r2, s2) * d / h_;
      by.J1 = all_rates * (one - part);
      by.J2 = all_rates * part;
    } else {
      by.J1 = by.T / r1 * (one - part);
      by.J2 = by.T / r2 * part;
    }
    times(k, is_up, d, r1, s1, r2, s2, by);
    return by;
  }

  [[nodiscard]] TurnParts<Scalar> turn(std::size_t j, bool is_set_up, const Scalar& A,
                                       const Scalar& from) const {
    const LawSide<Scalar> up = fluxes_.side(j, true), down = fluxes_.side(j, false);
    const LawState<Scalar> s_up = state(j, A, true), s_down = state(j, A, false);
    const Scalar bend = pieces_.bend[j] < 0 ? Scalar(-pieces_.bend[j]) : pieces_.bend[j], one(1);
    const Scalar &near = is_set_up ? pieces_.low[j] : pieces_.high[j],
                 &far = is_set_up ? pieces_.high[j] : pieces_.low[j], width = pieces_.width(j);
    TurnParts<Scalar> by{};
    by.T = LawTurn<Scalar>(up, down, pieces_.form[j], bend, A, s_up, s_down, h_).T;
    const Scalar slow = slowness(j, A, true) + slowness(j, A, false);
    const auto over = [&](const auto& f) {
      const auto at = [&](const Scalar& chord, const Scalar&, const Scalar& m) {
        return Scalar(f(Scalar(chord * m)));
      };
      return s_up.from_peak * up.mean(s_up.from_pure, up.reach(), at) +
             s_down.from_peak * down.mean(s_down.from_pure, down.reach(), at);
    };
    if (pieces_.form[j] == RateForm::linear) {
      const Scalar fall = near - far;
      by.M_far = over([&](const Scalar& G) { return Scalar((near - h_ / G) / fall); }) / bend;
      by.M_near = over([&](const Scalar& G) { return Scalar((h_ / G - far) / fall); }) / bend;
      by.T_A = slow / bend;
      by.T_far = by.T / fall;
      by.T_near = -by.T / fall;
      by.T_h = -A / h_ * slow / bend;
    } else {
      using std::log;
      const Scalar fall = bend * width, w_high = (from - pieces_.boundaries[j]) / width,
                   before = is_set_up ? w_high : Scalar(one - w_high);
      const Scalar passed =
          over([&](const Scalar& G) { return Scalar(before + log(Scalar(A / h_ * G)) / fall); }) / bend;
      const Scalar both = (s_up.from_peak + s_down.from_peak) / bend;
      by.M_far = passed / far;
      by.M_near = (both - passed) / near;
      by.T_A = slow / (bend * A);
      by.T_far = by.T / (fall * far);
      by.T_near = -by.T / (fall * near);
      by.T_h = -(by.T + slow / bend) / h_;
    }
    return by;
  }

 private:
  [[nodiscard]] LawState<Scalar> state(std::size_t k, const Scalar& r, bool is_up) const {
    const Scalar &least = path_.r_reference, lack = path_.x * path_.x,
                 e = r == least ? lack : Scalar(((r - least) + least * lack) / r);
    return fluxes_.side(k, is_up).at(std::clamp(e, Scalar(0), Scalar(1)),
                                     std::min(Scalar(1), Scalar(h_ / r)));
  }
  [[nodiscard]] Scalar slope(std::size_t k, const LawState<Scalar>& s, bool is_up) const {
    using std::sqrt;
    return std::max(Scalar(sqrt(unit_roundoff<Scalar>())), fluxes_.side(k, is_up).slope(s));
  }
  [[nodiscard]] Scalar rho(const LawSide<Scalar>& side, std::size_t k, const Scalar& d, const Scalar& r1,
                           const LawState<Scalar>& s1, const Scalar& r2, const LawState<Scalar>& s2) const {
    const Scalar rise = rise_of(pieces_.form[k], pieces_.bend[k], r1, d);
    return LawRun<Scalar>::steepness(side, rise, r1, s1, r2, s2, h_).rho;
  }

  void times(std::size_t k, bool is_up, const Scalar& d, const Scalar& r1, const LawState<Scalar>& s1,
             const Scalar& r2, const LawState<Scalar>& s2, RunParts<Scalar>& by) const {
    const Scalar four(4), one(1);
    const RateForm form = pieces_.form[k];
    const Scalar& bend = pieces_.bend[k];
    const Scalar slow1 = four / (r1 * slope(k, s1, is_up)), slow2 = four / (r2 * slope(k, s2, is_up));
    if (LawSide<Scalar>::change(s1, s2).is_large && r1 != r2) {
      if (form == RateForm::linear) {
        const Scalar rise = r2 - r1;
        by.T1 = (by.T - slow1 * d) / rise;
        by.T2 = (slow2 * d - by.T) / rise;
        by.T_h = d * (r1 * slow1 - r2 * slow2) / (h_ * rise);
      } else {
        const Scalar rise = bend * d;
        by.T1 = (by.T - slow1 * d) / (rise * r1);
        by.T2 = (slow2 * d - by.T) / (rise * r2);
        by.T_h = ((slow1 - slow2) / bend - by.T) / h_;
      }
      return;
    }
    using Rule = boost::math::quadrature::gauss<Scalar, std::numeric_limits<Scalar>::digits == 53 ? 10 : 30>;
    by.T1 = by.T2 = by.T_h = Scalar(0);
    const auto add = [&](const Scalar& w, const Scalar& weight) {
      const Scalar r =
          std::clamp(rate_beyond(form, bend, r1, Scalar(w * d)), std::min(r1, r2), std::max(r1, r2));
      const LawState<Scalar> s = state(k, r, is_up);
      const Scalar dG = slope(k, s, is_up), slow = four / (r * dG),
                   ddG = fluxes_.flux(k).bend(s.from_peak, is_up);  // -G''
      const Scalar by_h = slow * ddG / (r * dG * dG), by_r = -(slow + by_h * h_) / r;
      const bool is_linear = form == RateForm::linear;
      const Scalar hat1 = is_linear ? Scalar(one - w) : Scalar(r / r1 * (one - w)),
                   hat2 = is_linear ? w : Scalar(r / r2 * w);
      by.T1 += weight * d * by_r * hat1;
      by.T2 += weight * d * by_r * hat2;
      by.T_h += weight * d * by_h;
    };
    // Between joints of the flux, where its second derivative may jump.
    Scalar from(0);
    const auto over = [&](const Scalar& to) {
      const Scalar middle = (from + to) / Scalar(2), half = (to - from) / Scalar(2);
      for (std::size_t n = 0; n < Rule::abscissa().size(); ++n) {
        const Scalar x = half * Rule::abscissa()[n], weight = half * Rule::weights()[n];
        add(Scalar(middle - x), weight);
        add(Scalar(middle + x), weight);
      }
      from = to;
    };
    const bool grows = s2.from_pure > s1.from_pure;
    const auto& joints = fluxes_.flux(k).joints(is_up);
    for (std::size_t n = 0; n < joints.size(); ++n) {
      const Scalar& m = joints[grows ? n : joints.size() - 1 - n];
      if (!(m > std::min(s1.from_pure, s2.from_pure) && m < std::max(s1.from_pure, s2.from_pure))) continue;
      const Scalar r = h_ / (m * fluxes_.flux(k).rise_beside(m, is_up).chord);
      const Scalar w = distance_of(form, bend, r1, Scalar(r - r1)) / d;
      if (w > from && w < one) over(w);
    }
    over(one);
  }

  const PieceFluxes<Scalar>& fluxes_;
  const SlopedPieces<Scalar>& pieces_;
  const Path<Scalar>& path_;
  Scalar h_;
};

}  // namespace shearfront::exact
