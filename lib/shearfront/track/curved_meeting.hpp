// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shearfront/track/curved_front.hpp"

namespace shearfront {

/// When and where two neighbours meet.
struct CurvedMeeting {
  double t, z;
};

/// The meeting of front or boundary `f` with its upper neighbour `g`; none if a turn or a boundary comes first for one of
/// them, or nothing. Whether fronts of one fan meet is decided on their states; else by signs of the difference of their times
/// at the ends of the stretch both pass, which changes its sign once. Only where the higher level has turned the polygon of
/// fluxes is not convex, and two fronts can touch and separate again: there the least difference is found first.
class CurvedMeetings {
 public:
  CurvedMeetings(const LevelCurves& grid, const CurvedNode& f, const CurvedNode& g)
      : grid_(grid), f_(f), g_(g) {}

  [[nodiscard]] std::optional<CurvedMeeting> find() const {
    if (f_.direction <= 0 && g_.direction >= 0) return std::nullopt;
    if (g_.direction == 0) return arrival(f_, g_.z);
    if (f_.direction == 0) return arrival(g_, f_.z);
    if (f_.direction != g_.direction) return opposite();
    return f_.direction > 0 ? overtaking(f_, g_, 1) : overtaking(g_, f_, -1);
  }

 private:
  [[nodiscard]] std::optional<CurvedMeeting> arrival(const CurvedNode& mover, double z) const {
    if (mover.direction * (z - mover.end) > 0) return std::nullopt;
    if (!(mover.direction * (z - mover.z) > 0)) return CurvedMeeting{mover.t, z};
    return CurvedMeeting{passage(grid_, mover, z).t, z};
  }
  [[nodiscard]] Passage difference(const CurvedNode& later, const CurvedNode& sooner, double z) const {
    const Passage a = passage(grid_, later, z), b = passage(grid_, sooner, z);
    return {a.t - b.t, a.slope - b.slope};
  }
  /// The same without the slope; when a front turns is known.
  [[nodiscard]] double lag(const CurvedNode& later, const CurvedNode& sooner, double z) const {
    const auto time = [&](const CurvedNode& f) {
      return f.turns && z == f.end ? f.end_t : passage(grid_, f, z).t;
    };
    return time(later) - time(sooner);
  }
  /// Both fronts at a height.
  struct Pair {
    double z;
    Passage f, g;
  };
  [[nodiscard]] Pair pair_at(double z) const { return {z, passage(grid_, f_, z), passage(grid_, g_, z)}; }
  /// At z, next to where they have been looked at, at the time of the front that knows it better: its own time is uncertain by
  /// rounding of heights, which slow fronts magnify, and of areas, which weak ones do.
  [[nodiscard]] CurvedMeeting meeting(const Pair& near, double z) const {
    const Passage& of = uncertainty(f_, near.f, z) < uncertainty(g_, near.g, z) ? near.f : near.g;
    return {z == near.z ? of.t : of.t + of.slope * (z - near.z), z};
  }
  /// The cubic through the times and slopes at two heights.
  [[nodiscard]] static double time_between(double z_a, const Passage& a, double z_b, const Passage& b,
                                           double z) {
    const double h = z_a - z_b, x = (z - z_b) / h, y = 1 - x;
    return b.t + x * x * (3 - 2 * x) * (a.t - b.t) + h * x * y * (b.slope * y - a.slope * x);
  }
  /// The same by cubics through the times at both heights, if they too meet there.
  [[nodiscard]] std::optional<CurvedMeeting> meeting(const Pair& far, const Pair& near, double z,
                                                     double tolerance) const {
    const double f = time_between(far.z, far.f, near.z, near.f, z),
                 g = time_between(far.z, far.g, near.z, near.g, z);
    if (!(std::abs(f - g) <= tolerance)) return std::nullopt;
    return CurvedMeeting{uncertainty(f_, near.f, z) < uncertainty(g_, near.g, z) ? f : g, z};
  }
  [[nodiscard]] CurvedMeeting at(double z) const { return meeting(pair_at(z), z); }
  /// Of the time, in units of rounding: of heights, which are found to a part of their piece, and of areas.
  [[nodiscard]] double uncertainty(const CurvedNode& f, const Passage& at, double z) const {
    const double h_below = grid_.capacity(grid_.level(f.below)),
                 h_above = grid_.capacity(grid_.level(f.above));
    const RatePiece& piece = grid_.piece(f.layer);
    const double area = std::abs(z - f.z) * std::min(1.0, std::max(h_below, h_above) / f.rate);
    return std::abs(at.slope) * (std::abs(z) + (piece.z_high - piece.z_low)) +
           2 * area / std::abs(h_below - h_above);
  }

