// SPDX-License-Identifier: BSD-3-Clause
// Facts every solution obeys, on random scenes: seeds are printed by the checks that fail.
#include <gtest/gtest.h>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "support/checked.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// Layered with probability 2/3, exponential otherwise; step or arbitrary data.
SceneSpec<double> any_scene(SceneMaker& make) {
  const int n = make.integer(1, 6);
  auto spec = make.integer(0, 1) == 0 ? make.step(n, make.order()) : make.data(n, make.order(), 6);
  if (make.integer(0, 2) == 0)
    spec.shear_rate = Exponential<double>{make.uniform(0.5, 4), make.uniform(0.1, 2)};
  spec.scale = make.uniform(0.5, 2);
  return spec;
}

double any_time(SceneMaker& make) { return std::exp(make.uniform(std::log(0.01), std::log(5.0))); }

template <class Check>
void for_random_scenes(std::uint64_t count, Check&& check) {
  for (std::uint64_t n = 1; n <= count; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    check(make, any_scene(make));
  }
}

TEST(ExactLaws, BoundsMassAndMonotoneGrowth) {
  for_random_scenes(300, [](SceneMaker& make, const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    const double u = 1e-15;
    double z0 = 0, M0 = 0;
    const double t = any_time(make);
    EXPECT_EQ(solution.M(scene.top(), t), solution.mass());
    EXPECT_EQ(solution.M(scene.bottom(), t), 0.0);
    for (int i = 1; i <= 40; ++i) {
      const double z = i / 40.0;
      const auto value = solution.at(z, t);
      EXPECT_GE(value.phi, 0.0);
      EXPECT_LE(value.phi, 1.0);
      EXPECT_GE(value.H, 0.0);
      EXPECT_GE(value.M, M0 - u);
      EXPECT_LE(value.M, M0 + (z - z0) + u);
      EXPECT_GE(solution.M(z, 1.1 * t), value.M - u);  // dM/dt = H >= 0
      EXPECT_GE(value.M, solution.M(z, 0.0) - u);
      EXPECT_LE(value.M, solution.M(z, infinity<double>()) + u);
      z0 = z;
      M0 = value.M;
    }
  });
}

TEST(ExactLaws, PhiIsTheSlopeAndHTheRateOfM) {
  for_random_scenes(60, [](SceneMaker& make, const SceneSpec<double>& spec) {
    const auto scene = scene_cast<Real110>(Scene<double>(spec));
    const ExactSolution<Real110> solution(scene);
    const Real110 h("1e-16");
    for (int k = 0; k < 6; ++k) {
      const Real110 z(make.uniform(0.001, 0.999)), t(any_time(make));
      const auto value = solution.at(z, t);
      const Real110 slope = (solution.M(z + h, t) - solution.M(z - h, t)) / (2 * h);
      const Real110 rate = (solution.M(z, t + h) - solution.M(z, t - h)) / (2 * h);
      EXPECT_LT(abs(to_double(Real110(value.phi - slope))), 1e-20) << "z " << z << " t " << t;
      EXPECT_LT(abs(to_double(Real110(value.H - rate))), 1e-20) << "z " << z << " t " << t;
      const Real110 flux = scene.scale() * scene.shear_rate_at(z) * value.phi * (1 - value.phi);
      EXPECT_LT(abs(to_double(Real110(value.H - flux))), 1e-45) << "z " << z << " t " << t;
    }
  });
}

TEST(ExactLaws, FluxIsContinuousAcrossInterfaces) {
  support::Checked checked({""}, 30);
  for_random_scenes(60, [&](SceneMaker& make, const SceneSpec<double>& spec) {
    const auto* a = std::get_if<Piecewise<double>>(&spec.shear_rate);
    if (a == nullptr) return;
    const ExactSolution<Real110> solution(scene_cast<Real110>(Scene<double>(spec)));
    const Real110 t(any_time(make)), d("1e-22");
    for (const double b : a->breaks) {
      const Real110 here = solution.H(b, t);
      EXPECT_LT(abs(to_double(Real110(solution.H(b - d, t) - here))), 1e-9) << "z " << b << " t " << t;
      EXPECT_LT(abs(to_double(Real110(solution.H(b + d, t) - here))), 1e-9) << "z " << b << " t " << t;
      // phi at the interface is the state above it.
      EXPECT_LT(abs(to_double(Real110(solution.phi(b + d, t) - solution.phi(b, t)))), 1e-9)
          << "z " << b << " t " << t;
      checked.count();
    }
  });
}

