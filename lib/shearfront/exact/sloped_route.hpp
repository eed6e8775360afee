// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/exact/middle.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_crossing.hpp"
#include "shearfront/exact/sloped_stretches.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// The way of a path without its start and its end: runs between nodes, each passed once or twice, and a turn. Its least
/// rate `least` is the largest h that can pass; with m the node that has it, h = least (1 - q_m^2).
template <Real Scalar>
struct SlopedRoute {
  /// Runs one after the other: `first`, which belongs to the view or to the search, to the end of a cell, and through whole cells
  /// beyond it.
  struct Leg {
    Passes passes = Passes::both;
    bool is_upwards = true;
    std::size_t cell = 0, n_cells = 0;
    const RunEnds<Scalar>* first = nullptr;
  };
  Leg once, twice;
  SlopedStretches<Scalar> stretches;  ///< of the runs
  Scalar least = infinity<Scalar>();
  Scalar turn_bend{0};  ///< |bend| of the piece in which it turns; 0: it does not
  RateForm turn_form = RateForm::linear;
  std::size_t turn_cell = 0;
  Scalar turn_rate{0};  ///< r where it enters that piece for good

  explicit SlopedRoute(bool has_bounds) : stretches(has_bounds) {}

  void add_bounds(const SlopedView<Scalar>& view, std::size_t cell, const RunEnds<Scalar>& run,
                  Passes passes) {
    if (stretches.is_off()) return;
    const bool is_same_flux = !view.fluxes || stretches.all().empty() ||
                              view.fluxes->of_piece[view.piece[cell]] ==
                                  view.fluxes->of_piece[view.piece[stretches.all().back().cell]];
    stretches.add(view.bends[cell], run.d, run.r1, run.r2, passes, cell, is_same_flux);
  }
  /// The next cell of what is passed once.
  void add(const SlopedView<Scalar>& view, std::size_t cell, const RunEnds<Scalar>& run, Passes passes,
           bool is_upwards) {
    least = std::min({least, run.r1, run.r2});
    if (once.n_cells++ == 0) {
      once.passes = passes;
      once.is_upwards = is_upwards;
      once.cell = cell;
      once.first = &run;
    }
    add_bounds(view, cell, run, passes);
  }
  /// Calls visit(leg, cell, run) for every run.
  template <class Visit>
  void for_each_run(const SlopedView<Scalar>& view, const Visit& visit) const {
    for (const Leg* leg : {&once, &twice}) {
      const auto& runs = leg->is_upwards ? view.upwards : view.downwards;
      for (std::size_t n = 0, cell = leg->cell; n < leg->n_cells; ++n, leg->is_upwards ? ++cell : --cell) {
        const RunEnds<Scalar>& run = n == 0 ? *leg->first : runs[cell];
        if (run.d > 0) visit(*leg, cell, run);
      }
    }
  }
};

/// A route at one h. F = q_m dT/dh is held between bounds on an interval of h by parts that are monotone in h:
/// F = rising + q_m steep + up - down, where rising and steep do not decrease and up, down and q_m do not increase. All of them are
/// kept times h, for rates may fall by more than the root of the largest number.
template <Real Scalar>
struct SlopedSample {
  Scalar v{0};                  ///< the variable of the search
  Scalar h{0}, lost{0}, qm{0};  ///< lost = least - h
  Scalar y{0}, rate{0};         ///< start of a state, and r there
  Scalar T{0}, X{0};            ///< X: with half of the E of a turn
  /// The parts of T that do not decrease and do not increase with h: not T less the other, which may be far larger.
  Scalar T_rising{0}, T_falling{0};
  Scalar X_falling{0};  ///< X of the turn
  Scalar rising{0}, steep{0}, up{0}, down{0};

  /// h F.
  [[nodiscard]] Scalar F() const { return rising + qm * steep + up - down; }
};

/// q at a node of rate r, where h = least - lost.
template <Real Scalar>
[[nodiscard]] Scalar q_at(const Scalar& r, const Scalar& inverse, const Scalar& least, const Scalar& lost) {
  using std::sqrt;
  const Scalar q2 = ((r - least) + lost) * inverse;
  return q2 > 0 ? Scalar(sqrt(q2)) : Scalar(0);
}
template <Real Scalar>
[[nodiscard]] Scalar q_at(const Scalar& r, const Scalar& least, const Scalar& lost) {
  return q_at<Scalar>(r, Scalar(1) / r, least, lost);
}

