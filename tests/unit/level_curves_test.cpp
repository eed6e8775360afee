// SPDX-License-Identifier: BSD-3-Clause
// Steady profiles of levels, their areas and the paths of fronts: closed forms against quadrature and the equations.
#include "shearfront/track/level_curves.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/track/curved_front.hpp"
#include "shearfront/track/curved_start.hpp"

namespace shearfront {
namespace {

const std::vector<RatePiece>& curved_pieces() {
  static const std::vector<RatePiece> all{
      {0, 1, 2, 0.5, RateCurve::linear},      {0, 1, 0.5, 2, RateCurve::linear},
      {0, 1, 2, 0.5, RateCurve::exponential}, {0, 1, 0.5, 2, RateCurve::exponential},
      {0, 1, 1, 1.0001, RateCurve::linear},   {0, 1, 1.0001, 1, RateCurve::exponential},
      {0, 1, 0.7, 0.7, RateCurve::constant}};
  return all;
}

double quadrature(const LevelCurves& grid, std::size_t level, double from, double to) {
  // z = turn +- y^2, where the root is smooth.
  const double turn = grid.piece(0).is_constant() ? from : grid.turning_height(0, level);
  const double sign = from < turn || to < turn ? -1 : 1;
  if (std::abs(turn - 0.5) > 2)
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        [&](double z) { return grid.q(0, level, z); }, from, to, 12, 1e-14);
  return sign * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                    [&](double y) { return 2 * y * grid.q(0, level, turn + sign * y * y); },
                    std::sqrt(std::abs(from - turn)), std::sqrt(std::abs(to - turn)), 12, 1e-14);
}

TEST(LevelCurves, AreasAreIntegrals) {
  int n = 0;
  for (const RatePiece& piece : curved_pieces()) {
    const LevelCurves grid({piece}, {0, 1e-9, 1e-3, 0.1, 0.3, 0.6, 1.00003, 1.5, 1.99, 2.5}, {});
    for (std::size_t level = 1; level <= grid.n_levels(); ++level) {
      for (const double from : {0.0, 0.2, 0.55, 0.9}) {
        for (const double to : {0.1, 0.56, 1.0}) {
          double a = from, b = to;
          if (!piece.is_constant()) {  // the dead part is 0
            const double turn = grid.turning_height(0, level);
            const auto live = [&](double z) { return piece.falls() ? std::min(z, turn) : std::max(z, turn); };
            a = live(from), b = live(to);
          }
          EXPECT_NEAR(grid.area(0, level, from, to), quadrature(grid, level, a, b), 4e-15)
              << piece.low << ' ' << piece.high << " level " << level << ": " << from << " to " << to;
          ++n;
        }
      }
    }
  }
  EXPECT_EQ(n, 7 * 9 * 12);
}

// Areas over thin intervals keep their digits: the mean of q is that in the middle.
TEST(LevelCurves, AreasOfThinIntervals) {
  for (const RatePiece& piece : curved_pieces()) {
    const LevelCurves grid({piece}, {0, 1e-3, 0.3, 0.45}, {});
    for (std::size_t level = 1; level <= 3; ++level)
      for (const double width : {1e-5, 1e-8, 1e-11}) {
        const double from = 0.25, to = from + width, middle = grid.q(0, level, from + width / 2);
        EXPECT_NEAR(grid.area(0, level, from, to) / (to - from), middle, 1e-10 + 1e-15 / width) << width;
      }
  }
}

TEST(LevelCurves, SmallStatesKeepAllTheirDigits) {
  const LevelCurves grid({curved_pieces()[0]}, {0, 1e-12, 1e-6}, {});
  // u (1 - u) = h / (4 r).
  for (const std::size_t level : {1u, 2u}) {
    const double u = grid.phi(0, grid.low(level), 0.5), wanted = grid.capacity(level) / (4 * 1.25);
    EXPECT_NEAR(u * (1 - u) / wanted, 1, 4e-16);
  }
}

TEST(LevelCurves, StatesAreOrdered) {
  const LevelCurves grid({curved_pieces()[0]}, {0, 0.1, 0.4, 0.9}, {});
  for (State s = 0; s < 7; ++s) {
    EXPECT_LE(grid.phi(0, s, 0.3), grid.phi(0, s + 1, 0.3));
    EXPECT_EQ(grid.level(grid.low(grid.level(s))), grid.level(s));
  }
  EXPECT_EQ(grid.phi(0, grid.low(0), 0.3), 0);
  EXPECT_EQ(grid.phi(0, grid.high(0), 0.3), 1);
  EXPECT_EQ(grid.phi(0, grid.high(3), 0.9), 0.5);  // beyond its turning height
}

TEST(LevelCurves, CharacteristicTimesAreIntegrals) {
  for (const RatePiece& piece : curved_pieces()) {
    const LevelCurves grid({piece}, {0, 1e-9, 0.1, 0.45}, {});
    for (std::size_t level = 0; level <= 3; ++level) {
      const double wanted = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
          [&](double z) { return 1 / (piece.rate(z) * grid.q(0, level, z)); }, 0.1, 0.8, 10, 1e-14);
      EXPECT_NEAR(grid.characteristic_time(0, grid.high(level), 0.1, 0.8) / wanted, 1, 1e-14);
      EXPECT_EQ(grid.characteristic_time(0, grid.low(level), 0.8, 0.1),
                grid.characteristic_time(0, grid.high(level), 0.1, 0.8));
    }
  }
}

