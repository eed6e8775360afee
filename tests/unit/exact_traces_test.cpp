// SPDX-License-Identifier: BSD-3-Clause
// Event times of beds that hold next to nothing of one kind of grains, for every flux of the exact method. The kind of
// fault: what is left was measured by differences of rounded amounts, so traces of it were taken for none.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/checked.hpp"

namespace shearfront {
namespace {

/// Every sample of every flux that the exact method takes.
template <class Visit>
void for_each_exact_flux(Visit&& visit) {
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples()) {
      SceneSpec<> spec;
      spec.fluxes = {flux};
      spec.shear_rate = Piecewise<double>{{}, {1}};
      spec.initial_values = {flux.range().lowest};
      if (!find_complaints(spec).empty() || !exact::refusal(Scene<>(spec)).empty()) continue;
      SCOPED_TRACE(std::string(F::kName));
      visit(flux, spec);
    }
  });
}

const std::vector<double> kTraces{1e-2,  1e-4,  1e-6,  1e-8,  1e-10,  1e-12,
                                  1e-13, 1e-14, 1e-15, 1e-20, 1e-100, 1e-300};

// phi everywhere, 0 < z < 1: the shocks that leave both walls, with the secants from the pure states to phi, meet when they
// have covered the bed together.
TEST(ExactTraces, UniformMixture) {
  support::Checked checked({""}, 100);
  for_each_exact_flux([&](const auto& flux, SceneSpec<> spec) {
    const auto [lowest, highest] = flux.range();
    for (const bool is_high : {false, true})
      for (const double trace : kTraces) {
        const double part = trace * (highest - lowest), phi = is_high ? highest - part : lowest + part;
        if (phi == lowest || phi == highest) continue;
        spec.initial_values = {phi};
        const double right = 1 / std::abs(flux.secant(lowest, phi) - flux.secant(phi, highest));
        const auto t = exact_timeline(Scene<>(spec)).t_star;
        ASSERT_TRUE(t);
        EXPECT_NEAR(*t, right, 1e-13 * right) << "phi = " << phi;
        checked.count();
      }
  });
}

// Traces in three layers fall, or rise, one by one: from the wall they leave behind to the other one.
TEST(ExactTraces, LayersAreCrossedOneByOne) {
  support::Checked checked({""}, 30);
  for_each_exact_flux([&](const auto& flux, SceneSpec<> spec) {
    const auto [lowest, highest] = flux.range();
    const std::vector<double> rates{0.5, 4, 0.03125}, heights{0.25, 0.25, 0.5};
    spec.shear_rate = Piecewise<double>{{0.25, 0.5}, rates};
    for (const double trace : {1e-18, 1e-100, 1e-300}) {
      const double phi = lowest + trace * (highest - lowest);
      if (phi == lowest) continue;
      spec.initial_values = {phi};
      double right = 0;
      for (std::size_t k = 0; k < 3; ++k)
        right += heights[k] / (rates[k] * std::abs(flux.derivative(lowest)));
      const auto t = exact_timeline(Scene<>(spec)).t_star;
      ASSERT_TRUE(t);
      EXPECT_NEAR(*t, right, 1e-12 * right) << "phi = " << phi;
      checked.count();
    }
  });
}

// The last change anywhere is that of the steady state.
TEST(ExactTraces, NothingChangesAfterTheSteadyTime) {
  SceneSpec<> spec;
  spec.fluxes = {Cubic<double>{0.10126079621214362}};
  spec.shear_rate =
      Piecewise<double>{{0.03882704821681804, 0.20417242977817648, 0.2041724297791765, 0.7609865587504373},
                        {0.5671335343250643, 7757.550032904749, 0.26244950260321204, 7.050352613051595,
                         6.7697428580025286e-09}};
  spec.initial_values = {1e-300};
  const Timeline<double> timeline = exact_timeline(Scene<>(spec));
  ASSERT_TRUE(timeline.t_star);
  for (const auto& at : timeline.interfaces) {
    ASSERT_TRUE(at.last);
    EXPECT_LE(*at.last, *timeline.t_star * (1 + 1e-14));
  }
}

}  // namespace
}  // namespace shearfront
