// SPDX-License-Identifier: BSD-3-Clause
// The exact solution against a naive conservative scheme that knows nothing of paths: a candidate forgotten
// by the formula would show as an error that does not fall with the cells.
#include <gtest/gtest.h>

#include "shearfront/exact/exact_solution.hpp"
#include "support/checked.hpp"
#include "support/conservative_scheme.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

struct Errors {
  double M, phi;  ///< largest |M difference| at cell edges, L1 of the cell averages
};

Errors errors(const SceneSpec<double>& spec, double t, std::size_t n_cells) {
  const Scene<double> scene(spec);
  const ExactSolution<double> exact(scene);
  std::vector<double> cuts{scene.bottom(), scene.top()};
  cuts.insert(cuts.end(), scene.initial_breaks().begin(), scene.initial_breaks().end());
  const auto knots = scene.knots();
  cuts.insert(cuts.end(), knots.begin(), knots.end());
  support::ConservativeScheme scheme(
      cuts, [&](double z) { return scene.scale() * scene.shear_rate_at(z); },
      [&](double z) { return scene.initial_phi(z); }, n_cells);
  scheme.advance(t);
  const auto M = scheme.cumulative();
  Errors worst{0, 0};
  for (std::size_t j = 0; j < M.size(); ++j)
    worst.M = std::max(worst.M, std::abs(M[j] - exact.M(scheme.edge[j], t)));
  for (std::size_t j = 0; j < scheme.u.size(); ++j) {
    const double exact_mass = exact.M(scheme.edge[j + 1], t) - exact.M(scheme.edge[j], t);
    worst.phi += std::abs(scheme.u[j] * (scheme.edge[j + 1] - scheme.edge[j]) - exact_mass);
  }
  return worst;
}

/// First order: M error about C / n, log n / n where waves keep meeting. Coarse to fine, eight times the
/// cells.
void expect_first_order(const SceneSpec<double>& spec, double t, const std::string& label,
                        support::Checked& falls) {
  const Errors coarse = errors(spec, t, 100), fine = errors(spec, t, 800);
  EXPECT_LT(fine.M, 1.5e-3) << label;
  EXPECT_LT(fine.phi, 1e-2) << label;
  if (coarse.M > 1e-3) {
    EXPECT_LT(fine.M, 0.5 * coarse.M) << label;
    falls.count();
  }
}

TEST(ExactAgainstScheme, Bottleneck) {
  support::Checked falls;
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_values = {0.65};
  for (const double t : {0.05, 0.3, 1.0, 2.0, 3.0})
    expect_first_order(spec, t, "t = " + std::to_string(t), falls);
}

TEST(ExactAgainstScheme, FiveLayers) {
  support::Checked falls;
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.2, 0.4, 0.6, 0.8}, {3.25, 2.32, 1.63, 1.05, 0.53}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  for (const double t : {0.1, 0.5, 1.0, 2.0}) expect_first_order(spec, t, "t = " + std::to_string(t), falls);
  auto& a = std::get<Piecewise<double>>(spec.shear_rate);
  std::reverse(a.values.begin(), a.values.end());
  for (const double t : {0.1, 0.5, 1.0, 2.0})
    expect_first_order(spec, t, "reversed, t = " + std::to_string(t), falls);
}

TEST(ExactAgainstScheme, ExponentialWithTurningCharacteristics) {
  support::Checked falls;
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{4, 0.25};
  spec.initial_breaks = {0.2, 0.5, 0.7};
  spec.initial_values = {0.3, 0.8, 0.1, 0.6};
  for (const double t : {0.1, 0.5, 1.0, 3.0}) expect_first_order(spec, t, "t = " + std::to_string(t), falls);
}

/// Exponential pieces with a throat between: passed at another capacity, or with a turn or a rest forgotten, M would be off by more
/// than cells explain.
TEST(ExactAgainstScheme, Chutes) {
  support::Checked falls;
  for (std::uint64_t n = 1; n <= 8; ++n) {
    SceneMaker make(support::seed_of(n));
    auto spec = n % 2 == 0 ? make.step(1, make.order()) : make.data(1, make.order(), 4);
    spec.shear_rate = Chute<double>{make.uniform(0.2, 0.6), make.uniform(0.25, 1), make.uniform(0.2, 0.8)};
    for (const double t : {0.4, 1.5, 3.0})
      expect_first_order(spec, t, "scene " + std::to_string(n) + ", t = " + std::to_string(t), falls);
  }
}

void scheme_of_random_scenes(std::uint64_t first, std::uint64_t count) {
  support::Checked falls;
  for (std::uint64_t n = first; n < first + count; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    const int layers = make.integer(1, 6);
    auto spec = n % 3 == 0 ? make.step(layers, make.order()) : make.data(layers, make.order(), 8);
    if (n % 7 == 0) spec.shear_rate = Exponential<double>{make.uniform(0.5, 3), make.uniform(0.1, 2)};
    const double t = std::exp(make.uniform(std::log(0.05), std::log(4.0)));
    expect_first_order(spec, t, "seed " + std::to_string(seed) + ", t = " + std::to_string(t), falls);
  }
}

TEST(ExactAgainstScheme, RandomScenes) { scheme_of_random_scenes(1, 12); }
TEST(SlowExactAgainstScheme, ManyRandomScenes) { scheme_of_random_scenes(100, 100); }

}  // namespace
}  // namespace shearfront
