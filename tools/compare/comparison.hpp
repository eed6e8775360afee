// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/solver.hpp"

/// Error against time: every method, from coarse to fine.
namespace shearfront::tools {

/// What makes a method finer.
enum class Refinement {
  cells,       ///< more cells
  resolution,  ///< a smaller step of phi between fronts
  points       ///< more heights at which an exact method is asked
};

/// A solver, with one of its options set if the name has the form solver:option.
struct ComparedMethod {
  std::string name;
  std::string_view solver;
  Refinement refinement = Refinement::cells;
  void (*set)(SolverOptions&) = nullptr;  ///< nullptr: all options as by default
};

/// Every exact solver and every solver with whole profiles, each followed by its variants.
[[nodiscard]] const std::vector<ComparedMethod>& compared_methods();
/// Those of a LIST of names, in its order, each once; all that are worth it by default if there is none.
/// Errors: InputError for a name that is not known.
[[nodiscard]] std::vector<ComparedMethod> compared_methods(std::string_view option,
                                                           const std::optional<std::string>& list);

/// How fine each method goes, coarse to fine.
struct Resolutions {
  std::vector<double> cells, resolutions, points;
  [[nodiscard]] const std::vector<double>& of(Refinement refinement) const;
};
/// 100 to 3200 cells doubling, resolutions 0.1 to 1e-5 in half decades, 1000 points; `longest` goes on to 2e6
/// cells and 1e-6.
[[nodiscard]] Resolutions default_resolutions(bool longest);

/// One method at one resolution to one time, begun afresh.
struct ComparedRun {
  double resolution = 0;  ///< cells, step of phi, or points
  double l1_error = 0;    ///< int |phi - exact phi| dz; 0 for an exact method, which is what is compared with
  double wall_s = 0;      ///< median, profile included
  std::uint64_t work = 0;  ///< cell updates, collisions, or points
};

/// One method at one time, as far as it went.
struct Course {
  ComparedMethod method;
  double t = 0;
  std::vector<ComparedRun> runs;
  std::string ended;  ///< why it did not go to its finest resolution; empty if it did
  /// Order of the error in the resolution from the run before.
  [[nodiscard]] std::optional<double> order(std::size_t run) const;
};

/// Course::ended where the next resolution would have taken longer than allowed.
inline constexpr const char* kBudgetSpent = "no time left for more (--budget)";

struct ComparisonLimits {
  double budget_s = 5;      ///< per method and time: none is begun that would take longer, errors not counted
  std::size_t repeats = 0;  ///< runs per resolution; 0: at least 3 and 20 ms in all, one if it takes a second
  std::function<bool(double, std::uint64_t)> progress;  ///< as in SolverOptions
  std::function<bool()> is_stopped;
};

/// Errors against exact/l1_error.hpp.
[[nodiscard]] Course compare_method(const Scene<double>& scene, const ExactSolution<double>& exact, double t,
                                    const ComparedMethod& method, const std::vector<double>& resolutions,
                                    const ComparisonLimits& limits);

}  // namespace shearfront::tools
