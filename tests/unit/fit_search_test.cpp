// SPDX-License-Identifier: BSD-3-Clause
// The searches one by one: same minimum, same every time, stopped when told to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/search/nlopt_algorithm.hpp"
#include "shearfront/fit/search/search.hpp"
#include "support/identification.hpp"

namespace shearfront::fit {
namespace {

using support::exact_data;
using support::example_3;
using support::example_4;
using support::example_5;
using support::example_6;
using support::fit_of;
using support::Identification;

/// Fewer heights than in the paper: quicker, as determined. (Example 4 needs its early times.)
Identification thinned(Identification problem) {
  problem.heights = support::decimals(0.05, 0.95, 0.05);
  return problem;
}

Estimate run(const Identification& problem, const std::string& algorithm,
             Quantity quantity = Quantity::cumulative, SearchSpec search = {}) {
  FitSpec spec = fit_of(problem, exact_data(problem, quantity));
  spec.search = search;
  spec.search.algorithm = algorithm;
  return fit(spec);
}

class EveryAlgorithm : public testing::TestWithParam<std::string> {};

TEST_P(EveryAlgorithm, FindsTwoParameters) {
  const Identification problem = thinned(example_5());
  const Estimate estimate = run(problem, GetParam());
  EXPECT_TRUE(estimate.usable());
  // A compass creeps in the narrow valley of an amplitude and its decay: 2000 evaluations bring it from 0.5 to 0.024.
  EXPECT_LE(problem.error(estimate), GetParam() == "pattern" ? 0.05 : 1e-4) << estimate.message;
  EXPECT_LE(estimate.evaluations, 2000U + 20U);
  EXPECT_FALSE(estimate.message.empty());
}

TEST_P(EveryAlgorithm, IsTheSameEveryTime) {
  const Identification problem = thinned(example_5());
  SearchSpec search;
  search.max_evaluations = 300;
  const Estimate once = run(problem, GetParam(), Quantity::cumulative, search);
  const Estimate again = run(problem, GetParam(), Quantity::cumulative, search);
  EXPECT_EQ(once.evaluations, again.evaluations);
  EXPECT_EQ(once.status, again.status);
  for (std::size_t i = 0; i < once.parameters.size(); ++i)
    EXPECT_EQ(once.parameters[i].estimate, again.parameters[i].estimate);
}

TEST_P(EveryAlgorithm, StopsWhenTold) {
  const Identification problem = thinned(example_5());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.search.algorithm = GetParam();
  double best = 0;
  const Estimate estimate = fit(spec, [&](std::size_t n, double misfit) {
    best = misfit;
    return n < 4;
  });
  EXPECT_EQ(estimate.status, Status::interrupted) << estimate.message;
  EXPECT_EQ(estimate.evaluations, 4U);
  EXPECT_EQ(estimate.misfit, best);
}

TEST_P(EveryAlgorithm, KeepsItsBudget) {
  const Identification problem = thinned(example_5());
  SearchSpec search;
  search.max_evaluations = 7;
  const Estimate estimate = run(problem, GetParam(), Quantity::cumulative, search);
  EXPECT_LE(estimate.evaluations, 7U);
  EXPECT_TRUE(estimate.status == Status::budget_reached || GetParam() == "ceres") << estimate.message;
  EXPECT_TRUE(estimate.usable());
}

TEST_P(EveryAlgorithm, PassesExceptionsOn) {
  const Identification problem = thinned(example_5());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.search.algorithm = GetParam();
  EXPECT_THROW((void)fit(spec,
                         [](std::size_t n, double) -> bool {
                           if (n == 3) throw std::runtime_error("from the caller");
                           return true;
                         }),
               std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Names, EveryAlgorithm, testing::ValuesIn(algorithm_names()), [](const auto& name) {
  std::string text = name.param;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return text;
});

// A run of a grid method may take long: it is asked within, and what is reported is what was known before.
TEST(InterruptedFit, EndsWithinARunWithTheBestPoint) {
  const Identification problem = thinned(example_3());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.forward.method = Method("godunov");
  spec.forward.method.set("cells", std::uint64_t{4000});  // half a second or more each
  std::size_t n_asked = 0, at_stop = 0;
  double best = 0;
  const Estimate estimate = fit(spec, [&](std::size_t n, double misfit) {
    ++n_asked;
    if (n == 0 || n_asked < 100) return true;
    if (at_stop == 0) at_stop = n, best = misfit;
    return false;
  });
  EXPECT_EQ(estimate.status, Status::interrupted) << estimate.message;
  ASSERT_TRUE(estimate.usable()) << estimate.message;
  // That of the run that was broken off, and the differences that were not made.
  EXPECT_LE(estimate.evaluations, at_stop + 2 + 2 * estimate.parameters.size());
  EXPECT_EQ(estimate.misfit, best);
  EXPECT_TRUE(std::isfinite(best));
  for (const ParameterEstimate& p : estimate.parameters) EXPECT_TRUE(std::isfinite(p.estimate)) << p.name;
}

// Before the first run has ended nothing is known.
TEST(InterruptedFit, HasNoResultBeforeTheFirstRun) {
  const Identification problem = thinned(example_3());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.forward.method = Method("godunov");
  const Estimate estimate = fit(spec, [](std::size_t, double) { return false; });
  EXPECT_EQ(estimate.status, Status::interrupted) << estimate.message;
}

// A compass goes by whole meshes: from the start by multiples of a power of two, down to the tolerance.
TEST(PatternSearch, EndsAtDyadicOffsetsFromTheStartBetterThanItsNeighbours) {
  const Identification problem = thinned(example_3());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.search.algorithm = "pattern";
  spec.search.tolerance = 0x1p-9;
  spec.unknown.start = {2.5, 0.75};
  spec.unknown.lower = {0.25, 0.125}, spec.unknown.upper = {8, 8};
  const Estimate estimate = fit(spec);
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  constexpr double kMesh = 0x1p-9;
  for (std::size_t i = 0; i < 2; ++i) {
    const double offset = (estimate.parameters[i].estimate - spec.unknown.start[i]) / kMesh;
    EXPECT_NEAR(offset, std::round(offset), 1e-6) << i;
    EXPECT_NE(offset, 0) << i;
  }
  // No neighbour on the last mesh is better: seen from outside, by fits that may evaluate their start only.
  spec.search.max_evaluations = 1;
  for (const double sign : {-1.0, 1.0})
    for (std::size_t i = 0; i < 2; ++i) {
      spec.unknown.start = {estimate.parameters[0].estimate, estimate.parameters[1].estimate};
      spec.unknown.start[i] += sign * kMesh;
      EXPECT_GE(fit(spec).misfit, estimate.misfit) << i;
    }
}

TEST(PatternSearch, KeepsToTheShape) {
  const Identification problem = thinned(example_4());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.search.algorithm = "pattern";
  spec.search.tolerance = 1e-3;
  spec.unknown.shape = Shape::decreasing;
  const Estimate estimate = fit(spec);
  for (std::size_t i = 1; i < estimate.parameters.size(); ++i)
    EXPECT_LE(estimate.parameters[i].estimate, estimate.parameters[i - 1].estimate * (1 + 1e-12));
}

struct SameMinimum {
  const char* algorithm;
  Identification (*problem)();
  double error;
};

class LocalAlgorithm : public testing::TestWithParam<SameMinimum> {};
class LocalAlgorithmOnPoints : public testing::TestWithParam<SameMinimum> {};

std::string name_of_test(const testing::TestParamInfo<SameMinimum>& info) {
  std::string text = info.param.algorithm + ("_" + info.param.problem().name);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return text;
}

TEST_P(LocalAlgorithm, ReachesTheMinimumOfRunningIntegrals) {
  const Identification problem = thinned(GetParam().problem());
  const Estimate estimate = run(problem, GetParam().algorithm);
  EXPECT_LE(problem.error(estimate), GetParam().error)
      << problem.name << ", misfit " << estimate.misfit << ", " << estimate.message;
}

TEST_P(LocalAlgorithmOnPoints, ReachesTheMinimum) {
  const Identification problem = thinned(GetParam().problem());
  const Estimate estimate = run(problem, GetParam().algorithm, Quantity::point);
  EXPECT_LE(problem.error(estimate), 1e-2)
      << problem.name << ", misfit " << estimate.misfit << ", " << estimate.message;
}

const auto kThreeExamples = testing::Values(
    SameMinimum{"nlopt:sbplx", example_3, 1e-8}, SameMinimum{"nlopt:cobyla", example_3, 1e-8},
    SameMinimum{"nlopt:nelder-mead", example_3, 1e-8}, SameMinimum{"nlopt:sbplx", example_4, 1e-5},
    SameMinimum{"nlopt:cobyla", example_4, 1e-8}, SameMinimum{"nlopt:nelder-mead", example_4, 1e-8},
    SameMinimum{"nlopt:sbplx", example_5, 1e-8}, SameMinimum{"nlopt:cobyla", example_5, 1e-8},
    SameMinimum{"nlopt:nelder-mead", example_5, 1e-8});
INSTANTIATE_TEST_SUITE_P(Examples, LocalAlgorithm, kThreeExamples, name_of_test);
INSTANTIATE_TEST_SUITE_P(Examples, LocalAlgorithmOnPoints, kThreeExamples, name_of_test);
INSTANTIATE_TEST_SUITE_P(TenLayers, LocalAlgorithm,
                         testing::Values(SameMinimum{"nlopt:cobyla", example_6, 1e-2}), name_of_test);

TEST(Ceres, NeedsFewEvaluations) {
  for (const Identification& problem : {example_3(), example_4(), example_5(), example_6()})
    for (const Quantity quantity : {Quantity::cumulative, Quantity::point}) {
      const Estimate estimate = run(thinned(problem), "ceres", quantity);
      EXPECT_LE(problem.error(estimate), 1e-9) << problem.name << ' ' << name_of(quantity);
      EXPECT_LE(estimate.evaluations, 25U) << problem.name << ' ' << name_of(quantity);
    }
}

TEST(Ceres, StartsOnABound) {
  const Identification problem = thinned(example_3());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.unknown.lower = spec.unknown.start;
  spec.unknown.lower[1] = 0.1;
  spec.unknown.upper = {20, spec.unknown.start[1]};
  EXPECT_LE(problem.error(fit(spec)), 1e-9);
}

TEST(Ceres, StaysInsideTheBounds) {
  const Identification problem = thinned(example_3());
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.unknown.lower = {0.1, 0.1};
  spec.unknown.upper = {2.8, 20};
  for (const char* algorithm : {"ceres", "nlopt:cobyla", "nlopt:slsqp", "nlopt:sbplx", "global"}) {
    spec.search.algorithm = algorithm;
    const Estimate estimate = fit(spec);
    EXPECT_NEAR(estimate.parameters[0].estimate, 2.8, 1e-6) << algorithm;
    EXPECT_LE(estimate.parameters[0].estimate, 2.8 * (1 + 1e-14)) << algorithm;
    EXPECT_TRUE(estimate.parameters[0].at_bound) << algorithm;
  }
}

TEST(Shape, IsTheSameAsConstraintsAndAsBox) {
  Identification problem = thinned(example_4());
  // Not convex: the convex fit ends on a face of the shape.
  std::get<Piecewise<double>>(problem.truth.shear_rate).values = {3.25, 2.9, 1.63, 1.05, 0.53};
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.unknown.shape = Shape::convex;
  const Estimate box = fit(spec);
  for (const char* algorithm : {"nlopt:slsqp", "nlopt:cobyla"}) {
    spec.search.algorithm = algorithm;
    const Estimate constraints = fit(spec);
    ASSERT_TRUE(constraints.usable()) << algorithm;
    EXPECT_NEAR(constraints.misfit / box.misfit, 1, 1e-6) << algorithm << ": " << constraints.message;
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(constraints.parameters[i].estimate, box.parameters[i].estimate, 1e-3) << algorithm;
    for (std::size_t i = 0; i + 2 < 5; ++i)
      EXPECT_GE(constraints.parameters[i].estimate - 2 * constraints.parameters[i + 1].estimate +
                    constraints.parameters[i + 2].estimate,
                -1e-12)
          << algorithm;
  }
}

TEST(SearchNames, SayWhatIsWrong) {
  const Identification problem = thinned(example_5());
  const auto message = [&](const std::string& algorithm) -> std::string {
    try {
      (void)run(problem, algorithm);
    } catch (const InputError& error) {
      return error.complaints().front().text();
    }
    return "";
  };
  EXPECT_EQ(message("nlopt:simplex").substr(0, 58),
            "search.algorithm = \"nlopt:simplex\"; must be one of: ceres,");
  EXPECT_NE(message("nlopt:"), "");
}

TEST(SearchNames, GlobalAlgorithmsNeedABox) {
  Identification problem = thinned(example_3());
  problem.parameters = {"domain.top"};
  problem.start = {1.0};
  FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
  spec.search.algorithm = "nlopt:direct-l";
  try {
    (void)fit(spec);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "search.algorithm = \"nlopt:direct-l\"; needs finite bounds for domain.top");
  }
  spec.search.algorithm = "nlopt:bobyqa";
  EXPECT_THROW((void)fit(spec), InputError);
}

TEST(ManyStarts, FindWhatOneStartMisses) {
  Identification problem = thinned(example_3());
  problem.start = {31.5, 0.05};
  const Estimate one = run(problem, "nlopt:lbfgs");
  SearchSpec search;
  search.starts = 10;
  const Estimate many = run(problem, "nlopt:lbfgs", Quantity::cumulative, search);
  EXPECT_LE(many.misfit, one.misfit);
  EXPECT_LE(problem.error(many), 1e-6) << many.message;
}

}  // namespace
}  // namespace shearfront::fit
