// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/solution/summary.hpp"

namespace shearfront::fit {

/// Where a search ended.
struct SearchResult {
  Eigen::VectorXd u;  ///< best point evaluated; the start if none was better
  double misfit = 0;  ///< F(u); infinite if no point had a solution
  std::size_t iterations = 0;
  Status status = Status::not_run;  ///< ok, budget_reached, not_converged, interrupted
  std::string message;
};

/// The search named by `spec.algorithm` ("ceres", "global", "pattern", "nlopt:NAME"), from `start` inside the box of the
/// coordinates; with spec.starts > 1 also from so many more points of the box less one, each with an equal
/// share of the evaluations left. It ends early when the misfit is at rounding level. The outcome is a
/// Status, never an exception; bad names throw InputError (search.algorithm).
[[nodiscard]] SearchResult search(Objective& objective, const Eigen::VectorXd& start, const SearchSpec& spec);

/// Levenberg-Marquardt of Ceres with bounds; coordinates marked in `fixed` (empty: none) keep their start.
[[nodiscard]] SearchResult search_ceres(Objective& objective, const Eigen::VectorXd& start,
                                        const SearchSpec& spec, const std::vector<bool>& fixed = {});

/// An algorithm of NLopt by its name here ("sbplx"; all in nlopt_algorithm.hpp). The best point evaluated is
/// returned whatever NLopt says of its end; its failures become a Status with its message.
///
/// A shape is the box of the coordinates, for COBYLA, SLSQP, MMA, CCSA and ISRES inequalities between the
/// parameters (nlopt_space.hpp). Tolerance: relative change of the misfit and of the parameters. Global
/// algorithms use two thirds of the evaluations, SBPLX the rest from the best point. COBYLA runs in variables
/// rescaled by the Jacobian: with exact data of Examples 3 to 5 it then needs 180 to 420 evaluations where
/// plain COBYLA has not converged after 2000. The same seed gives the same search. Errors: InputError
/// (search.algorithm) if a global algorithm lacks finite bounds or there are too few unknowns for it.
[[nodiscard]] SearchResult search_nlopt(Objective& objective, const Eigen::VectorXd& start,
                                        const SearchSpec& spec, std::string_view name);

/// Where a function of few numbers is least in a box, without derivatives, by NLopt (BOBYQA; of one number SBPLX): steps begin with
/// first_step and end below `tolerance`, or after `most` values wherever it is then. f may be infinite.
[[nodiscard]] Eigen::VectorXd least_in_box(const std::function<double(const Eigen::VectorXd&)>& f,
                                           const Eigen::VectorXd& from, const Eigen::VectorXd& lower,
                                           const Eigen::VectorXd& upper, double first_step, double tolerance,
                                           int most);

/// Compass search with the defaults of MATLAB's patternsearch, for comparison with papers that used it: from a mesh of 1 it
/// tries +e_1 ... +e_N, -e_1 ... -e_N times the mesh, goes to the first point that is better and doubles the mesh, and
/// halves it where there is none; points beyond the bounds or without the shape are skipped. It ends when the mesh is
/// below the tolerance. It moves the parameters themselves, unscaled, so its answers depend on their units and are the
/// start plus multiples of powers of two. Cost: up to 2 N evaluations for each halving. Source: Torczon (1997), SIAM J.
/// Optim. 7, 1-25.
[[nodiscard]] SearchResult search_pattern(Objective& objective, const Eigen::VectorXd& start,
                                          const SearchSpec& spec);

/// The smallest of many minima: short Ceres searches, continued where they promise more than the best so far.
///
/// They start from `start` times the common factor of a(z) that the data like best (a unit of time, scanned
/// in octaves), from a constant a(z) treated likewise, from `start` itself, then, by turns near and far, from
/// the best of a few points of a low-discrepancy set (starts.hpp). It ends at rounding level, or when three
/// searches led to the best misfit out of three and one per unknown. Exact data and starts ten times off in
/// every parameter: the truth in 100 of 100 random problems of 2 to 5 layers from running integrals, bins or
/// points, in 50, 50, 800 evaluations (median; tests/bench/global_table.cpp).
[[nodiscard]] SearchResult search_global(Objective& objective, const Eigen::VectorXd& start,
                                         const SearchSpec& spec);

/// The complaint about a name that is not one of algorithm_names().
[[nodiscard]] InputError unknown_algorithm(std::string_view algorithm);

/// "ceres", "global", "pattern", "nlopt:sbplx", ...: what search.algorithm may be.
[[nodiscard]] std::vector<std::string> algorithm_names();

/// Whether the algorithm follows derivatives (and so needs a misfit without jumps).
[[nodiscard]] bool uses_derivatives(std::string_view algorithm);

}  // namespace shearfront::fit
