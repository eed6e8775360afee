// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

#include "shearfront/exact/branch_means.hpp"
#include "shearfront/exact/inverse_flux.hpp"
#include "shearfront/exact/rate_form.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Paths with constant H where the rate r is linear or exponential in z, for any flux with one extremum (exact/inverse_flux.hpp).
///
/// With h = 4 H a path has G(p) = h / r, moves at the speed r |G'| / 4, and p' = r' G / 4 along it. m is the distance of p from the
/// pure state of the side it is on: towards 1 going up, towards 0 going down. Over a run from r1 to r2
///
///     T = int 4 dz / (r G'(m)),     X = int (G / G' - m) dz >= 0,
///
/// and, dz by dr and that by dm, with rho = -(m2 - m1) / (r2 - r1) = h / (r1 r2 [chord of G from m1 to m2]) and < > the mean over m,
///
///     linear, slope b:         T = 4 d rho <1 / G>,                     X = d h rho <(G - m G') / G^2>,
///     exponential, r' / r = k: T = 4 rho ((r2 - r1) / k) / h,           X = rho ((r2 - r1) / k) <(G - m G') / G>.
///
/// Nothing is divided by a small slope. The way up from r to the turn at the rate h and back, d_up and d_down its distances from the peak:
///
///     linear:      T = (4 / |b|) int dp / G,              X = r (d_up + d_down) / |b|,
///     exponential: T = 4 (d_up + d_down) / (|k| h),       X = (d_up + d_down) / |k| + int (p_up - p_down) dz.
///
/// The means are taken by Gauss and Legendre's rule between the places where a flux is not analytic: over m, with 20 points (100 in many
/// digits), where G is a cubic in pieces, what is singular next to the pure state taken out (exact/branch_means.hpp); else in log m, by
/// halves where a model says nothing. Error: of T and X some u of themselves and u m d.
namespace shearfront::exact {

/// A state on one side of the peak: its distances from the peak and from the pure state, of which the smaller is right to
/// a few u of itself.
template <Real Scalar>
struct LawState {
  Scalar from_peak, from_pure;
};

/// One side of a flux.
template <Real Scalar>
class LawSide {
 public:
  using State = LawState<Scalar>;

  LawSide(const InverseFlux<Scalar>& flux, bool is_up) : flux_(&flux), is_up_(is_up) {}

  [[nodiscard]] Scalar reach() const { return flux_->reach(is_up_); }
  /// The state that lacks e to the capacity and has G = 1 - e.
  [[nodiscard]] State at(const Scalar& e, const Scalar& G) const {
    if (G + G < Scalar(1)) {
      const Scalar m = G > 0 ? flux_->distance_beside(G, is_up_) : Scalar(0);
      return {reach() - m, m};
    }
    const Scalar d = flux_->inverse(e, is_up_);
    return {d, reach() - d};
  }
  /// G'.
  [[nodiscard]] Scalar slope(const State& s) const {
    return s.from_peak < s.from_pure ? flux_->slope(s.from_peak, is_up_)
                                     : flux_->rise_beside(s.from_pure, is_up_).slope;
  }
  /// The slope of the chord of G between two states.
  [[nodiscard]] Scalar chord(const State& a, const State& b) const {
    if (a.from_peak == b.from_peak && a.from_pure == b.from_pure) return slope(a);
    return flux_->chord_beside(a.from_pure, b.from_pure, is_up_);
  }
  [[nodiscard]] Scalar chord_between(const Scalar& m1, const Scalar& m2) const {
    return m1 == m2 ? flux_->rise_beside(m1, is_up_).slope : flux_->chord_beside(m1, m2, is_up_);
  }
  /// m2 - m1 by what is known better, and whether that is good enough.
  struct Change {
    Scalar value;
    bool is_large, by_peak;
  };
  [[nodiscard]] static Change change(const State& a, const State& b) {
    const Scalar of_peak = std::max(a.from_peak, b.from_peak), of_pure = std::max(a.from_pure, b.from_pure);
    const bool by_peak = of_peak < of_pure;
    const Scalar value = by_peak ? Scalar(a.from_peak - b.from_peak) : Scalar(b.from_pure - a.from_pure);
    const Scalar size = value < 0 ? Scalar(-value) : value;
    return {value, size > (by_peak ? of_peak : of_pure) / Scalar(16), by_peak};
  }
  /// Mean of 1 / G over m between two states.
  [[nodiscard]] Scalar mean_inverse(const Scalar& m1, const Scalar& m2) const {
    if (const auto* branch = flux_->branch(is_up_)) return BranchMeans<Scalar>(*branch, m1, m2).inverse();
    return mean(m1, m2, [](const Scalar& chord, const Scalar&, const Scalar& m) {
      return Scalar(Scalar(1) / (chord * m));
    });
  }
  /// Of (G - m G') / G.
  [[nodiscard]] Scalar mean_bow(const Scalar& m1, const Scalar& m2) const {
    if (const auto* branch = flux_->branch(is_up_)) return BranchMeans<Scalar>(*branch, m1, m2).bow();
    return mean(m1, m2, [](const Scalar& chord, const Scalar& slope, const Scalar&) {
      return Scalar((chord - slope) / chord);
    });
  }
  /// Of (G - m G') / G^2.
  [[nodiscard]] Scalar mean_bow_over_height(const Scalar& m1, const Scalar& m2) const {
    if (const auto* branch = flux_->branch(is_up_))
      return BranchMeans<Scalar>(*branch, m1, m2).bow_over_height();
    return mean(m1, m2, [](const Scalar& chord, const Scalar& slope, const Scalar& m) {
      return Scalar((chord - slope) / chord / (chord * m));
    });
  }
  /// int (reach - m) dG / G from a state to the peak.
  [[nodiscard]] Scalar rest_to_peak(const State& from) const {
    if (flux_->branch(is_up_)) {
      using std::log;
      const Scalar all = -reach() * log(Scalar(from.from_pure * chord_between(Scalar(0), from.from_pure)));
      return all - from.from_peak * (Scalar(1) - mean_bow(from.from_pure, reach()));
    }
    return from.from_peak *
           mean(from.from_pure, reach(), [&](const Scalar& chord, const Scalar& slope, const Scalar& m) {
             return Scalar((reach() - m) / m * (slope / chord));
           });
  }
  /// Mean of f(G / m, G', m) over m between two states.
  template <class F>
  [[nodiscard]] Scalar mean(const Scalar& m1, const Scalar& m2, const F& f) const {
    const auto at = [&](const Scalar& m) {
      const auto [chord, slope] = flux_->rise_beside(m, is_up_);
      return Scalar(f(chord, slope, m));
    };
    const Scalar &lo = std::min(m1, m2), &hi = std::max(m1, m2), width = hi - lo;
    if (!(width > 0)) return at(lo);
    Scalar all(0), from = lo;
    for (const Scalar& joint : flux_->joints(is_up_)) {
      if (!(joint > from)) continue;
      if (!(joint < hi)) break;
      all += integral(from, joint, at);
      from = joint;
    }
    return (all + integral(from, hi, at)) / width;
  }

