// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
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

/// The search named by `spec.algorithm` ("ceres", "global", "nlopt:NAME"), from `start` inside the box of the
/// coordinates. The outcome is a Status, never an exception; bad names throw InputError (search.algorithm).
[[nodiscard]] SearchResult search(Objective& objective, const Eigen::VectorXd& start, const SearchSpec& spec);

/// Levenberg-Marquardt of Ceres with bounds; coordinates marked in `fixed` (empty: none) keep their start.
[[nodiscard]] SearchResult search_ceres(Objective& objective, const Eigen::VectorXd& start,
                                        const SearchSpec& spec, const std::vector<bool>& fixed = {});

/// An algorithm of NLopt by its name here ("sbplx"). Needs finite bounds where the algorithm does.
[[nodiscard]] SearchResult search_nlopt(Objective& objective, const Eigen::VectorXd& start,
                                        const SearchSpec& spec, std::string_view name);

/// Many Ceres searches from a low-discrepancy set over the box, the best one finished.
[[nodiscard]] SearchResult search_global(Objective& objective, const Eigen::VectorXd& start,
                                         const SearchSpec& spec);

/// "ceres", "global", "nlopt:sbplx", ...: what search.algorithm may be.
[[nodiscard]] std::vector<std::string> algorithm_names();

/// Whether the algorithm follows derivatives (and so needs a misfit without jumps).
[[nodiscard]] bool uses_derivatives(std::string_view algorithm);

}  // namespace shearfront::fit
