// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "shearfront/track/level_curves.hpp"

namespace shearfront {

/// u(z, 0) where it varies.
struct StartShape {
  std::function<double(double z)> u;
  std::function<double(double lo, double hi)> amount;  ///< int u dz
};

/// A part of one piece in which u(z, 0) is constant, or continuous, on one side of the top of the flux, and r g(u) monotone.
struct StartSegment {
  std::size_t piece;
  double z_low, z_high;
  double u_low, u_high;                       ///< at its ends
  std::shared_ptr<const StartShape> shape{};  ///< none where u is constant

  StartSegment(std::size_t in, double low, double high, double u)
      : piece(in), z_low(low), z_high(high), u_low(u), u_high(u) {}
  StartSegment(std::size_t in, double low, double high, std::shared_ptr<const StartShape> course)
      : piece(in), z_low(low), z_high(high), u_low(course->u(low)), u_high(course->u(high)) {
    if (u_low != u_high || course->u(low + (high - low) / 2) != u_low) shape = std::move(course);
  }
};

/// What lies beyond the ends of a bed: walls, states in the course of time, or the other end.
struct CurvedEnds {
  std::array<std::vector<double>, 2>
      states{};  ///< u beyond the bottom (0) and the top (1), in turn; none: a wall
  std::array<std::vector<double>, 2> changes{};  ///< times between them
  bool is_periodic = false;
};

/// All that is to be tracked but the levels.
struct CurvedProblem {
  std::vector<RatePiece> pieces;
  std::vector<StartSegment> start;  ///< bottom to top
  CurvedEnds ends{};
  std::vector<bool> is_part{};  ///< a piece and the one below it are parts of a smooth rate; empty: none

  /// Whether the rate only goes on, rising or falling, from piece p - 1 to piece p: there is nothing in the bed.
  [[nodiscard]] bool continues(std::size_t p) const {
    return !is_part.empty() && is_part[p] && pieces[p - 1].bend * pieces[p].bend > 0;
  }
};

/// The initial state in levels: from one segment to the next a jump to be solved, inside a segment steps.
struct StartSegmentLevels {
  struct Step {
    double z;
    State below, above;
  };
  State at_low, at_high;    ///< at the ends of the segment
  std::vector<Step> steps;  ///< between them, ascending
};

/// Appends [low, high] of a piece, where `course` and its slope are monotone, cut where it passes the top of the flux and where
/// r g(u) has its extrema, which are looked for between 38 heights.
void add_smooth_segments(std::vector<StartSegment>& segments, const RatePiece& rate, std::size_t piece,
                         double low, double high, const std::shared_ptr<const StartShape>& course);

/// What the levels must know of a start: which capacities are met exactly, and where levels turn.
struct LevelPlan {
  std::vector<double> capacities;  ///< 4 H, ascending from 0
  std::vector<bool>
      is_plateau;  ///< whether a level is that of an initial state or of a jump or kink of the rate
  std::vector<KnownTurn> known;
};

/// Levels of which the steps of u are at most `resolution` where q >= 1/2 (of a parabola: |u - 1/2| >= 1/4); everything that can be excited by the start is
/// a level to the bit: capacities at the ends of pieces and at initial jumps up across the top of the flux, fluxes at the ends of segments.
/// Between them levels lie geometrically with an offset. Cost: O(levels + segments).
[[nodiscard]] LevelPlan plan_levels(const CurvedProblem& problem, double resolution);
/// How many levels these would be, about.
[[nodiscard]] double count_levels(const CurvedProblem& problem, double resolution);

/// The state u beyond an end, where the rate is that of the piece there: a level to the bit if it is one of the problem.
[[nodiscard]] State outside_state(const LevelCurves& grid, std::size_t end, double u);

/// A segment in levels. Where the rate or u varies it is no steady state: between the heights at which r g(u) is
/// a level there is one step, where it keeps the amount; the top of the flux, all along, is a level beyond its turning height. Cost: O(levels crossed).
[[nodiscard]] StartSegmentLevels in_levels(const LevelCurves& grid, const StartSegment& segment);

}  // namespace shearfront
