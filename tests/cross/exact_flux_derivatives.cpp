// SPDX-License-Identifier: BSD-3-Clause
// The exact derivatives of scenes with other fluxes, solid fraction and temperature against central differences of
// the exact solution in 50 digits.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/flux_scenes.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::FluxShape;
using support::SceneMaker;
using Spec = SceneSpec<Real110>;

Real110 size(const Real110& x) { return x < 0 ? Real110(-x) : x; }

/// Compares at random points; where the two sides of a difference have different paths, the point is no point
/// of differentiability and is left out. Returns the number of derivatives compared.
int compare(const Scene<Real110>& scene, SceneMaker& make) {
  const Real110 h("1e-16");
  const ExactSolution<Real110> solution(scene);
  const Derivatives<Real110> derivatives(solution);
  const std::vector<Entry> all = entries(scene.spec());
  int compared = 0;
  for (int i = 0; i < 3; ++i) {
    const Real110 z = make.uniform(0, 1), t = std::exp(make.uniform(-2, 2));
    const auto exact = derivatives.at(z, t);
    const auto path = solution.path(z, t);
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (!derivative_refusal(scene, all[e]).empty()) continue;
      Spec less = scene.spec(), more = scene.spec();
      *entry_places(less)[e] -= h;
      *entry_places(more)[e] += h;
      if (!find_complaints(less).empty() || !find_complaints(more).empty()) continue;
      const ExactSolution<Real110> low{Scene<Real110>(less)}, high{Scene<Real110>(more)};
      const auto is_other = [&](const ExactSolution<Real110>& s) {
        const auto q = s.path(z, t);
        return q.kind != path.kind || q.upward != path.upward || size(q.foot - path.foot) > Real110(1e-6);
      };
      if (is_other(low) || is_other(high)) continue;
      const Real110 two_h = 2 * h;
      const Real110 M = (high.M(z, t) - low.M(z, t)) / two_h, phi = (high.phi(z, t) - low.phi(z, t)) / two_h;
      const Real110 &dM = exact.M[e], &dphi = exact.phi[e];
      EXPECT_LT(size(dM - M), Real110(1e-20) * (1 + size(M)))
          << all[e].name() << " M at " << z << ", " << t << " kind " << int(path.kind) << ": " << dM
          << " against " << M;
      EXPECT_LT(size(dphi - phi), Real110(1e-20) * (1 + size(phi)))
          << all[e].name() << " phi at " << z << ", " << t << " kind " << int(path.kind) << ": " << dphi
          << " against " << phi;
      ++compared;
    }
  }
  return compared;
}

class FluxDerivatives : public ::testing::TestWithParam<FluxShape> {};

TEST_P(FluxDerivatives, AreDifferencesInFiftyDigits) {
  SceneMaker make(support::seed_of(5201 + static_cast<std::uint64_t>(GetParam())));
  int compared = 0;
  for (int n = 0; n < 5; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    compared +=
        compare(scene_cast<Real110>(Scene<double>(support::random_flux_scene(make, GetParam()))), make);
  }
  EXPECT_GT(compared, 80);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FluxDerivatives,
                         ::testing::Values(FluxShape::convex_parabolas, FluxShape::concave_parabolas,
                                           FluxShape::convex, FluxShape::concave));

TEST(FluxDerivativeRefusal, SayWhenThereAreNone) {
  SceneSpec<double> spec;
  spec.fluxes = {Quadratic<double>{}};
  spec.shear_rate = Piecewise<double>{{0.3}, {2, 1}};
  spec.initial_values = {0.5};
  spec.solid_fraction = Piecewise<double>{{0.3}, {0.5, 0.25}};
  const auto text = [&](const std::string& name) {
    for (const Entry& entry : entries(spec))
      if (entry.name() == name) return derivative_refusal(Scene<double>(spec), entry);
    return std::string("no such entry");
  };
  EXPECT_EQ(text("shear_rate.breaks[0]"),
            "shear_rate.breaks[0] lies on a jump of solid fraction, temperature or flux");
  EXPECT_EQ(text("shear_rate.values[0]"), "");
  EXPECT_EQ(text("solid_fraction.values[0]"), "solid_fraction.values has no exact derivatives");
  EXPECT_EQ(text("domain.top"), "domain.top has no exact derivatives");
  spec.solid_fraction = Piecewise<double>{{0.4}, {0.5, 0.25}};
  EXPECT_EQ(text("shear_rate.breaks[0]"), "");
  spec.solid_fraction = Table<double>{{0, 1}, {0.5, 0.25}};
  EXPECT_EQ(text("shear_rate.values[0]"), "the solid fraction varies smoothly");
}

}  // namespace
}  // namespace shearfront
