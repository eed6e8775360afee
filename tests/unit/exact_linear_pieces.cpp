// SPDX-License-Identifier: BSD-3-Clause
// Tables: a(z) linear in pieces. PieceReference values are those of another program in 64-bit significands, closed forms are worked
// out beside the tests.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "support/many_digits.hpp"
#include "support/random_scene.hpp"
#include "support/table_scenes.hpp"

namespace shearfront {
namespace {

using support::four_pieces;
using support::one_piece;
using support::table_scene;

struct PieceReference {
  char scene;
  double t, z, phi, M;
};
const std::vector<PieceReference> kReferences{
    {'B', 0.2, 0.1, 0.0000000000000000, 0.0000000000000000},
    {'B', 0.2, 0.3, 0.1915831519774210, 0.0180907244800961},
    {'B', 0.2, 0.45, 0.3782424404898054, 0.0602789981097019},
    {'B', 0.2, 0.6, 0.6195760256229160, 0.1342738764696734},
    {'B', 0.2, 0.8, 1.0000000000000000, 0.3000000000000000},
    {'B', 0.2, 0.95, 1.0000000000000000, 0.4500000000000000},
    {'B', 0.5, 0.1, 0.2049492417778422, 0.0855389976834220},
    {'B', 0.5, 0.3, 0.2799251064814566, 0.1336950103060395},
    {'B', 0.5, 0.45, 0.3521672424782740, 0.1808895958803117},
    {'B', 0.5, 0.6, 0.4455697932794304, 0.2403941880063105},
    {'B', 0.5, 0.8, 0.6270113958148319, 0.3462108322459379},
    {'B', 0.5, 0.95, 0.8483148607476097, 0.4554930884328039},
    {'B', 1, 0.1, 1.0000000000000000, 0.1000000000000000},
    {'B', 1, 0.3, 1.0000000000000000, 0.3000000000000000},
    {'B', 1, 0.45, 0.2612577297658849, 0.3634843316780484},
    {'B', 1, 0.6, 0.3029106614646441, 0.4056517213229652},
    {'B', 1, 0.8, 0.3838246687684674, 0.4736824277269644},
    {'B', 1, 0.95, 0.0000000000000000, 0.5000000000000000},
    {'A', 0.3, 0.05, 1.0000000000000000, 0.0500000000000000},
    {'A', 0.3, 0.2, 0.6179747260316607, 0.1601369533015586},
    {'A', 0.3, 0.35, 0.4788454264804978, 0.2538414555798329},
    {'A', 0.3, 0.5, 0.6807508564284175, 0.3417332191428777},
    {'A', 0.3, 0.55, 0.6807508564284175, 0.3757707619642985},
    {'A', 0.3, 0.62, 0.8935663587922633, 0.4332914751127766},
    {'A', 0.3, 0.8, 0.1374901416791675, 0.4800059149924995},
    {'A', 0.3, 0.9, 0.0000000000000000, 0.4825000000000000},
    {'A', 1, 0.05, 1.0000000000000000, 0.0500000000000000},
    {'A', 1, 0.2, 1.0000000000000000, 0.2000000000000000},
    {'A', 1, 0.35, 1.0000000000000000, 0.3500000000000000},
    {'A', 1, 0.5, 0.1938137821521027, 0.4311864640379106},
    {'A', 1, 0.55, 0.5000000000000000, 0.4450578213054954},
    {'A', 1, 0.62, 0.0000000000000000, 0.4825000000000000},
    {'A', 1, 0.8, 0.0000000000000000, 0.4825000000000000},
    {'A', 1, 0.9, 0.0000000000000000, 0.4825000000000000},
    {'A', 1.8, 0.05, 1.0000000000000000, 0.0500000000000000},
    {'A', 1.8, 0.2, 1.0000000000000000, 0.2000000000000000},
    {'A', 1.8, 0.35, 1.0000000000000000, 0.3500000000000000},
    {'A', 1.8, 0.5, 0.0000000000000000, 0.4825000000000000},
    {'A', 1.8, 0.55, 0.0000000000000000, 0.4825000000000000},
    {'A', 1.8, 0.62, 0.0000000000000000, 0.4825000000000000},
    {'A', 1.8, 0.8, 0.0000000000000000, 0.4825000000000000},
    {'A', 1.8, 0.9, 0.0000000000000000, 0.4825000000000000},
};

TEST(LinearPieces, AreTheReferenceValues) {
  const ExactSolution<double> one{Scene<double>(one_piece())}, four{Scene<double>(four_pieces())};
  EXPECT_TRUE(one.is_exact());
  EXPECT_EQ(four.n_layers(), 4u);
  for (const PieceReference& r : kReferences) {
    const auto value = (r.scene == 'B' ? one : four).at(r.z, r.t);
    EXPECT_NEAR(value.M, r.M, 1e-14) << r.scene << " z " << r.z << " t " << r.t;
    EXPECT_NEAR(value.phi, r.phi, 1e-13) << r.scene << " z " << r.z << " t " << r.t;
    EXPECT_EQ(value.M_error, 0);
  }
}

TEST(LinearPieces, HaveTheReferenceEvents) {
  const auto one = exact_timeline(Scene<double>(one_piece())),
             four = exact_timeline(Scene<double>(four_pieces()));
  EXPECT_NEAR(*one.t0, std::log(2 / 1.25) / (1.5 * 1.3), 1e-15);
  EXPECT_NEAR(*one.t1, std::log(1.25 / 0.5) / (1.5 * 1.3), 1e-15);
  EXPECT_NEAR(*one.t_star, 1.42184037037937499, 4e-15);
  EXPECT_NEAR(*four.t_star, 1.54443877503510759, 4e-15);
}

/// One piece with 1 above 0: the last grain turns at the top of the bed it rises through, t* = 4 artanh(|b| m / a(m)) / (s |b|).
TEST(LinearPieces, MixedBedsOfOnePieceComeToRestAtTheClosedForm) {
  const auto events = exact_timeline(Scene<double>(one_piece()));
  const double b = 1.5, m = 0.5, a = 2 - b * m;
  EXPECT_NEAR(*events.t_star, 4 / (1.3 * b) * std::atanh(b * m / a), 4e-15);
}

/// A throat in the middle of a vee: its capacity a / 4 delays the last grains far longer than a staircase says.
TEST(LinearPieces, AThroatLetsThroughWhatItCan) {
  // The flux at rest is s a / 4 = 0.05: M(1/2) grows as 0.05 t from the time the first path rests there.
  const Scene<double> vee(table_scene({{0, 0.5, 1}, {2, 0.2, 2}}, {0.7}, {0, 1}));
  const ExactSolution<double> exact(vee);
  EXPECT_NEAR(exact.M(0.5, 4) - exact.M(0.5, 3), 0.05, 1e-15);
  EXPECT_NEAR(exact.phi(0.5, 3), 0.5, 1e-15);
  // Two throats: four digits of a Godunov scheme, extrapolated.
  const auto events = exact_timeline(Scene<double>(
      table_scene({{0, 0.2, 0.35, 0.5, 0.8, 1}, {0.5, 3, 0.2, 1.5, 0.1, 2}}, {0.5}, {0.2, 0.9})));
  EXPECT_GT(*events.t_star, 7.950);
  EXPECT_LT(*events.t_star, 7.951);
}

/// Random tables with jumps, flats and slopes of 1e-15.
Table<double> random_table(support::SceneMaker& make, int n_pieces) {
  Table<double> table{{0}, {std::exp(make.uniform(-1, 1))}};
  for (int k = 1; k <= n_pieces; ++k) {
    const double z = double(k) / n_pieces, last = table.values.back();
    const int kind = make.integer(0, 5);
    table.z.push_back(z);
    table.values.push_back(kind == 0 ? last : kind == 1 ? last * (1 - 2e-15) : std::exp(make.uniform(-1, 1)));
    if (k < n_pieces && make.integer(0, 3) == 0) {
      table.z.push_back(z);
      table.values.push_back(std::exp(make.uniform(-1, 1)));
    }
  }
  return table;
}

std::vector<double> random_states(support::SceneMaker& make, std::size_t n) {
  std::vector<double> states;
  for (std::size_t i = 0; i < n; ++i) {
    const int kind = make.integer(0, 5);
    states.push_back(kind == 0 ? 0.0 : kind == 1 ? 1.0 : kind == 2 ? 0.5 : make.uniform(0, 1));
  }
  return states;
}

/// The engine of constant layers, another search with other candidates: its layers are as many steps, and a path that rests is
/// let through at the mean of the step at the throat. So the change from four times as many steps bounds what is left.
TEST(LinearPieces, AreTheLimitOfManyLayers) {
  const std::uint64_t seed = support::seed_of(71);
  support::SceneMaker make(seed);
  for (int n = 0; n < 12; ++n) {
    const Table<double> table = random_table(make, make.integer(1, 7));
    const auto spec = table_scene(table, {0.3125, 0.59375}, random_states(make, 3));
    const auto in_layers = [&](std::size_t n_layers) {
      const auto stack = staircase(Scene<double>(spec), n_layers);
      SceneSpec<double> steps = spec;
      Piecewise<double> a;
      for (std::size_t k = 0; k < stack.n_layers(); ++k) {
        if (k > 0) a.breaks.push_back(stack.boundary(k));
        a.values.push_back(stack.shear_rate(k));
      }
      steps.shear_rate = a;
      return ExactSolution<double>{Scene<double>(steps)};
    };
    const ExactSolution<double> exact{Scene<double>(spec)}, coarse = in_layers(256), fine = in_layers(1024);
    for (int i = 0; i < 40; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 1));
      const double M = exact.M(z, t), change = std::abs(coarse.M(z, t) - fine.M(z, t));
      EXPECT_NEAR(M, fine.M(z, t), change + 1e-4)
          << "seed " << seed << " scene " << n << " z " << z << " t " << t;
    }
  }
}

