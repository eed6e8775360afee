// SPDX-License-Identifier: BSD-3-Clause
// A solver refuses a scene or solves it; and what a refusal recommends instead solves it.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/any_scene.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"
#include "support/random_diffusion.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// Calls check(scene) for scenes of every kind, one in five with diffusion.
template <class Check>
void for_beds(std::uint64_t seed, int n, Check&& check) {
  SceneMaker maker(support::seed_of(seed));
  for (int number = 0; number < n;) {
    SceneSpec<double> spec = support::any_scene(maker, 2);
    if (maker.integer(0, 4) == 0) {
      spec.diffusion = Diffusion<double>{0.05, {}, false};
      if (maker.integer(0, 1) == 0) spec.solid_fraction.reset();
      if (maker.integer(0, 1) == 0) spec.outside_bottom.reset(), spec.outside_top.reset();
      if (maker.integer(0, 3) == 0) {  // those with a closed form
        spec.fluxes = {Quadratic<double>{}};
        spec.flux_breaks.clear();
        spec.solid_fraction.reset();
        spec.outside_bottom.reset(), spec.outside_top.reset();
        spec.is_periodic = false;
        spec.temperature.reset();
        spec.shear_rate = Piecewise<double>{{}, {1}};
        spec.initial_breaks.clear();
        spec.initial_values = {maker.uniform(0.1, 0.9)};
      }
    }
    if (!find_complaints(spec).empty()) continue;
    const Scene<double> scene(std::move(spec));
    SCOPED_TRACE("scene " + std::to_string(number++) + ", flux " + std::string(scene.fluxes()[0].name()));
    check(scene);
  }
}

const support::OptionNumbers kCoarse{{"resolution", 0.2}, {"cells", 20}, {"layers", 8}};

TEST(Refusals, ASolverRefusesASceneOrSolvesIt) {
  support::Checked checked;
  SolverList::for_each([&]<class S>() {
    checked.expect(std::string(S::kName) + " refuses");
    if (S::guarantees().has_slab) return;  // these are beds
    checked.expect(std::string(S::kName) + " solves");
    checked.expect(std::string(S::kName) + " runs");
  });
  for_beds(7501, 600, [&](const Scene<double>& scene) {
    checked.count();
    SolverList::for_each([&]<class S>() {
      const std::string name(S::kName);
      const auto options = support::options_of<S>(kCoarse);
      const std::string why = S::refusal(scene, options);
      const SolverResult result = solve<S>(scene, SolverRequest{{0.1}, {0.3}}, options);
      EXPECT_EQ(result.summary.status == Status::unsupported, !why.empty())
          << name << ": " << why << "; " << result.summary.message;
      checked.count(name + (why.empty() ? " solves" : " refuses"));
      if (!why.empty()) return;
      const auto run = S::start(scene, options, {});
      const Status status = run->advance(0.1);
      // Schemes that promise no bounds may leave them for good.
      if (status == Status::diverged && !S::guarantees().bounded) return;
      ASSERT_TRUE(status == Status::ok || status == Status::steady) << name << ": " << run->summary().message;
      EXPECT_TRUE(run->summary().usable()) << name << ": " << run->summary().message;
      EXPECT_NEAR(run->field().at(scene.bottom()).M, 0, 1e-12) << name;
      checked.count(name + " runs");
    });
  });
}

/// The names of methods in "why; use a, b".
std::vector<std::string> recommended(const std::string& refusal) {
  constexpr std::string_view kUse = "; use ";
  std::vector<std::string> names;
  const std::size_t begin = refusal.rfind(kUse);
  if (begin == std::string::npos) return names;
  std::istringstream list(refusal.substr(begin + kUse.size()));
  for (std::string name; std::getline(list >> std::ws, name, ',');)
    if (SolverList::contains(name)) names.push_back(name);
  return names;
}

void expect_honest_refusals(const Scene<double>& scene, support::Checked& checked) {
  std::vector<std::string> able;
  for (const std::string& name : Method::names())
    if (Method(name).refusal(scene).empty()) able.push_back(name);
  for (const std::string& name : Method::names()) {
    const std::string why = Method(name).refusal(scene);
    if (why.empty()) continue;
    EXPECT_EQ(recommended(why), able) << why;
    EXPECT_EQ(why.ends_with("; no method of this program solves this scene"), able.empty()) << why;
    checked.count(able.empty() ? "no method" : "others");
  }
}

TEST(Refusals, NameExactlyTheMethodsThatSolveTheScene) {
  support::Checked checked({"others", "no method"});
  for_beds(7502, 600, [&](const Scene<double>& scene) { expect_honest_refusals(scene, checked); });
}

// A flux that does not vanish at the ends of its range between layers: no engine knows what happens there.
TEST(Refusals, OfBurgersFluxInTwoLayersGoInNoCircle) {
  SceneSpec<double> spec;
  spec.fluxes = {Burgers<double>{}};
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 2}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  spec.is_periodic = true;
  support::Checked checked({"no method"}, SolverList::kSize);
  expect_honest_refusals(Scene<double>(spec), checked);
}

// Another option, not another method, is what a refusal of options asks for.
TEST(Refusals, OfOptionsDoNotSendToOtherMethods) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  const std::string why = Method::of<FrontTrackingSolver>({.resolution = 1e-12}).refusal(scene);
  EXPECT_NE(why.find("coarser resolution"), std::string::npos) << why;
  EXPECT_TRUE(recommended(why).empty()) << why;
}

}  // namespace
}  // namespace shearfront
