// SPDX-License-Identifier: BSD-3-Clause
// The exact engine for general convex and concave fluxes against closed forms, the quadratic engine, 50
// digits and a naive Godunov scheme.
#include <gtest/gtest.h>

#include <cmath>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/exact/layered_medium.hpp"
#include "shearfront/fv/godunov_solver.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"
#include "support/flux_scenes.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::FluxShape;
using support::SceneMaker;

TEST(GeneralLaw, BranchesInvertTheFlux) {
  const auto check = [](const Flux<double>& flux) {
    const exact::InverseFlux<double> law(flux);
    for (const bool up : {true, false}) {
      double before = -1;
      support::Checked checked({""}, 50);
      for (int i = 0; i <= 64; ++i) {
        const double e = std::pow(i / 64.0, 3), d = law.inverse(e, up);
        EXPECT_NEAR(law.lack(d, up), e, 4e-16 + 4e-16 * law.slope(d, up)) << i << up;
        EXPECT_GT(d, before);
        EXPECT_LE(d, law.reach(up));
        before = d;
        const double h = 1e-6;
        if (d > h && d + h < law.reach(up)) {
          EXPECT_NEAR(law.slope(d, up), (law.lack(d + h, up) - law.lack(d - h, up)) / (2 * h), 1e-6);
          checked.count();
        }
      }
      EXPECT_EQ(law.state(law.inverse(1, up), up), up ? 1 : 0);
    }
  };
  for (const auto& flux : Lwr<double>::samples()) check(flux);
  for (const auto& flux : Triangular<double>::samples()) check(flux);
  for (const double gamma : {0.0, 0.25, 0.5})
    for (const CubicScaling scaling : {CubicScaling::none, CubicScaling::quadratic_extremum})
      check(Cubic<double>{gamma, scaling});
  check(FluxTable<double>::samples().front());
}

TEST(GeneralMedium, AgreesWithTheQuadraticOne) {
  SceneMaker make(support::seed_of(5301));
  double worst_M = 0, worst_p = 0;
  int jumps = 0;
  support::Checked checked({""}, 500);
  for (int n = 0; n < 100; ++n) {
    const Scene<double> scene(make.data(make.integer(1, 8), make.order(), 8));
    const exact::CanonicalForm<double> form(std::make_shared<const Scene<double>>(scene), 1);
    const auto special = exact::make_medium(form);
    const exact::LayeredMedium<double, exact::UnimodalLaw<double>> general(exact::unimodal_law(form),
                                                                           special->cells(), special->mass());
    for (int i = 0; i < 40; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-4, 3));
      const auto a = special->best_free(z, t, 1e300), b = general.best_free(z, t, 1e300);
      const double wall = std::min(special->pure_travel_time(0, z) <= t ? z : 1e300,
                                   special->pure_travel_time(1, z) <= t ? scene.mass() : 1e300);
      const double M = std::min(a.value, wall);
      worst_M = std::max(worst_M, std::abs(M - std::min(b.value, wall)));
      if (M == wall) continue;  // either may leave out what a wall does better
      checked.count();
      if (std::abs(a.p - b.p) > 1e-3)
        ++jumps;  // within rounding of a shock
      else
        worst_p = std::max(worst_p, std::abs(a.p - b.p));
    }
  }
  EXPECT_LT(worst_M, 1e-12);
  EXPECT_LT(worst_p, 1e-12);
  EXPECT_EQ(jumps, 0);
}

/// A road with the speed limits 2 | 1 and the densities left | right, far from its ends.
ExactSolution<double> road(double left, double right) {
  SceneSpec<double> spec;
  spec.bottom = -4;
  spec.top = 4;
  spec.fluxes = {Lwr<double>{1}};
  spec.shear_rate = Piecewise<double>{{0}, {2, 1}};
  spec.initial_breaks = {0};
  spec.initial_values = {left, right};
  return ExactSolution<double>{Scene<double>(spec)};
}

