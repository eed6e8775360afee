// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "shearfront/track/curved_node.hpp"
#include "shearfront/track/level_curves.hpp"

namespace shearfront::curved_front_detail {

/// Levels whose capacities differ by less than this part are taken for one where a difference would be rounding.
inline constexpr double kNearLevels = 1e-7;
/// Between levels nearer to each other than this part of r q^2 means are taken by Gauss's rule of three points, of which this is one.
inline constexpr double kCloseLevels = 0.0125, kOuterNode = 0.11270166537925831;
/// Times are functions of q at one end on the scale of q at the other; Gauss's rule takes them over an interval this much shorter.
inline constexpr double kFarFromOrigin = 64;
/// So near that q, which is at most the root of that where the lower one turns, changes less than the rule needs.
inline constexpr double kVeryCloseLevels = 1e-6;

/// When a front of one side is at z after it was at its origin, as the mean over its levels of the times of characteristics, by Gauss's
/// rule of three points: a relative error of 1e-15 where levels are near to each other, while the difference of their areas loses what
/// their distance is of their flux. Next to the turning heights of levels very near to each other, at z or at the origin, over q there, of
/// which times are smooth functions, and over those that have turned, or begin where they turn, apart. Nothing where they are not near.
/// `shrink`: in an exponential piece, as there.
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

}  // namespace shearfront::curved_front_detail
