// SPDX-License-Identifier: BSD-3-Clause
// The branches of fluxes: tables against the flux itself, the closed forms of the parabola, and quadrature.
#include "shearfront/track/flux_branches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/curved_front.hpp"

namespace shearfront {
namespace {

/// Convex, concave, with joints; the first two are parabolas that do not say so.
std::vector<Flux<double>> branched_fluxes() {
  return {Cubic<double>{0},
          LwrCubic<double>{0.5, 0},
          Cubic<double>{0.3},
          Cubic<double>{0.5},
          LwrCubic<double>{0.7, 0.45},
          FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.18, -0.24, -0.18, 0}}};
}

TEST(FluxBranches, FluxesThatSuit) {
  for (const Flux<double>& flux : branched_fluxes()) EXPECT_TRUE(FluxBranches::suits(flux)) << flux.name();
  EXPECT_FALSE(FluxBranches::suits(Cubic<double>{0.6}));
  EXPECT_FALSE(FluxBranches::suits(RichardsonZaki<double>{3}));
  EXPECT_FALSE(FluxBranches::suits(Triangular<double>{}));
  EXPECT_FALSE(FluxBranches::suits(FluxTable<double>{{0, 0.25, 0.5, 0.75, 1}, {0, -0.2, -0.3, -0.2, 0}}));
  EXPECT_FALSE(FluxBranches::suits(BuckleyLeverett<double>{}));
  EXPECT_FALSE(FluxBranches::suits(Burgers<double>{}));
}

TEST(FluxBranches, InvertTheFlux) {
  for (const Flux<double>& flux : branched_fluxes()) {
    const FluxBranches branches(flux);
    EXPECT_LE(branches.error(), 4e-15) << flux.name();
    for (const double u : {1e-12, 1e-6, 0.01, 0.1, 0.2, 0.249, 0.3, 0.45, 0.6, 0.8, 0.95, 0.999, 1 - 1e-9}) {
      const bool is_high = u > branches.top();
      const double pure = is_high ? 1 - u : u, x = branches.value(u), w = branches.root_of(u);
      const double f = std::abs(flux.value(branches.end() + branches.slope() * u)),
                   most = std::abs(flux.value(flux.extrema().front()));
      EXPECT_NEAR(x, f / most, 1e-15) << flux.name() << ' ' << u;
      EXPECT_NEAR(w * w + x, 1, 1e-15) << flux.name() << ' ' << u;
      EXPECT_NEAR(branches.lack(is_high, w, x) / (2 * pure), 1, 1e-14 + 1e-16 / pure)
          << flux.name() << ' ' << u;
      EXPECT_NEAR(branches.lack_slope(is_high, w, x) * branches.steepness(u) / 2, 1, 1e-11)
          << flux.name() << ' ' << u;
    }
  }
}

TEST(FluxBranches, ParabolaInClosedForm) {
  const FluxBranches branches(branched_fluxes()[0]);
  EXPECT_EQ(branches.top(), 0.5);
  for (const bool is_high : {false, true}) {
    EXPECT_NEAR(branches.spread(is_high), 1, 1e-15);
    EXPECT_NEAR(branches.pure_shape(is_high), 0.5, 1e-15);
    for (const double w : {0.0, 1e-9, 0.003, 0.3, 0.51, 0.97, 1.0})
      EXPECT_NEAR(branches.shape(is_high, w), 1 / (1 + w), 4e-15) << w;
    // int dx / (1 + w) = int 2 w / (1 + w) dw = 2 (w - log(1 + w)).
    for (const double to : {1e-3, 0.04, 0.5, 0.999})
      EXPECT_NEAR(branches.shape_integral(is_high, 0, to, to * to), 2 * (to - std::log1p(to)), 4e-15) << to;
  }
}

// Also of thin intervals, of which an integral keeps its digits.
TEST(FluxBranches, IntegralsAreIntegrals) {
  for (const Flux<double>& flux : branched_fluxes()) {
    const FluxBranches branches(flux);
    for (const bool is_high : {false, true})
      for (const double from : {0.1, 0.4, 0.495, 0.9})
        for (const double width : {1e-9, 0.01, 0.05, 0.09}) {
          const double to = from + width, dx = width * (from + to);
          const double joint = std::clamp((0.5 - from) / width, 0.0, 1.0);  // of the table
          const auto integral = [&](auto&& f) {                             // in w, as a mean
            const auto g = [&](double part) {
              return f(from + width * part) * 2 * (from + width * part) * width;
            };
            using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
            return (joint > 0 ? Quadrature::integrate(g, 0.0, joint, 8, 1e-14) : 0) +
                   (joint < 1 ? Quadrature::integrate(g, joint, 1.0, 8, 1e-14) : 0);
          };
          const double wanted = integral([&](double w) { return branches.shape(is_high, w); });
          EXPECT_NEAR(branches.shape_integral(is_high, from, to, dx) / wanted, 1, 1e-13)
              << flux.name() << ' ' << from << ' ' << width;
          const double rest = integral([&](double w) {
            return (branches.shape(is_high, w) - branches.pure_shape(is_high)) / ((1 - w) * (1 + w));
          });
          EXPECT_NEAR(branches.rest_integral(is_high, from, to, dx), rest, 1e-13 * width + 1e-14)
              << flux.name() << ' ' << from << ' ' << width;
        }
  }
}

