// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/events.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/middle.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

namespace {

using exact::CanonicalForm;
using exact::Cells;
using exact::FinalAmount;
using exact::Medium;
using exact::Path;
using exact::PathKind;

/// Whether the initial states equal `pure` on the whole of (from, to); decided from the data, not from sums.
template <Real Scalar>
bool is_pure(const Cells<Scalar>& cells, const Scalar& from, const Scalar& to, int pure) {
  for (std::size_t i = 0; i < cells.n_cells(); ++i)
    if (cells.x[i] < to && cells.x[i + 1] > from && (cells.is_curved(i) || cells.phi[i] != Scalar(pure)))
      return false;
  return true;
}

/// 1s below, 0s above, or only one of them.
template <Real Scalar>
bool is_steady(const Cells<Scalar>& cells) {
  bool seen_zero = false;
  for (std::size_t i = 0; i < cells.n_cells(); ++i) {
    const Scalar& u = cells.phi[i];
    if (cells.is_curved(i)) return false;
    if (u == Scalar(0)) {
      seen_zero = true;
    } else if (u != Scalar(1) || seen_zero) {
      return false;
    }
  }
  return true;
}

/// First time at which M(z, t) reaches its final amount.
///
/// Finds the root of N(t) = amount, N the least value over paths that do not start at a wall: before the root
/// N = M is increasing with slope H, after it N > amount (or no such path is left). Newton with the known
/// slope, kept inside a bracket, on the shortfall itself: where H is small, the difference of two rounded
/// amounts would cost u (top - bottom) / H of the time. For the same reason a path with H = 0 that ties with
/// the amount (a pure region that reached z before the wall's own path; `tie` tells it from one that misses a
/// real volume) makes way for the best moving one, whose shortfall decides. Precondition: M(z, 0) < amount.
/// `start` is any positive guess, `near` the best moving path found so far, at this height or another. Cost: about 10
/// queries.
template <Real Scalar>
Scalar final_time(const Medium<Scalar>& medium, const Scalar& z, FinalAmount amount, const Scalar& start,
                  const Scalar& height, Path<Scalar>& near) {
  const Scalar u = unit_roundoff<Scalar>();
  const Scalar tie = Scalar(64) * u * height;
  const auto shortfall = [&](const Path<Scalar>& path, const Scalar& time) {
    return path.kind == PathKind::none ? Scalar(0) : medium.shortfall(path, z, time, amount);
  };
  Scalar lo(0), hi = infinity<Scalar>(), t = start;
  constexpr int kMaxQueries = 4000;  // bisection of the whole exponent range
  for (int n = 0; n < kMaxQueries; ++n) {
    Path<Scalar> best = medium.best_beside(near, z, t, false);
    Scalar missing = shortfall(best, t);
    if (best.kind != PathKind::none && best.H == 0 && missing <= tie) {
      best = medium.best_beside(near, z, t, true);
      missing = shortfall(best, t);
    }
    if (best.kind != PathKind::none && best.H > 0) near = best;
    const bool none = best.kind == PathKind::none;
    (missing > 0 ? lo : hi) = t;
    Scalar next = t;
    if (!none && best.H > 0) {
      const Scalar step = missing / best.H;
      next = t + step;
      const Scalar size = step < 0 ? Scalar(-step) : step;
      if (size <= Scalar(4) * u * t) return next;
    }
    if (!(next > lo && next < hi)) {
      if (!is_finite(hi)) {
        next = Scalar(2) * t;
      } else if (lo > 0 && hi > Scalar(4) * lo) {
        next = exact::geometric_middle<Scalar>(lo, hi);
      } else {
        next = lo + (hi - lo) / Scalar(2);
      }
    }
    if (is_finite(hi) && hi - lo <= Scalar(4) * u * hi) return hi;
    t = next;
  }
  return t;
}

/// The same for fluxes with straight branches: pure states then travel with the contacts behind them, and a
/// moving path that ties with one at rest says nothing. Before the time some path misses something, after it none does;
/// what is missed is known to a few u of what its path carries, H t, and of paths at rest to rounding in twice the digits.
/// Steps as Newton's from before it, where a path that is linear in t leads there at once, else by halves. Precondition:
/// `late` is no earlier, and mostly it is the time. Cost: some four times two queries.
template <Real Scalar>
Scalar final_time_of_contacts(const Medium<Scalar>& medium, const Scalar& z, FinalAmount amount,
                              const Scalar& late, const Scalar& height, const Path<Scalar>& near) {
  const Scalar u = unit_roundoff<Scalar>();
  const auto gain = [&](const Path<Scalar>& path, const Scalar& time) {  // time until the path misses nothing
    if (path.kind == PathKind::none) return Scalar(0);
    const Scalar rounding = Scalar(64) * u * (path.H > 0 ? Scalar(path.H * time) : Scalar(u * height));
    const Scalar missing = medium.shortfall(path, z, time, amount);
    return !(missing > rounding) ? Scalar(0) : path.H > 0 ? Scalar(missing / path.H) : infinity<Scalar>();
  };
  const Scalar close = Scalar(4) * u;
  Scalar lo(0), hi = late, t = late - close * late, back = close;
  for (int n = 0; hi - lo > close * hi; ++n) {
    // Steps, however small they have become, may not take the place of halves for long.
    if (n % 4 == 3 || !(t > lo && t < hi)) t = lo + (hi - lo) / Scalar(2);
    if (!(t > lo && t < hi)) break;
    const Scalar left = std::max(gain(medium.best_beside(near, z, t, false), t),
                                 gain(medium.best_beside(near, z, t, true), t));
    if (left > 0) {
      lo = t;
      t += left + close * t;
    } else {
      hi = t;
      back *= Scalar(16);
      t -= back * t;
    }
  }
  return hi;
}

/// Whether pure states travel with contacts: a branch of a flux is straight.
template <Real Scalar>
bool has_contacts(const Scene<Scalar>& scene) {
  return std::any_of(scene.fluxes().begin(), scene.fluxes().end(), [](const Flux<Scalar>& flux) {
    if (flux.is_parabola()) return false;
    const Scalar m = flux.extrema().front();
    return is_straight(flux, flux.range().lowest, m) || is_straight(flux, m, flux.range().highest);
  });
}

/// The times of a canonical form, at its heights.
template <Real Scalar>
class Events {
 public:
  Events(const CanonicalForm<Scalar>& form, const Medium<Scalar>& medium)
      : form_(form), medium_(medium), has_contacts_(has_contacts(form.scene())) {}

