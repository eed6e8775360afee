// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace shearfront::tools {

/// A line on standard error that shows how far a long computation is; only if standard error is a terminal.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// For SolverOptions::progress; must not outlive this object. Empty if there is no terminal.
  [[nodiscard]] std::function<bool(double, std::uint64_t)> callback();
  /// Evaluations of a search so far and its smallest misfit.
  void show_search(std::size_t evaluations, double misfit);

 private:
  [[nodiscard]] bool is_due();
  void show(double t, std::uint64_t work);
  bool is_terminal_;
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace shearfront::tools
