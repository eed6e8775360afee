// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "shearfront/riemann/state.hpp"
#include "shearfront/track/front_list.hpp"
#include "shearfront/track/level_curves.hpp"

namespace shearfront {

/// A front between two levels, or a boundary (wall, jump or kink of the rate), which rests.
///
/// By Rankine and Hugoniot a front between the states l, r of levels i != j moves such that
///
///     dt/dz = 2 (s_r q_j(z) - s_l q_i(z)) / (h_i - h_j),   s = -1 or 1 for low and high states,
///
/// so its time is a closed form of its height. Since q_i - q_j over h_j - h_i is a mean of the 1 / (r q) / 2 of the levels
/// between, a front between neighbouring levels is the mean of the characteristics of these fluxes.
struct CurvedNode {
  double z = 0, t = 0;              ///< passes z at t
  double rate = 0;                  ///< r(z)
  double q_below = 0, q_above = 0;  ///< of its levels at z
  double end = 0;                   ///< height at which it ends or turns
  double end_t = 0;                 ///< when it turns there
  double meets = 0, meeting_z = 0;  ///< next event: when, and where
  double turned = kNever;           ///< when a mean characteristic of its levels turned there; kEarlier
  State below = 0, above = 0;
  FrontIndex prev = kNoFront, next = kNoFront;
  std::uint32_t layer = 0;  ///< piece of a front; of a boundary the piece above it
  std::uint32_t stamp = 0;
  std::int8_t direction = 0;  ///< 1 up, -1 down, 0 it stands
  bool turns = false;         ///< it turns at its end
  bool turns_next = false;    ///< its next event is that
  bool is_edge = false;       ///< the edge of a fan next to a state that was there before
  double edge_t = 0;          ///< of an edge: when the characteristic of that state was at z

  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kEarlier = -kNever;  ///< it did in an earlier part of a smooth rate
  /// At its next event.
  [[nodiscard]] double position(double /*time*/) const { return meeting_z; }
};

/// When a front is at a height, and dt/dz there.
struct Passage {
  double t, slope;
};

namespace curved_front_detail {

/// Levels whose capacities differ by less than this part are taken for one where a difference would be rounding.
inline constexpr double kNearLevels = 1e-7;
/// Between levels nearer to each other than this part of r q^2 means are taken by Gauss's rule of three points, of which this is one.
inline constexpr double kCloseLevels = 0.0125, kOuterNode = 0.11270166537925831;
/// Times are functions of q at one end on the scale of q at the other; Gauss's rule takes them over an interval this much shorter.
inline constexpr double kFarFromOrigin = 64;
/// So near that q, which is at most the root of that where the lower one turns, changes less than the rule needs.
inline constexpr double kVeryCloseLevels = 1e-6;

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

/// When a front of one side is at z after it was at its origin, as the mean over its levels of the times of characteristics, by Gauss's
/// rule of three points: a relative error of 1e-15 where levels are near to each other, while the difference of their areas loses what
/// their distance is of their flux. Next to the turning heights of levels very near to each other in q at z, of which times are smooth
/// functions, and those that have turned apart. Nothing where they are not near. `shrink`: in an exponential piece, as there.
[[nodiscard]] inline std::optional<double> mean_time(const LevelCurves& grid, const CurvedNode& f,
                                                     double h_below, double h_above, double z, double rate,
                                                     double q_below, double q_above, double shrink = 0) {
  const double spread = std::abs(h_below - h_above), least = std::min(q_below, q_above);
  const bool is_far = spread < kCloseLevels * rate * least * least;
  if (!is_far && !(spread < kVeryCloseLevels * rate)) return std::nullopt;
  // A joint of a tabulated flux is no place for Gauss.
  if (grid.flux(f.layer) && !(spread < kNearLevels * std::max(h_below, h_above))) return std::nullopt;
  const bool is_from_turn = f.q_below == 0 && f.q_above == 0;
  const double least_before = std::min(f.q_below, f.q_above), most_before = std::max(f.q_below, f.q_above);
  const bool is_close_before = spread < kCloseLevels * (is_from_turn ? std::min(h_below, h_above)
                                                                     : f.rate * least_before * least_before);
  const double beyond =
      std::max(0.0, std::max(h_below, h_above) - f.rate);  // part of the flux that turns ahead
  const bool is_near_turn_before =
      is_far && kFarFromOrigin * most_before < least && spread < kVeryCloseLevels * f.rate;
  if (!is_close_before && !is_near_turn_before) return std::nullopt;
  const RatePiece& piece = grid.piece(f.layer);
  // Of the rate: how much it has grown, as a part of what it is then; and by its logarithm.
  const auto change_of = [&](double to_rate) { return (to_rate - f.rate) / to_rate; };
  double change_here = 0, log_here = 0;
  if (!is_from_turn && !grid.flux(f.layer)) {
    const double along = piece.bend * (z - f.z);
    const bool is_linear = piece.curve == RateCurve::linear;
    change_here = is_linear ? along / rate : -shrink;
    if (is_linear) log_here = rate < f.rate / 2 ? std::log(rate / f.rate) : std::log1p(along / f.rate);
  }
  const auto between = [](double below, double above, double share) {  // q^2 is linear in h
    return std::sqrt(std::max(0.0, below * below + share * ((above - below) * (above + below))));
  };
  // Of the characteristic of the flux that is this share of the way from the lower level to the upper one, from the origin, where q is
  // `before`, or from where it turns if that is 0, to where r and q are these.
  const auto time = [&](double share, double before, double q, double to_rate) {
    const double h = h_below + share * (h_above - h_below);
    const bool begins_at_turn = before == 0;
    if (grid.flux(f.layer)) {
      const LevelCurves::Place origin{begins_at_turn ? piece.height_of(h) : f.z, begins_at_turn ? h : f.rate,
                                      before},
          here{to_rate == rate ? z : piece.height_of(to_rate), to_rate, q};
      const bool rises = here.z > origin.z;
      const double way = grid.characteristic_time(f.layer, grid.is_high(f.above), h, rises ? origin : here,
                                                  rises ? here : origin);
      return rises ? way : -way;
    }
    const bool is_exponential = piece.curve == RateCurve::exponential;
    if (begins_at_turn) return is_exponential ? 2 * q / (h * piece.bend) : 2 * std::atanh(q) / piece.bend;
    const double change = to_rate == rate ? change_here : change_of(to_rate);
    if (is_exponential) return 2 * change / (f.rate * piece.bend * (before + q));
    const double logarithm = to_rate == rate ? log_here : RatePiece::log_ratio(f.rate, to_rate);
    return (2 * std::log1p(h * change / (f.rate * (before + q) * (1 + before))) + logarithm) / piece.bend;
  };
  // Mean of a function over an interval.
  const auto mean = [](double from, double to, const auto& value) {
    const auto at = [&](double part) { return value(from + part * (to - from)); };
    return (5 * (at(kOuterNode) + at(1 - kOuterNode)) + 8 * at(0.5)) / 18;
  };
  // Where the time is a smooth function of q, not of h, weights come from q: capacities so near to each other differ by rounding.
  const auto share_above_low = [&](double share) { return h_below < h_above ? share : 1 - share; };
  if (is_far) {
    const auto time_of = [&](double share, double before) {
      return time(share, before, between(q_below, q_above, share), rate);
    };
    if (is_close_before)
      return mean(0, 1, [&](double share) { return time_of(share, between(f.q_below, f.q_above, share)); });
    const double begun = f.rate * ((most_before - least_before) * (most_before + least_before)),
                 all = begun + beyond;
    if (!(all > 0)) return std::nullopt;
    double sum = 0;
    if (begun > 0)
      sum += (most_before - least_before) * mean(least_before, most_before, [&](double q) {
               const double above_low = f.rate * ((most_before - q) * (most_before + q)) / all;
               return 2 * f.rate * q * time_of(share_above_low(above_low), q);
             });
    if (beyond > 0)
      sum += beyond * mean(begun / all, 1, [&](double share) { return time_of(share_above_low(share), 0); });
    return sum / all;
  }
  const double low = std::min(h_below, h_above), high = std::max(h_below, h_above);
  const double most = std::max(q_below, q_above),
               live = std::clamp(rate, low, high);  // those above it have turned
  const double alive = rate * ((most - least) * (most + least)), all = alive + (high - live);
  if (!(all > 0)) return std::nullopt;
  double sum = 0;
  if (most > least)
    sum += (most - least) * mean(least, most, [&](double q) {
             const double share = share_above_low(rate * ((most - q) * (most + q)) / all);
             return 2 * rate * q * time(share, between(f.q_below, f.q_above, share), q, rate);
           });
  if (high > live && !is_from_turn)
    sum += (high - live) * mean(alive / all, 1, [&](double share) {
             const double of = share_above_low(share);
             return time(of, between(f.q_below, f.q_above, of), 0, low + share * (high - low));
           });
  return sum / all;
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
