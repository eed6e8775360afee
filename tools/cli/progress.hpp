// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "shearfront/solver/solver.hpp"

/// While something is computed.
namespace shearfront::tools {

/// A line on standard error that shows how far it is and for how long it has run, if standard error is a terminal; elsewhere,
/// with --verbose, a line per minute, or as often as it says. Work that reports nothing is seen to run by the seconds. The line is gone
/// when this object is: nothing else may be written meanwhile.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Lines where standard error is no terminal, so many seconds apart; 0: none.
  static void set_verbose(double seconds);
  [[nodiscard]] static bool is_verbose();

  /// Must not outlive this object. Empty if there are no lines. `t_end` > 0: with the part that is done and the time that
  /// is left at the same pace.
  [[nodiscard]] Progress callback(double t_end = 0);
  /// Evaluations of a search so far and its smallest misfit.
  void show_search(std::size_t evaluations, double misfit);
  /// How many of all are done, with the time that is left at the same pace.
  void show_part(std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  void show(std::string text);
  [[nodiscard]] std::string part_text(double part) const;
  void tick();

  const Clock::time_point begin_ = Clock::now();
  std::mutex mutex_;  ///< of what follows
  std::condition_variable stopped_;
  bool is_over_ = false;
  std::string text_;
  bool is_shown_ = false;
  const bool is_terminal_;
  std::thread
      ticking_;  ///< none if there is no terminal. Not a jthread: libc++ has had that since its version 20 only
};

/// Calls work(Progress) under a line of its own.
template <class Work>
auto with_progress(Work&& work, double t_end = 0) {
  ProgressLine line;
  return work(line.callback(t_end));
}

/// Ctrl-C (SIGINT) ends the program at once, as ever, with a line that says what becomes of its files. nohup stays.
void say_when_interrupted();

/// While one of these exists, the first Ctrl-C (SIGINT) is only remembered, so that a long computation can
/// end with what it has, if it can within kPatience; else, and by a second one, the program ends as usual.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  [[nodiscard]] static bool is_interrupted();

  /// Not felt by who waits, with room below a fifth of a second for what the machine does besides.
  static constexpr std::chrono::milliseconds kPatience{150};

 private:
  struct sigaction before_ {
  }, alarm_before_{};
};

}  // namespace shearfront::tools
