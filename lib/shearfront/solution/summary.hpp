// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace shearfront {

/// How a computation ended: kind 3 of the three kinds of error. Nothing is thrown for these.
enum class Status {
  not_run,         ///< solve() was not called
  ok,              ///< reached the time asked for
  steady,          ///< reached the steady state; nothing changes afterwards
  budget_reached,  ///< stopped at the largest amount of work allowed
  not_converged,   ///< an iteration did not reach its tolerance
  diverged,        ///< the numbers grew beyond all bounds: the scheme is unstable for this scene
  unsupported,     ///< the method does not apply to this scene; the message says which does
  interrupted      ///< the caller asked to stop
};

[[nodiscard]] constexpr std::string_view name_of(Status status) {
  switch (status) {
    case Status::not_run:
      return "not_run";
    case Status::ok:
      return "ok";
    case Status::steady:
      return "steady";
    case Status::budget_reached:
      return "budget_reached";
    case Status::not_converged:
      return "not_converged";
    case Status::diverged:
      return "diverged";
    case Status::unsupported:
      return "unsupported";
    case Status::interrupted:
      return "interrupted";
  }
  return "unknown";
}

/// What a solver reports about its run.
struct Summary {
  Status status = Status::not_run;
  std::string message = "solve() was not called";
  std::string remark;              ///< of a usable result: what is less good than usual, and what helps
  std::uint64_t collisions = 0;    ///< front tracking: Riemann problems solved after t = 0
  std::uint64_t fronts_max = 0;    ///< front tracking: most fronts alive at one time
  std::uint64_t levels = 0;        ///< front tracking: flux levels of the grid
  std::uint64_t cell_updates = 0;  ///< finite volumes: cells times time steps
  std::uint64_t layers = 0;        ///< layers used (a staircase for smooth a)
  double wall_s = 0;               ///< wall time in seconds
  std::optional<double>
      rest_time;  ///< of grid methods that were asked for the steady state: when they had come to it

  /// Whether the numbers that came with this summary may be used.
  [[nodiscard]] bool usable() const { return status == Status::ok || status == Status::steady; }
};

}  // namespace shearfront