 private:
  static constexpr bool kIsDouble = std::numeric_limits<Scalar>::digits == 53;
  static constexpr double kPanel = kIsDouble ? 0.5 : 0.1;
  using Rule = boost::math::quadrature::gauss<Scalar, kIsDouble ? 10 : 30>;
  using FewRule = boost::math::quadrature::gauss<Scalar, kIsDouble ? 6 : 30>;

  /// Of a flux that is analytic between lo and hi.
  template <class At>
  [[nodiscard]] Scalar integral(const Scalar& lo, const Scalar& hi, const At& at) const {
    using std::exp;
    using std::log;
    if (hi < lo + lo / Scalar(16)) return sum<FewRule>(lo, hi, at);
    const Scalar from = log(lo), to = log(hi);
    const int panels = 1 + static_cast<int>(to_double(Scalar((to - from) / kPanel)));
    const auto by_log = [&](const Scalar& x) {
      const Scalar m = std::clamp(Scalar(exp(x)), lo, hi);
      return Scalar(at(m) * m);
    };
    Scalar all(0);
    for (int n = 0; n < panels; ++n)
      all += sum<Rule>(Scalar(from + (to - from) * Scalar(n) / Scalar(panels)),
                       Scalar(from + (to - from) * Scalar(n + 1) / Scalar(panels)), by_log);
    return all;
  }
  /// By halves where the flux is not known to be smooth.
  template <class Nodes, class F>
  [[nodiscard]] Scalar sum(const Scalar& a, const Scalar& b, const F& f) const {
    const Scalar whole = rule<Nodes>(a, b, f);
    if (flux_->is_smooth()) return whole;
    return halves<Nodes>(a, b, f, whole,
                         Scalar(64) * unit_roundoff<Scalar>() * (whole < 0 ? Scalar(-whole) : whole), 0);
  }
  template <class Nodes, class F>
  [[nodiscard]] static Scalar halves(const Scalar& a, const Scalar& b, const F& f, const Scalar& whole,
                                     const Scalar& tolerance, int depth) {
    const Scalar middle = a + (b - a) / Scalar(2);
    const Scalar low = rule<Nodes>(a, middle, f), high = rule<Nodes>(middle, b, f),
                 change = whole - (low + high);
    constexpr int kMost = 40;
    if ((change < 0 ? Scalar(-change) : change) <= tolerance || depth == kMost) return low + high;
    return halves<Nodes>(a, middle, f, low, tolerance, depth + 1) +
           halves<Nodes>(middle, b, f, high, tolerance, depth + 1);
  }
  template <class Nodes, class F>
  [[nodiscard]] static Scalar rule(const Scalar& a, const Scalar& b, const F& f) {
    const auto& x = Nodes::abscissa();
    const auto& w = Nodes::weights();
    const Scalar middle = a + (b - a) / Scalar(2), half = (b - a) / Scalar(2);
    Scalar all(0);
    for (std::size_t n = 0; n < x.size(); ++n)  // an even rule: no abscissa is 0
      all += w[n] * (f(Scalar(middle - half * x[n])) + f(Scalar(middle + half * x[n])));
    return all * half;
  }

