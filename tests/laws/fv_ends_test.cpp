// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes with open and periodic ends and with different fluxes in different layers; random scenes
// with fixed seeds, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/fv/cell_profile.hpp"
#include "shearfront/fv/run.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"
#include "support/solid_scene.hpp"

namespace shearfront {
namespace {

using fv::March;
using fv::Rule;
using support::Grains, support::SceneMaker;

SceneMaker maker_with_ends(int number) { return SceneMaker(support::seed_of(12000 + std::uint64_t(number))); }

/// Layers of one or several fluxes of the same kind, solid fraction, temperature, two open ends or a ring.
SceneSpec<double> random_ends(SceneMaker& maker, bool is_ring) {
  SceneSpec<double> spec = support::solid_data(maker, Grains::large);
  const std::vector<Flux<double>> minima{Quadratic<double>{}, Cubic<double>{}, RichardsonZaki<double>{},
                                         Quadratic<double>{}};
  const std::vector<Flux<double>> maxima{Lwr<double>{}, Triangular<double>{0.3, 1.0}, Lwr<double>{},
                                         Triangular<double>{0.5, 1.0}};
  const auto& choice = maker.integer(0, 1) == 0 ? minima : maxima;
  spec.fluxes.clear();
  const int n = maker.integer(1, 3);
  for (int i = 0; i < n; ++i) spec.fluxes.push_back(choice[std::size_t(maker.integer(0, 3))]);
  spec.flux_breaks = maker.heights(n - 1, 0, 1);
  spec.is_periodic = is_ring;
  if (is_ring) return spec;
  const auto outside = [&] {
    return OutsideState<double>{{0.1, 0.17}, {maker.uniform(0, 1), maker.uniform(0, 1), maker.uniform(0, 1)}};
  };
  spec.outside_bottom = outside();
  if (maker.integer(0, 3) > 0) spec.outside_top = outside();
  return spec;
}

std::array<double, 2> outside_at(const SceneSpec<double>& spec, std::size_t k) {
  const double none = std::nan("");
  return {spec.outside_bottom ? spec.outside_bottom->values[k] : none,
          spec.outside_top ? spec.outside_top->values[k] : none};
}

TEST(FvEnds, AmountChangesByWhatComesIn) {
  support::Checked checked({"ring", "open"});
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_ends(number);
    const Scene<double> scene(random_ends(maker, number % 3 == 0));
    const fv::Grid grid = fv::equal_cells(scene, 40);
    for (const Rule rule : {Rule::godunov, Rule::engquist_osher}) {
      March march(fv::Scheme{rule}, scene, grid);
      const auto amount = [&] { return fv::cell_profile(scene, grid, march.shares()).mass(); };
      EXPECT_NEAR(amount(), scene.mass(), 1e-14);
      for (std::size_t i = 0; i < 300; ++i) {
        march.set_outside(outside_at(scene.spec(), i / 100));
        march.step(march.largest_step());
        for (const double x : march.shares().x) ASSERT_TRUE(x >= 0 && x <= 1) << x;
      }
      EXPECT_NEAR(amount(), scene.mass() + march.inflow(), 1e-13);
      checked.count(scene.spec().is_periodic ? "ring" : "open");
      if (scene.spec().is_periodic) {
        EXPECT_EQ(march.inflow(), 0);
      }
    }
  }
}

TEST(FvEnds, ContractInL1AndKeepTheOrder) {
  for (int number = 0; number < 60; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_ends(number);
    SceneSpec<double> spec = random_ends(maker, number % 3 == 0), upper = spec, other = spec;
    for (double& x : upper.initial_values) x += (1 - x) * maker.uniform(0, 1);
    for (double& x : other.initial_values) x = maker.uniform(0, 1);
    const Scene<double> scene(spec);
    const fv::Grid grid = fv::equal_cells(scene, 40);
    const std::vector<double> capacity = fv::capacities(scene, grid);
    for (const Rule rule : {Rule::godunov, Rule::engquist_osher}) {
      March u(fv::Scheme{rule}, scene, grid);
      March v(fv::Scheme{rule}, Scene<double>(upper), grid);
      March w(fv::Scheme{rule}, Scene<double>(other), grid);
      double last = 1e300;
      for (std::size_t i = 0; i < 300; ++i) {
        for (March* march : {&u, &v, &w}) {
          march->set_outside(outside_at(spec, i / 100));
          march->step(march->largest_step());
        }
        double distance = 0;
        const auto at_u = u.shares().x, at_v = v.shares().x, at_w = w.shares().x;
        for (std::size_t j = 0; j < grid.n_cells(); ++j) {
          ASSERT_LE(at_u[j], at_v[j] + 1e-14);
          distance += capacity[j] * std::abs(at_u[j] - at_w[j]);
        }
        ASSERT_LE(distance, last + 1e-14);
        last = distance;
      }
    }
  }
}

template <class Solver>
class FvTraffic : public testing::Test {};
struct NameOfSolver {
  template <class Solver>
  static std::string GetName(int) {
    return std::string(Solver::kName) == "engquist-osher" ? "engquist_osher" : std::string(Solver::kName);
  }
};
using SchemesWithEnds = testing::Types<EngquistOsherSolver, GodunovSolver>;
TYPED_TEST_SUITE(FvTraffic, SchemesWithEnds, NameOfSolver);

SceneSpec<double> road() {
  SceneSpec<double> spec;
  spec.fluxes = {Lwr<double>{}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.2};
  spec.outside_bottom = OutsideState<double>{{}, {0.2}};
  return spec;
}

// 0.2 (1 - 0.2) = 0.16 cars arrive per time; nobody leaves while the light at the end is red (outside:
// jammed), and 1/4 per time, the capacity, once it is green (outside: empty). The queue grows at speed -0.2.
TYPED_TEST(FvTraffic, RedLightAndGreenLight) {
  SceneSpec<double> spec = road();
  spec.outside_top = OutsideState<double>{{0.513}, {1, 0}};
  SolverRequest request{{0.9, 0.5, 0.25, 0.513}, {0.5, 0.8, 1}};
  request.profiles = true;
  typename TypeParam::Options options;
  options.cells = 400;
  const auto result = solve<TypeParam>(Scene<double>(spec), request, options);
  ASSERT_TRUE(result.summary.usable()) << result.summary.message;
  EXPECT_NEAR(result.profiles[2].mass(), 0.2 + 0.16 * 0.25, 1e-13);
  EXPECT_NEAR(result.profiles[1].mass(), 0.2 + 0.16 * 0.5, 1e-13);
  EXPECT_NEAR(result.profiles[3].mass(), 0.2 + 0.16 * 0.513, 1e-13);
  EXPECT_NEAR(result.profiles[0].mass(), 0.2 + 0.16 * 0.9 - 0.25 * (0.9 - 0.513), 1e-13);
  const auto exact = [](double z) { return z < 0.9 ? 0.2 : 1.0; };  // t = 0.5
  double error = 0;
  for (std::size_t i = 0; i < result.profiles[1].n_cells(); ++i)
    error += std::abs(result.profiles[1].below()[i] - exact(result.profiles[1].z()[i])) / 400;
  EXPECT_LT(error, 0.01);
}

// Waves that leave take their own flux along: the state outside counts only where waves come in from there.
TYPED_TEST(FvTraffic, AnOutsideStateThatSendsNoWavesInDoesNotMatter) {
  SceneSpec<double> spec;
  spec.fluxes = {Burgers<double>{-1, 1}};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.3};
  spec.initial_values = {0.5, 0.8};
  spec.outside_bottom = OutsideState<double>{{}, {0.5}};
  const auto with_top = [&](double top) {
    spec.outside_top = OutsideState<double>{{}, {top}};
    typename TypeParam::Options options;
    options.cells = 100;
    return solve<TypeParam>(Scene<double>(spec), {{0.4, 1}, {0.1, 0.5, 0.9, 1}}, options);
  };
  const auto a = with_top(0.9), b = with_top(0.1), c = with_top(0.0), d = with_top(-0.3);
  ASSERT_EQ(a.samples.size(), 8u);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].phi, b.samples[i].phi);
    EXPECT_EQ(a.samples[i].phi, c.samples[i].phi);
    EXPECT_EQ(a.samples[i].phi, d.samples[i].phi);  // a shock 0.8 | -0.3 moves upwards and out
  }
  EXPECT_NEAR(a.samples[5].phi, 0.5, 1e-6);  // the fan has left z <= 0.8 at t = 1
}

