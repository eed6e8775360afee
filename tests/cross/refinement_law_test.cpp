// SPDX-License-Identifier: BSD-3-Clause
// Everything that is printed with a promised order shows it, in random scenes of every kind, by every method of the list.
// The kind of fault: an order shown for one smooth, monotone case and promised for all.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "support/checked.hpp"
#include "support/refinement.hpp"
#include "support/refinement_scenes.hpp"

namespace shearfront {
namespace {

using support::Convergence;
using support::Refinement;
using support::SceneKind;
using support::SceneMaker;

constexpr int kLevels = 4;
constexpr double kSlack = 2;
/// Of the promised order, in the mean over so many scenes: monotone schemes lose the logarithm at shocks, and starts are late.
constexpr double kMeanShare = 0.7;
constexpr int kMany = 10;
/// Errors of fronts go down in steps, those of times of events in steps as wide as several halvings: a new level is of use to one
/// scene and not to the next one. Their mean order takes more of them.
constexpr int kLevelsOfFronts = 9;
constexpr std::uint64_t kManyCollisions = 20'000;  ///< no finer than this

/// What the scenes of one kind showed of one order.
struct ShownOrder {
  double observed = 0, share = 0;  ///< sums; share: of what is promised
  int n = 0;
};

/// One kind of scene by every method that takes it and promises an order.
class RefinementLaw : public testing::TestWithParam<SceneKind> {
 protected:
  void check(int n_scenes) {
    std::map<std::pair<std::string, std::string>, ShownOrder> orders;
    for (const support::RefinedMethod& method : support::refined_methods()) {
      const std::string name = method.name();
      for (int number = 0; number < n_scenes; ++number) {
        const std::uint64_t seed = support::seed_of(9100 + static_cast<std::uint64_t>(number));
        SCOPED_TRACE(std::string(GetParam().name) + " by " + name + ", seed " + std::to_string(seed));
        SceneMaker make(seed);
        const SceneSpec<double> spec = GetParam().draw(make);
        ASSERT_TRUE(find_complaints(spec).empty());
        const Scene<double> scene(spec);
        if (!method.at(0).refusal(scene).empty()) continue;
        if (support::PromisedOrders(method, scene).M == 0) continue;
        Refinement refinement(scene, method, {make.uniform(0.1, 0.6), make.uniform(0.7, 2)}, number % 2 == 1);
        const auto few = refinement.errors(kLevels);
        ASSERT_EQ(refinement.trouble(), "");
        for (const auto& [what, convergence] : few) {
          const bool is_slow = !convergence.shows_order(kSlack);
          Convergence all = is_slow ? refinement.errors(kLevels + 2)[what] : convergence;
          const bool is_time = what.front() == 't';
          const auto is_shown = [&] {
            return all.shows_order(kSlack) || (is_slow && all.comes_to_order(is_time ? 2 : 3));
          };
          for (int levels = kLevels + 3;
               levels <= kLevelsOfFronts && !is_shown() && refinement.collisions() > 0 &&
               refinement.collisions() < kManyCollisions;
               ++levels)
            all = refinement.errors(levels)[what];
          if (all.errors.front() > all.rounding) {  // else right by chance: says nothing about orders
            ShownOrder& shown = orders[{name, what.substr(0, what.find('('))}];
            double observed = all.observed();
            if (n_scenes >= kMany && what.front() == 't')
              for (int levels = kLevels + 1; levels <= kLevelsOfFronts && refinement.collisions() > 0 &&
                                             refinement.collisions() < kManyCollisions;
                   ++levels)
                observed = refinement.errors(levels)[what].observed();
            ASSERT_EQ(refinement.trouble(), "");
            shown.observed += observed;
            shown.share += observed / all.order;
            ++shown.n;
          }
          checked_.count();
          EXPECT_TRUE(is_shown()) << what << ": " << text(all);
        }
      }
    }
    for (const auto& [key, shown] : orders) {
      std::printf("| %s | %s | %s | %.2f | %.2f | %d |\n", std::string(GetParam().name).c_str(),
                  key.first.c_str(), key.second.c_str(), shown.observed / shown.n, shown.share / shown.n,
                  shown.n);
      if (shown.n >= kMany) {
        EXPECT_GE(shown.share / shown.n, kMeanShare) << key.first << ", " << key.second;
      }
    }
  }

 private:
  static std::string text(const Convergence& convergence) {
    std::string all = "order " + std::to_string(convergence.order) + " promised, errors";
    for (const double error : convergence.errors) all += " " + number_text(error, 3);
    return all;
  }
  support::Checked checked_;
};

std::string kind_name(const testing::TestParamInfo<SceneKind>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (c != ',') name += c == ' ' ? '_' : c;
  return name;
}

TEST_P(RefinementLaw, EveryOrderIsShown) { check(1); }
INSTANTIATE_TEST_SUITE_P(Kinds, RefinementLaw, testing::ValuesIn(support::kSceneKinds), kind_name);

using RefinementLawOfMany = RefinementLaw;
TEST_P(RefinementLawOfMany, EveryOrderIsShown) { check(12); }
INSTANTIATE_TEST_SUITE_P(Slow, RefinementLawOfMany, testing::ValuesIn(support::kSceneKinds), kind_name);

}  // namespace
}  // namespace shearfront
