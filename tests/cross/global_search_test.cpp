// SPDX-License-Identifier: BSD-3-Clause
// The global search finds the truth from starts a factor ten off in every parameter.
#include <gtest/gtest.h>

#include <iostream>

#include "support/random_identification.hpp"

namespace shearfront::fit {
namespace {

constexpr double kClose = 1e-6;

/// How many of the problems first..last - 1 end at the truth.
int found(Quantity quantity, int first, int last) {
  int n = 0;
  for (int k = first; k < last; ++k) {
    const auto complaint =
        support::random_identification(static_cast<std::uint64_t>(1000 + k), 2 + k % 4, 10);
    FitSpec spec = support::fit_of(complaint, support::exact_data(complaint, quantity));
    spec.search.algorithm = "global";
    const Estimate estimate = fit(spec);
    const double error = complaint.error(estimate);
    n += error <= kClose ? 1 : 0;
    if (!(error <= kClose))
      std::cout << "complaint " << k << ": error " << error << ", misfit " << estimate.misfit << ", "
                << estimate.message << '\n';
  }
  return n;
}

TEST(GlobalSearch, FindsTheTruthFromFarAway) { EXPECT_EQ(found(Quantity::cumulative, 0, 4), 4); }

TEST(SlowGlobalSearch, FindsTheTruthFromFarAwayByRunningIntegrals) {
  EXPECT_GE(found(Quantity::cumulative, 0, 100), 98);
}
TEST(SlowGlobalSearch, FindsTheTruthFromFarAwayByBins) { EXPECT_GE(found(Quantity::bin, 0, 100), 98); }

// A layer as thin as the distance of the heights may hold no point away from jumps.
TEST(SlowGlobalSearch, FindsTheTruthFromFarAwayByPoints) { EXPECT_GE(found(Quantity::point, 0, 8), 8); }

TEST(SlowGlobalSearch, IsTheSameEveryTime) {
  const auto complaint = support::random_identification(1003, 5, 10);
  FitSpec spec = support::fit_of(complaint, support::exact_data(complaint, Quantity::point));
  spec.search.algorithm = "global";
  const Estimate once = fit(spec), again = fit(spec);
  EXPECT_EQ(once.evaluations, again.evaluations);
  for (std::size_t i = 0; i < once.parameters.size(); ++i)
    EXPECT_EQ(once.parameters[i].estimate, again.parameters[i].estimate);
}

}  // namespace
}  // namespace shearfront::fit
