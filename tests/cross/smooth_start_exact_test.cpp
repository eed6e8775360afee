// SPDX-License-Identifier: BSD-3-Clause
// Smooth and tabulated starts, solved exactly, against the same beds with the start as cells: M of the two cannot differ by
// more than M of the starts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

struct WorstGap {
  double over = 0;  ///< |M difference| less the bound
  double phi = 0;   ///< mean |phi difference| over all places
  int n_places = 0;
};

/// At random places and times; phi may differ much where shocks are a little elsewhere.
WorstGap compare_with_cells(const SceneSpec<double>& spec, int n_cells, support::SceneMaker& make) {
  const support::CellStart cells = support::as_cells(spec, n_cells);
  const ExactSolution<double> smooth{Scene<double>(spec)}, steps{Scene<double>(cells.spec)};
  WorstGap worst;
  worst.over = -1;
  const double crossing = smooth.medium().pure_travel_time(smooth.medium().bottom(), smooth.medium().top());
  for (int n = 0; n < 40; ++n) {
    const double t = crossing * std::exp(make.uniform(-6, 1)), z = make.uniform(spec.bottom, spec.top);
    const auto a = smooth.at(z, t), b = steps.at(z, t);
    worst.over = std::max(worst.over, std::abs(a.M - b.M) - cells.M_bound - a.M_error - b.M_error);
    worst.phi += std::abs(a.phi - b.phi);
    ++worst.n_places;
  }
  worst.phi /= worst.n_places;
  return worst;
}

constexpr double kRoundingOfM = 1e-13;

TEST(SmoothStartExact, InLayersOfParabolas) {
  int n = 0;
  double phi = 0;
  for (std::uint64_t number = 0; number < 60; ++number) {
    support::SceneMaker make(support::seed_of(71000 + number));
    SceneSpec<double> spec;
    spec.shear_rate = make.layers(make.integer(1, 5), make.order());
    spec.initial_state = support::random_start(make);
    const WorstGap worst = compare_with_cells(spec, 400, make);
    EXPECT_LE(worst.over, kRoundingOfM) << "seed " << 71000 + number;
    phi += worst.phi;
    n += worst.n_places;
  }
  EXPECT_EQ(n, 2400);
  EXPECT_LT(phi / 60, 3e-3);
}

TEST(SmoothStartExact, WithOtherFluxes) {
  int n = 0;
  double phi = 0;
  const std::vector<Flux<double>> fluxes{Cubic<double>{0.4}, Lwr<double>{}, Triangular<double>{}};
  for (std::uint64_t number = 0; number < 30; ++number) {
    support::SceneMaker make(support::seed_of(72000 + number));
    SceneSpec<double> spec;
    spec.fluxes = {fluxes[number % fluxes.size()]};
    if (number % 2 == 0) spec.solid_fraction = Piecewise<double>{{0.4}, {0.5, 0.7}};
    spec.shear_rate = make.layers(make.integer(1, 4), make.order());
    const auto range = spec.fluxes[0].range();
    spec.initial_state = support::random_start(make, range.lowest, range.highest);
    const Scene<double> scene(spec);
    if (!exact::refusal(scene).empty()) continue;
    const WorstGap worst = compare_with_cells(spec, 200, make);
    EXPECT_LE(worst.over, kRoundingOfM * (range.highest - range.lowest))
        << "seed " << 72000 + number << ' ' << spec.fluxes[0].name();
    phi += worst.phi / (range.highest - range.lowest);
    n += worst.n_places;
  }
  EXPECT_GT(n, 400);
  EXPECT_LT(phi / 30, 6e-3);
}

/// An exponential shear rate, or a table with kinks and flats.
DepthFunction<double> random_slopes(support::SceneMaker& make, bool is_exponential) {
  if (is_exponential) return Exponential<double>{1, make.uniform(0.2, 3)};
  Table<double> table{{0}, {std::exp(make.uniform(-1, 1))}};
  for (const double z : make.heights(make.integer(0, 3), 0, 1)) {
    table.z.push_back(z);
    table.values.push_back(make.integer(0, 4) == 0 ? table.values.back() : std::exp(make.uniform(-1, 1)));
  }
  table.z.push_back(1);
  table.values.push_back(std::exp(make.uniform(-1, 1)));
  return table;
}