/// Adds all runs and the turn of a route to a sample that has h, lost, qm.
template <Real Scalar>
void add_route(const SlopedView<Scalar>& view, const SlopedRoute<Scalar>& route, SlopedSample<Scalar>& s) {
  const Scalar& least = route.least;
  Scalar r_last(-1), q_last(0);
  route.for_each_run(view, [&](const auto& leg, std::size_t, const RunEnds<Scalar>& run) {
    const Scalar q1 = run.r1 == r_last  ? q_last
                      : run.r1 == least ? s.qm
                                        : q_at(run.r1, run.inverse1, least, s.lost);
    const Scalar q2 = run.r2 == least ? s.qm : q_at(run.r2, run.inverse2, least, s.lost);
    r_last = run.r2;
    q_last = q2;
    const Crossing<Scalar> c(run, q1, q2, s.h);
    const Scalar n(leg.passes == Passes::both ? 2 : 1);
    s.T_rising += n * c.T;
    s.X += n * c.X;
    if (run.form == RateForm::linear) {
      const Scalar by = n * run.d * (s.h * run.inverse1) * run.inverse2, sum = q1 + q2;
      if (run.r1 == least)
        s.rising += by / (sum * q2);
      else if (run.r2 == least)
        s.rising += by / (sum * q1);
      else
        s.steep += by / (sum * (q1 * q2));
    } else {
      // T = 2 sigma / (q1 + q2); with q_m at one end the product does not decrease either.
      const Scalar by = n * c.T / (Scalar(2) * (q1 + q2));
      if (run.r1 == least)
        s.rising += by * (s.h * run.inverse1 + s.h * run.inverse2 * (q1 / q2));
      else if (run.r2 == least)
        s.rising += by * (s.h * run.inverse2 + s.h * run.inverse1 * (q2 / q1));
      else
        s.steep += by * (s.h * run.inverse1 / q1 + s.h * run.inverse2 / q2);
    }
  });
  if (route.turn_bend > 0) {
    const Scalar q = route.turn_rate == least ? s.qm : q_at(route.turn_rate, least, s.lost);
    const Turn<Scalar> turn(route.turn_form, route.turn_bend, route.turn_rate, q, s.h);
    s.T_falling += turn.T;
    s.X_falling += turn.X;
    s.X += s.X_falling;
    const Scalar ratio = route.turn_rate == least ? Scalar(1) : Scalar(s.qm / q);
    s.down += ratio * turn.steep;
  }
  s.T = s.T_rising + s.T_falling;
}

/// Whether times of a path and t are the same but for rounding, which at the ends of an interval of h, right at a node, paths of
/// another kind have as well: it must not drop both. Of T some u; and what `of_place()` says, which the rate at z makes, where q may be
/// the root of an error.
template <Real Scalar, class OfPlace>
[[nodiscard]] bool is_within_rounding(const Scalar& gap, const Scalar& t, const OfPlace& of_place) {
  using std::sqrt;
  const Scalar &u = unit_roundoff<Scalar>(), little = Scalar(256) * u * t;
  if (gap <= little) return true;
  return gap <= Scalar(8) * sqrt(u) * t && gap <= little + of_place();
}

/// All roots of T = t on [a, b], a.h < b.h, at which dT/dh has the sign `sign`: calls found(sample, change of v) with a
/// sample next to the root and what is missing to it. `at` makes the sample of a v, `slope` is t dv/dT there: dv/dT itself may be no number.
/// Rigorous: an interval is dropped only where T cannot be t or dT/dh cannot have the sign. A minimising path has no conjugate
/// point before t, so the sign is known: + for straight fans, - for turned ones.
/// `rounding` is what the rate at z makes of the T of a sample.
template <Real Scalar, class At, class Slope, class Found, class Rounding>
class SlopedRootSearch {
 public:
  SlopedRootSearch(const Scalar& t, int sign, const At& at, const Slope& slope, const Found& found,
                   const Rounding& rounding)
      : t_(t), sign_(sign), at_(at), slope_(slope), found_(found), rounding_(rounding) {}

  void run(const SlopedSample<Scalar>& a, const SlopedSample<Scalar>& b, int depth = 0) {
    // T between the values of its rising and its falling part.
    const auto rounding = [&] { return std::max(rounding_(a), rounding_(b)); };
    if (!is_within_rounding(Scalar(a.T_rising + b.T_falling - t_), t_, rounding)) return;
    if (!is_within_rounding(Scalar(t_ - (b.T_rising + a.T_falling)), t_, rounding)) return;
    const Scalar ratio = a.h / b.h;  // both times the h of a
    const Scalar low = a.rising + b.qm * a.steep + b.up * ratio - a.down;
    const Scalar high = (b.rising + a.qm * b.steep - b.down) * ratio + a.up;
    if (sign_ > 0 ? high < 0 : low > 0) return;
    constexpr int kMost = 100;
    const bool is_sure = sign_ > 0 ? low >= 0 : high <= 0;
    if (is_sure || depth == kMost) return solve(a, b);
    const Scalar middle = split(a.v, b.v);
    if (!(middle > std::min(a.v, b.v) && middle < std::max(a.v, b.v))) return solve(a, b);
    const SlopedSample<Scalar> m = at_(middle);
    run(a, m, depth + 1);
    run(m, b, depth + 1);
  }

