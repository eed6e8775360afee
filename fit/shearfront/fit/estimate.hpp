// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/summary.hpp"

namespace shearfront::fit {

/// Stands for a number that the data do not give.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Called after every evaluation, and within those that take long, with the number so far and the smallest misfit; false
/// ends the search with the best point found (Status::interrupted), and what is still running within RunControl::kGrace.
using Progress = std::function<bool(std::size_t evaluations, double best_misfit)>;

/// The smallest misfit after so many evaluations: a curve for the picture of a search.
struct SearchStep {
  std::size_t evaluations = 0;
  double misfit = 0;
  std::size_t stage = 0;  ///< misfits of different stages cannot be compared
};

struct Interval {
  double low = 0, high = 0;
};

/// What is wrong with an end of a 95 % interval (interval_check.hpp).
enum class EndFault { none, too_near, too_far, no_solution };
struct IntervalCheck {
  EndFault low = EndFault::none, high = EndFault::none;
  std::string failure;  ///< why the model has no solution at an end
  [[nodiscard]] bool is_doubtful() const { return low != EndFault::none || high != EndFault::none; }
};

/// What was found about one unknown. Error bars are empty where they would be invented: at a bound, not seen
/// by the data, confounded with others, or no degrees of freedom left.
struct ParameterEstimate {
  std::string name;
  double start = 0, estimate = 0;
  std::optional<double> std_error;  ///< from the Jacobian
  std::optional<Interval> ci95;     ///< estimate -+ q std_error; for positive entries in the logarithm
  std::optional<Interval>
      profile95;  ///< profile likelihood, on request, beside bounds and where `check` doubts; NaN: open end
  std::optional<Interval> bootstrap95;  ///< parametric bootstrap, on request
  std::optional<IntervalCheck> check;   ///< of ci95; empty where none was made
  bool at_bound = false;
  bool held_by_shape = false;  ///< the shape binds it to its neighbours
  [[nodiscard]] bool is_held() const { return at_bound || held_by_shape; }
};

/// How well the residuals look like independent noise (residual_structure.hpp); NaN where there are too few.
struct ResidualStructure {
  double lag1_height = 0, lag1_time = 0;  ///< correlation of neighbours in z, and in t
  double runs_z_score = 0;                ///< Wald-Wolfowitz runs of signs over z: negative for too few runs
  bool is_structured = false;             ///< 1 % level
};

/// What was found about correlated noise: covariance sigma_i sigma_j (independent delta_ij + (1 - independent) k_ij), or
/// sigma_i^2 delta_ij + tau^2 k_ij with a discrepancy, k_ij = exp(-|dz| / length_z - |dt| / length_t).
struct NoiseEstimate {
  std::string model;
  double length_z = kUnknown, length_t = kUnknown;  ///< NaN where all observations have one height (time)
  double independent = 0;                           ///< of exponential noise; NaN otherwise
  double tau = kUnknown;                            ///< of a discrepancy, in the unit of the data
  /// 95 % intervals of those that were estimated; empty beside a bound and where the data do not tell.
  std::optional<Interval> length_z95, length_t95, independent95, tau95;
  std::size_t estimated = 0;  ///< how many of them were
};

/// How far the derivatives of front tracking reach: of all unknowns alone, the one of which fewest standard errors from the estimate
/// change the order of events, to first order (Linearisation::order_holds).
struct OrderOfEvents {
  std::string parameter;
  double std_errors = 0;
  std::size_t changes = 0;  ///< steps of the search that changed the order
};

/// The result of a fit.
struct Estimate {
  std::string name;
  std::string method, algorithm, quantity, loss;  ///< what was used, defaults resolved
  std::vector<ParameterEstimate> parameters;
  std::optional<Scene<double>> scene;  ///< with the estimates in place; empty if there is none

  double misfit = 0;         ///< sum rho(r^2) / 2 of the last stage, r in units of sigma
  double residual_norm = 0;  ///< sqrt(sum r^2), in the unit of the data
  double sigma =
      0;  ///< noise per observation: estimated from the residuals; 1 if the data have their own; without the
          ///< discrepancy
  double freedom = 0;  ///< degrees of freedom of sigma, if estimated
  bool sigma_is_given = false;
  std::size_t observations = 0;  ///< used in the last stage
  std::size_t left_out = 0;      ///< point data near a shock
  std::size_t evaluations = 0, iterations = 0;
  double wall_s = 0;
  /// Correlation of the estimates; NaN for those without error bar.
  Eigen::MatrixXd correlation;
  /// Of a bootstrap, on request: row = replicate that could be fitted, column = unknown. Bands are those of these rows.
  Eigen::MatrixXd replicates;
  std::optional<double> aic, bic;  ///< of all observations, Gaussian; smaller is better
  std::optional<ResidualStructure> structure;
  std::optional<NoiseEstimate> noise;  ///< empty: independent
  std::optional<OrderOfEvents>
      order;  ///< empty where fronts carry no derivatives, or no standard error is known

  /// Of every observation in its own quantity, in the order of the data (NaN: no prediction).
  std::vector<double> predicted;
  std::vector<SearchStep> steps;

  std::vector<std::string> warnings;
  Status status = Status::not_run;
  std::string message;
  [[nodiscard]] bool usable() const { return scene.has_value(); }
};

}  // namespace shearfront::fit
