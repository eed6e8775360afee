// SPDX-License-Identifier: BSD-3-Clause
// Degenerate and extreme scenes: each test states what must hold, not what the program printed.
#include <gtest/gtest.h>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"
#include "support/closeness.hpp"
#include "support/layered_spec.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::layered;
using support::relative_error;
using support::SceneMaker;

/// double against 50 digits on a grid, and the bounds.
void expect_accurate(const SceneSpec<double>& spec, const std::vector<double>& times,
                     double tolerance = 4e-15) {
  const Scene<double> scene(spec);
  const ExactSolution<double> solution(scene);
  const ExactSolution<Real110> oracle(scene_cast<Real110>(scene));
  for (const double t : times)
    for (int i = 0; i <= 20; ++i) {
      const double z = i / 20.0;
      const auto value = solution.at(z, t);
      EXPECT_NEAR(value.M, to_double(oracle.M(Real110(z), Real110(t))), tolerance) << "z " << z << " t " << t;
      EXPECT_GE(value.phi, 0.0);
      EXPECT_LE(value.phi, 1.0);
    }
}

TEST(ExactHardCases, ThinLayer) {
  for (const double a : {0.01, 1.0, 100.0})
    expect_accurate(layered({0.4, 0.4 + 1e-12}, {2, a, 1}, {0.5}, {0, 1}), {0.05, 0.3, 1.0, 3.0});
  // A layer this thin that is not slower than its neighbours changes M by no more than its thickness.
  const ExactSolution<double> with{Scene<double>(layered({0.4, 0.4 + 1e-12}, {2, 5, 1}, {0.5}, {0, 1}))};
  const ExactSolution<double> without{Scene<double>(layered({0.4}, {2, 1}, {0.5}, {0, 1}))};
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(with.M(i / 20.0, 0.6), without.M(i / 20.0, 0.6), 2e-11);
}

TEST(ExactHardCases, NextToAJumpWhoseStateIsNextToOneHalf) {
  // 4 phi (1 - phi) of such a state may round to more than 1; the narrow fan that leaves the jump all the
  // same is the only path to the heights next to it.
  for (const double phi : {0.4999999999811922, 0.5 - 1e-12, std::nextafter(0.5, 0.0)})
    for (const double a : {0.8138, 1.0, 0.3, 2.7}) {
      const double x = 0.30123;
      const auto spec = layered({}, {a}, {x}, {phi, 0.98});
      const Scene<double> scene(spec);
      const ExactSolution<double> solution(scene);
      const ExactSolution<Real110> oracle(scene_cast<Real110>(scene));
      for (const double z : {std::nextafter(x, 0.0), x - 1e-13, x, std::nextafter(x, 1.0)})
        EXPECT_NEAR(solution.M(z, 0.1), to_double(oracle.M(Real110(z), Real110(0.1))), 4e-15)
            << phi << " " << a;
    }
}

TEST(ExactHardCases, NoFluxThroughAnInterfaceExceedsWhatTheLayerAboveCarries) {
  // The fan sets out within rounding of the interface, from the layer that carries a little more.
  const double z = 0.4724065368652349, above = 1.0084867162819546;
  const ExactSolution<double> solution{Scene<double>(
      layered({z}, {1.00848671628316, above}, {std::nextafter(z, 0.0)}, {0.5000000000516142, 1}))};
  for (const double t : {6.8e-6, 2.9e-5, 0.01}) {
    const auto value = solution.at(z, t);
    EXPECT_LE(value.H, above / 4);
    EXPECT_NEAR(value.H, above * value.phi * (1 - value.phi), 1e-15);
  }
}

TEST(ExactHardCases, APureBedHasTheMassOfItsHeight) {
  SceneMaker maker(support::seed_of(63));
  for (int number = 0; number < 200; ++number) {
    auto spec = layered({}, {1}, {maker.uniform(-6e3, 1e3)}, {1, 1});
    spec.bottom = maker.uniform(-2e4, -1e4), spec.top = maker.uniform(1e4, 2e4);
    const ExactSolution<double> solution{Scene<double>(spec)};
    EXPECT_EQ(solution.mass(), spec.top - spec.bottom);
    for (const double t : {0.0, 1.0, 1e5, infinity<double>()}) {
      EXPECT_EQ(solution.M(spec.bottom, t), 0);
      EXPECT_EQ(solution.M(spec.top, t), solution.mass());
    }
  }
}

TEST(ExactHardCases, PathsFromFarAboveInAnExponentialMedium) {
  // Where a falls by e^-15, characteristics come down from where a is e^-9 of what it is here.
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{2, 1.0 / 15};
  spec.initial_breaks = {0.9};
  spec.initial_values = {0.4, 0.35};
  for (const double t : {10.0, 1e3, 1e4, 3e4, 1e5}) expect_accurate(spec, {t}, 2e-15);
}