TYPED_TEST(FvTraffic, RingKeepsItsCarsAndHasNoBeginning) {
  for (int number = 0; number < 20; ++number) {
    SceneMaker maker = maker_with_ends(number);
    constexpr std::size_t n = 48;
    SceneSpec<double> spec, turned;
    spec.fluxes = {Triangular<double>{0.25, 1.0}};
    spec.shear_rate = Piecewise<double>{{}, {1.5}};
    spec.is_periodic = true;
    turned = spec;
    std::vector<double> values;
    for (std::size_t j = 0; j < n; ++j) values.push_back(maker.uniform(0, 1));
    for (std::size_t j = 1; j < n; ++j) spec.initial_breaks.push_back(double(j) / n);
    turned.initial_breaks = spec.initial_breaks;
    spec.initial_values = values;
    std::rotate(values.begin(), values.begin() + 17, values.end());
    turned.initial_values = values;
    SolverRequest request{{0.3, 2}, {1.0}};
    request.profiles = true;
    typename TypeParam::Options options;
    options.cells = n;
    const auto a = solve<TypeParam>(Scene<double>(spec), request, options);
    const auto b = solve<TypeParam>(Scene<double>(turned), request, options);
    ASSERT_TRUE(a.summary.usable() && b.summary.usable());
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(a.profiles[i].mass(), Scene<double>(spec).mass(), 1e-13);
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_NEAR(a.profiles[i].below()[(j + 17) % n], b.profiles[i].below()[j], 1e-13);
    }
  }
}