const std::vector<RatePiece>& branch_pieces() {
  static const std::vector<RatePiece> all{{0, 1, 2, 0.5, RateCurve::linear},
                                          {0, 1, 0.5, 2, RateCurve::exponential},
                                          {0, 1, 1, 1.0001, RateCurve::linear},
                                          {0, 1, 0.7, 0.7, RateCurve::constant}};
  return all;
}

// Amounts by quadrature of states, which are checked by their flux; times of characteristics by that of 4 / (r |g'|).
TEST(FluxBranches, AmountsAndTimesAreIntegrals) {
  for (const Flux<double>& flux : branched_fluxes()) {
    const auto branches = std::make_shared<const FluxBranches>(flux);
    for (const RatePiece& piece : branch_pieces()) {
      RatePiece with_flux = piece;
      with_flux.flux = branches;
      const LevelCurves grid({with_flux}, {0, 1e-7, 0.1, 0.35, 0.62}, {});
      for (State s = 1; s < 9; ++s) {
        const std::size_t level = grid.level(s);
        double lo = 0.05, hi = 0.95;
        if (!piece.is_constant() && level > 0) {
          const double turn = grid.turning_height(0, level);
          if (piece.falls()) hi = std::min(hi, turn - 0.01);
          if (!piece.falls()) lo = std::max(lo, turn + 0.01);
        }
        for (const double z : {lo, hi})
          EXPECT_NEAR(piece.rate(z) * branches->value(grid.phi(0, s, z)), grid.capacity(level), 4e-15);
        const auto integral = [&](auto&& f) {
          return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, lo, hi, 12, 1e-13);
        };
        EXPECT_NEAR(grid.amount(0, s, lo, hi), integral([&](double z) { return grid.phi(0, s, z); }), 1e-12)
            << flux.name() << " state " << s;
        const double time =
            integral([&](double z) { return 4 / (piece.rate(z) * branches->steepness(grid.phi(0, s, z))); });
        // Quadrature takes no notice of joints, where g' has a kink.
        const double tolerance = flux.name() == "table" ? 1e-9 : 1e-11;
        EXPECT_NEAR(grid.characteristic_time(0, s, lo, hi) / time, 1, tolerance)
            << flux.name() << " state " << s << ' ' << piece.bend;
      }
    }
  }
}

TEST(FluxBranches, FrontsMoveByRankineAndHugoniot) {
  int n = 0;
  for (const Flux<double>& flux : branched_fluxes()) {
    const auto branches = std::make_shared<const FluxBranches>(flux);
    for (const RatePiece& piece : branch_pieces()) {
      RatePiece with_flux = piece;
      with_flux.flux = branches;
      const LevelCurves grid({with_flux}, {0, 0.1, 0.25, 0.25 * (1 + 1e-9), 0.45}, {});
      for (State l = 0; l < 10; ++l)
        for (State r = 0; r < 10; ++r) {
          if (grid.level(l) == grid.level(r)) continue;
          CurvedNode front;
          front.below = l;
          front.above = r;
          set_course(grid, front, 0.5, 0.3);
          const bool is_near =
              std::abs(grid.capacity(grid.level(l)) / grid.capacity(grid.level(r)) - 1) < 1e-6;
          const double z = 0.5 + 0.2 * front.direction, step = 1e-5;
          const double slope =
              (passage(grid, front, z + step).t - passage(grid, front, z - step).t) / (2 * step);
          const double u_l = grid.phi(0, l, z), u_r = grid.phi(0, r, z);
          // Of levels so near to each other the characteristic.
          const double wanted =
              is_near && grid.is_high(l) == grid.is_high(r)
                  ? (grid.is_high(l) ? 4 : -4) / (piece.rate(z) * branches->steepness(u_l))
                  : 4 * (u_r - u_l) / (grid.capacity(grid.level(l)) - grid.capacity(grid.level(r)));
          EXPECT_NEAR(slope / wanted, 1, is_near ? 1e-6 : 1e-7) << flux.name() << ' ' << l << ' ' << r;
          EXPECT_NEAR(passage(grid, front, z).slope / wanted, 1, 1e-7);
          const double t = passage(grid, front, z).t;
          EXPECT_NEAR(position_of(grid, front, t), z, 1e-11);
          ++n;
        }
    }
  }
  EXPECT_EQ(n, 6 * 4 * 80);
}

}  // namespace
}  // namespace shearfront
