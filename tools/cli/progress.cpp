// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <utility>

namespace shearfront::tools {
namespace {

volatile sig_atomic_t interrupted = 0;

extern "C" void end_with_a_word(int /*signal*/) {
  constexpr char kText[] = "\nshearfront: interrupted; files are written whole or not at all\n";
  (void)!write(STDERR_FILENO, kText, sizeof kText - 1);
  std::signal(SIGINT, SIG_DFL);
  (void)std::raise(SIGINT);
}

/// SIGALRM after so long; 0: not any more. A bare system call, which signal handlers may make.
void set_alarm(std::chrono::milliseconds after) {
  const itimerval timer{{}, {0, static_cast<suseconds_t>(after.count()) * 1000}};
  (void)setitimer(ITIMER_REAL, &timer, nullptr);
}

extern "C" void remember_interrupt(int /*signal*/) {
  interrupted = 1;
  set_alarm(InterruptGuard::kPatience);
}

double seconds_between_lines = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace

void ProgressLine::set_verbose(double seconds) { seconds_between_lines = seconds; }
bool ProgressLine::is_verbose() { return seconds_between_lines > 0; }

void say_when_interrupted() {
  struct sigaction now {};
  sigaction(SIGINT, nullptr, &now);
  if (now.sa_handler == SIG_DFL) std::signal(SIGINT, end_with_a_word);
}

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {
  if (is_terminal_ || seconds_between_lines > 0) ticking_ = std::thread([this] { tick(); });
}

ProgressLine::~ProgressLine() {
  if (!ticking_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  stopped_.notify_one();
  ticking_.join();
  if (is_shown_) std::fputs("\r\x1b[K", stderr);
}

Progress ProgressLine::callback(double t_end) {
  if (!ticking_.joinable()) return {};
  return [this, t_end](double t, std::uint64_t work) {
    const std::string part = t_end > 0 && t > 0 && t < t_end ? part_text(t / t_end) + ", " : "";
    show(part + (work == 0 ? fmt::format("t = {:.6g}", t)
                           : fmt::format("t = {:.6g}, {} events or cell updates", t, work)));
    return true;
  };
}

std::string ProgressLine::part_text(double part) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  return fmt::format("{:.0f} %, {:.0f} s left", 100 * part, seconds * (1 - part) / part);
}

void ProgressLine::show_search(std::size_t evaluations, double misfit) {
  if (ticking_.joinable()) show(fmt::format("{} evaluations, best misfit {:.6g}", evaluations, misfit));
}

void ProgressLine::show_part(std::size_t done, std::size_t all) {
  if (ticking_.joinable() && done > 0) show(part_text(static_cast<double>(done) / static_cast<double>(all)));
}

void ProgressLine::show(std::string text) {
  const std::lock_guard lock(mutex_);
  text_ = std::move(text);
}

void ProgressLine::tick() {
  constexpr std::chrono::duration<double> kPeriod{0.2};
  const std::chrono::duration<double> period =
      is_terminal_ ? kPeriod : std::chrono::duration<double>(seconds_between_lines);
  constexpr double kPatience = 1;  // short work shows nothing
  std::unique_lock lock(mutex_);
  while (!stopped_.wait_for(lock, period, [this] { return is_over_; })) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    if (seconds < kPatience) continue;
    const std::string line = fmt::format("{}{}{:.0f} s", text_, text_.empty() ? "" : ", ", seconds);
    if (!is_terminal_) {
      fmt::print(stderr, "shearfront: {}\n", line);
      continue;
    }
    fmt::print(stderr, "\r\x1b[K{}", line);
    is_shown_ = true;
  }
}

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler == SIG_IGN) return;  // nohup and the like
  struct sigaction action {};
  action.sa_handler = remember_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  struct sigaction at_last = action;
  at_last.sa_handler = end_with_a_word;
  sigaction(SIGALRM, &at_last, &alarm_before_);
  sigaction(SIGINT, &action, nullptr);
}

InterruptGuard::~InterruptGuard() {
  if (before_.sa_handler == SIG_IGN) return;
  set_alarm(std::chrono::milliseconds(0));
  sigaction(SIGINT, &before_, nullptr);
  sigaction(SIGALRM, &alarm_before_, nullptr);
}

bool InterruptGuard::is_interrupted() { return interrupted != 0; }

}  // namespace shearfront::tools
