// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"

/// Where to measure next: which of many possible measurements say most about the unknowns of a fit.
namespace shearfront::fit {

/// What is to be small. C is the covariance of the unknowns in the coordinates of a fit without shape: entries that must be
/// positive in their logarithm, so that their errors are relative; the others as parts of their unit.
enum class Criterion {
  D,  ///< det C, the volume of the confidence ellipsoid: log det C / p
  A,  ///< trace C, the sum of the variances: log trace C
  E,  ///< the largest eigenvalue of C, the worst combination: log (trace C^q)^(1/q), q = 32, at most 5 % more for p <= 5
  target  ///< the variance of one unknown: log C_jj (c-optimal)
};
inline constexpr std::array<std::string_view, 4> kCriterionNames{"D", "A", "E", "c"};

/// What is chosen as one: a camera gives all heights at a time, a sensor all times at a height.
enum class DesignUnit { measurement, time, height };
inline constexpr std::array<std::string_view, 3> kDesignUnitNames{"measurement", "time", "height"};

/// What could be measured, and what is wanted of it.
struct DesignSpec {
  Observations candidates;  ///< places and sigma > 0 of each; their values do not matter
  std::size_t n = 0;        ///< how many units are to be chosen, each at most once; 1 <= n <= all
  DesignUnit unit = DesignUnit::measurement;
  Criterion criterion = Criterion::D;
  std::string target;  ///< name of the unknown of Criterion::target
  bool adds = true;    ///< to the observations of the fit; otherwise in their place
  std::size_t draws =
      1;  ///< 1: at the estimate; more: the mean over scenes drawn from its error bars as well
  std::uint64_t seed = 1;  ///< of the draws
};

/// One candidate unit: the rows of the candidates that belong to it, how much of the continuous design it has (the weights
/// sum to 1), and what one more of it is worth there: - d criterion / d weight, largest where measuring is best.
struct DesignChoice {
  std::vector<std::size_t> rows;
  double weight = 0, worth = 0;
  bool is_chosen = false;
};

/// Standard errors of the unknowns in their own units at the estimate, as linear error propagation predicts them; NaN where
/// they are not determined.
struct DesignErrors {
  Eigen::VectorXd before;  ///< from the observations of the fit
  Eigen::VectorXd evenly;  ///< with as many units spread evenly over the candidates
  Eigen::VectorXd chosen;  ///< with the units chosen
};

struct Design {
  std::vector<std::string> unknowns;  ///< those that are not held at a bound
  Eigen::VectorXd estimates;
  std::vector<DesignChoice> choices;  ///< in the order of the candidates' first rows
  double criterion = 0;               ///< of the units chosen, the mean over draws
  /// No choice of n units can be better than this: the criterion is convex in the weights, so its tangent at the
  /// continuous design bounds it from below.
  double bound = 0;
  /// exp(bound - criterion): at least this part of the information of the best n units, in units of the criterion
  /// (variances; for D their geometric mean).
  [[nodiscard]] double efficiency() const;
  DesignErrors errors;
  std::size_t evenly_spread = 0;  ///< units behind errors.evenly: n, or less where a lattice needs it
};

/// The best n units of the candidates.
///
/// A unit g with Jacobian J_g of its residuals (in units of sigma) adds J_g^T J_g to the information M = C^-1. First the
/// continuous design: n times weights 0 <= w_g <= 1/n of sum 1, by NLopt's L-BFGS (by Newton's
/// method where noise is correlated); then n units by exchange: each in turn for the one with which the criterion is least, until none is. What it is short of the best
/// is bounded (Design::bound). Correlated noise, as the fit has it, is that of all that is chosen and of the data together
/// (correlated_information.hpp); candidates are then at most 2000, of the quantity of the data. Over draws the criterion is averaged, which makes the design hold where
/// the estimate is wrong.
/// Derivatives are those of the fit (exact with `exact`). Points next to a shock have large derivatives that hold for
/// no finite error; bins and sums have not.
/// Precondition: the estimate is usable. Errors: InputError (criterion, n, draws, candidates, quantity) for what cannot be done: a
/// target that is no unknown, unknowns that all candidates together do not determine, no error bars to draw from.
/// Cost: (draws) solutions at all candidates, then some 500 x units x p^2 x draws flops;
/// where noise is correlated as correlated_information.hpp says.
[[nodiscard]] Design design(const FitSpec& spec, const Estimate& estimate, const DesignSpec& wanted);

}  // namespace shearfront::fit
