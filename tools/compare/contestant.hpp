// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "cli/method.hpp"

/// Who takes part in `shearfront compare`, and how fine each goes.
namespace shearfront::tools {

/// What makes a method finer from rung to rung.
enum class LadderKind {
  cells,       ///< more cells
  resolution,  ///< a smaller step of phi between fronts
  points       ///< more heights at which an exact method is asked
};

/// A solver, with one of its options set if the name has the form solver:option.
struct Contestant {
  std::string name;
  std::string_view solver;
  LadderKind kind = LadderKind::cells;
  const char *option = nullptr, *value = nullptr;  ///< nullptr: all options as by default
  bool is_drawing = false;  ///< differs from the solver only in how profiles are drawn, not in its events

  /// Options for one rung; a number of points changes none.
  [[nodiscard]] SolverOptions options(double rung) const;
};

/// Every exact solver and every solver with whole profiles, each followed by its variants.
[[nodiscard]] const std::vector<Contestant>& all_contestants();
/// Those of a LIST of names, in its order, each once; all that are worth it by default if it is empty.
/// Errors: InputError for a name that is not known.
[[nodiscard]] std::vector<Contestant> contestants_of(std::string_view option, const std::string* list);

/// Rungs of the ladders, coarse to fine.
struct Ladders {
  std::vector<double> cells, resolutions, points;
  [[nodiscard]] const std::vector<double>& of(LadderKind kind) const;
};

/// The ladders by default: 100 to 3200 cells doubling, resolutions 0.1 to 1e-5 in half decades, 1000 points;
/// `longest` goes on to 2e6 cells and 1e-6, for those who give a budget.
[[nodiscard]] Ladders default_ladders(bool longest);

}  // namespace shearfront::tools
