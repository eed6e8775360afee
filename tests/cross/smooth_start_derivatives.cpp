// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of smooth starts by every entry of the scene, over every shear rate, against differences of the solution itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"
#include "support/start_differences.hpp"

namespace shearfront {
namespace {

using support::for_each_smooth_scene;
using support::SceneMaker;
using support::StartDifference;

TEST(SmoothStartDerivatives, AreThoseOfDifferencesOverEveryShearRate) {
  StartDifference<double> check{1e-6, 3e-6, 16};
  for_each_smooth_scene(support::seed_of(5301), 2, [&](const SceneSpec<double>& spec, SceneMaker& make) {
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene, {4, 1e-6});
    const double crossing = solution.medium().pure_travel_time(0, solution.medium().top());
    for (int i = 0; i < 2; ++i)
      check.compare(scene, make.uniform(0.1, 0.9), crossing * std::exp(make.uniform(-4, 0)));
  });
  EXPECT_GT(check.compared, 200);
  EXPECT_GT(check.from_start, 100);
}

/// At four places of beds with every flux, of which set_bed(spec, make) gives all but flux and start.
template <class SetBed>
StartDifference<double> compared_with_every_flux(std::uint64_t seed, const SetBed& set_bed) {
  StartDifference<double> check{1e-6, 3e-6, 16};
  SceneMaker make(support::seed_of(seed));
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples()) {
      SceneSpec<double> spec;
      spec.fluxes = {flux};
      set_bed(spec, make);
      const auto range = Flux<double>(flux).range();
      const double room = 0.05 * (range.highest - range.lowest);
      spec.initial_state = support::random_start(make, range.lowest + room, range.highest - room);
      if (!find_complaints(spec).empty() || !exact::refusal(Scene<double>(spec)).empty()) continue;
      SCOPED_TRACE(F::kName);
      for (int i = 0; i < 4; ++i) {
        const double z = make.uniform(0.1, 0.9), t = std::exp(make.uniform(-4, -1));
        check.compare(Scene<double>(spec), z, t);
      }
    }
  });
  return check;
}

/// A table with a flat piece and a throat, and an exponential bed.
TEST(SmoothStartDerivatives, AreThoseOfDifferencesInSlopedPiecesOfAnyFlux) {
  const auto in_table = compared_with_every_flux(5304, [](SceneSpec<double>& spec, SceneMaker&) {
    spec.shear_rate = Table<double>{{0, 0.3, 0.55, 0.8, 1}, {1.6, 0.7, 0.7, 1.3, 0.9}};
  });
  const auto in_exponential = compared_with_every_flux(5305, [](SceneSpec<double>& spec, SceneMaker&) {
    spec.shear_rate = Exponential<double>{1, 0.7};
  });
  EXPECT_GT(std::min(in_table.compared, in_exponential.compared), 100);
  EXPECT_GT(std::min(in_table.from_start, in_exponential.from_start), 50);
}

/// A state at the peak of a triangular flux leaves its layer when it likes, and with the capacity of the layer: phi beyond was taken
/// for that of a state which moves with its start.
TEST(SmoothStartDerivatives, AreThoseOfDifferencesWhereAStateLingersAtAKink) {
  StartDifference<double> check{1e-6, 3e-6, 16};
  SceneSpec<double> spec;
  spec.fluxes = {Triangular<double>{0.25, 1}};
  spec.shear_rate = Piecewise<double>{{0.55}, {1, 1.25}};
  spec.initial_state = TableInitial<double>{{0, 0.2, 0.4, 1}, {0.8, 0.75, 0.125, 0.125}};
  for (const double t : {0.15, 0.3, 0.45})
    for (const double z : {0.58, 0.63, 0.71, 0.83, 0.93}) check.compare(Scene<double>(spec), z, t);
  EXPECT_GT(check.compared, 80);
  EXPECT_GT(check.from_start, 40);
}

/// Layers with other fluxes and solid fractions.
TEST(SmoothStartDerivatives, AreThoseOfDifferencesInLayersOfAnyFlux) {
  const auto check = compared_with_every_flux(5302, [](SceneSpec<double>& spec, SceneMaker& make) {
    const auto order = make.order();
    spec.shear_rate = make.layers(3, order);
    if (make.integer(0, 1) == 0) spec.solid_fraction = Piecewise<double>{{0.4}, {0.5, 0.7}};
  });
  EXPECT_GT(check.compared, 100);
  EXPECT_GT(check.from_start, 50);
}

}  // namespace
}  // namespace shearfront