TEST(ExactHardCases, ContrastOf1e12) {
  const auto falling = layered({0.5}, {1, 1e-12}, {0.7}, {0, 1});
  expect_accurate(falling, {0.1, 1.0, 1e10, 3e11, 1e12, 5e12});
  expect_accurate(layered({0.5}, {1e-12, 1}, {0.7}, {0, 1}), {0.1, 1.0, 1e10, 3e11, 1e12, 5e12});
  for (const auto& spec : {falling, layered({0.3, 0.6}, {1e-6, 1e6, 1}, {0.45}, {0, 1})}) {
    const Scene<double> scene(spec);
    const auto one = exact_timeline(scene);
    const auto two = exact_timeline(scene_cast<Real110>(scene));
    EXPECT_LT(relative_error(*one.t_star, to_double(*two.t_star)), 2e-14);
    EXPECT_LT(relative_error(*one.t0, to_double(*two.t0)), 1e-15);
    EXPECT_LT(relative_error(*one.interfaces[0].last, to_double(*two.interfaces[0].last)), 2e-14);
  }
}

TEST(ExactHardCases, EqualNeighboursAreOneLayer) {
  SceneMaker make(support::seed_of(5));
  for (int n = 0; n < 20; ++n) {
    auto spec = make.data(1, SceneMaker::Order::random, 4);
    const double a = std::get<Piecewise<double>>(spec.shear_rate).values[0];
    const ExactSolution<double> one{Scene<double>(spec)};
    spec.shear_rate = Piecewise<double>{{0.2, 0.5, 0.7}, {a, a, a, a}};
    const ExactSolution<double> four{Scene<double>(spec)};
    for (int k = 0; k < 40; ++k) {
      const double z = k % 4 == 0 ? 0.5 : make.uniform(0, 1), t = make.uniform(0.01, 2);
      EXPECT_NEAR(one.M(z, t), four.M(z, t), 2e-15);
    }
  }
}

TEST(ExactHardCases, JumpOnAnInterface) {
  const auto spec = layered({0.3, 0.6}, {2, 0.5, 1}, {0.3}, {0, 1});
  expect_accurate(spec, {0.05, 0.3, 1.0, 3.0});
  // The limit of jumps that approach the interface from both sides.
  const ExactSolution<double> on{Scene<double>(spec)};
  for (const double d : {-1e-9, 1e-9}) {
    const ExactSolution<double> near{Scene<double>(layered({0.3, 0.6}, {2, 0.5, 1}, {0.3 + d}, {0, 1}))};
    for (int i = 0; i <= 20; ++i) EXPECT_NEAR(on.M(i / 20.0, 0.4), near.M(i / 20.0, 0.4), 2e-9);
  }
}

TEST(ExactHardCases, TinyAndHugeTimes) {
  SceneMaker make(support::seed_of(12));
  for (int n = 0; n < 30; ++n) {
    auto spec = make.data(make.integer(1, 5), make.order(), 4);
    if (n % 3 == 0) spec.shear_rate = Exponential<double>{2, 0.4};
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    for (int k = 0; k < 20; ++k) {
      const double z = make.uniform(0, 1);
      EXPECT_NEAR(solution.M(z, 1e-300), solution.M(z, 0.0), 1e-15);
      EXPECT_EQ(solution.phi(z, 1e-300), scene.initial_phi(z));
      EXPECT_EQ(solution.M(z, 1e300), solution.M(z, infinity<double>()));
      EXPECT_EQ(solution.phi(z, 1e300), solution.phi(z, infinity<double>()));
      const auto all = entries(scene.spec());
      const auto derivatives = Derivatives<double>(solution).at(z, 1e300);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].field == "shear_rate.values") {
          EXPECT_EQ(derivatives.M[i], 0.0);
        }
    }
    EXPECT_EQ(solution.M(1.0, 1e-300), solution.mass());
  }
}

TEST(ExactHardCases, TinyAndHugeScales) {
  SceneMaker make(support::seed_of(14));
  for (int n = 0; n < 20; ++n) {
    auto spec = make.data(make.integer(1, 5), make.order(), 4);
    if (n % 4 == 0) spec.shear_rate = Exponential<double>{2, 0.4};
    const ExactSolution<double> one{Scene<double>(spec)};
    const auto events = exact_timeline(one.scene());
    for (const double power : {std::ldexp(1.0, 990), std::ldexp(1.0, -990)}) {
      spec.scale = power;
      const ExactSolution<double> other{Scene<double>(spec)};
      const auto scaled_events = exact_timeline(other.scene());
      EXPECT_NEAR(*scaled_events.t_star * power, *events.t_star, 1e-14 * *events.t_star);
      for (int k = 0; k < 20; ++k) {
        const double z = make.uniform(0, 1), t = make.uniform(0.01, 2);
        EXPECT_EQ(other.M(z, t / power), one.M(z, t));
        EXPECT_EQ(other.phi(z, t / power), one.phi(z, t));
        const auto a = Derivatives<double>(one).at(z, t), b = Derivatives<double>(other).at(z, t / power);
        const auto all = entries(one.scene().spec());
        for (std::size_t i = 0; i < all.size(); ++i) {
          if (all[i].field != "shear_rate.values") continue;
          EXPECT_NEAR(a.M[i], b.M[i], 1e-13);
          EXPECT_NEAR(a.phi[i], b.phi[i], 1e-12 * (1 + std::abs(a.phi[i])));
        }
      }
    }
  }
}

