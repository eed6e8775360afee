// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/solve.hpp"

/// Error against time: every method, from coarse to fine.
namespace shearfront::tools {

/// A method, and what it is called in a comparison: solver, or solver:option with an option that is switched on,
/// or with the value of one that has names. Made finer by its option "resolution" or "cells".
struct ComparedMethod {
  std::string name;
  Method method;
};

/// Every exact solver and every solver with whole profiles, each followed by its variants.
[[nodiscard]] std::vector<ComparedMethod> compared_methods();
/// Those of a LIST of names, in its order, each once; without one every solver, and the variants worth it.
/// Errors: InputError for a name that is not known.
[[nodiscard]] std::vector<ComparedMethod> compared_methods(std::string_view option,
                                                           const std::optional<std::string>& list);

/// One method at one resolution to one time, begun afresh.
struct ComparedRun {
  double resolution = 0;  ///< cells or step of phi; of an exact method the heights at which it is asked
  double l1_error =
      0;  ///< int |phi - exact phi| dz per height of the bed, a number without unit; 0 for an exact
          ///< method: it is what is compared with
  std::optional<double> order;  ///< of the error in the resolution, from the run before
  double wall_s = 0;            ///< median, profile included
  std::uint64_t work = 0;       ///< cell updates, collisions, or heights
};

/// One method at one time, as far as it went.
struct Course {
  ComparedMethod method;
  double t = 0;
  std::vector<ComparedRun> runs;
  std::string ended;  ///< why it did not go to its finest resolution; empty if it did
};

/// Course::ended where the next resolution would have taken longer than allowed.
inline constexpr const char* kBudgetSpent = "no time left for more (--budget)";

struct ComparisonLimits {
  double budget_s = 5;      ///< no run is begun that would take a method at a time longer, errors not counted
  std::size_t repeats = 0;  ///< runs per resolution; 0: at least 3 and 20 ms in all, one if it takes a second
  Progress progress;
};

/// Errors against exact/l1_error.hpp, from coarse to fine. Ctrl-C ends it (InterruptGuard).
[[nodiscard]] Course compare_method(const Scene<double>& scene, const ExactSolution<double>& exact, double t,
                                    const ComparedMethod& method, std::vector<double> resolutions,
                                    const ComparisonLimits& limits);

}  // namespace shearfront::tools
