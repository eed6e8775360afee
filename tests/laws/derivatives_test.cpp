// SPDX-License-Identifier: BSD-3-Clause
// Every shear rate with every flux and several initial states: each entry of the scene either has exact
// derivatives or is refused, and a fit can ask for all of them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/refusal.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/fit/forward.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/model_types.hpp"

namespace shearfront {
namespace {

/// Shares of the range of a flux: a jump, pure states, several jumps, no jump.
struct Start {
  std::vector<double> breaks, states;
};
const std::vector<Start> kStarts{{{0.5}, {0, 1}}, {{0.25, 0.6}, {0.3, 0.9, 0.1}}, {{}, {0.4}}};

template <class Model>
class ExactDerivatives : public testing::Test {
 protected:
  /// Calls visit(spec) for every scene with this shear rate that has an exact solution.
  template <class Visit>
  static void for_each_scene(Visit&& visit) {
    for (const Model& rate : Model::samples())
      FluxList<double>::for_each([&]<class F>() {
        for (const F& flux : F::samples())
          for (const Start& start : kStarts) {
            SceneSpec<double> spec;
            spec.fluxes = {flux};
            spec.shear_rate = rate;
            spec.initial_breaks = start.breaks;
            const auto range = flux.range();
            for (const double x : start.states)
              spec.initial_values.push_back(range.lowest + x * (range.highest - range.lowest));
            if (!find_complaints(spec).empty() || !exact::refusal(Scene<double>(spec)).empty()) continue;
            SCOPED_TRACE(std::string(Model::kName) + " with " + std::string(F::kName));
            visit(spec);
          }
      });
  }
};

template <class List>
struct TestTypes;
template <class... Model>
struct TestTypes<TypeList<Model...>> {
  using Type = testing::Types<Model...>;
};
TYPED_TEST_SUITE(ExactDerivatives, TestTypes<DepthFunctionList<double>>::Type, support::ModelName);

TYPED_TEST(ExactDerivatives, AFitCanAskForEveryEntry) {
  int checked = 0;
  fit::ForwardSpec exact;
  exact.options.layers = 8;
  this->for_each_scene([&](const SceneSpec<double>& spec) {
    for (const Entry& entry : entries(spec)) {
      if (entry.field.starts_with("domain.")) continue;
      fit::UnknownSpec unknown;
      unknown.parameters = {entry.name()};
      const fit::Parameters parameters(Scene<double>(spec), unknown);
      for (const auto observable : {fit::Observable::phi, fit::Observable::M}) {
        const auto forward =
            fit::make_forward(parameters, exact, observable, {{0.2, 0.3}, {0.2, 0.7}, {1, 0.5}});
        const auto at = forward->predict(parameters.start(), forward->has_derivatives());
        ASSERT_TRUE(at.is_valid()) << entry.name() << ": " << at.failure;
        if (forward->has_derivatives()) {
          ASSERT_EQ(at.derivatives.rows(), 3) << entry.name();
          EXPECT_TRUE(at.derivatives.allFinite()) << entry.name();
        }
        ++checked;
      }
    }
  });
  EXPECT_GT(checked, 0);
}

}  // namespace
}  // namespace shearfront
