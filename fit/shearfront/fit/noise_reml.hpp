// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/noise_covariance.hpp"

namespace shearfront::fit {

/// What a fit leaves, in units of sigma_i (1 where the data have none), not whitened.
struct NoiseData {
  std::shared_ptr<const NoisePlaces> places;
  bool sigma_is_given = false;
  double mean_sigma = 1;  ///< of the data, 1 where they have none
  double range = 1;       ///< of the values of the data
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  ///< of the unknowns that are not held
};

/// Numbers of a noise model: as given by [noise], or estimated.
struct NoiseNumbers {
  NoiseShape shape;
  NoiseEstimate estimate;
  Eigen::VectorXd place;  ///< of the estimated ones in the search: where the next begins
};

/// The numbers of [noise] if all that these places let see are given; otherwise nothing.
[[nodiscard]] std::optional<NoiseNumbers> given_noise(const NoiseSpec& spec, const NoisePlaces& places);

/// Those that are not given by restricted maximum likelihood of e = r + J d, linear in what the unknowns move:
///
///     minimise log|C| + log|J^T C^-1 J| + (n - p) log(e^T P e)      (e^T P e where sigma is given),
///     P = C^-1 - C^-1 J (J^T C^-1 J)^-1 J^T C^-1,
///
/// plus -2 log of the half-normal priors of a discrepancy. That is the likelihood of what no change of the unknowns makes, so
/// the degrees of freedom they take do not shrink the correlation (Patterson & Thompson 1971; Harville 1977). Lengths from a
/// twentieth of the least distance to a hundred times the reach of the data, by NLopt's BOBYQA from the best of a coarse lattice, or from `place`.
/// Intervals: -+ 1.96 standard errors in the logarithm, from second differences.
/// Nothing where the observations are too few: n - p must exceed the number of unknown numbers.
/// Cost: 50 to 150 covariances.
[[nodiscard]] std::optional<NoiseNumbers> estimated_noise(const NoiseSpec& spec, const NoiseData& data,
                                                          const Eigen::VectorXd& place = {});

/// The [noise] of a fit with all numbers as found. A discrepancy beside an unknown sigma is exponential noise with an
/// independent part: that is the same covariance, whatever sigma is.
[[nodiscard]] NoiseSpec known_noise(const FitSpec& spec, const Estimate& estimate);

/// Of an estimate. `sigma`: the noise of one observation, 1 where the data have their own.
[[nodiscard]] NoiseShape shape_of(const NoiseEstimate& estimate, double sigma);

}  // namespace shearfront::fit
