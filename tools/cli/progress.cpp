// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

namespace shearfront::tools {
namespace {

volatile sig_atomic_t interrupted = 0;

extern "C" void remember_interrupt(int /*signal*/) { interrupted = 1; }

}  // namespace

ProgressLine::ProgressLine() {
  if (isatty(STDERR_FILENO) != 0)
    ticking_ = std::jthread([this](const std::stop_token& stop) { tick(stop); });
}

ProgressLine::~ProgressLine() {
  if (!ticking_.joinable()) return;
  ticking_.request_stop();
  ticking_.join();
  if (is_shown_) std::fputs("\r\x1b[K", stderr);
}

Progress ProgressLine::callback() {
  if (!ticking_.joinable()) return {};
  return [this](double t, std::uint64_t work) {
    show(work == 0 ? fmt::format("t = {:.6g}", t)
                   : fmt::format("t = {:.6g}, {} events or cell updates", t, work));
    return true;
  };
}

void ProgressLine::show_search(std::size_t evaluations, double misfit) {
  if (ticking_.joinable()) show(fmt::format("{} evaluations, best misfit {:.6g}", evaluations, misfit));
}

void ProgressLine::show_part(std::size_t done, std::size_t all) {
  if (!ticking_.joinable() || done == 0) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double left = seconds * static_cast<double>(all - done) / static_cast<double>(done);
  show(fmt::format("{:.0f} %, {:.0f} s left", 100.0 * static_cast<double>(done) / static_cast<double>(all),
                   left));
}

void ProgressLine::show(std::string text) {
  const std::lock_guard lock(mutex_);
  text_ = std::move(text);
}

void ProgressLine::tick(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kPeriod{200};
  constexpr double kPatience = 1;  // short work shows nothing
  std::unique_lock lock(mutex_);
  while (!stopped_.wait_for(lock, stop, kPeriod, [&] { return stop.stop_requested(); })) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    if (seconds < kPatience) continue;
    fmt::print(stderr, "\r\x1b[K{}{}{:.0f} s", text_, text_.empty() ? "" : ", ", seconds);
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
  sigaction(SIGINT, &action, nullptr);
}

InterruptGuard::~InterruptGuard() { sigaction(SIGINT, &before_, nullptr); }

bool InterruptGuard::is_interrupted() { return interrupted != 0; }

}  // namespace shearfront::tools
