// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::tools {

/// One run of one method to one time.
struct Rung {
  double resolution = 0;   ///< cells, step of phi, or points
  double l1_error = 0;     ///< int |phi - exact phi| dz
  double wall_s = 0;       ///< median wall time of a run that ends at the time, profile included
  std::uint64_t work = 0;  ///< cell updates, collisions, or points
};

/// Course::ended of a ladder that would have taken longer than allowed.
inline constexpr const char* kBudgetSpent = "no time left for more (--budget)";

/// The ladder of one method at one time, as far as it went.
struct Course {
  Contestant contestant;
  std::vector<Rung> rungs;
  std::string ended;  ///< why the ladder was not climbed to its end; empty if it was

  /// Order of the error in the resolution from the rung before.
  [[nodiscard]] std::optional<double> order(std::size_t rung) const;
};

struct Panel {
  double t = 0;
  std::vector<Course> courses;
};

/// How far a ladder is climbed and how often a rung is run.
struct RaceLimits {
  double budget_s = 0;      ///< no rung is begun that would take a method at one time beyond this, errors not
                            ///< counted
  std::size_t repeats = 0;  ///< runs per rung; 0: at least 3 and 20 ms in all, one if it takes a second
  std::function<bool(double, std::uint64_t)> progress;  ///< as in SolverOptions
  std::function<bool()> is_stopped;
};

/// Error against time of every method at one time. Each run starts afresh and ends at t. Errors are measured
/// against the exact solution (exact/l1_error.hpp); that of an exact method itself is 0.
[[nodiscard]] Panel race(const Scene<double>& scene, const ExactSolution<double>& exact, double t,
                         const std::vector<Contestant>& contestants, const Ladders& ladders,
                         const RaceLimits& limits);

/// Median wall time of runs of `run`, which returns whether to go on, and their number; see RaceLimits.
[[nodiscard]] double median_time(const std::function<bool()>& run, std::size_t repeats);

/// The wall time a method needs for an error.
struct TimeToError {
  enum class Kind { within_first, interpolated, extrapolated, never };
  Kind kind = Kind::never;
  double wall_s = 0;
};
/// Between two rungs log-log; beyond the last along the last two, unless that needs more than 1e8 cells,
/// steps of phi below 1e-8 or 1000 years, or the error does not fall.
[[nodiscard]] TimeToError time_to_error(const Course& course, double error);

}  // namespace shearfront::tools