  const InverseFlux<Scalar>* flux_;
  bool is_up_;
};

/// A run over d from the rate r1 (with the state s1) to r2 (with s2), in which r has the bend `bend` in that direction.
template <Real Scalar>
struct LawRun {
  Scalar T{0}, X{0};

  LawRun(const LawSide<Scalar>& side, RateForm form, const Scalar& bend, const Scalar& d, const Scalar& r1,
         const LawState<Scalar>& s1, const Scalar& r2, const LawState<Scalar>& s2, const Scalar& h) {
    if (!(d > 0)) return;
    if (h == 0) {
      const Scalar four(4), slope = side.slope(s1);
      T = four / slope * pure_time(form, bend, d, r1, r2);
      return;
    }
    const Scalar rise = rise_of(form, bend, r1, d);
    const auto [rho, ends] = steepness(side, rise, r1, s1, r2, s2, h);
    if (!is_finite(rho)) {
      T = infinity<Scalar>();
      return;
    }
    const Scalar &m1 = s1.from_pure, &m2 = s2.from_pure;
    if (form == RateForm::linear) {
      T = Scalar(4) * d * rho * side.mean_inverse(m1, m2);
      // By the ends the same, of terms that are small where these are far apart: next to the peak those of the distances from it.
      if (ends == Ends::alike)
        X = d * h * rho * side.mean_bow_over_height(m1, m2);
      else if (ends == Ends::by_peak)
        X = d * ((r2 * s2.from_peak - r1 * s1.from_peak) / rise - side.reach());
      else
        X = d * ((r1 * m1 - r2 * m2) / rise);
    } else {
      const Scalar way = rise / bend;
      T = Scalar(4) * rho * way / h;
      X = rho * way * side.mean_bow(m1, m2);
    }
  }

  /// rho of a run in which r gains `rise`. Next to the peak states are known by what r differs from h, and that to rounding: where r
  /// hardly changes their difference is none of its.
  enum class Ends { alike, by_peak, by_pure };  ///< whether they differ by more than rounding, and in what
  struct Steepness {
    Scalar rho;
    Ends ends;
  };
  [[nodiscard]] static Steepness steepness(const LawSide<Scalar>& side, const Scalar& rise, const Scalar& r1,
                                           const LawState<Scalar>& s1, const Scalar& r2,
                                           const LawState<Scalar>& s2, const Scalar& h) {
    static const Scalar kResolved(std::ldexp(1.0, 6 - std::numeric_limits<Scalar>::digits / 2));
    const auto [change, is_large, by_peak] = LawSide<Scalar>::change(s1, s2);
    const Scalar least = kResolved * r1;
    if (is_large && (rise > least || -rise > least))
      return {-change / rise, by_peak ? Ends::by_peak : Ends::by_pure};
    return {h / r1 / r2 / side.chord(s1, s2), Ends::alike};
  }

  /// int dz / r.
  [[nodiscard]] static Scalar pure_time(RateForm form, const Scalar& bend, const Scalar& d, const Scalar& r1,
                                        const Scalar& r2) {
    using std::log1p;
    if (form == RateForm::exponential)
      return r1 < r2 ? exponential_time(bend, r1, d) : exponential_time(Scalar(-bend), r2, d);
    const Scalar& least = std::min(r1, r2);
    const Scalar x = (bend < 0 ? Scalar(-bend) : bend) * d / least;
    return x > 0 ? Scalar(d / least * (log1p(x) / x)) : Scalar(d / least);
  }
};

/// The way up from the rate r, with the states of both sides there, to the turn at the rate h and back down, in a piece that falls
/// with the given |bend|.
template <Real Scalar>
struct LawTurn {
  Scalar T{0};
  Scalar X{0};  ///< H T + int p dz - the height gained

  LawTurn(const LawSide<Scalar>& up, const LawSide<Scalar>& down, RateForm form, const Scalar& bend,
          const Scalar& r, const LawState<Scalar>& s_up, const LawState<Scalar>& s_down, const Scalar& h) {
    const Scalar four(4), both = s_up.from_peak + s_down.from_peak;
    if (form == RateForm::linear) {
      T = four / bend *
          (s_up.from_peak * up.mean_inverse(s_up.from_pure, up.reach()) +
           s_down.from_peak * down.mean_inverse(s_down.from_pure, down.reach()));
      X = r * both / bend;
    } else {
      T = four * (both / h) / bend;
      X = (both + (up.rest_to_peak(s_up) + down.rest_to_peak(s_down))) / bend;
    }
  }
};

}  // namespace shearfront::exact
