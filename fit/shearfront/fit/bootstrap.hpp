// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/noise_covariance.hpp"
#include "shearfront/fit/parameters.hpp"

namespace shearfront::fit {

/// What a parametric bootstrap found.
struct Bootstrap {
  /// Percentile 95 % intervals; empty for parameters that the data do not determine, and with fewer than
  /// kFewestReplicates replicates.
  std::vector<std::optional<Interval>> intervals;
  Eigen::MatrixXd estimates;   ///< row = replicate that could be fitted, in their order; column = parameter
  Eigen::MatrixXd covariance;  ///< of the estimates
  std::size_t failed = 0;      ///< replicates that could not be fitted, left out
  std::vector<std::string> warnings;
};

/// One fit and nothing else: the values found, nothing if the fit failed or was ended by its Progress. Called from several
/// threads at once.
using Refit = std::function<std::optional<Eigen::VectorXd>(const FitSpec& spec, const Progress& progress)>;

/// Parametric bootstrap: spec.uncertainty.bootstrap replicates of the data, each the prediction at the
/// estimate plus Gaussian noise (sigma of the rows, otherwise estimate.sigma; correlated as the fit found), fitted from the
/// estimate with the same settings and a local search. Noise is not clipped to [0, 1].
///
/// An interval runs from the 2.5 % to the 97.5 % quantile of the estimates, (B + 1) p-th in order with linear
/// interpolation. Guarantees: the numbers depend on spec and estimate alone, to the bit, whatever the number
/// of threads: replicate b draws from stream_seed(seed, b). No interval is given to a parameter without error
/// bar that is not at a bound, nor one of length zero. Preconditions: `estimate` is usable.
/// Cost: replicates x one fit, on all cores (spec.uncertainty.threads). Source: Efron & Tibshirani (1993),
/// chapters 6 and 13.
[[nodiscard]] Bootstrap bootstrap(const FitSpec& spec, const Parameters& parameters, const Estimate& estimate,
                                  const Refit& refit, const Progress& progress = {});

inline constexpr std::size_t kFewestReplicates = 40;

/// The specification of all replicates but for the values of their observations: from the estimate, by a local search.
[[nodiscard]] FitSpec replicate_of(const FitSpec& spec, const Parameters& parameters,
                                   const Estimate& estimate);
/// Predictions of the estimate with fresh noise in place of the values. Preconditions: they are finite, sigma > 0.
/// `noise`: noise_of_draws().
void draw_observations(Observations& observations, const Estimate& estimate, const NoiseCovariance* noise,
                       std::uint64_t seed);
/// How the noise of an estimate is correlated; null where it is not.
[[nodiscard]] std::shared_ptr<const NoiseCovariance> noise_of_draws(const Observations& observations,
                                                                    const Estimate& estimate);

}  // namespace shearfront::fit