CurvedNode front_between(const LevelCurves& grid, State below, State above, double z, double t) {
  CurvedNode front;
  front.below = below;
  front.above = above;
  set_course(grid, front, z, t);
  return front;
}

// dt/dz by Rankine and Hugoniot: the jump of u over that of - r u (1 - u), from the states themselves.
TEST(CurvedFront, MovesByRankineAndHugoniot) {
  int n = 0;
  for (const RatePiece& piece : curved_pieces()) {
    const LevelCurves grid({piece}, {0, 0.1, 0.25, 0.45}, {});
    for (State l = 0; l < 8; ++l)
      for (State r = 0; r < 8; ++r) {
        if (grid.level(l) == grid.level(r)) continue;
        const CurvedNode front = front_between(grid, l, r, 0.5, 0.3);
        EXPECT_NE(front.direction, 0);
        const double z = 0.5 + 0.2 * front.direction, step = 1e-5;
        const double slope =
            (passage(grid, front, z + step).t - passage(grid, front, z - step).t) / (2 * step);
        const auto flux = [&](State s) { return -grid.capacity(grid.level(s)) / 4; };
        const double wanted = (grid.phi(0, r, z) - grid.phi(0, l, z)) / (flux(r) - flux(l));
        EXPECT_NEAR(slope / wanted, 1, 1e-8);
        EXPECT_NEAR(passage(grid, front, z).slope / wanted, 1, 1e-12);
        EXPECT_GT(wanted * front.direction, 0);
        const double t = passage(grid, front, z).t;
        EXPECT_NEAR(position_of(grid, front, t), z, 1e-13);
        ++n;
      }
  }
  EXPECT_EQ(n, 7 * 48);
}

// A front between neighbouring levels is the mean of the characteristics between them.
TEST(CurvedFront, IsTheMeanOfCharacteristics) {
  const RatePiece piece(0, 1, 2, 0.5, RateCurve::exponential);
  const double h_low = 0.2, h_high = 0.3;
  const LevelCurves grid({piece}, {0, h_low, h_high}, {});
  const CurvedNode front = front_between(grid, grid.low(2), grid.low(1), 0.9, 0);
  const double t = passage(grid, front, 0.1).t;
  const double mean = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                          [&](double h) {
                            const LevelCurves one({piece}, {0, h}, {});
                            return one.characteristic_time(0, 1, 0.1, 0.9);
                          },
                          h_low, h_high, 8, 1e-14) /
                      (h_high - h_low);
  EXPECT_NEAR(t, mean, 1e-13);
}

// Special capacities are levels to the bit, however near to each other they lie.
TEST(CurvedStart, EndsAndInitialStatesAreLevels) {
  const std::vector<RatePiece> pieces{{0, 0.5, 1, 0.4, RateCurve::linear},
                                      {0.5, 1, 0.4 * (1 + 1e-10), 0.9, RateCurve::linear}};
  const std::vector<StartSegment> start{{0, 0, 0.3, 0.2}, {0, 0.3, 0.5, 0.8}, {1, 0.5, 1, 0.8}};
  const LevelPlan plan = plan_levels({pieces, start}, 0.05);
  const auto has = [&](double h) {
    return std::any_of(plan.capacities.begin(), plan.capacities.end(),
                       [&](double level) { return std::abs(level - h) < 1e-14; });
  };
  for (const double h : {0.4, 0.4 * (1 + 1e-10), 1 - 0.36, 0.64, 0.64 * (1 - 0.36), 0.64 * 0.9})
    EXPECT_TRUE(has(h)) << h;
  EXPECT_TRUE(std::is_sorted(plan.capacities.begin(), plan.capacities.end(), std::less_equal<>()));
  EXPECT_EQ(plan.capacities.front(), 0);
}

// Steps that stand for a constant state hold what it does, between every two levels.
TEST(CurvedStart, StepsKeepTheAmount) {
  for (const RatePiece& piece : curved_pieces()) {
    for (const double u :
         {0.0, 0.03, 0.4, 0.4999, 0.499999, 0.49999999, 0.499999999, 0.5, 0.5 + 1e-12, 0.51, 0.8, 1.0}) {
      const std::vector<StartSegment> start{{0, 0, 1, u}};
      const LevelPlan plan = plan_levels({{piece}, start}, 0.05);
      const LevelCurves grid({piece}, plan.capacities, plan.known);
      const StartSegmentLevels levels = in_levels(grid, start[0]);
      double z = 0, amount = 0;
      State state = levels.at_low;
      for (const auto& step : levels.steps) {
        EXPECT_EQ(step.below, state);
        EXPECT_GE(step.z, z);
        amount += grid.amount(0, state, z, step.z);
        z = step.z;
        state = step.above;
      }
      EXPECT_EQ(state, levels.at_high);
      EXPECT_NEAR(amount + grid.amount(0, state, z, 1), u, 2e-15)
          << u << ": " << piece.low << ' ' << piece.high;
    }
  }
}

}  // namespace
}  // namespace shearfront