// s a(z) is an ordinary number in the bed, but s amplitude, the rate far below it, is none. The same scene in
// another unit of time, a power of two, is the same to the bit.
TEST(ExactHardCases, ExponentialRatesWhoseAmplitudeOverflows) {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{0x1p200, 0x1p-7};
  spec.scale = 0x1p900;
  spec.bottom = 1.25;
  spec.top = 1.3125;
  spec.initial_breaks = {1.28};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  spec.scale = 1;
  const Scene<double> slow(spec);
  ASSERT_TRUE(std::isinf(scene.scale() * 0x1p200));
  const ExactSolution<double> fast_solution(scene), slow_solution(slow);
  const double t = (spec.top - spec.bottom) / slow.shear_rate_at(1.28);
  for (const double z : {1.25, 1.26, 1.27, 1.28, 1.29, 1.3, 1.3125}) {
    EXPECT_EQ(fast_solution.M(z, std::ldexp(t, -900)), slow_solution.M(z, t)) << z;
    EXPECT_EQ(fast_solution.phi(z, std::ldexp(t, -900)), slow_solution.phi(z, t)) << z;
  }
}

TEST(ExactHardCases, ConstantStates) {
  for (const double a_above : {0.5, 2.0, 8.0}) {
    const ExactSolution<double> zero{Scene<double>(layered({0.4}, {2, a_above}, {}, {0}))};
    const ExactSolution<double> one{Scene<double>(layered({0.4}, {2, a_above}, {}, {1}))};
    for (const double t : {0.0, 1e-300, 0.1, 10.0, 1e300, infinity<double>()})
      for (const double z : {0.0, 0.2, 0.4, 0.7, 1.0}) {
        EXPECT_EQ(zero.M(z, t), 0.0);
        EXPECT_EQ(zero.phi(z, t), 0.0) << "z " << z << " t " << t;
        EXPECT_EQ(one.M(z, t), z);
        EXPECT_EQ(one.phi(z, t), 1.0) << "z " << z << " t " << t;
      }
    expect_accurate(layered({0.4}, {2, a_above}, {}, {0.5}), {0.01, 0.1, 0.3, 1.0});
  }
  // phi = 1/2, one layer: still between the walls' waves, M = z / 2 + a t / 4.
  const ExactSolution<double> half{Scene<double>(layered({}, {2}, {}, {0.5}))};
  EXPECT_DOUBLE_EQ(half.M(0.5, 0.125), 0.25 + 0.0625);
  EXPECT_EQ(half.phi(0.5, 0.125), 0.5);
}

TEST(ExactHardCases, StatesAtTheWallsAndAtJumps) {
  const ExactSolution<double> solution{Scene<double>(layered({0.29}, {2.4, 0.31}, {0.5}, {0, 1}))};
  EXPECT_EQ(solution.phi(0.5, 0.0), 1.0);  // the value above
  EXPECT_EQ(solution.phi(1.0, 0.0), 1.0);  // the value below the top
  EXPECT_EQ(solution.phi(1.0, 1.6), 1.0);  // first wave there at 1.6129
  EXPECT_EQ(solution.phi(1.0, 1.62), 0.0);
  EXPECT_EQ(solution.phi(0.0, 0.79), 0.0);  // first wave there at 0.798
  EXPECT_EQ(solution.phi(0.0, 0.80), 1.0);
  EXPECT_EQ(solution.phi(0.5, infinity<double>()), 0.0);
  EXPECT_EQ(solution.phi(0.4999, infinity<double>()), 1.0);
}

TEST(ExactHardCases, AnyDomain) {
  SceneMaker make(support::seed_of(13));
  for (int n = 0; n < 20; ++n) {
    const auto spec = make.data(3, make.order(), 4);
    SceneSpec<double> moved = spec;  // z -> 8 z - 2, a -> 8 a: the same times, M eight times as large
    auto& a = std::get<Piecewise<double>>(moved.shear_rate);
    for (double& x : a.breaks) x = 8 * x - 2;
    for (double& x : a.values) x *= 8;
    for (double& x : moved.initial_breaks) x = 8 * x - 2;
    moved.bottom = -2;
    moved.top = 6;
    const ExactSolution<double> one{Scene<double>(spec)}, two{Scene<double>(moved)};
    for (int k = 0; k < 20; ++k) {
      const double z = make.uniform(0, 1), t = make.uniform(0.01, 2);
      EXPECT_NEAR(8 * one.M(z, t), two.M(8 * z - 2, t), 4e-14);
    }
  }
}

}  // namespace
}  // namespace shearfront
