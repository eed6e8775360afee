// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include "shearfront/solver/solver.hpp"

/// While something is computed.
namespace shearfront::tools {

/// A line on standard error that shows how far it is and for how long it has run; only if standard error is a terminal.
/// Work that reports nothing is seen to run by the seconds. The line is gone when this object is: nothing else may be
/// written meanwhile.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Must not outlive this object. Empty if there is no terminal.
  [[nodiscard]] Progress callback();
  /// Evaluations of a search so far and its smallest misfit.
  void show_search(std::size_t evaluations, double misfit);
  /// How many of all are done, with the time that is left at the same pace.
  void show_part(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::string text);
  void tick(const std::stop_token& stop);

  const Clock::time_point begin_ = Clock::now();
  std::mutex mutex_;  ///< of what follows
  std::condition_variable_any stopped_;
  std::string text_;
  bool is_shown_ = false;
  std::jthread ticking_;  ///< none if there is no terminal; ends before the rest is gone
};

/// Calls work(Progress) under a line of its own.
template <class Work>
auto with_progress(Work&& work) {
  ProgressLine line;
  return work(line.callback());
}

/// While one of these exists, the first Ctrl-C (SIGINT) is only remembered, so that a long computation can
/// end with what it has; the second one ends the program as usual.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] static bool is_interrupted();

 private:
  struct sigaction before_ {};
};

}  // namespace shearfront::tools