  /// A height with the difference of times there.
  struct Point {
    double z;
    Passage d;
  };
  /// Where the height as a cubic function of the difference, by its values and slopes in two points, has the difference 0.
  [[nodiscard]] static double interpolated(const Point& a, const Point& b) {
    const double h = b.d.t - a.d.t, x = -a.d.t / h, y = 1 - x;
    return b.z + (a.z - b.z) * ((1 + 2 * x) * y * y) + h * x * y * (y / a.d.slope - x / b.d.slope);
  }
  /// The difference of the times of f and g, times `sign`.
  [[nodiscard]] static Point point(const Pair& at, int sign) {
    return {at.z, {sign * (at.f.t - at.g.t), sign * (at.f.slope - at.g.slope)}};
  }
  /// The first place from `start`, where the difference times `sign` of the times of f and g is positive, on the way to `to` at
  /// which it is 0; none if it is positive there. Precondition: it changes its sign once at most. Newton's method, then cubic
  /// interpolation, in a bracket; `to` is looked at only if they lead there, at once where nothing is known of `start`.
  [[nodiscard]] std::optional<CurvedMeeting> first_zero(int sign, const Pair& start, double to,
                                                        bool is_start_known = true) const {
    constexpr int kMostEvaluations = 200, kPatience = 8;
    constexpr double kLastStep = 1e-9;  // the next one would be its square at least
    constexpr double kRounding = 2e-16;
    const RatePiece& piece = grid_.piece(f_.layer);
    const double from = start.z, length = std::abs(to - from), height = piece.z_high - piece.z_low;
    double positive = from, beyond = to;
    bool has_bracket = false;
    const auto is_inside = [&](double z) {
      return positive < beyond ? z > positive && z < beyond : z < positive && z > beyond;
    };
    Pair previous = start;
    Point last = is_start_known ? point(start, sign) : Point{from, {1, 0}};
    double z = from - last.d.t / last.d.slope;
    enum class By { newton, cubic, other } by = By::newton;  // how z was found
    if (!is_inside(z)) {
      z = to;
      by = By::other;
    }
    for (int n = 0;; ++n) {
      const Pair both = pair_at(z);
      const Point now = point(both, sign);
      if (z == to && !has_bracket && now.d.t > 0) return std::nullopt;
      if (n == kMostEvaluations) return meeting(both, z);
      has_bracket = has_bracket || now.d.t < 0;
      (now.d.t < 0 ? beyond : positive) = z;
      if (std::abs(now.d.t) <= kRounding * std::abs(z * now.d.slope)) return meeting(both, z);
      const double newton = z - now.d.t / now.d.slope;
      double next = interpolated(last, now);
      const bool is_cubic = is_inside(next);
      if (!is_cubic) next = newton;
      bool is_guess = is_inside(next);
      if (is_guess && has_bracket && n > kPatience && n % 3 == 0) is_guess = false;
      if (!is_guess) next = has_bracket ? positive + (beyond - positive) / 2 : to;
      const double step = std::abs(next - z);
      if (has_bracket && (next == positive || next == beyond)) return meeting(both, next);
      if (step <= kRounding * (length + std::abs(z))) return meeting(both, next);
      // Where one front stands for a while the cubic may stay at a place that is no root.
      const double larger = std::max(step, std::abs(newton - z));
      // Next to turning heights times bend within the way from there, which may be far shorter than the bracket.
      if (is_guess && larger < kLastStep * std::min(std::abs(beyond - positive), std::abs(next - from)))
        return meeting(both, next);
      // d apart, Newton's step has left k d^2: then the cubic is off by about k^3 of the product of both squares, and K of them if it
      // was a cubic that has left K d^4 at most. Where that is not so the cubics of both times do not meet there.
      const double apart = std::abs(z - last.z), share = larger / apart, cube = share * share * share;
      constexpr double kSmallShare = 0.01, kPartOfRounding = 0.01, kNear = 1.0 / 256;
      if (is_guess && is_cubic && by != By::other && apart < kNear * height && share < kSmallShare &&
          cube * (by == By::newton ? share * larger : apart) <=
              kPartOfRounding * kRounding * (length + std::abs(z)))
        if (const auto met = meeting(previous, both, next,
                                     kRounding * (std::abs(now.d.slope) * (length + std::abs(z)) + both.f.t)))
          return met;
      by = is_guess && is_cubic ? By::cubic : By::other;
      previous = both;
      last = now;
      z = next;
    }
  }

