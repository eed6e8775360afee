// SPDX-License-Identifier: BSD-3-Clause
// The exact derivatives of scenes with other fluxes, solid fraction and temperature against central differences of
// the exact solution in 50 digits.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/sensitivities.hpp"
#include "shearfront/scene/scene_cast.hpp"
#include "support/flux_scenes.hpp"

namespace shearfront {
namespace {

using support::FluxShape;
using support::SceneMaker;
using Spec = SceneSpec<Real110>;

struct Parameter {
  std::string name;
  std::function<Real110&(Spec&)> number;
  std::function<Real110(const Gradient<Real110>&)> derivative;
};

std::vector<Parameter> parameters_of(const Spec& spec) {
  std::vector<Parameter> all;
  const auto add = [&](const char* name, std::size_t n, auto number, auto derivative) {
    for (std::size_t i = 0; i < n; ++i)
      all.push_back({name + ("[" + std::to_string(i) + "]"),
                     [number, i](Spec& s) -> Real110& { return number(s)[i]; },
                     [derivative, i](const Gradient<Real110>& g) { return derivative(g)[i]; }});
  };
  const auto& a = std::get<Piecewise<Real110>>(spec.shear_rate);
  add(
      "shear_rate.values", a.values.size(),
      [](Spec & s) -> auto& { return std::get<Piecewise<Real110>>(s.shear_rate).values; },
      [](const Gradient<Real110>& g) { return g.shear_rate_values(); });
  add(
      "shear_rate.breaks", a.breaks.size(),
      [](Spec & s) -> auto& { return std::get<Piecewise<Real110>>(s.shear_rate).breaks; },
      [](const Gradient<Real110>& g) { return g.shear_rate_breaks(); });
  add(
      "initial.breaks", spec.initial_breaks.size(), [](Spec & s) -> auto& { return s.initial_breaks; },
      [](const Gradient<Real110>& g) { return g.initial_breaks(); });
  add(
      "initial.values", spec.initial_values.size(), [](Spec & s) -> auto& { return s.initial_values; },
      [](const Gradient<Real110>& g) { return g.initial_values(); });
  all.push_back({"shear_rate.scale", [](Spec& s) -> Real110& { return s.scale; },
                 [](const Gradient<Real110>& g) { return g.scale; }});
  return all;
}

Real110 size(const Real110& x) { return x < 0 ? Real110(-x) : x; }

/// Compares at random points; where the two sides of a difference have different paths, the point is no point
/// of differentiability and is left out. Returns the number of derivatives compared.
int compare(const Scene<Real110>& scene, SceneMaker& make) {
  const Real110 h("1e-16");
  const ExactSolution<Real110> solution(scene);
  EXPECT_EQ(sensitivity_refusal(solution), "");
  int compared = 0;
  for (int i = 0; i < 3; ++i) {
    const Real110 z = make.uniform(0, 1), t = std::exp(make.uniform(-2, 2));
    const auto exact = sensitivities(solution, z, t);
    const auto path = solution.path(z, t);
    for (const Parameter& p : parameters_of(scene.spec())) {
      Spec less = scene.spec(), more = scene.spec();
      p.number(less) -= h;
      p.number(more) += h;
      if (!find_complaints(less).empty() || !find_complaints(more).empty()) continue;
      const ExactSolution<Real110> low{Scene<Real110>(less)}, high{Scene<Real110>(more)};
      const auto is_other = [&](const ExactSolution<Real110>& s) {
        const auto q = s.path(z, t);
        return q.kind != path.kind || q.upward != path.upward || size(q.foot - path.foot) > Real110(1e-6);
      };
      if (is_other(low) || is_other(high)) continue;
      const Real110 two_h = 2 * h;
      const Real110 M = (high.M(z, t) - low.M(z, t)) / two_h, phi = (high.phi(z, t) - low.phi(z, t)) / two_h;
      const Real110 dM = p.derivative(exact.M), dphi = p.derivative(exact.phi);
      EXPECT_LT(size(dM - M), Real110(1e-20) * (1 + size(M)))
          << p.name << " M at " << z << ", " << t << " kind " << int(path.kind) << ": " << dM << " against "
          << M;
      EXPECT_LT(size(dphi - phi), Real110(1e-20) * (1 + size(phi)))
          << p.name << " phi at " << z << ", " << t << " kind " << int(path.kind) << ": " << dphi
          << " against " << phi;
      ++compared;
    }
  }
  return compared;
}

class FluxSensitivities : public ::testing::TestWithParam<FluxShape> {};

TEST_P(FluxSensitivities, AreDifferencesInFiftyDigits) {
  SceneMaker make(support::seed_of(5201 + static_cast<std::uint64_t>(GetParam())));
  int compared = 0;
  for (int n = 0; n < 5; ++n) {
    SCOPED_TRACE("scene " + std::to_string(n));
    compared +=
        compare(scene_cast<Real110>(Scene<double>(support::random_flux_scene(make, GetParam()))), make);
  }
  EXPECT_GT(compared, 80);
}

INSTANTIATE_TEST_SUITE_P(Shapes, FluxSensitivities,
                         ::testing::Values(FluxShape::convex_parabolas, FluxShape::concave_parabolas,
                                           FluxShape::convex, FluxShape::concave));

TEST(FluxSensitivityRefusal, SayWhenThereAreNone) {
  SceneSpec<double> spec;
  spec.fluxes = {Quadratic<double>{}};
  spec.shear_rate = Piecewise<double>{{0.3}, {2, 1}};
  spec.initial_values = {0.5};
  spec.solid_fraction = Piecewise<double>{{0.3}, {0.5, 0.25}};
  const auto text = [&] { return sensitivity_refusal(ExactSolution<double>{Scene<double>(spec)}); };
  EXPECT_EQ(text(),
            "shear_rate.breaks = 0.3 lies on a jump of packing, temperature or flux: derivatives by "
            "differences only");
  spec.solid_fraction = Piecewise<double>{{0.4}, {0.5, 0.25}};
  EXPECT_EQ(text(), "");
  spec.solid_fraction = Table<double>{{0, 1}, {0.5, 0.25}};
  EXPECT_NE(text(), "");
}

}  // namespace
}  // namespace shearfront