TEST(Traffic, FreeFlowPassesTheSpeedLimit) {
  const auto solution = road(0.13, 0.1);
  for (const double t : {0.5, 1.0}) {
    EXPECT_NEAR(solution.phi(-0.01, t), 0.13, 1e-15);
    EXPECT_NEAR(solution.phi(0, t), 0.34572751, 5e-9);
    EXPECT_NEAR(solution.phi(0.30854497 * t - 1e-6, t), 0.34572751, 5e-9);
    EXPECT_NEAR(solution.phi(0.30854497 * t + 1e-3, t), (1 - 0.30854497 - 1e-3 / t) / 2, 5e-9);
    EXPECT_NEAR(solution.phi(0.8 * t - 1e-6, t), 0.1 + 0.5e-6 / t, 1e-14);
    EXPECT_NEAR(solution.phi(0.8 * t + 1e-6, t), 0.1, 1e-15);
    EXPECT_NEAR(solution.H(0, t), -0.2262, 1e-15);
  }
}

TEST(Traffic, JamBeforeTheSpeedLimit) {
  const auto solution = road(0.2, 0.1);
  for (const double t : {0.5, 1.0}) {
    EXPECT_NEAR(solution.phi(-0.10710678 * t - 1e-7, t), 0.2, 1e-15);
    EXPECT_NEAR(solution.phi(-0.10710678 * t + 1e-7, t), 0.85355339, 5e-9);
    EXPECT_NEAR(solution.phi(-1e-6, t), 0.85355339, 5e-9);
    EXPECT_NEAR(solution.phi(0, t), 0.5, 1e-15);
    for (const double v : {0.1, 0.4, 0.79}) EXPECT_NEAR(solution.phi(v * t, t), (1 - v) / 2, 1e-14);
    EXPECT_NEAR(solution.phi(0.81 * t, t), 0.1, 1e-15);
  }
}

/// Triangular roads: every wave is a contact or a shock of known speed.
TEST(Traffic, TriangularRoadWithABottleneck) {
  SceneSpec<double> spec;
  spec.bottom = -4;
  spec.top = 4;
  spec.fluxes = {Triangular<double>{0.25, 1}};  // speeds a and -a / 3, capacity a / 4
  spec.shear_rate = Piecewise<double>{{0}, {2, 1}};
  spec.initial_breaks = {0};
  spec.initial_values = {0.2, 0.1};  // arrives 0.4, the bottleneck carries 0.25
  const ExactSolution<double> solution{Scene<double>(spec)};
  const double queue = 1 - 3 * 0.25 / 2;  // 2 (1 - rho) / 3 = 0.25
  const double shock = (0.25 - 0.4) / (queue - 0.2);
  for (const double t : {0.5, 1.0}) {
    EXPECT_NEAR(solution.phi(shock * t - 1e-9, t), 0.2, 1e-15);
    EXPECT_NEAR(solution.phi(shock * t + 1e-9, t), queue, 1e-14);
    EXPECT_NEAR(solution.phi(-1e-9, t), queue, 1e-14);
    EXPECT_NEAR(solution.phi(0, t), 0.25, 1e-15);
    EXPECT_NEAR(solution.phi(t - 1e-9, t), 0.25, 1e-15);
    EXPECT_NEAR(solution.phi(t + 1e-9, t), 0.1, 1e-15);
  }
}

