// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace shearfront::tools {
namespace {

volatile sig_atomic_t interrupted = 0;

extern "C" void remember_interrupt(int /*signal*/) { interrupted = 1; }

}  // namespace

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (is_shown_) std::fputs("\r\x1b[K", stderr);
}

Progress ProgressLine::callback() {
  if (!is_terminal_) return {};
  return [this](double t, std::uint64_t work) {
    if (is_due()) fmt::print(stderr, "\r\x1b[Kt = {:.6g}, {} events or cell updates", t, work);
    return true;
  };
}

void ProgressLine::show_search(std::size_t evaluations, double misfit) {
  if (is_terminal_ && is_due())
    fmt::print(stderr, "\r\x1b[K{} evaluations, best misfit {:.6g}", evaluations, misfit);
}

bool ProgressLine::is_due() {
  constexpr std::chrono::milliseconds kPeriod{200};
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kPeriod) return false;
  last_ = now;
  return is_shown_ = true;
}

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler == SIG_IGN) return;  // nohup and the like
  struct sigaction action {};
  action.sa_handler = remember_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

InterruptGuard::~InterruptGuard() { sigaction(SIGINT, &before_, nullptr); }

bool InterruptGuard::is_interrupted() { return interrupted != 0; }

}  // namespace shearfront::tools
