// SPDX-License-Identifier: BSD-3-Clause
// Envelopes of the polygons of every flux, between all pairs of states: a chain of vertices that bends one
// way and lies on one side of the polygon is the envelope.
#include "shearfront/riemann/envelope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/track/unimodal_grid.hpp"
#include "support/any_flux.hpp"

namespace shearfront {
namespace {

using Fronts = std::vector<std::pair<State, State>>;

/// Flux in the orientation of the indices, in which phi rises.
void check(const UnimodalGrid<double>& grid, State l, State r, const Fronts& fronts) {
  ASSERT_FALSE(fronts.empty());
  EXPECT_EQ(fronts.front().first, l);
  EXPECT_EQ(fronts.back().second, r);
  const double steepest = grid.fastest();
  double last = -2 * steepest;
  for (std::size_t i = 0; i < fronts.size(); ++i) {
    const auto [a, b] = fronts[i];
    if (i > 0) {
      EXPECT_EQ(a, fronts[i - 1].second);
    }
    ASSERT_EQ(a < b, l < r);
    const double speed = grid.speed(0, a, b);
    EXPECT_GE(speed, last - 1e-14 * steepest);
    last = speed;
    // Below the polygon where states rise, above it where they fall, told in phi and its flux.
    const bool phi_rises = grid.phi(0, a) < grid.phi(0, b);
    for (State k = std::min(a, b); k <= std::max(a, b); ++k) {
      const double above_chord =
          grid.flux(0, k) - grid.flux(0, a) - speed * (grid.phi(0, k) - grid.phi(0, a));
      EXPECT_GE(phi_rises ? above_chord : -above_chord, -1e-14 * steepest) << a << " " << b << " " << k;
    }
  }
}

TEST(Envelope, IsOneSidedAndBendsOneWay) {
  for (const Flux<double>& flux : support::unimodal_fluxes()) {
    SCOPED_TRACE(support::name_of(flux));
    const LayerStack<double> stack({0, 1}, {1.7}, 1, {}, {{flux}, {}, {}});
    const auto built = UnimodalGrid<double>::exact_levels(stack, 0.04, {{0, 0.03125}});
    const UnimodalGrid<double>& grid = built.grid;
    for (State l = 0; l < grid.n_states(0); ++l)
      for (State r = 0; r < grid.n_states(0); ++r) {
        if (l == r) continue;
        SCOPED_TRACE(std::to_string(l) + " | " + std::to_string(r));
        Fronts fronts;
        Envelope<UnimodalGrid<double>>(grid, 0, l, r).for_each([&](State a, State b) {
          fronts.emplace_back(a, b);
        });
        check(grid, l, r, fronts);
        if (testing::Test::HasFailure()) return;
      }
  }
}

/// What no check of a scene lets through must not run for ever.
TEST(Envelope, OfStatesThatNoLayerHasIsAnError) {
  for (const Flux<double>& flux : support::unimodal_fluxes()) {
    SCOPED_TRACE(support::name_of(flux));
    const LayerStack<double> stack({0, 1}, {1.7}, 1, {}, {{flux}, {}, {}});
    const auto built = UnimodalGrid<double>::exact_levels(stack, 0.04, {{0, 0.03125}});
    const State n = built.grid.n_states(0);
    for (const auto& [l, r] : Fronts{{0, n}, {n, 0}, {0, n + 3}, {n + 3, 1}, {n, n + 1}, {-1, 1}, {1, -2}})
      EXPECT_THROW(Envelope<UnimodalGrid<double>>(built.grid, 0, l, r), ContractViolation) << l << " " << r;
  }
}

}  // namespace
}  // namespace shearfront