/// The same tables with 60 more points on their lines: enough for the bounds by which turns and starts are left out unseen. One that is
/// too tight would lose the best path. (Tables of few points are searched without them.)
TEST(LinearPieces, MorePointsOnTheLinesChangeNothing) {
  const std::uint64_t seed = support::seed_of(74);
  support::SceneMaker make(seed);
  int n_turned = 0;
  for (int n = 0; n < 40; ++n) {
    const Table<double> table = random_table(make, make.integer(1, 7));
    const std::vector<double> breaks{0.3125, 0.59375};
    const auto states = random_states(make, 3);
    Table<double> fine;
    for (std::size_t i = 0; i < table.z.size(); ++i) {
      fine.z.push_back(table.z[i]);
      fine.values.push_back(table.values[i]);
      if (i + 1 == table.z.size() || table.z[i] == table.z[i + 1]) continue;
      for (int k = 1; k <= 60; ++k) {
        fine.z.push_back(table.z[i] + (table.z[i + 1] - table.z[i]) * k / 61);
        fine.values.push_back(table.values[i] + (table.values[i + 1] - table.values[i]) * k / 61);
      }
    }
    const ExactSolution<double> few{Scene<double>(table_scene(table, breaks, states))},
        many{Scene<double>(table_scene(fine, breaks, states))};
    for (int i = 0; i < 40; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 2));
      n_turned += few.path(z, t).turned ? 1 : 0;
      EXPECT_NEAR(many.M(z, t), few.M(z, t), 1e-13)
          << "seed " << seed << " scene " << n << " z " << z << " t " << t;
    }
  }
  EXPECT_GT(n_turned, 20);
}

