// SPDX-License-Identifier: BSD-3-Clause
// Beds whose rate falls as a root to their surface: `bagnold`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/checked.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

/// The layer of the source: angle 0.43, g = h = 1, grains of 0.04.
SceneSpec<double> source_bed(double scale) {
  SceneSpec<double> spec;
  Bagnold<double> a;
  a.angle = 0.43;
  a.grain = 0.04;
  a.gravity = 1;
  spec.shear_rate = a;
  spec.scale = scale;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}
constexpr double kSlope = 3.0994652327;  // du/dz at the ground

TEST(RootBed, HasTheNumbersOfTheSource) {
  const auto a = std::get<Bagnold<double>>(source_bed(1).shear_rate);
  EXPECT_NEAR(a.value(0), kSlope, 1e-10);
  EXPECT_NEAR(a.velocity(0, 1), 2.0663101551, 1e-10);
  EXPECT_NEAR(a.value(0) * 0.04 / std::sqrt(std::cos(0.43)), 0.1300388143, 1e-10);  // inertial number
}

/// sa = sqrt(1 - z): closed forms, t* by one root.
TEST(RootBed, EventTimesAreClosedForms) {
  const double slope = std::get<Bagnold<double>>(source_bed(1).shear_rate).value(0);
  const ExactSolution<double> solution{Scene<double>(source_bed(1 / slope))};
  EXPECT_TRUE(solution.is_exact());
  EXPECT_EQ(solution.n_layers(), 1u);
  const auto times = exact_timeline(solution);
  EXPECT_NEAR(*times.t0, 2 - std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(*times.t1, std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(*times.t_star, 3.280901971540853, 1e-14);
  const ExactSolution<double> source{Scene<double>(source_bed(0.5))};
  const auto of_source = exact_timeline(source);
  EXPECT_NEAR(*of_source.t0, 0.37799194, 5e-9);
  EXPECT_NEAR(*of_source.t1, 0.91255327, 5e-9);
  EXPECT_NEAR(*of_source.t_star, 2.11707616, 5e-9);
}

SceneSpec<double> random_bed(support::SceneMaker& make, bool to_surface) {
  SceneSpec<double> spec = source_bed(make.uniform(0.2, 1));
  if (!to_surface) std::get<Bagnold<double>>(spec.shear_rate).surface = make.uniform(1.01, 2);
  spec.initial_breaks = {make.uniform(0.1, 0.5), make.uniform(0.55, 0.95)};
  spec.initial_values.clear();
  for (int i = 0; i < 3; ++i) {
    const int kind = make.integer(0, 3);
    spec.initial_values.push_back(kind == 0 ? 0.0 : kind == 1 ? 1.0 : make.uniform(0, 1));
  }
  return spec;
}

/// Tables are solved by other closed forms: second order in their steps, here even in the root of the depth.
TEST(RootBed, IsTheLimitOfTables) {
  support::SceneMaker make(support::seed_of(2103));
  for (int n = 0; n < 4; ++n) {
    auto spec = random_bed(make, false);
    const auto a = std::get<Bagnold<double>>(spec.shear_rate);
    const ExactSolution<double> exact{Scene<double>(spec)};
    double before = 0;
    for (const int points : {50, 200}) {
      Table<double> table;
      for (int i = 0; i <= points; ++i) {
        const double z = static_cast<double>(i) / points;
        table.z.push_back(z);
        table.values.push_back(a.value(z));
      }
      auto of_table = spec;
      of_table.shear_rate = table;
      const ExactSolution<double> other{Scene<double>(of_table)};
      double worst = 0;
      for (int i = 1; i < 10; ++i)
        for (const double t : {0.1, 0.3, 1.0, 3.0})
          worst = std::max(worst, std::abs(other.M(i / 10.0, t) - exact.M(i / 10.0, t)));
      if (before > 0) {
        EXPECT_LT(worst, before / 8) << "seed " << support::seed_of(2103) << " scene " << n;
      }
      before = worst;
    }
    EXPECT_LT(before, 2e-5);
  }
}

/// Conservation: M is that of the walls, phi within [0, 1], and M is the integral of phi.
TEST(RootBed, MIsTheIntegralOfPhi) {
  support::SceneMaker make(support::seed_of(2104));
  for (int n = 0; n < 6; ++n) {
    const auto spec = random_bed(make, n % 2 == 0);
    const ExactSolution<double> solution{Scene<double>(spec)};
    for (const double t : {0.05, 0.4, 2.0}) {
      double sum = 0;
      const int steps = 2000;
      for (int i = 0; i < steps; ++i) {
        const double phi = solution.phi((i + 0.5) / steps, t);
        EXPECT_GE(phi, 0);
        EXPECT_LE(phi, 1);
        sum += phi / steps;
        if ((i + 1) % 250 != 0) continue;
        EXPECT_NEAR(sum, solution.M((i + 1.0) / steps, t), 3e-3) << n << ' ' << t << ' ' << i;
      }
    }
  }
}

TEST(RootBed, DerivativesAreThoseOfDifferences) {
  const std::uint64_t seed = support::seed_of(2105);
  support::SceneMaker make(seed);
  support::Checked checked({"entries"}, 400);
  for (int n = 0; n < 8; ++n) {
    const auto spec = random_bed(make, n % 2 == 0);
    const ExactSolution<double> solution{Scene<double>(spec)};
    const Derivatives<double> derivatives(solution);
    const auto all = entries(spec);
    for (int i = 0; i < 12; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 1));
      const auto at = derivatives.at(z, t);
      for (std::size_t e = 0; e < all.size(); ++e) {
        if (!derivative_refusal(solution.scene(), all[e]).empty()) continue;
        auto moved = spec;
        double& entry = *entry_places(moved)[e];
        const double here = entry, h = 1e-5 * std::abs(here);
        if (h == 0 || (all[e].field == "initial.values" && here + 2 * h > 1)) continue;
        const auto value = [&](int steps) {
          entry = here + steps * h;
          return ExactSolution<double>(Scene<double>(moved)).at(z, t);
        };
        const auto a = value(1), b = value(-1), c = value(2), d = value(-2);
        const double M = (8 * (a.M - b.M) - (c.M - d.M)) / (12 * h),
                     phi = (8 * (a.phi - b.phi) - (c.phi - d.phi)) / (12 * h);
        if (std::abs(phi) > 1e3) continue;  // a shock within the steps
        EXPECT_NEAR(at.M[e], M, 1e-7 * (1 + std::abs(M)))
            << "seed " << seed << ' ' << n << ' ' << all[e].name();
        EXPECT_NEAR(at.phi[e], phi, 1e-5 * (1 + std::abs(phi)))
            << "seed " << seed << ' ' << n << ' ' << all[e].name() << " z " << z << " t " << t;
        checked.count("entries");
      }
    }
  }
}