// A flux beside itself is no interface.
TEST(FvFluxes, TheSameFluxTwiceIsOneFlux) {
  for (int number = 0; number < 20; ++number) {
    SceneMaker maker = maker_with_ends(number);
    SceneSpec<double> spec = maker.data(3, maker.order(), 5);
    spec.fluxes = {Cubic<double>{}};
    const Scene<double> one(spec);
    spec.fluxes.push_back(spec.fluxes[0]);
    spec.flux_breaks = {0.43};
    const SolverRequest request{{0.1, 0.8}, {0.2, 0.4, 0.5, 0.9}};
    const auto a = solve<GodunovSolver>(one, request, {}),
               b = solve<GodunovSolver>(Scene<double>(spec), request, {});
    ASSERT_TRUE(a.summary.usable() && b.summary.usable());
    for (std::size_t i = 0; i < a.samples.size(); ++i) EXPECT_NEAR(a.samples[i].phi, b.samples[i].phi, 1e-10);
  }
}

// Between walls all comes to rest, on the side where the flux leads.
TEST(FvFluxes, DifferentFluxesComeToRestBetweenWalls) {
  for (int number = 0; number < 20; ++number) {
    SCOPED_TRACE("scene " + std::to_string(number));
    SceneMaker maker = maker_with_ends(number);
    SceneSpec<double> spec = random_ends(maker, true);
    spec.is_periodic = false;
    const Scene<double> scene(spec);
    const auto check = [&]<class Solver>(Solver) {
      SolverRequest request{{infinity<double>()}, {1.0}};
      request.profiles = true;
      typename Solver::Options options;
      options.cells = 30;
      const auto result = solve<Solver>(scene, request, options);
      ASSERT_EQ(result.summary.status, Status::steady) << result.summary.message;
      EXPECT_NEAR(result.profiles[0].mass(), scene.mass(), 1e-12);
      EXPECT_LT(support::overshoot(scene, result.profiles[0]), 1e-300);
    };
    check(GodunovSolver{});
    check(EngquistOsherSolver{});
  }
}

TEST(FvFluxes, SaysWhatItCannot) {
  SceneSpec<double> spec = road();
  spec.outside_top = OutsideState<double>{{}, {0.1}};
  const SolverRequest request{{1}, {0.5}};
  EXPECT_EQ(solve<MusclSolver>(Scene<double>(spec), request, {}).summary.status, Status::unsupported);
  EXPECT_TRUE(solve<UpwindSolver>(Scene<double>(spec), request, {}).summary.usable());
  spec.fluxes = {Burgers<double>{-1, 1}};
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 2}};
  EXPECT_EQ(solve<GodunovSolver>(Scene<double>(spec), request, {}).summary.status, Status::unsupported);
  EXPECT_EQ(solve<UpwindSolver>(Scene<double>(spec), request, {}).summary.status, Status::unsupported);
}

}  // namespace
}  // namespace shearfront
