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
  /// At z, at the time of the front that knows it better: its own time is uncertain by rounding of heights, which slow fronts
  /// magnify, and of areas, which weak ones do.
  [[nodiscard]] CurvedMeeting at(double z) const {
    const Passage a = passage(grid_, f_, z), b = passage(grid_, g_, z);
    return {uncertainty(f_, a, z) < uncertainty(g_, b, z) ? a.t : b.t, z};
  }
  /// Of the time, in units of rounding.
  [[nodiscard]] double uncertainty(const CurvedNode& f, const Passage& at, double z) const {
    const double h_below = grid_.capacity(grid_.level(f.below)),
                 h_above = grid_.capacity(grid_.level(f.above));
    const double area = std::abs(z - f.z) * std::min(1.0, std::max(h_below, h_above) / f.rate);
    return std::abs(at.slope * z) + 2 * area / std::abs(h_below - h_above);
  }
  /// Where the difference of the times of a and b is 0, being negative at `negative` and positive at `positive`.
  [[nodiscard]] CurvedMeeting root(const CurvedNode& a, const CurvedNode& b, double negative, double positive,
                                   double start) const {
    const double z = bracketed_root(negative, positive, start, [&](double x) { return difference(a, b, x); });
    return at(z);
  }

  /// A first guess of a root between lo and hi: Newton's from lo, or along the secant.
  [[nodiscard]] static double first_guess(double lo, double hi, const Passage& at_lo, double at_hi) {
    const double next = lo - at_lo.t / at_lo.slope, share = at_lo.t / (at_lo.t - at_hi);
    const bool is_inside = lo < hi ? next > lo && next < hi : next < lo && next > hi;
    return is_inside ? next : lo + (hi - lo) * std::clamp(share, 0.01, 0.99);
  }

  /// f rises, g sinks.
  [[nodiscard]] std::optional<CurvedMeeting> opposite() const {
    const double lo = std::max(f_.z, g_.end), hi = std::min(g_.z, f_.end);
    if (!(lo < hi)) {
      if (f_.z < g_.z) return std::nullopt;  // they turn before
      return CurvedMeeting{std::max(f_.t, g_.t), f_.z};
    }
    const Passage at_lo = difference(f_, g_, lo);
    if (at_lo.t > 0) {
      if (lo == f_.z) return at(lo);
      return std::nullopt;
    }
    const double at_hi = difference(f_, g_, hi).t;
    if (at_hi < 0) {
      if (hi == g_.z) return at(hi);
      return std::nullopt;
    }
    if (at_hi == at_lo.t) return at(lo);
    return root(f_, g_, lo, hi, first_guess(lo, hi, at_lo, at_hi));
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
    if (is_fan && !ahead(hi, dead)) return std::nullopt;
    const double at_hi = difference(rear, lead, hi).t;
    if (is_fan) {
      if (at_hi >= 0) return std::nullopt;
      const double from = ahead(dead, lo) ? (ahead(dead, hi) ? hi : dead) : lo;
      if (!(difference(rear, lead, from).t > 0)) return at(from);
      return root(rear, lead, hi, from, from + (hi - from) / 2);
    }
    const Passage at_lo = difference(rear, lead, lo);
    const bool touches = at_lo.t <= 0 && leaves(rear, lead, at_lo, s);
    if (at_lo.t <= 0 && !touches) return at(lo);
    if (at_hi <= 0)
      return root(rear, lead, hi, lo, touches ? lo + (hi - lo) / 2 : first_guess(lo, hi, at_lo, at_hi));
    if (!gets_smaller || !ahead(hi, dead)) return std::nullopt;
    return touching(rear, lead, lo, ahead(lo, dead) ? lo : dead, hi, s);
  }
  /// Whether they touch where one of them begins and then separate: a front that has just turned is faster than any other.
  [[nodiscard]] bool leaves(const CurvedNode& rear, const CurvedNode& lead, const Passage& at_lo,
                            int s) const {
    constexpr double kTie = 1e-12;  // what rounding makes of times that are equal, some events later
    return s * at_lo.slope > 0 && at_lo.t >= -kTie * std::max(rear.t, lead.t);
  }
  /// The difference is positive at lo and hi and has its minimum beyond `from`, if anywhere.
  [[nodiscard]] std::optional<CurvedMeeting> touching(const CurvedNode& rear, const CurvedNode& lead,
                                                      double lo, double from, double hi, int s) const {
    const auto growth = [&](double z) { return s * (slope_of(grid_, rear, z) - slope_of(grid_, lead, z)); };
    if (difference(rear, lead, from).t <= 0) return root(rear, lead, from, lo, lo + (from - lo) / 2);
    if (!(growth(from) < 0) || !(growth(hi) > 0)) return std::nullopt;
    double falling = from, rising = hi;
    constexpr int kMostHalvings = 60;
    for (int n = 0; n < kMostHalvings; ++n) {
      const double z = falling + (rising - falling) / 2;
      if (z == falling || z == rising) break;
      const Passage d = difference(rear, lead, z);
      if (d.t <= 0) return root(rear, lead, z, lo, lo + (z - lo) / 2);
      (s * d.slope < 0 ? falling : rising) = z;
    }
    return std::nullopt;
  }

  const LevelCurves& grid_;
  const CurvedNode &f_, &g_;
};

}  // namespace shearfront