/// What rounding does: the same in 110 digits.
TEST(LinearPieces, AreTheSameInManyDigits) {
  const std::uint64_t seed = support::seed_of(72);
  support::SceneMaker make(seed);
  for (int n = 0; n < 12; ++n) {
    const Scene<double> scene(
        table_scene(random_table(make, make.integer(1, 8)), {0.3125, 0.59375}, random_states(make, 3)));
    support::expect_same_in_many_digits(scene, make, 6, 4e-15, 1e-11,
                                        "seed " + std::to_string(seed) + " scene " + std::to_string(n));
  }
}

/// M is the integral of phi.
TEST(LinearPieces, MRisesAsPhiSays) {
  const std::uint64_t seed = support::seed_of(73);
  support::SceneMaker make(seed);
  for (int n = 0; n < 20; ++n) {
    const ExactSolution<double> exact{Scene<double>(
        table_scene(random_table(make, make.integer(1, 6)), {0.3125, 0.59375}, random_states(make, 3)))};
    const double t = std::exp(make.uniform(-2, 1)), h = 1e-5;
    int n_smooth = 0;
    for (int i = 0; i < 60; ++i) {
      const double z = make.uniform(0.01, 0.99);
      const auto low = exact.at(z - h, t), high = exact.at(z + h, t);
      EXPECT_GE(high.M, low.M - 1e-15);
      if (std::abs(high.phi - low.phi) > 1e-3) continue;
      ++n_smooth;
      EXPECT_NEAR((high.M - low.M) / (2 * h), exact.phi(z, t), 1e-3) << "seed " << seed << " scene " << n;
    }
    EXPECT_GT(n_smooth, 30);
  }
}

