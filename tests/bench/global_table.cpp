// SPDX-License-Identifier: BSD-3-Clause
// Prints how often a search finds the truth from starts a factor ten off in every parameter, and what it
// costs: 100 random problems of 2 to 5 layers, exact data.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "support/random_identification.hpp"

namespace shearfront::fit {
namespace {

constexpr int kProblems = 100;
constexpr double kClose = 1e-6;

void row(Quantity quantity, const char* algorithm, std::size_t starts) {
  int found = 0;
  std::vector<std::size_t> evaluations;
  std::vector<double> seconds;
  for (int k = 0; k < kProblems; ++k) {
    const auto complaint =
        support::random_identification(static_cast<std::uint64_t>(1000 + k), 2 + k % 4, 10);
    FitSpec spec = support::fit_of(complaint, support::exact_data(complaint, quantity));
    spec.search.algorithm = algorithm;
    spec.search.starts = starts;
    const Estimate estimate = fit(spec);
    found += complaint.error(estimate) <= kClose ? 1 : 0;
    evaluations.push_back(estimate.evaluations);
    seconds.push_back(estimate.wall_s);
  }
  std::sort(evaluations.begin(), evaluations.end());
  std::sort(seconds.begin(), seconds.end());
  std::printf("| %s | %s | %zu | %d | %zu | %zu | %.2f | %.2f |\n", std::string(name_of(quantity)).c_str(),
              algorithm, starts, found, evaluations[kProblems / 2], evaluations.back(),
              seconds[kProblems / 2], seconds.back());
  std::fflush(stdout);
}

}  // namespace
}  // namespace shearfront::fit

int main() {
  using shearfront::Quantity;
  std::printf(
      "| data | algorithm | starts | found of 100 | evaluations, median | most | seconds, median | most |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const Quantity quantity : {Quantity::cumulative, Quantity::bin, Quantity::point}) {
    shearfront::fit::row(quantity, "ceres", 1);
    shearfront::fit::row(quantity, "ceres", 20);
    shearfront::fit::row(quantity, "global", 1);
  }
}