  /// What rounding makes of two times that are equal, some events later.
  [[nodiscard]] double tie(const Pair& at) const {
    constexpr double kTie = 1e-12, kRoundings = 64 * 0x1p-53;
    return kTie * std::max(at.f.t, at.g.t) +
           kRoundings * (uncertainty(f_, at.f, at.z) + uncertainty(g_, at.g, at.z));
  }
  /// f rises, g sinks. Where one turns when the other comes it turns first: then it is faster than any other, and they part.
  [[nodiscard]] std::optional<CurvedMeeting> opposite() const {
    const double lo = std::max(f_.z, g_.end), hi = std::min(g_.z, f_.end);
    if (!(lo < hi)) {
      if (f_.z < g_.z) return std::nullopt;  // they turn before
      return CurvedMeeting{std::max(f_.t, g_.t), f_.z};
    }
    const Pair both = pair_at(lo);
    const Passage at_lo{both.g.t - both.f.t, both.g.slope - both.f.slope};
    if (g_.turns && lo == g_.end && lo > f_.z && at_lo.t <= tie(both)) return std::nullopt;
    if (f_.turns && hi == f_.end && hi < g_.z) {
      const Pair at_hi = pair_at(hi);
      if (at_hi.f.t - at_hi.g.t <= tie(at_hi)) return std::nullopt;
    }
    if (at_lo.t < 0) {
      if (lo == f_.z) return at(lo);
      return std::nullopt;
    }
    if (at_lo.t == 0) return at(lo);
    if (const auto met = first_zero(-1, both, hi)) return met;
    if (hi == g_.z) return at(hi);
    return std::nullopt;
  }

  /// `rear` follows `lead` in the direction s.
  [[nodiscard]] std::optional<CurvedMeeting> overtaking(const CurvedNode& rear, const CurvedNode& lead,
                                                        int s) const {
    if (f_.below == g_.above) return std::nullopt;  // they run in parallel
    const auto ahead = [s](double x, double y) { return s > 0 ? x > y : x < y; };
    const double lo = ahead(rear.z, lead.z) ? rear.z : lead.z;
    const double hi = ahead(rear.end, lead.end) ? lead.end : rear.end;
    if (ahead(lo, hi)) return std::nullopt;
    const std::size_t p = f_.layer;
    const std::size_t most = std::max({grid_.level(f_.below), grid_.level(f_.above), grid_.level(g_.above)});
    const RatePiece& piece = grid_.piece(p);
    const bool gets_smaller = s * piece.bend < 0;
    // Beyond it the polygon is not convex.
    const double dead = most > 0 && gets_smaller ? grid_.turning_height(p, most) : hi;
    const bool is_fan = f_.below < g_.below && g_.below < g_.above;
    if (is_fan) {
      if (!ahead(hi, dead)) return std::nullopt;
      if (lag(rear, lead, hi) >= 0) return std::nullopt;
      const double from = ahead(dead, lo) ? (ahead(dead, hi) ? hi : dead) : lo;
      const Pair both = pair_at(from);
      if (!(point(both, s).d.t > 0)) return meeting(both, from);
      return first_zero(s, both, hi);
    }
    const Pair both = pair_at(lo);
    const Passage at_lo = point(both, s).d;
    // A front that has just turned is faster than any other: where another is then they touch and separate.
    const bool touches = s * at_lo.slope > 0 && std::abs(at_lo.t) <= tie(both);
    if (at_lo.t <= 0 && !touches) return meeting(both, lo);
    const bool may_part = gets_smaller && ahead(hi, dead);
    if (!touches && !may_part) return first_zero(s, both, hi);
    if (lag(rear, lead, hi) <= 0) return first_zero(s, both, hi, !touches);
    if (!may_part) return std::nullopt;
    return touching(rear, lead, lo, ahead(lo, dead) ? lo : dead, hi, s);
  }
  /// The difference is positive at lo and hi and has its minimum beyond `from`, if anywhere.
  [[nodiscard]] std::optional<CurvedMeeting> touching(const CurvedNode& rear, const CurvedNode& lead,
                                                      double lo, double from, double hi, int s) const {
    const auto growth = [&](double z) { return s * (slope_of(grid_, rear, z) - slope_of(grid_, lead, z)); };
    // Where one of them touches the other at lo, the place to begin with is not that.
    const auto zero_before = [&](double z) { return first_zero(s, {lo, {}, {}}, z, false); };
    if (difference(rear, lead, from).t <= 0) return zero_before(from);
    if (!(growth(from) < 0) || !(growth(hi) > 0)) return std::nullopt;
    double falling = from, rising = hi;
    constexpr int kMostHalvings = 60;
    for (int n = 0; n < kMostHalvings; ++n) {
      const double z = falling + (rising - falling) / 2;
      if (z == falling || z == rising) break;
      const Passage d = difference(rear, lead, z);
      if (d.t <= 0) return zero_before(z);
      (s * d.slope < 0 ? falling : rising) = z;
    }
    return std::nullopt;
  }

  const LevelCurves& grid_;
  const CurvedNode &f_, &g_;
};

}  // namespace shearfront
