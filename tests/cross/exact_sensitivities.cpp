// SPDX-License-Identifier: BSD-3-Clause
// The exact derivatives against central differences of the exact solution in 50 digits.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/sensitivities.hpp"
#include "shearfront/scene/scene_cast.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;
using Spec = SceneSpec<Real110>;

/// One number of a scene file: how to reach it, and where its derivatives are found.
struct Parameter {
  std::string name;
  std::function<Real110&(Spec&)> number;
  std::function<Real110(const Gradient<Real110>&)> derivative;
  bool is_state = false;  ///< confined to [0, 1]
};

std::vector<Parameter> parameters_of(const Spec& spec) {
  std::vector<Parameter> all;
  const auto text = [](const char* name, std::size_t i) { return name + ("[" + std::to_string(i) + "]"); };
  if (const auto* a = std::get_if<Piecewise<Real110>>(&spec.shear_rate)) {
    for (std::size_t i = 0; i < a->values.size(); ++i)
      all.push_back({text("shear_rate.values", i),
                     [i](Spec& s) -> Real110& { return std::get<Piecewise<Real110>>(s.shear_rate).values[i]; },
                     [i](const Gradient<Real110>& g) { return g.shear_rate_values()[i]; }});
    for (std::size_t i = 0; i < a->breaks.size(); ++i)
      all.push_back({text("shear_rate.breaks", i),
                     [i](Spec& s) -> Real110& { return std::get<Piecewise<Real110>>(s.shear_rate).breaks[i]; },
                     [i](const Gradient<Real110>& g) { return g.shear_rate_breaks()[i]; }});
  }
  if (const auto* a = std::get_if<Table<Real110>>(&spec.shear_rate))
    for (std::size_t i = 0; i < a->values.size(); ++i)
      all.push_back({text("shear_rate.values", i),
                     [i](Spec& s) -> Real110& { return std::get<Table<Real110>>(s.shear_rate).values[i]; },
                     [i](const Gradient<Real110>& g) { return g.shear_rate_values()[i]; }});
  if (std::holds_alternative<Exponential<Real110>>(spec.shear_rate)) {
    all.push_back({"shear_rate.amplitude",
                   [](Spec& s) -> Real110& { return std::get<Exponential<Real110>>(s.shear_rate).amplitude; },
                   [](const Gradient<Real110>& g) { return g.amplitude; }});
    all.push_back({"shear_rate.decay",
                   [](Spec& s) -> Real110& { return std::get<Exponential<Real110>>(s.shear_rate).decay; },
                   [](const Gradient<Real110>& g) { return g.decay; }});
  }
  all.push_back({"shear_rate.scale", [](Spec& s) -> Real110& { return s.scale; },
                 [](const Gradient<Real110>& g) { return g.scale; }});
  for (std::size_t i = 0; i < spec.initial_breaks.size(); ++i)
    all.push_back({text("initial.breaks", i), [i](Spec& s) -> Real110& { return s.initial_breaks[i]; },
                   [i](const Gradient<Real110>& g) { return g.initial_breaks()[i]; }});
  for (std::size_t i = 0; i < spec.initial_values.size(); ++i)
    all.push_back({text("initial.values", i), [i](Spec& s) -> Real110& { return s.initial_values[i]; },
                   [i](const Gradient<Real110>& g) { return g.initial_values()[i]; }, true});
  return all;
}

struct PhiM {
  Real110 phi, M;
};

PhiM solve(Spec spec, const Parameter& parameter, const Real110& step, std::size_t layers, const Real110& z,
           const Real110& t) {
  parameter.number(spec) += step;
  const auto value = ExactSolution<Real110>(Scene<Real110>(spec), {layers}).at(z, t);
  return {value.phi, value.M};
}

/// Second-order difference quotient, one-sided where a state would leave [0, 1].
PhiM difference(const Spec& spec, const Parameter& parameter, std::size_t layers, const Real110& z,
                const Real110& t) {
  const Real110 h("1e-17");
  Spec copy = spec;
  const Real110 here = parameter.number(copy);
  const auto at = [&](int steps) { return solve(spec, parameter, h * steps, layers, z, t); };
  if (parameter.is_state && (here == 0 || here == 1)) {
    const int sign = here == 0 ? 1 : -1;
    const PhiM a = at(0), b = at(sign), c = at(2 * sign);
    const Real110 H = 2 * h * sign;
    return {(4 * b.phi - 3 * a.phi - c.phi) / H, (4 * b.M - 3 * a.M - c.M) / H};
  }
  const PhiM lo = at(-1), hi = at(1);
  return {(hi.phi - lo.phi) / (2 * h), (hi.M - lo.M) / (2 * h)};
}

