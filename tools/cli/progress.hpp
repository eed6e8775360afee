// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction

#include <chrono>
#include <string_view>

#include "shearfront/solver/solver.hpp"

/// While something is computed.
namespace shearfront::tools {

/// A line on standard error that shows how far it is; only if standard error is a terminal.
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

 private:
  [[nodiscard]] bool is_due();
  bool is_terminal_, is_shown_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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