  /// T is monotone on [a, b] with the sign wanted.
  void solve(const SlopedSample<Scalar>& a, const SlopedSample<Scalar>& b) {
    const SlopedSample<Scalar>& less = sign_ > 0 ? a : b;  // T <= t there
    const SlopedSample<Scalar>& more = sign_ > 0 ? b : a;
    if (less.T >= t_) {
      if (is_within_rounding(Scalar(less.T - t_), t_, [&] { return rounding_(less); }))
        found_(less, Scalar(0));
      return;
    }
    if (more.T <= t_) {
      if (is_within_rounding(Scalar(t_ - more.T), t_, [&] { return rounding_(more); }))
        found_(more, Scalar(0));
      return;
    }
    Scalar lo = less.v, hi = more.v, lo_T = less.T, hi_T = more.T;
    Place last, here{guess(lo, lo_T, hi, hi_T), Scalar(0), Scalar(0)};
    for (int n = 0; n < 400; ++n) {
      const SlopedSample<Scalar> s = at_(here.v);
      const Scalar gap = (t_ - s.T) / t_;
      (gap > 0 ? lo : hi) = here.v;
      here.T = s.T;
      here.slope = slope_(s);
      Scalar step = here.slope * gap;
      // Newton on 1 / T where that is the straighter line: T has a pole next to a flat piece of rate h.
      if (gap < 0) step *= s.T / t_;
      bool is_found = is_small(step, here.v);
      if (!is_found && n > 0) is_found = refine(last, here, step);
      if (is_found) return found_(s, step);
      Scalar next = here.v + step;
      const bool inside = next > std::min(lo, hi) && next < std::max(lo, hi);
      if (!inside) next = split(lo, hi);
      if (next == here.v || !(next > std::min(lo, hi) && next < std::max(lo, hi)))
        return found_(s, Scalar(0));
      last = here;
      here.v = next;
    }
  }

 private:
  struct Place {
    Scalar v{0}, T{0}, slope{0};  ///< t dv/dT
  };
  static Scalar size(const Scalar& x) { return x < 0 ? Scalar(-x) : x; }
  /// So small that its square is rounding.
  [[nodiscard]] static bool is_small(const Scalar& step, const Scalar& v) {
    using std::sqrt;
    static const Scalar close = sqrt(unit_roundoff<Scalar>());
    return size(step) <= close * size(v) || step == 0;
  }
  /// Newton's step from `here` by the cubic v(T) through this place and the last one, with their slopes: true if what it leaves is rounding.
  /// Its error is (t - T)^2 (t - T_last)^2 / 24 times the fourth derivative. With the length of v over which the slope changes, known
  /// from what the cubic corrects, that is correction^3 (way from the last place)^2 / step^4.
  [[nodiscard]] bool refine(const Place& last, const Place& here, Scalar& step) const {
    const Scalar gap = (t_ - here.T) / t_, before = (t_ - last.T) / t_, apart = (last.T - here.T) / t_;
    if (!(Scalar(4) * size(before) < Scalar(1)) || apart == 0) return false;
    const Scalar chord = (last.v - here.v) / apart, near = (chord - here.slope) / apart,
                 far = (last.slope - chord) / apart;
    const Scalar newton = here.slope * gap, correction = gap * gap * (near + before * ((far - near) / apart));
    if (!is_finite(correction) || size(correction) > size(newton)) return false;
    step = newton + correction;
    const Scalar scale = size(here.v), s = size(newton) / scale, c = size(correction) / scale,
                 way = size(Scalar(last.v - here.v)) / scale;
    const Scalar &rounding = unit_roundoff<Scalar>(), s2 = s * s;
    return s2 * s <= rounding && s2 * way * way <= rounding && c * c * c * way * way <= rounding * s2 * s2;
  }
  /// Where 1 / T is 1 / t if it is linear in v.
  Scalar guess(const Scalar& lo, const Scalar& lo_T, const Scalar& hi, const Scalar& hi_T) const {
    Scalar part(0.5);
    if (lo_T > 0)
      part = is_finite(hi_T) ? Scalar((hi_T / t_) * ((t_ - lo_T) / (hi_T - lo_T)))
                             : Scalar(Scalar(1) - lo_T / t_);
    part = std::clamp(part, Scalar(1) / Scalar(1024), Scalar(1023) / Scalar(1024));
    const Scalar v = lo + (hi - lo) * part;
    return v > 0 && std::min(lo, hi) * Scalar(64) < std::max(lo, hi) && std::min(lo, hi) > 0 ? split(lo, hi)
                                                                                             : v;
  }
  static Scalar split(const Scalar& a, const Scalar& b) {
    const Scalar &lo = std::min(a, b), &hi = std::max(a, b);
    if (lo > 0 && hi > Scalar(16) * lo) return geometric_middle<Scalar>(lo, hi);
    return lo + (hi - lo) / Scalar(2);
  }

  Scalar t_;
  int sign_;
  const At& at_;
  const Slope& slope_;
  const Found& found_;
  Rounding rounding_;
};

}  // namespace shearfront::exact