void expect_derivatives(const SceneSpec<double>& in_double, const Real110& z, const Real110& t,
                        const std::string& label, std::size_t layers = 0) {
  const Scene<Real110> scene = scene_cast<Real110>(Scene<double>(in_double));
  const Spec& spec = scene.spec();
  const ExactSolution<Real110> solution(scene, {layers});
  const auto exact = sensitivities(solution, z, t);
  const auto path = solution.path(z, t);
  EXPECT_EQ(exact.value.M, solution.M(z, t));
  for (const Parameter& parameter : parameters_of(spec)) {
    const PhiM numeric = difference(spec, parameter, layers, z, t);
    const Real110 dM = parameter.derivative(exact.M), dphi = parameter.derivative(exact.phi);
    const double size_M = 1 + std::abs(to_double(dM)), size_phi = 1 + std::abs(to_double(dphi));
    EXPECT_LT(abs(to_double(Real110(dM - numeric.M))), 1e-20 * size_M)
        << label << " dM/d " << parameter.name << " kind " << int(path.kind) << " z " << z << " t " << t
        << " exact " << dM << " numeric " << numeric.M;
    // Far from its mean phi may bend sharply: the difference quotient is worth h^2 phi'''.
    EXPECT_LT(abs(to_double(Real110(dphi - numeric.phi))), 1e-20 * size_phi * size_phi * size_phi)
        << label << " dphi/d " << parameter.name << " kind " << int(path.kind) << " z " << z << " t " << t
        << " exact " << dphi << " numeric " << numeric.phi;
  }
}

void check_random_scenes(std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t n = first; n < first + count; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    const int layers = make.integer(1, 6);
    const auto spec = n % 2 == 0 ? make.step(layers, make.order()) : make.data(layers, make.order(), 5);
    for (int k = 0; k < 3; ++k) {
      const Real110 z(make.uniform(0, 1)), t(std::exp(make.uniform(std::log(0.02), std::log(4.0))));
      expect_derivatives(spec, z, t, "seed " + std::to_string(seed));
    }
  }
}

TEST(ExactSensitivities, LayeredScenesAgreeWithDifferences) { check_random_scenes(1, 12); }
TEST(SlowExactSensitivities, ManyLayeredScenesAgreeWithDifferences) { check_random_scenes(100, 500); }

TEST(ExactSensitivities, ExponentialScenesAgreeWithDifferences) {
  for (std::uint64_t n = 1; n <= 25; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    auto spec = n % 2 == 0 ? make.step(1, make.order()) : make.data(1, make.order(), 5);
    spec.shear_rate = Exponential<double>{make.uniform(0.5, 4), make.uniform(0.1, 2)};
    spec.scale = make.uniform(0.5, 2);
    for (int k = 0; k < 3; ++k) {
      const Real110 z(make.uniform(0, 1)), t(std::exp(make.uniform(std::log(0.02), std::log(4.0))));
      expect_derivatives(spec, z, t, "seed " + std::to_string(seed));
    }
  }
}

TEST(ExactSensitivities, TableScenesAgreeWithDifferencesOfTheSameStaircase) {
  for (std::uint64_t n = 1; n <= 4; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    auto spec = make.step(1, make.order());
    spec.shear_rate = Table<double>{{0, 0.3, 0.6, 1},
                                    {make.uniform(0.5, 3), make.uniform(0.5, 3), make.uniform(0.5, 3), 0.4}};
    const Real110 z(make.uniform(0, 1)), t(make.uniform(0.1, 1));
    expect_derivatives(spec, z, t, "seed " + std::to_string(seed), 16);
  }
}

TEST(ExactSensitivities, WallsAndTheSteadyStateDependOnlyOnTheMass) {
  SceneMaker make(support::seed_of(3));
  const auto spec = make.step(3, SceneMaker::Order::falling);
  const ExactSolution<double> solution{Scene<double>(spec)};
  const auto above = sensitivities(solution, 0.95, infinity<double>());
  EXPECT_EQ(above.M.initial_breaks()[0], -1.0);
  EXPECT_EQ(above.M.scale, 0.0);
  const auto below = sensitivities(solution, 0.01, infinity<double>());
  EXPECT_EQ(below.M.initial_breaks()[0], 0.0);
  const auto start = sensitivities(solution, 0.95, 0.0);
  EXPECT_EQ(start.M.initial_breaks()[0], -1.0);
  EXPECT_EQ(start.phi.initial_values()[1], 1.0);
}

}  // namespace
}  // namespace shearfront
