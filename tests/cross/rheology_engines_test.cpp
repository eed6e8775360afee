// SPDX-License-Identifier: BSD-3-Clause
// Shear rates from rheology by every engine: they share nothing but the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

SceneSpec<double> bed(DepthFunction<double> rate, double scale) {
  SceneSpec<double> spec;
  spec.shear_rate = std::move(rate);
  spec.scale = scale;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return spec;
}
Bagnold<double> slope() {
  Bagnold<double> a;
  a.angle = 0.43;
  a.grain = 0.04;
  a.gravity = 1;
  return a;
}
Kinetic<double> cell() {
  Kinetic<double> a;
  a.length = 0.2;
  return a;
}
template <class Shear>
Scaling<Shear> law(Shear shear) {
  Scaling<Shear> a;
  a.shear = std::move(shear);
  a.small_diameter = 0.02;
  a.size_ratio = 2;
  return a;
}
KineticShear<double> sheared_cell() {
  KineticShear<double> a;
  a.length = 0.2;
  return a;
}

MusclSolver::Options muscl_on_200_cells() {
  MusclSolver::Options options;
  options.cells = 200;
  return options;
}

/// In units of time in which a few are enough.
std::vector<std::pair<std::string, SceneSpec<double>>> beds() {
  return {{"bagnold", bed(slope(), 0.5)},
          {"kinetic", bed(cell(), 1)},
          {"scaling-bagnold", bed(law(slope()), 100)},
          {"scaling-kinetic", bed(law(sheared_cell()), 2000)},
          {"scaling-velocity", bed(law(VelocityPoints<double>{{0, 0.4, 1}, {0, 1, 1.5}}), 300)}};
}

double worst(const SolverResult& a, const SolverResult& b) {
  double all = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i)
    all = std::max(all, std::abs(a.samples[i].M - b.samples[i].M));
  return all;
}

TEST(RheologyEngines, AgreeWithTheExactMethod) {
  for (const auto& [name, spec] : beds()) {
    const Scene<double> scene(spec);
    SolverRequest request;
    request.times = {0.3, 1, 3};
    request.heights = {0.05, 0.25, 0.5, 0.75, 0.95};
    const auto exact = solve<ExactSolver>(scene, request, {.tolerance = 1e-5});
    ASSERT_TRUE(exact.summary.usable()) << name;
    const auto fronts = solve<FrontTrackingSolver>(scene, request, {.resolution = 0.05});
    ASSERT_TRUE(fronts.summary.usable()) << name;
    EXPECT_LT(worst(exact, fronts), 2e-3) << name;
    const auto cells = solve<MusclSolver>(scene, request, muscl_on_200_cells());
    ASSERT_TRUE(cells.summary.usable()) << name;
    EXPECT_LT(worst(exact, cells), 1e-3) << name;
  }
}

/// D -> 0: the scheme with little diffusion.
TEST(RheologyEngines, DiffusionTendsToTheExactMethod) {
  for (const auto& [name, spec] : beds()) {
    SolverRequest request;
    request.times = {0.3, 1};
    request.heights = {0.25, 0.5, 0.75};
    const auto exact = solve<ExactSolver>(Scene<double>(spec), request, {.tolerance = 1e-5});
    double before = 0;
    for (const double D : {8e-3, 1e-3}) {
      auto diffusing = spec;
      diffusing.diffusion = Diffusion<double>{D, {}, false};
      const auto scheme = solve<CrankNicolsonSolver>(Scene<double>(diffusing), request, {.cells = 200});
      ASSERT_TRUE(scheme.summary.usable()) << name;
      const double difference = worst(exact, scheme);
      if (before > 0) {
        EXPECT_LT(difference, before / 2) << name;
      }
      before = difference;
    }
    EXPECT_LT(before, 2e-2) << name;
  }
}

}  // namespace
}  // namespace shearfront
