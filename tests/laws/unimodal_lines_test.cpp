// SPDX-License-Identifier: BSD-3-Clause
// The linear reconstruction of front tracking for every flux of the list with one extremum: range, mass, order.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/any_flux.hpp"
#include "support/checked.hpp"

namespace shearfront {
namespace {

using support::draw;
using support::name_of;
using support::SceneMaker;
using support::unimodal_fluxes;

using UnimodalSetup = TrackingSetup<double, UnimodalGrid<double>>;

TEST(UnimodalLines, KeepMassAndRange) {
  SceneMaker maker(support::seed_of(8401));
  support::Checked checked({""}, 100);
  for (const Flux<double>& flux : unimodal_fluxes())
    for (int number = 0; number < 3; ++number) {
      SCOPED_TRACE(name_of(flux) + ", scene " + std::to_string(number));
      const Scene<double> scene(draw(maker, flux, 1 + number, 2));
      const UnimodalSetup setup(scene, 0.05);
      Tracker<UnimodalGrid<double>> tracker(setup);
      for (const double t : {0.02, 0.2, 1.0}) {
        tracker.advance_to(t);
        const Profile<double> steps = tracker.profile(), lines = linear_profile(tracker);
        EXPECT_NEAR(lines.mass(), scene.mass(), 1e-12);
        const auto [lowest, highest] = flux.range();
        for (std::size_t i = 0; i < lines.n_cells(); ++i)
          for (const double phi : {lines.below()[i], lines.above()[i]}) {
            EXPECT_GE(phi, lowest - 1e-12);
            EXPECT_LE(phi, highest + 1e-12);
          }
        for (std::size_t k = 0; k <= setup.stack.n_layers(); ++k) {
          const double z = setup.stack.boundary(k);
          EXPECT_NEAR(lines.at(z).M, steps.at(z).M, 1e-12) << "M at an interface or wall, z = " << z;
        }
        checked.count();
      }
    }
}

// Against steps so fine that their error does not count. Sixteen times finer, the error of second order is 1/256, give or
// take how shocks fall between the states; that of the steps themselves a sixteenth.
TEST(UnimodalLines, AreOfSecondOrder) {
  support::Checked checked({""}, 8);
  for (const Flux<double>& flux : unimodal_fluxes()) {
    SCOPED_TRACE(name_of(flux));
    const auto [lowest, highest] = flux.range();
    SceneSpec<double> spec;
    spec.fluxes = {flux};
    spec.shear_rate = Piecewise<double>{{0.29}, {1.5, 0.75}};
    spec.initial_breaks = {0.5};
    spec.initial_values = {lowest, highest};
    if (flux.value(flux.extrema()[0]) > 0) std::swap(spec.initial_values[0], spec.initial_values[1]);
    const Scene<double> scene(spec);
    const double t = 0.4;
    const auto tracked = [&](double resolution, bool lines) {
      const UnimodalSetup setup(scene, resolution);
      Tracker<UnimodalGrid<double>> tracker(setup);
      tracker.advance_to(t);
      return lines ? linear_profile(tracker) : tracker.profile();
    };
    const Profile<double> right = tracked(2e-5, false);
    const double width = highest - lowest;
    const auto error = [&](double resolution, bool lines) {
      return l1_distance(tracked(resolution, lines), right) / width;
    };
    const double coarse = error(0.16, true), fine = error(0.01, true);
    if (coarse < 1e-4) continue;  // contacts are exact
    EXPECT_LT(fine, coarse / 50);
    EXPECT_LT(fine, error(0.01, false) / 5);
    checked.count();
  }
}

}  // namespace
}  // namespace shearfront
