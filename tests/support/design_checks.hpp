// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/fit/design/design.hpp"
#include "shearfront/fit/design/information.hpp"
#include "support/fit_scenes.hpp"

/// What holds of designs whichever noise there is.
namespace shearfront::support {

inline constexpr fit::Criterion kEveryCriterion[] = {fit::Criterion::D, fit::Criterion::A, fit::Criterion::E,
                                                     fit::Criterion::target};

/// The least value of all choices of n units there are.
inline double least_of_all(std::size_t n_units, std::size_t n,
                           const std::function<double(const std::vector<std::size_t>&)>& value) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<bool> mask(n_units, false);
  std::fill(mask.begin(), mask.begin() + static_cast<std::ptrdiff_t>(n), true);
  do {
    std::vector<std::size_t> some;
    for (std::size_t g = 0; g < n_units; ++g)
      if (mask[g]) some.push_back(g);
    least = std::min(least, value(some));
  } while (std::prev_permutation(mask.begin(), mask.end()));
  return least;
}

/// Of choices checked against all there are.
struct CheckedChoices {
  int n = 0, n_best = 0;
  double efficiency = 0;  ///< the sum of what their bounds say
};

/// The choice is of n different units, none is better than the bound, and `value` is what it is by another road.
template <class Information>
void check_choice(const Information& information, const fit::InformationCriterion& criterion,
                  std::size_t n_units, std::size_t n,
                  const std::function<double(const std::vector<std::size_t>&)>& value,
                  CheckedChoices& checked) {
  const auto continuous = fit::continuous_design(information, criterion, n);
  ASSERT_TRUE(continuous);
  EXPECT_NEAR(continuous->weights.sum(), 1, 1e-12);
  EXPECT_LE(continuous->weights.maxCoeff(), 1 / static_cast<double>(n) + 1e-12);
  const auto chosen = fit::exchanged_design(information, criterion, n, *continuous);
  EXPECT_EQ(chosen.size(), n);
  EXPECT_EQ(std::adjacent_find(chosen.begin(), chosen.end()), chosen.end());
  const double best = least_of_all(n_units, n, value), found = value(chosen);
  EXPECT_GE(best, continuous->bound - 1e-9);
  EXPECT_GE(found, best - 1e-9);
  checked.n_best += found < best + 1e-6 ? 1 : 0;
  checked.efficiency += std::exp(continuous->bound - found);
  ++checked.n;
}

/// Two layers seen in bins of 0.05 at eight times.
inline ObservationPlan bins_of_layers() {
  ObservationPlan plan{{0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0}, {}, Quantity::bin, 0.05};
  for (int i = 1; i < 20; ++i) plan.depths.push_back(0.05 * i);
  return plan;
}

/// The data of a fit to choose from.
inline fit::DesignSpec measured_again(const fit::FitSpec& spec, std::size_t n, bool adds) {
  fit::DesignSpec wanted;
  wanted.candidates = spec.observations;
  wanted.n = n;
  wanted.adds = adds;
  return wanted;
}

/// Of a design that is all there is.
inline void expect_errors_of_fit(const fit::Design& all, const fit::Estimate& estimate) {
  ASSERT_EQ(all.unknowns.size(), estimate.parameters.size());
  for (Index j = 0; j < all.estimates.size(); ++j) {
    const double error = estimate.parameters[static_cast<std::size_t>(j)].std_error.value();
    EXPECT_NEAR(all.errors.before[j] / error, 1, 1e-9);
    EXPECT_NEAR(all.errors.chosen[j] / error, 1, 1e-9);
    EXPECT_NEAR(all.errors.evenly[j] / error, 1, 1e-9);
  }
  EXPECT_NEAR(all.efficiency(), 1, 1e-9);
}

/// What is chosen of the data, refitted alone to fresh noise of seeds 1, 2, ..., scatters as the design says.
inline void expect_errors_of_refits(const fit::Design& best, int n_refits, double tolerance,
                                    const std::function<fit::FitSpec(std::uint64_t seed)>& data) {
  VectorXd sum = VectorXd::Zero(best.estimates.size()), squares = sum;
  for (int k = 0; k < n_refits; ++k) {
    fit::FitSpec some = data(1 + static_cast<std::uint64_t>(k));
    std::vector<Observation> rows;
    for (const fit::DesignChoice& choice : best.choices)
      if (choice.is_chosen) rows.push_back(some.observations.rows[choice.rows.front()]);
    some.observations.rows = rows;
    const fit::Estimate refit = fit::fit(some);
    ASSERT_TRUE(refit.usable()) << "seed " << 1 + k;
    for (Index j = 0; j < sum.size(); ++j) {
      const double p = refit.parameters[static_cast<std::size_t>(j)].estimate;
      sum[j] += p;
      squares[j] += p * p;
    }
  }
  for (Index j = 0; j < sum.size(); ++j) {
    const double mean = sum[j] / n_refits, scatter = std::sqrt(squares[j] / n_refits - mean * mean);
    EXPECT_NEAR(best.errors.chosen[j] / scatter, 1, tolerance) << best.unknowns[static_cast<std::size_t>(j)];
  }
}

}  // namespace shearfront::support