/// A table through an exponential: second order in its steps.
TEST(LinearPieces, TendToAnExponentialWithTheSecondOrder) {
  const SceneSpec<double> spec = table_scene({}, {0.3, 0.6}, {0, 1, 0.35});
  SceneSpec<double> smooth = spec;
  smooth.shear_rate = Exponential<double>{2, 0.3};
  const ExactSolution<double> exact{Scene<double>(smooth)};
  std::vector<double> errors;
  for (const int n : {32, 64, 128}) {
    SceneSpec<double> pieces = spec;
    Table<double> table;
    for (int i = 0; i <= n; ++i) {
      table.z.push_back(double(i) / n);
      table.values.push_back(2 * std::exp(-table.z.back() / 0.3));
    }
    pieces.shear_rate = table;
    const ExactSolution<double> linear{Scene<double>(pieces)};
    double worst = 0;
    for (const double t : {0.1, 0.4, 1.6})
      for (int i = 1; i < 40; ++i)
        worst = std::max(worst, std::abs(linear.M(i / 40.0, t) - exact.M(i / 40.0, t)));
    errors.push_back(worst);
  }
  EXPECT_GT(errors[0] / errors[1], 3.5);
  EXPECT_GT(errors[1] / errors[2], 3.5);
  EXPECT_LT(errors[2], 1e-4);
}

/// Against a profile of constant cells made of the exact M itself, the error is what a fine quadrature says.
TEST(LinearPieces, L1ErrorsAreThoseOfAQuadrature) {
  const ExactSolution<double> exact{Scene<double>(four_pieces())};
  const double t = 0.3;
  constexpr std::size_t n = 40;
  std::vector<double> z{0}, phi;
  for (std::size_t i = 1; i <= n; ++i) {
    z.push_back(double(i) / n);
    phi.push_back((exact.M(z[i], t) - exact.M(z[i - 1], t)) * n);
  }
  const Profile<double> profile(z, phi, phi);
  const auto errors = errors_against(exact, profile, t);
  double sum = 0;
  constexpr int kFine = 4000;  // a shock costs the rule no more than half a step
  for (std::size_t i = 0; i < n; ++i)
    for (int j = 0; j < kFine; ++j)
      sum += std::abs(phi[i] - exact.phi((double(i) + (j + 0.5) / kFine) / n, t)) / (double(n) * kFine);
  EXPECT_NEAR(errors.l1, sum, 2e-5);
}

TEST(LinearPieces, ATableMayJumpInsideTheBed) {
  const auto complaints = [](Table<double> table) {
    return find_complaints(table_scene(std::move(table), {}, {0.5}));
  };
  EXPECT_TRUE(complaints({{0, 0.5, 0.5, 1}, {1, 2, 3, 4}}).empty());
  EXPECT_FALSE(complaints({{0, 0, 0.5, 1}, {1, 2, 3, 4}}).empty());
  EXPECT_FALSE(complaints({{0, 0.5, 1, 1}, {1, 2, 3, 4}}).empty());
  EXPECT_FALSE(complaints({{0, 0.5, 0.5, 0.5, 1}, {1, 2, 3, 4, 5}}).empty());
  EXPECT_FALSE(complaints({{0, 0.5, 0.4, 1}, {1, 2, 3, 4}}).empty());
}

/// Constant on both sides of its jumps, a table is a stack of layers: two engines, one solution.
TEST(LinearPieces, ATableOfStepsIsAStackOfLayers) {
  const ExactSolution<double> table{Scene<double>(
      table_scene({{0, 0.25, 0.25, 0.625, 0.625, 1}, {2, 2, 0.5, 0.5, 1, 1}}, {0.5}, {0.2, 0.9}))};
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.25, 0.625}, {2, 0.5, 1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0.2, 0.9};
  const ExactSolution<double> layers{Scene<double>(spec)};
  for (const double t : {0.05, 0.3, 1.0, 3.0, 8.0})
    for (int i = 0; i <= 64; ++i) {
      const auto a = table.at(i / 64.0, t), b = layers.at(i / 64.0, t);
      EXPECT_NEAR(a.M, b.M, 4e-15) << i << " " << t;
      EXPECT_NEAR(a.phi, b.phi, 1e-12) << i << " " << t;
    }
}

}  // namespace
}  // namespace shearfront