TEST(ExactLaws, DoubleAgreesWith50Digits) {
  double worst_M = 0, worst_phi = 0;
  for_random_scenes(150, [&](SceneMaker& make, const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    const ExactSolution<double> in_double(scene);
    const ExactSolution<Real110> oracle(scene_cast<Real110>(scene));
    for (int k = 0; k < 8; ++k) {
      const double z = make.uniform(0, 1), t = any_time(make);
      const auto value = in_double.at(z, t);
      const auto exact = oracle.at(Real110(z), Real110(t));
      const double error_M = std::abs(value.M - to_double(exact.M)),
                   error_phi = std::abs(value.phi - to_double(exact.phi));
      worst_M = std::max(worst_M, error_M);
      worst_phi = std::max(worst_phi, error_phi);
      EXPECT_LT(error_M, 2e-15) << "z " << z << " t " << t;
      EXPECT_LT(error_phi, 1e-12) << "z " << z << " t " << t;
    }
  });
  RecordProperty("worst_M", std::to_string(worst_M * 1e16) + "e-16");
  RecordProperty("worst_phi", std::to_string(worst_phi * 1e16) + "e-16");
}

TEST(ExactLaws, ReflectionSymmetry) {
  // z -> bottom + top - z, phi -> 1 - phi, a reversed: M(z) -> height part below minus what lies above.
  support::Checked checked({""}, 50);
  for_random_scenes(150, [&](SceneMaker& make, const SceneSpec<double>& spec) {
    const auto* a = std::get_if<Piecewise<double>>(&spec.shear_rate);
    if (a == nullptr) return;
    SceneSpec<Real110> mirror = scene_cast<Real110>(Scene<double>(spec)).spec();
    auto& rate = std::get<Piecewise<Real110>>(mirror.shear_rate);
    const Real110 bottom(-0.5);
    for (auto* heights : {&rate.breaks, &mirror.initial_breaks}) {
      std::reverse(heights->begin(), heights->end());
      for (Real110& x : *heights) x = 1 - x;
    }
    std::reverse(rate.values.begin(), rate.values.end());
    std::reverse(mirror.initial_values.begin(), mirror.initial_values.end());
    for (Real110& phi : mirror.initial_values) phi = 1 - phi;
    // The mirrored scene lives in a shifted domain as well.
    for (auto* heights : {&rate.breaks, &mirror.initial_breaks})
      for (Real110& x : *heights) x += bottom;
    mirror.bottom = bottom;
    mirror.top = bottom + 1;
    const ExactSolution<Real110> one(scene_cast<Real110>(Scene<double>(spec))), two{Scene<Real110>(mirror)};
    checked.count();
    for (int k = 0; k < 5; ++k) {
      const Real110 z(make.uniform(0, 1)), t(any_time(make));
      // int_0^z phi = int_{1-z}^1 (1 - phi~) = z - (m~ - M~(1 - z)).
      const Real110 M = z - (two.mass() - two.M(bottom + 1 - z, t));
      EXPECT_LT(abs(to_double(Real110(one.M(z, t) - M))), 1e-45) << "z " << z << " t " << t;
      EXPECT_LT(abs(to_double(Real110(one.phi(z, t) - (1 - two.phi(bottom + 1 - z, t))))), 1e-40)
          << "z " << z << " t " << t;
    }
  });
}

TEST(ExactLaws, ScaleIsATimeUnit) {
  for_random_scenes(100, [](SceneMaker& make, const SceneSpec<double>& spec) {
    SceneSpec<double> faster = spec;
    faster.scale *= 1024;  // a power of two: exact
    const ExactSolution<double> one{Scene<double>(spec)}, two{Scene<double>(faster)};
    for (int k = 0; k < 5; ++k) {
      const double z = make.uniform(0, 1), t = any_time(make);
      EXPECT_EQ(one.M(z, t), two.M(z, t / 1024)) << "z " << z << " t " << t;
      EXPECT_EQ(one.phi(z, t), two.phi(z, t / 1024)) << "z " << z << " t " << t;
    }
  });
}

TEST(ExactLaws, SteadyAfterTheSteadyTime) {
  support::Checked checked({""}, 100);
  for_random_scenes(150, [&](SceneMaker&, const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    const double t = *exact_timeline(scene).t_star * (1 + 1e-12);
    if (t == 0) return;
    checked.count();
    for (int i = 0; i <= 20; ++i) {
      const double z = i / 20.0;
      EXPECT_NEAR(solution.M(z, t), solution.M(z, infinity<double>()), 1e-15) << "z " << z;
    }
  });
}

/// Restart: the solution at t1, taken as new initial data in very small steps, reaches the solution at
/// t1 + t2.
TEST(ExactLaws, Semigroup) {
  for_random_scenes(12, [](SceneMaker& make, const SceneSpec<double>& spec) {
    const ExactSolution<double> direct{Scene<double>(spec)};
    const double t1 = any_time(make) / 4, t2 = any_time(make) / 4;
    SceneSpec<double> restart = spec;
    restart.initial_breaks.clear();
    restart.initial_values.clear();
    const int n = 1000;
    double M = 0;
    for (int i = 1; i <= n; ++i) {
      const double z = double(i) / n, next = direct.M(z, t1);
      if (i < n) restart.initial_breaks.push_back(z);
      restart.initial_values.push_back(std::clamp((next - M) * n, 0.0, 1.0));
      M = next;
    }
    const ExactSolution<double> again{Scene<double>(restart)};
    // Averaging over cells of width h moves the initial M by at most h / 4, and M contracts in the maximum.
    for (int i = 0; i <= 20; ++i)
      EXPECT_NEAR(again.M(i / 20.0, t2), direct.M(i / 20.0, t1 + t2), 0.25 / n + 1e-12) << "z " << i / 20.0;
  });
}