TEST(SmoothStartExact, InSlopedPieces) {
  int n = 0;
  double phi = 0;
  for (std::uint64_t number = 0; number < 30; ++number) {
    support::SceneMaker make(support::seed_of(73000 + number));
    SceneSpec<double> spec;
    spec.shear_rate = random_slopes(make, number % 3 == 0);
    spec.initial_state = support::random_start(make);
    const WorstGap worst = compare_with_cells(spec, 100, make);
    EXPECT_LE(worst.over, kRoundingOfM) << "seed " << 73000 + number;
    phi += worst.phi;
    n += worst.n_places;
  }
  EXPECT_EQ(n, 1200);
  EXPECT_LT(phi / 30, 1e-2);
}

/// Every flux. Beds of half as many parts give the same: paths are found, not approximated.
TEST(SmoothStartExact, WithOtherFluxesInSlopedPieces) {
  int n = 0;
  std::vector<Flux<double>> fluxes;
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples()) fluxes.push_back(flux);
  });
  double phi = 0;
  for (std::uint64_t number = 0; number < 90; ++number) {
    support::SceneMaker make(support::seed_of(74500 + number));
    SceneSpec<double> spec;
    spec.fluxes = {fluxes[number % fluxes.size()]};
    spec.shear_rate = random_slopes(make, number % 3 == 0);
    const auto range = spec.fluxes[0].range();
    const double width = range.highest - range.lowest;
    spec.initial_state = support::random_start(make, range.lowest, range.highest);
    if (!find_complaints(spec).empty() || !exact::refusal(Scene<double>(spec)).empty()) continue;
    SCOPED_TRACE("seed " + std::to_string(74500 + number) + ' ' + std::string(spec.fluxes[0].name()));
    const ExactSolution<double> solution{Scene<double>(spec)};
    EXPECT_TRUE(solution.is_exact() || solution.meets_tolerance());
    EXPECT_LE(solution.probed_error(), kRoundingOfM * width);
    const WorstGap worst = compare_with_cells(spec, 60, make);
    EXPECT_LE(worst.over, kRoundingOfM * width);
    phi += worst.phi / width;
    n += worst.n_places;
  }
  EXPECT_GT(n, 1500);
  EXPECT_LT(phi / (n / 40), 2e-2);
}

/// A cubic flux that is a parabola but for 1e-9 has other code: integrals along its pieces, no closed forms.
TEST(SmoothStartExact, NearlyParabolasInSlopedPieces) {
  int n = 0, n_times = 0;
  for (std::uint64_t number = 0; number < 40; ++number) {
    support::SceneMaker make(support::seed_of(76000 + number));
    SceneSpec<double> spec;
    spec.shear_rate = random_slopes(make, number % 3 == 0);
    spec.initial_state = support::random_start(make);
    SceneSpec<double> nearly = spec;
    nearly.fluxes = {Cubic<double>{1e-9}};
    const ExactSolution<double> a{Scene<double>(spec)}, b{Scene<double>(nearly)};
    const double crossing = a.medium().pure_travel_time(0, 1);
    SCOPED_TRACE("seed " + std::to_string(76000 + number));
    for (int i = 0; i < 40; ++i, ++n) {
      const double t = crossing * std::exp(make.uniform(-6, 1)), z = make.uniform(0, 1);
      const auto of_a = a.at(z, t), of_b = b.at(z, t);
      EXPECT_NEAR(of_a.M, of_b.M, 2e-9) << z << ' ' << t;
      EXPECT_NEAR(of_a.phi, of_b.phi, 1e-6) << z << ' ' << t;
    }
    const auto times = exact_timeline(a), others = exact_timeline(b);
    const auto compare = [&](const std::optional<double>& x, const std::optional<double>& y) {
      ASSERT_EQ(x.has_value(), y.has_value());
      if (!x) return;
      EXPECT_NEAR(*x, *y, 1e-7 * *x);
      ++n_times;
    };
    compare(times.t0, others.t0);
    compare(times.t1, others.t1);
    compare(times.t_star, others.t_star);
    ASSERT_EQ(times.interfaces.size(), others.interfaces.size());
    for (std::size_t i = 0; i < times.interfaces.size(); ++i) {
      compare(times.interfaces[i].first, others.interfaces[i].first);
      compare(times.interfaces[i].last, others.interfaces[i].last);
    }
  }
  EXPECT_EQ(n, 1600);
  EXPECT_GT(n_times, 120);
}

}  // namespace
}  // namespace shearfront