/// Of other fluxes pieces stand for the bed that get thinner towards the surface. With -phi (1 - phi)(1 - gamma phi) pure large grains
/// rise at 1 - gamma times the speed of those of the parabola, small ones sink as fast.
TEST(RootBed, OtherFluxesTakeFewPiecesThatThinTowardsTheSurface) {
  auto spec = source_bed(0.5);
  const auto parabola = exact_timeline(ExactSolution<double>{Scene<double>(spec)});
  spec.fluxes = {Cubic<double>{0.3}};
  double before = 0, change = 0;
  for (const std::size_t pieces : {32u, 64u, 128u}) {
    const ExactSolution<double> solution{Scene<double>(spec), {.layers = pieces}};
    const auto times = exact_timeline(solution);
    const double error = timeline_error(solution, times);
    EXPECT_NEAR(*times.t0, *parabola.t0, 0.1 / static_cast<double>(pieces * pieces)) << pieces;
    EXPECT_LT(std::abs(*times.t1 - *parabola.t1 / 0.7), 1.2 * error) << pieces;
    EXPECT_LT(error, 0.15 / static_cast<double>(pieces)) << pieces;
    if (change > 0) {
      EXPECT_LT(std::abs(*times.t_star - before), change / 3) << pieces;  // second order
    }
    if (before > 0) change = std::abs(*times.t_star - before);
    before = *times.t_star;
  }
}

/// Where it is not one piece of parabolas, the bed is approximated, and grains still reach its surface.
TEST(RootBed, IsApproximatedBesideLayers) {
  auto spec = source_bed(0.5);
  const auto exact = exact_timeline(ExactSolution<double>{Scene<double>(spec)});
  spec.temperature = Piecewise<double>{{0.3}, {1, 1}};
  const ExactSolution<double> pieces{Scene<double>(spec)};
  EXPECT_FALSE(pieces.is_exact());
  const auto times = exact_timeline(pieces);
  EXPECT_NEAR(*times.t0, *exact.t0, 1e-5);
  // Grains come to the surface through its last pieces: of first order in their number.
  EXPECT_NEAR(*times.t1, *exact.t1, 1e-3);
  EXPECT_NEAR(*times.t_star, *exact.t_star, 1e-4);
  EXPECT_LT(std::abs(*times.t1 - *exact.t1), 1.2 * timeline_error(pieces, times));
}

TEST(RootBed, RefusesAnAngleWithoutSteadyFlow) {
  auto spec = source_bed(1);
  for (const double angle : {0.2, 0.6, 24.6}) {
    std::get<Bagnold<double>>(spec.shear_rate).angle = angle;
    const auto complaints = find_complaints(spec);
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_EQ(complaints[0].key, "shear_rate.angle");
    EXPECT_EQ(complaints[0].constraint,
              "must be between 0.363147 and 0.569313 radian (20.81 and 32.62 degrees): no steady flow at any "
              "other angle");
  }
}

}  // namespace
}  // namespace shearfront
