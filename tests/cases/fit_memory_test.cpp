// SPDX-License-Identifier: BSD-3-Clause
// The kind of fault: memory and time that grow with the square of the data. Running sums over the heights of a time were
// stored one by one: 20,000 heights at two times took 6.3 GB and 31 s.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

/// The most memory this process ever had, in bytes.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TEST(FitMemory, GrowsWithTheDataNotWithTheirSquare) {
  constexpr int kDataHeights = 10000;
  constexpr double kMostBytes = 0.2 * 8.0 * kDataHeights * kDataHeights;  // a fifth of one such matrix
  const SceneSpec<double> truth = support::small_above_large({0.3, 0.6}, {2, 1, 0.5});
  ObservationPlan plan{{0.5, 1}, {}, Quantity::point, 0};
  for (int k = 0; k < kDataHeights; ++k) plan.depths.push_back((k + 0.5) / kDataHeights);
  FitSpec spec = support::fit_of(truth, support::observed(truth, plan, 0.01, 1, true), {"shear_rate.values"},
                                 {1.5, 1.4, 0.8});
  spec.search.max_evaluations = 3;
  const double before = peak_memory();
  const Estimate estimate = fit(spec);
  EXPECT_TRUE(estimate.usable()) << estimate.message;
  EXPECT_LT(peak_memory() - before, kMostBytes);
}

}  // namespace
}  // namespace shearfront::fit