TEST(Cubic, FanOfOneLayerIsTheInverseOfTheSpeed) {
  constexpr double kGamma = 0.4;
  SceneSpec<double> spec;
  spec.fluxes = {Cubic<double>{kGamma}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const ExactSolution<double> solution{Scene<double>(spec)};
  // f' = -1 + 2 (1 + gamma) p - 3 gamma p^2 = (z - 1/2) / t, from -1 to 1 - gamma.
  for (const double t : {0.1, 0.3, 0.45})
    for (const double v : {-0.99, -0.5, -0.01, 0.2, 0.59}) {
      const double b = 1 + kGamma, p = (1 + v) / (b + std::sqrt(b * b - 3 * kGamma * (1 + v)));
      EXPECT_NEAR(solution.phi(0.5 + v * t, t), p, 1e-14);
    }
  const auto times = exact_timeline(Scene<double>(spec));
  EXPECT_NEAR(*times.t0, 0.5, 1e-15);
  EXPECT_NEAR(*times.t1, 0.5 / (1 - kGamma), 1e-14);
  EXPECT_GT(*times.t_star, *times.t1);
  EXPECT_NEAR(solution.M(0.5, *times.t_star * (1 + 1e-9)), 0.5, 1e-15);
  EXPECT_LT(solution.M(0.5, *times.t_star * (1 - 1e-6)), 0.5 - 1e-9);
}

class GeneralScenes : public ::testing::TestWithParam<FluxShape> {
 protected:
  SceneMaker make_{support::seed_of(5401 + static_cast<std::uint64_t>(GetParam()))};
};

TEST_P(GeneralScenes, ConserveAndStayInRange) {
  for (int n = 0; n < 30; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    const Scene<double> scene(support::random_flux_scene(make_, GetParam()));
    const ExactSolution<double> solution(scene);
    ASSERT_TRUE(solution.is_exact());
    for (const double t : {0.0, 0.05, 0.4, 2.0, 30.0, std::numeric_limits<double>::infinity()}) {
      EXPECT_EQ(solution.M(1, t), scene.mass());
      EXPECT_EQ(solution.M(0, t), 0);
      double z = 0, M = 0;
      for (int i = 1; i <= 50; ++i) {
        const double next_z = i / 50.0, next = solution.M(next_z, t);
        const auto range = scene.range_at(next_z);
        const double phi = solution.phi(next_z, t);
        EXPECT_GE(phi, range.lowest);
        EXPECT_LE(phi, range.highest);
        double most = 0;  // of phi between the two heights
        for (int k = 0; k <= 20; ++k)
          most = std::max(most, scene.range_at(z + (next_z - z) * k / 20).highest);
        EXPECT_GE(next, M - 2e-15);
        EXPECT_LE(next, M + most * (next_z - z) + 2e-15);
        M = next;
        z = next_z;
      }
    }
  }
}

/// dM/dz = phi and dM/dt = H: the solution satisfies the equation where it is smooth.
TEST_P(GeneralScenes, SolveTheEquation) {
  int smooth = 0;
  for (int n = 0; n < 10; ++n) {
    const Scene<Real110> scene =
        scene_cast<Real110>(Scene<double>(support::random_flux_scene(make_, GetParam())));
    const ExactSolution<Real110> solution(scene);
    const Real110 h("1e-18");
    for (int i = 0; i < 6; ++i) {
      const Real110 z = make_.uniform(0.01, 0.99), t = std::exp(make_.uniform(-2, 2));
      const auto at = solution.at(z, t);
      const auto slope = [&](const Real110& dz, const Real110& dt) {
        return Real110((solution.M(z + dz, t + dt) - solution.M(z - dz, t - dt)) / (2 * h));
      };
      const Real110 by_z = slope(h, Real110(0)), by_t = slope(Real110(0), h);
      if (abs(Real110(solution.phi(z + h, t) - solution.phi(z - h, t))) > Real110("1e-12")) continue;
      EXPECT_LT(abs(Real110(by_z - at.phi)), Real110("1e-14")) << n << " " << z << " " << t;
      EXPECT_LT(abs(Real110(by_t - at.H)), Real110("1e-14")) << n << " " << z << " " << t;
      const Real110 c = scene.solid_fraction_at(z);
      const Real110 flux = scene.scale() * scene.rate_at(z) * c * scene.flux_at(z).value(Real110(at.phi / c));
      EXPECT_LT(abs(Real110(at.H + flux)), Real110("1e-40")) << n << " " << z << " " << t;
      ++smooth;
    }
  }
  EXPECT_GT(smooth, 50);
}

TEST_P(GeneralScenes, DoubleKeepsTheDigits) {
  double worst_M = 0, worst_phi = 0;
  int jumps = 0;
  for (int n = 0; n < 15; ++n) {
    const Scene<double> scene(support::random_flux_scene(make_, GetParam()));
    const ExactSolution<double> solution(scene);
    const ExactSolution<Real110> precise(scene_cast<Real110>(scene));
    for (int i = 0; i < 20; ++i) {
      const double z = make_.uniform(0, 1), t = std::exp(make_.uniform(-3, 2));
      const auto a = solution.at(z, t);
      const auto b = precise.at(Real110(z), Real110(t));
      worst_M = std::max(worst_M, std::abs(a.M - to_double(b.M)));
      const double phi = std::abs(a.phi - to_double(b.phi));
      if (phi > 1e-3)
        ++jumps;
      else
        worst_phi = std::max(worst_phi, phi);
    }
  }
  EXPECT_LT(worst_M, 1e-14);
  EXPECT_LT(worst_phi, 1e-12);
  EXPECT_EQ(jumps, 0);
}

/// All breaks on multiples of 1 / 250, the edges of Godunov's cells; false if two fall together.
bool snap(SceneSpec<double>& spec) {
  const auto round = [](std::vector<double>& heights) {
    for (double& z : heights) z = std::round(z * 250) / 250;
  };
  round(spec.flux_breaks);
  round(spec.initial_breaks);
  round(std::get<Piecewise<double>>(spec.shear_rate).breaks);
  if (spec.solid_fraction) round(std::get<Piecewise<double>>(*spec.solid_fraction).breaks);
  if (spec.temperature) round(std::get<Piecewise<double>>(*spec.temperature).breaks);
  return find_complaints(spec).empty();
}

TEST_P(GeneralScenes, GodunovConverges) {
  support::Checked checked({"small", "falls"}, 3);
  for (int n = 0; n < 6; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    SceneSpec<double> spec = support::random_flux_scene(make_, GetParam());
    if (!snap(spec)) continue;
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    const double t = std::exp(make_.uniform(-1.5, 0.5));
    double before = 0;
    for (const std::size_t cells : {250U, 1000U}) {
      const auto phi = support::godunov_any_scene(scene, t, cells);
      double error = 0, M = 0;
      for (std::size_t j = 0; j < cells; ++j) {
        M += phi[j] / double(cells);
        error += std::abs(M - solution.M(double(j + 1) / double(cells), t)) / double(cells);
      }
      EXPECT_LT(error, 3.0 / double(cells));
      checked.count("small");
      if (before > 1e-9) {             // not at rest
        EXPECT_LT(error, before / 2);  // four times the cells
        checked.count("falls");
      }
      before = error;
    }
  }
}

/// The finite volumes of the library, and the exactly integrated error against the sum over many points.
TEST(GeneralErrors, OfGodunovFallWithTheCells) {
  for (const Flux<double>& flux : {Flux<double>(Cubic<double>{0.4}), Flux<double>(Lwr<double>{0.5}),
                                   Flux<double>(Triangular<double>{})}) {
    SceneSpec<double> spec;
    spec.fluxes = {flux};
    spec.shear_rate = Piecewise<double>{{0.25}, {2, 1}};
    spec.initial_breaks = {0.5};
    spec.initial_values = {0.125, 0.375};
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    double before = 0;
    for (const std::size_t cells : {200U, 800U}) {
      SolverRequest request;
      request.times = {0.3};
      request.profiles = true;
      const auto result = solve<GodunovSolver>(scene, request, {{.cells = cells}});
      ASSERT_EQ(result.profiles.size(), 1u) << result.summary.message;
      const Profile<double>& profile = result.profiles[0];
      const auto errors = errors_against(solution, profile, 0.3);
      double sum = 0;
      constexpr int kPoints = 40000;
      for (int i = 0; i < kPoints; ++i) {
        const double z = (i + 0.5) / kPoints;
        sum += std::abs(profile.at(z).phi - solution.phi(z, 0.3)) / kPoints;
      }
      EXPECT_NEAR(errors.l1, sum, 2e-5);
      if (before > 0) {
        EXPECT_LT(errors.l1, before / 1.8);  // order 1/2 at contacts, 1 elsewhere
      }
      before = errors.l1;
    }
    EXPECT_LT(before, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, GeneralScenes,
                         ::testing::Values(FluxShape::convex_parabolas, FluxShape::concave_parabolas,
                                           FluxShape::convex, FluxShape::concave));

}  // namespace
}  // namespace shearfront