/// Two initial data: the larger M stays the larger (comparison), the distance in the maximum does not grow.
TEST(ExactLaws, ComparisonAndContraction) {
  for_random_scenes(100, [](SceneMaker& make, const SceneSpec<double>& spec) {
    SceneSpec<double> other = spec;
    for (double& phi : other.initial_values) phi = std::min(1.0, phi + make.uniform(0, 0.3));
    const ExactSolution<double> one{Scene<double>(spec)}, two{Scene<double>(other)};
    const double t = any_time(make), gap = two.mass() - one.mass();  // M differs most at the top
    for (int i = 0; i <= 20; ++i) {
      const double z = i / 20.0, difference = two.M(z, t) - one.M(z, t);
      EXPECT_GE(difference, -1e-15) << "z " << z;
      EXPECT_LE(difference, gap + 1e-15) << "z " << z;
    }
  });
}

TEST(ExactLaws, StaircasesConvergeToTheExponential) {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{2, 0.3};
  spec.initial_breaks = {0.3, 0.6};
  spec.initial_values = {0.2, 0.1, 0.9};
  const Scene<double> scene(spec);
  const ExactSolution<double> exact(scene);
  std::vector<double> errors;
  for (const std::size_t n : {32u, 64u, 128u, 256u}) {
    const auto layers = staircase(scene, n);
    SceneSpec<double> steps = spec;
    Piecewise<double> a;
    for (std::size_t k = 0; k < layers.n_layers(); ++k) {
      if (k > 0) a.breaks.push_back(layers.boundary(k));
      a.values.push_back(layers.shear_rate(k));
    }
    steps.shear_rate = a;
    const ExactSolution<double> stairs{Scene<double>(steps)};
    double worst = 0;
    for (const double t : {0.1, 0.5, 2.0})
      for (int i = 1; i < 20; ++i)
        worst = std::max(worst, std::abs(stairs.M(i / 20.0, t) - exact.M(i / 20.0, t)));
    errors.push_back(worst);
  }
  // Order 3/2, not 2: where a path turns its speed vanishes like the root of the distance, and the staircase
  // lets it rest at the last stair instead. Eight times the layers: 8^(3/2) = 22.6.
  EXPECT_LT(errors.back(), 1.2e-4);
  EXPECT_GT(errors.front() / errors.back(), 16.0);
}

TEST(ExactLaws, ASmoothBedStatesAnErrorThatHolds) {
  SceneMaker make(support::seed_of(11));
  for (int scene_number = 0; scene_number < 5; ++scene_number) {
    SceneSpec<double> spec = make.step(1, SceneMaker::Order::falling);
    spec.shear_rate = Chute<double>{make.uniform(0.5, 3), make.uniform(0.3, 2), make.uniform(0, 1)};
    spec.temperature = Table<double>{{0, 1}, {make.uniform(2, 4), make.uniform(0.5, 1)}};
    const Scene<double> scene(spec);
    const ExactSolution<double> coarse(scene, {128}), fine(scene, {2048});
    double worst = 0, stated = 0;
    for (int k = 0; k < 30; ++k) {
      const double z = make.uniform(0, 1), t = make.uniform(0.05, 1);
      const auto value = coarse.at(z, t);
      worst = std::max(worst, std::abs(value.M - fine.M(z, t)));
      stated = std::max(stated, value.M_error);
    }
    EXPECT_LE(worst, stated);
    EXPECT_GT(stated, 0.0);
    EXPECT_LT(stated, 5e-2);
  }
}

/// A table whose values follow no bend is one straight line; against the exponential it tends to.
TEST(ExactLaws, ATableThroughAnExponentialTendsToIt) {
  Table<double> table;
  for (int i = 0; i <= 64; ++i) {
    table.z.push_back(i / 64.0);
    table.values.push_back(2 * std::exp(-i / 64.0 / 0.3));
  }
  SceneSpec<double> spec;
  spec.shear_rate = table;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  SceneSpec<double> smooth = spec;
  smooth.shear_rate = Exponential<double>{2, 0.3};
  const ExactSolution<double> one(Scene<double>(spec), {512}), two{Scene<double>(smooth)};
  for (const double t : {0.2, 1.0, 4.0})
    for (int i = 1; i < 20; ++i) EXPECT_NEAR(one.M(i / 20.0, t), two.M(i / 20.0, t), 3e-4);
}

}  // namespace
}  // namespace shearfront
