// SPDX-License-Identifier: BSD-3-Clause
// A flux of a user of the library, which is in no list: every solver takes it as it takes the same formula of the list.
// The kind of fault: a loop over a closed list in front of a type that is open.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "shearfront/model/flux/cubic.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"

namespace shearfront {
namespace {

struct OwnCubic : Cubic<double> {
  static constexpr std::string_view kName = "own";
};

SceneSpec<> two_layers_of(const Flux<double>& flux) {
  SceneSpec<> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0.125, 0.875};
  return spec;
}

void expect_same(const Scene<>& own, const Scene<>& listed, support::Checked& checked) {
  const support::OptionNumbers options{{"resolution", 0.05}, {"cells", 40}};
  const SolverRequest request{{0.25, 1}, {0.1, 0.3, 0.7}};
  SolverList::for_each([&]<class S>() {
    SCOPED_TRACE(std::string(S::kName));
    const auto chosen = support::options_of<S>(options);
    ASSERT_EQ(S::refusal(own, chosen).empty(), S::refusal(listed, chosen).empty());
    if (!S::refusal(own, chosen).empty()) return;
    checked.count(std::string(S::kName));
    const SolverResult a = solve<S>(own, request, chosen), b = solve<S>(listed, request, chosen);
    ASSERT_EQ(a.summary.status, b.summary.status);
    if (!b.summary.usable()) return;
    ASSERT_EQ(a.samples.size(), 6U);
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
      EXPECT_EQ(a.samples[i].phi, b.samples[i].phi) << i;
      EXPECT_EQ(a.samples[i].M, b.samples[i].M) << i;
    }
  });
}

TEST(OwnFlux, EverySolverTakesIt) {
  support::Checked checked({"exact", "front-tracking", "engquist-osher", "godunov", "crank-nicolson"});
  for (const double gamma : {0.25, 0.875}) {
    SCOPED_TRACE(gamma);
    OwnCubic own;
    own.gamma = gamma;
    SceneSpec<> mine = two_layers_of(own), listed = two_layers_of(Cubic<double>{gamma});
    ASSERT_FALSE(mine.fluxes[0].as<Cubic<double>>());
    expect_same(Scene<>(mine), Scene<>(listed), checked);
    mine.diffusion = listed.diffusion = Diffusion<double>{0.02, {}, false};
    expect_same(Scene<>(mine), Scene<>(listed), checked);
  }
}

}  // namespace
}  // namespace shearfront
