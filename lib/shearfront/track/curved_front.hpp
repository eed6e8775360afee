// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/track/curved_mean_time.hpp"
#include "shearfront/track/curved_node.hpp"
#include "shearfront/track/level_curves.hpp"

namespace shearfront {

namespace curved_front_detail {

/// front_slope() for fluxes that are no parabola.
[[nodiscard]] inline double branch_slope(const LevelCurves& grid, const CurvedNode& f, double rate,
                                         double q_below, double q_above) {
  const FluxBranches& flux = *grid.flux(f.layer);
  const double h_below = grid.capacity(grid.level(f.below)), h_above = grid.capacity(grid.level(f.above));
  const bool is_below_high = grid.is_high(f.below), is_above_high = grid.is_high(f.above);
  const auto lack = [&](bool is_high, double h, double q) {
    return q > 0 ? flux.lack(is_high, q, h / rate) : flux.spread(is_high);
  };
  const double s_j = is_above_high ? 1 : -1;
  if (is_below_high != is_above_high)
    return 2 * s_j * (2 - lack(is_below_high, h_below, q_below) - lack(is_above_high, h_above, q_above)) /
           (h_below - h_above);
  if (std::abs(h_below - h_above) < kNearLevels * h_below && q_below > 0 && q_above > 0)
    return 2 * s_j *
           flux.lack_slope(is_above_high, (q_below + q_above) / 2, (h_below + h_above) / (2 * rate)) / rate;
  return 2 * s_j * (lack(is_below_high, h_below, q_below) - lack(is_above_high, h_above, q_above)) /
         (h_below - h_above);
}

}  // namespace curved_front_detail

/// dt/dz of a front where the rate is `rate` and its levels have these q. The difference of two that are near to each other comes
/// from what they are.
[[nodiscard]] inline double front_slope(const LevelCurves& grid, const CurvedNode& f, double rate,
                                        double q_below, double q_above) {
  const double s_i = grid.sign(f.below), s_j = grid.sign(f.above);
  if (grid.flux(f.layer)) return curved_front_detail::branch_slope(grid, f, rate, q_below, q_above);
  if (s_i == s_j && q_below > 0 && q_above > 0) return 2 * s_j / (rate * (q_below + q_above));
  return 2 * (s_j * q_above - s_i * q_below) /
         (grid.capacity(grid.level(f.below)) - grid.capacity(grid.level(f.above)));
}

/// int (1 - q_k) dz from the origin of a front to a height as `plain` - `weight` log1p(logarithm), and q_k there.
struct LevelWay {
  double q, plain, weight, logarithm;
};

namespace curved_front_detail {

/// q of a level at z; `shrink` = r(origin) / r(z) - 1.
[[nodiscard]] inline double exponential_root(const LevelCurves& grid, const CurvedNode& f, std::size_t level,
                                             double q_origin, double z, double rate, double shrink) {
  if (level == 0) return 1;
  constexpr double kFarFromTurn = 0.75, kCancelling = 0.1;
  const double h = grid.capacity(level), x = h / rate;
  if (x < kFarFromTurn) return std::sqrt(1 - x);
  const double before = q_origin * q_origin, square = before - (h / f.rate) * shrink;
  return before > 0 && square > kCancelling * before ? std::sqrt(square) : grid.q(f.layer, level, z, rate);
}
[[nodiscard]] inline LevelWay exponential_way(const LevelCurves& grid, const CurvedNode& f, std::size_t level,
                                              double q_origin, double q, double z, double rate,
                                              double shrink) {
  if (level == 0) return {1, 0, 0, 0};
  constexpr double kSmallRoot = 0.1;  // below it terms cancel: LevelCurves::area knows how
  const std::size_t p = f.layer;
  const double h = grid.capacity(level), factor = 2 / grid.piece(p).bend;
  if (!(q_origin > 0)) {  // from its turning height on
    const double turn = grid.turning_height(p, level);
    if (q < kSmallRoot) return {q, (z - f.z) - grid.area(p, level, {turn, h, 0}, {z, h, q}), 0, 0};
    return {q, (turn - f.z) + factor * q, factor, q};
  }
  if (!(q > 0) || (q < kSmallRoot && q_origin < kSmallRoot))
    return {q, (z - f.z) - grid.area(p, level, {f.z, f.rate, q_origin}, {z, rate, q}), 0, 0};
  const double delta = -(h / f.rate) * shrink / (q_origin + q);
  return {q, factor * delta, factor, delta / (1 + q_origin)};
}

/// Whether the levels of a front in an exponential piece live at its origin and where r is less by `shrink`, by so much that no
/// term cancels.
[[nodiscard]] inline bool is_far_from_turns(const CurvedNode& f, double h_below, double h_above,
                                            double shrink) {
  constexpr double kFarRoot = 0.316, kFarShare = 0.9;  // q^2 >= 1 / 10
  return f.q_below > kFarRoot && f.q_above > kFarRoot &&
         std::max(h_below, h_above) * (1 + shrink) < kFarShare * f.rate;
}
/// passage() there: as by exponential_way(), with as few divisions as it takes.
[[nodiscard]] inline Passage far_passage(const CurvedNode& f, double h_below, double h_above, double s_below,
                                         double s_above, double bend, double d, double shrink) {
  const double at_origin = 1 / f.rate, here = at_origin * (1 + shrink);  // 1 / r
  const double q_below = std::sqrt(1 - h_below * here), q_above = std::sqrt(1 - h_above * here);
  const double scale = 2 / bend, slope = 2 * s_above * here / (q_below + q_above);
  const double least = std::min({q_below, q_above, f.q_below, f.q_above});
  if (s_below == s_above &&
      std::abs(h_below - h_above) * std::max(at_origin, here) < kCloseLevels * least * least) {
    // As mean_time().
    const auto time = [&](double share) {
      const double before =
          f.q_below * f.q_below + share * ((f.q_above - f.q_below) * (f.q_above + f.q_below));
      const double q = q_below * q_below + share * ((q_above - q_below) * (q_above + q_below));
      return 1 / (std::sqrt(before) + std::sqrt(q));
    };
    const double mean = (5 * (time(kOuterNode) + time(1 - kOuterNode)) + 8 * time(0.5)) / 18;
    return {f.t - s_above * mean * scale * at_origin * shrink, slope};
  }
  const double delta_below = -h_below * at_origin * shrink / (f.q_below + q_below),
               delta_above = -h_above * at_origin * shrink / (f.q_above + q_above);
  const double a = 1 + f.q_below, b = 1 + f.q_above, over = 2 / (h_below - h_above);
  if (s_below == s_above) {
    const double logarithm = std::log1p((delta_above * a - delta_below * b) / (b * (a + delta_below)));
    const double way = scale * ((delta_below - delta_above) + logarithm);
    return {f.t + over * s_above * way, slope};
  }
  const double logarithm =
      std::log1p((delta_below * b + delta_above * a + delta_below * delta_above) / (a * b));
  const double way = 2 * d + scale * (logarithm - delta_below - delta_above);
  return {f.t + over * s_above * way, over * s_above * (q_below + q_above)};
}

}  // namespace curved_front_detail

/// When a front is at a height of its piece, ahead of its origin.
[[nodiscard]] inline Passage passage(const LevelCurves& grid, const CurvedNode& f, double z) {
  const RatePiece& piece = grid.piece(f.layer);
  const double d = z - f.z;
  if (piece.is_constant() || d == 0) {
    const double slope = front_slope(grid, f, f.rate, f.q_below, f.q_above);
    return {f.t + slope * d, slope};
  }
  const std::size_t i = grid.level(f.below), j = grid.level(f.above), p = f.layer;
  const double h_i = grid.capacity(i), h_j = grid.capacity(j), factor = 2 / (h_i - h_j);
  const double s_i = grid.sign(f.below), s_j = grid.sign(f.above);
  const bool is_one_side = s_i == s_j;
  if (piece.curve == RateCurve::exponential && !grid.flux(f.layer)) {
    const bool needs_rate = (i > 0 && f.q_below > 0) || (j > 0 && f.q_above > 0);
    const double shrink = needs_rate ? std::expm1(-piece.bend * d) : 0;
    if (curved_front_detail::is_far_from_turns(f, h_i, h_j, shrink))
      return curved_front_detail::far_passage(f, h_i, h_j, s_i, s_j, piece.bend, d, shrink);
    const double rate = needs_rate ? f.rate / (1 + shrink) : piece.rate(z);
    const double q_i = curved_front_detail::exponential_root(grid, f, i, f.q_below, z, rate, shrink),
                 q_j = curved_front_detail::exponential_root(grid, f, j, f.q_above, z, rate, shrink);
    if (is_one_side)
      if (const auto mean = curved_front_detail::mean_time(grid, f, h_i, h_j, z, rate, q_i, q_j, shrink))
        return {f.t + s_j * *mean, front_slope(grid, f, rate, q_i, q_j)};
    const LevelWay a = curved_front_detail::exponential_way(grid, f, i, f.q_below, q_i, z, rate, shrink),
                   b = curved_front_detail::exponential_way(grid, f, j, f.q_above, q_j, z, rate, shrink);
    // Both logarithms at once: log1p(x) - log1p(y) = log1p((x - y) / (1 + y)).
    double way = is_one_side ? a.plain - b.plain : 2 * d - a.plain - b.plain;
    const double weight = std::max(std::abs(a.weight), std::abs(b.weight)) * (piece.bend < 0 ? -1 : 1);
    if (weight != 0) {
      const double x = b.logarithm, y = a.logarithm;
      way += weight * (is_one_side ? std::log1p((x - y) / (1 + y)) : std::log1p(x + y + x * y));
    }
    return {f.t + factor * s_j * way, front_slope(grid, f, rate, a.q, b.q)};
  }
  const double rate = piece.rate(z);
  const LevelCurves::Place below{z, rate, grid.q(p, i, z, rate)}, above{z, rate, grid.q(p, j, z, rate)};
  if (is_one_side)
    if (const auto mean = curved_front_detail::mean_time(grid, f, h_i, h_j, z, rate, below.q, above.q))
      return {f.t + s_j * *mean, front_slope(grid, f, rate, below.q, above.q)};
  const double E_i = grid.deficit(p, f.below, {f.z, f.rate, f.q_below}, below),
               E_j = grid.deficit(p, f.above, {f.z, f.rate, f.q_above}, above);
  const double way = s_i == s_j ? E_i - E_j : 2 * d - E_i - E_j;
  return {f.t + factor * s_j * way, front_slope(grid, f, rate, below.q, above.q)};
}
[[nodiscard]] inline double slope_of(const LevelCurves& grid, const CurvedNode& f, double z) {
  const std::size_t p = f.layer;
  const double rate = grid.piece(p).rate(z);
  return front_slope(grid, f, rate, grid.q(p, grid.level(f.below), z, rate),
                     grid.q(p, grid.level(f.above), z, rate));
}

/// Sets where the way of a front, or what is left of it, begins, with the states it has. Its lower state may be the upper one of another
/// front that begins there.
inline void set_origin(const LevelCurves& grid, CurvedNode& f, double z, double t,
                       const CurvedNode* neighbour = nullptr) {
  const std::size_t p = f.layer;
  f.z = z;
  f.t = t;
  f.rate = neighbour ? neighbour->rate : grid.piece(p).rate(z);
  f.q_below = neighbour ? neighbour->q_above : grid.q(p, grid.level(f.below), z, f.rate);
  f.q_above = grid.q(p, grid.level(f.above), z, f.rate);
}

/// Sets the course of a front from (z, t) on: its origin, direction, end, whether it turns there.
inline void set_course(const LevelCurves& grid, CurvedNode& f, double z, double t,
                       const CurvedNode* neighbour = nullptr) {
  const std::size_t i = grid.level(f.below), j = grid.level(f.above), p = f.layer;
  const RatePiece& piece = grid.piece(p);
  set_origin(grid, f, z, t, neighbour);
  f.turns = false;
  f.end = z;
  f.direction = 0;
  if (i == j) return;
  f.direction = (i > j) == (f.above > f.below) ? 1 : -1;
  f.end = f.direction > 0 ? piece.z_high : piece.z_low;
  const std::size_t most = std::max(i, j);
  const bool gets_smaller = f.direction > 0 ? piece.bend < 0 : piece.bend > 0;
  if (most < 2 || !gets_smaller) return;
  const double last = grid.turning_height(p, most - 1);
  if (f.direction > 0 ? !(last < f.end) : !(last > f.end)) return;
  f.end = f.direction > 0 ? std::max(last, z) : std::min(last, z);
  f.turns = most == (f.direction > 0 ? i : j);  // else the front ahead does
  if (f.turns) f.end_t = f.end == z ? t : passage(grid, f, f.end).t;
}

/// Newton's method inside a bracket: where evaluate(z) = {value, slope} is 0, the value having the sign of `orientation`
/// towards `hi` and the other one towards `lo`, lo and hi in any order.
template <class Evaluate>
[[nodiscard]] double bracketed_root(double lo, double hi, double start, Evaluate&& evaluate) {
  constexpr int kMostNewtonSteps = 200, kPatience = 6;
  constexpr double kLastStep = 1e-10;  // the next one would be its square
  const double bracket = std::abs(hi - lo), first = lo, last = hi;
  // Next to a turn, where a bracket likes to end, times bend within the way from there.
  const auto scale = [&](double z) { return std::min(std::abs(z - first), std::abs(z - last)); };
  double z = start;
  for (int n = 0; n < kMostNewtonSteps; ++n) {
    const Passage at = evaluate(z);
    if (at.t == 0) return z;
    (at.t < 0 ? lo : hi) = z;
    const double middle = lo + (hi - lo) / 2;
    double next = z - at.t / at.slope;
    const bool is_inside = lo < hi ? next > lo && next < hi : next > hi && next < lo;
    const bool is_newton = is_inside && !(n > kPatience && n % 3 == 0);
    if (!is_newton) next = middle;
    const double step = std::abs(next - z);
    if (step <= 2e-16 * (bracket + std::abs(z)) || next == lo || next == hi) return next;
    if (is_newton && step < kLastStep * std::min(std::abs(hi - lo), scale(next))) return next;
    z = next;
  }
  return z;
}

/// Where the characteristic of the mean flux of a front is at a time, which is next to it if its levels are; a height outside of
/// its way, or not a number, where that is not known.
[[nodiscard]] inline double mean_position(const LevelCurves& grid, const CurvedNode& f, double t) {
  const RatePiece& piece = grid.piece(f.layer);
  const double h = (grid.capacity(grid.level(f.below)) + grid.capacity(grid.level(f.above))) / 2;
  const double q = (f.q_below + f.q_above) / 2, turn = f.direction * piece.bend * (t - f.t) / 2;
  double lack = q > 0 ? h / f.rate / (1 + q) : 1;  // 1 - q, which changes by h turn or as artanh q by turn
  if (piece.curve == RateCurve::exponential) {
    lack -= h * turn;
  } else {
    const double change = std::tanh(turn);
    lack *= (1 - change) / (1 + q * change);
  }
  return piece.height_of(h / (lack * (2 - lack)));
}

/// Where a front is at a time. Precondition: it has begun; after its end it is there.
[[nodiscard]] inline double position_of(const LevelCurves& grid, const CurvedNode& f, double t) {
  if (f.direction == 0 || !(t > f.t)) return f.z;
  const auto late = [&](double z) {
    Passage at = passage(grid, f, z);
    at.t -= t;
    return at;
  };
  const bool is_curved = !grid.piece(f.layer).is_constant();
  if (is_curved && !grid.flux(f.layer) && grid.is_high(f.below) == grid.is_high(f.above)) {
    constexpr int kFewSteps = 4;
    constexpr double kLastStep = 1e-10;
    const double lo = std::min(f.z, f.end), hi = std::max(f.z, f.end);
    double z = mean_position(grid, f, t);
    for (int n = 0; n < kFewSteps && z > lo && z < hi; ++n) {
      const Passage at = late(z);
      const double step = at.t / at.slope, next = z - step;
      if (next >= lo && next <= hi && std::abs(step) < kLastStep * std::min(next - lo, hi - next))
        return next;
      z = next;
    }
  }
  const double t_end = f.turns ? f.end_t : passage(grid, f, f.end).t;
  if (!(t < t_end)) return f.end;
  const double share = (t - f.t) / (t_end - f.t);
  return bracketed_root(f.z, f.end, f.z + (f.end - f.z) * std::clamp(share, 0.01, 0.99), late);
}

}  // namespace shearfront
