// SPDX-License-Identifier: BSD-3-Clause
// Random tables of 2 to 20 points, with humps, throats, flats and jumps, against a naive conservative scheme that knows nothing
// of paths, refined: a path forgotten by the formula would show as an error that does not fall with the cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/solver/method.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/options.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

SceneSpec<double> random_bed(support::SceneMaker& make) {
  SceneSpec<double> spec;
  const int n_inner = make.integer(0, 18);
  std::vector<double> z;
  for (int i = 1; i <= n_inner; ++i) z.push_back((i + make.uniform(-0.25, 0.25)) / (n_inner + 1));
  z.push_back(1);
  Table<double> table{{0}, {std::exp(make.uniform(-1.5, 1.5))}};
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double last = table.values.back();
    table.z.push_back(z[k]);
    table.values.push_back(make.integer(0, 4) == 0 ? last : std::exp(make.uniform(-1.5, 1.5)));
    if (k + 1 < z.size() && make.integer(0, 3) == 0) {
      table.z.push_back(z[k]);
      table.values.push_back(std::exp(make.uniform(-1.5, 1.5)));
    }
  }
  spec.shear_rate = table;
  const int jumps = make.integer(0, 4);
  spec.initial_breaks = make.heights(jumps, 0, 1);
  for (int i = 0; i <= jumps; ++i)
    spec.initial_values.push_back(make.integer(0, 2) == 0 ? double(make.integer(0, 1)) : make.uniform(0, 1));
  return spec;
}

/// Godunov's scheme with a(z) on both sides of every face, so that a throat lets through what it can on any cells: largest
/// |M difference| at the edges of about n cells of height 1.
double M_error(const ExactSolution<double>& exact, double t, std::size_t n) {
  const Scene<double>& scene = exact.scene();
  std::vector<double> cuts = scene.knots();
  cuts.insert(cuts.end(), scene.initial_breaks().begin(), scene.initial_breaks().end());
  cuts.push_back(scene.top());
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> edge{scene.bottom()}, low, high, u;  // a at the lower and upper end of each cell
  double dt = t;
  for (const double cut : cuts) {
    const double from = edge.back(), piece = cut - from;
    if (!(piece > 0)) continue;
    const int parts = std::max(1, static_cast<int>(std::lround(piece * static_cast<double>(n))));
    for (int j = 1; j <= parts; ++j) {
      const double lo = edge.back(), hi = j == parts ? cut : from + piece * j / parts, width = hi - lo;
      const double first = scene.shear_rate_at(lo + width / 4), last = scene.shear_rate_at(hi - width / 4);
      edge.push_back(hi);
      low.push_back(first - (last - first) / 2);
      high.push_back(last + (last - first) / 2);
      u.push_back(scene.initial_phi(lo + width / 2));
      dt = std::min(dt, 0.9 * width / std::max(low.back(), high.back()));
    }
  }
  const auto n_steps = static_cast<std::size_t>(std::ceil(t / dt));
  dt = t / static_cast<double>(n_steps);
  std::vector<double> flux(u.size() + 1, 0.0);
  const auto f = [](double p) { return p * (p - 1); };
  for (std::size_t step = 0; step < n_steps; ++step) {
    for (std::size_t j = 1; j < u.size(); ++j)
      flux[j] = std::max(high[j - 1] * f(std::max(u[j - 1], 0.5)), low[j] * f(std::min(u[j], 0.5)));
    for (std::size_t j = 0; j < u.size(); ++j) u[j] -= dt / (edge[j + 1] - edge[j]) * (flux[j + 1] - flux[j]);
  }
  double M = 0, worst = 0;
  for (std::size_t j = 0; j < u.size(); ++j) {
    M += u[j] * (edge[j + 1] - edge[j]);
    worst = std::max(worst, std::abs(M - exact.M(edge[j + 1], t)));
  }
  return worst;
}

/// The error falls with the cells: with eight times as many to a third at least, or else, where those are still too few for a
/// thin piece, with four times as many again to a half.
void expect_convergence(int first, int count, std::size_t n_cells) {
  int n_falling = 0;
  for (int n = first; n < first + count; ++n) {
    const std::uint64_t seed = support::seed_of(88000 + static_cast<std::uint64_t>(n));
    support::SceneMaker make(seed);
    const ExactSolution<double> exact{Scene<double>(random_bed(make))};
    const double t = std::exp(make.uniform(-2.5, 1));
    const double coarse = M_error(exact, t, n_cells), fine = M_error(exact, t, 8 * n_cells);
    const double small = 0.06 / static_cast<double>(n_cells);
    if (coarse > small) ++n_falling;
    if ((coarse > small && fine > coarse / 3) || fine > small) {
      EXPECT_LT(M_error(exact, t, 32 * n_cells), fine / 2) << "seed " << seed << " t " << t;
    }
  }
  EXPECT_GT(n_falling, count / 2);
}

TEST(ExactTables, AreTheLimitOfAScheme) { expect_convergence(0, 40, 60); }

class ExactTableBlocks : public testing::TestWithParam<int> {};
TEST_P(ExactTableBlocks, AreTheLimitOfAScheme) { expect_convergence(GetParam(), 25, 100); }
INSTANTIATE_TEST_SUITE_P(Slow, ExactTableBlocks, testing::Range(0, 500, 25));

/// An exponential as a table of 200 points: what a scheme is off by is the scheme's, whichever guise the bed has. An exact solution by
/// steps had an error of its own that was larger.
TEST(ExactTables, AnExponentialAsATableGivesASchemeTheSameError) {
  SceneSpec<double> formula;
  formula.shear_rate = Exponential<double>{0.31, 13};
  formula.initial_breaks = {12, 30};
  formula.initial_values = {0, 1, 0.35};
  formula.top = 42;
  SceneSpec<double> table = formula;
  Table<double> points;
  constexpr int kPoints = 200;
  for (int i = 0; i < kPoints; ++i) {
    points.z.push_back(i + 1 == kPoints ? 42 : 42.0 * i / (kPoints - 1));
    points.values.push_back(0.31 * std::exp(-points.z.back() / 13));
  }
  table.shear_rate = points;
  SolverRequest request;
  request.times = {40, 150, 500};
  request.profiles = true;
  const auto errors = [&](const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    EXPECT_TRUE(exact.is_exact());
    const auto result = solve(scene, support::method_of("muscl", {{"cells", 1600}}), request);
    std::vector<double> all;
    for (std::size_t i = 0; i < request.times.size(); ++i)
      all.push_back(errors_against(exact, result.profiles.at(i), request.times[i]).l1);
    return all;
  };
  const auto of_formula = errors(formula), of_table = errors(table);
  for (std::size_t i = 0; i < request.times.size(); ++i) {
    EXPECT_GT(of_formula[i], 1e-5) << "t " << request.times[i];
    EXPECT_LT(of_formula[i], 5e-2) << "t " << request.times[i];
    EXPECT_NEAR(of_table[i], of_formula[i], 0.05 * of_formula[i]) << "t " << request.times[i];
  }
}

}  // namespace
}  // namespace shearfront