  Timeline<Scalar> all() {
    Timeline<Scalar> events;
    events.t0 = at_wall(false);
    events.t1 = at_wall(true);
    events.t_star = is_steady(medium_.cells()) ? Scalar(0) : last_time(medium_.steady_height());
    if (!form_.is_exact()) return events;
    for (std::size_t i = 1; i + 1 < form_.boundaries().size(); ++i)
      events.interfaces.push_back(at_interface(i));
    return events;
  }

 private:
  /// First wave at the bottom or the top: of the nearest jump where the states really change, if the state at the wall
  /// is the one that does not stay there.
  std::optional<Scalar> at_wall(bool is_top) const {
    const Cells<Scalar>& cells = medium_.cells();
    const std::size_t n = cells.n_cells();
    const Scalar& state = is_top ? cells.phi_high[n - 1] : cells.phi[0];
    if (state == Scalar(is_top ? 0 : 1)) return std::nullopt;
    if (state != Scalar(is_top ? 1 : 0)) return Scalar(0);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t cell = is_top ? n - 1 - i : i;
      if (!cells.is_curved(cell) && cells.phi[cell] == state) continue;
      return medium_.pure_travel_time(cells.x[is_top ? cell + 1 : cell],
                                      is_top ? medium_.top() : medium_.bottom());
    }
    return std::nullopt;
  }

  typename Timeline<Scalar>::InterfaceTimes at_interface(std::size_t i) {
    const Scalar& y = form_.boundaries()[i];
    typename Timeline<Scalar>::InterfaceTimes times{form_.layers().boundary(i), medium_.first_wave(i), {}};
    // Only 1 below or only 0 above: no flux ever passes y, which acts as a wall; the first wave there is the
    // last.
    if (is_pure(medium_.cells(), medium_.bottom(), y, 1) || is_pure(medium_.cells(), y, medium_.top(), 0)) {
      times.last = times.first;
    } else {
      times.last = last_time(y);
      // The same wave can be the first and the last: rounding must not order them.
      if (times.first && *times.last < *times.first) times.last = times.first;
    }
    return times;
  }

  Scalar last_time(const Scalar& y) {
    const Scalar steady_height = medium_.steady_height();
    const auto amount = y < steady_height   ? FinalAmount::full_below
                        : y > steady_height ? FinalAmount::all_mass
                                            : FinalAmount::both;
    const Scalar start = last_ > 0 && is_finite(last_)
                             ? last_
                             : std::max(medium_.pure_travel_time(medium_.bottom(), y),
                                        medium_.pure_travel_time(medium_.top(), y));
    const Scalar height = medium_.top() - medium_.bottom();
    const Scalar t = final_time(medium_, y, amount, start, height, near_);
    last_ = t;
    return has_contacts_ ? final_time_of_contacts(medium_, y, amount, t, height, near_) : t;
  }

  const CanonicalForm<Scalar>& form_;
  const Medium<Scalar>& medium_;
  bool has_contacts_;
  Scalar last_{0};     ///< change at the height asked for before this one
  Path<Scalar> near_;  ///< by which it came, as mostly does that at the next height
};

}  // namespace

template <Real Scalar>
Timeline<Scalar> exact_timeline(const ExactSolution<Scalar>& solution) {
  const Scene<Scalar>& scene = solution.scene();
  Timeline<Scalar> events = Events<Scalar>(solution.form(), solution.medium()).all();
  events.mass = scene.mass();
  // Of a smooth c, not of its pieces.
  events.steady_height =
      scene.is_layered() || solution.form().is_identity() ? solution.steady_height() : scene.steady_height();
  return events;
}

template <Real Scalar>
Scalar timeline_error(const ExactSolution<Scalar>& solution, const Timeline<Scalar>& times) {
  if (solution.is_exact()) return Scalar(0);
  const Timeline<Scalar> coarse = Events<Scalar>(*solution.coarse_form(), solution.coarse_medium()).all();
  Scalar most(0);
  for (const auto member : {&Timeline<Scalar>::t0, &Timeline<Scalar>::t1, &Timeline<Scalar>::t_star}) {
    if (!(times.*member) || !(coarse.*member)) continue;
    const Scalar change = *(times.*member) - *(coarse.*member);
    most = std::max(most, change < 0 ? Scalar(-change) : change);
  }
  return most;
}

template Timeline<Instantiated> exact_timeline<Instantiated>(const ExactSolution<Instantiated>&);
template Instantiated timeline_error<Instantiated>(const ExactSolution<Instantiated>&,
                                                   const Timeline<Instantiated>&);

}  // namespace shearfront
