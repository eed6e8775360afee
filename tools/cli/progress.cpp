// SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace shearfront::tools {
namespace {

constexpr std::chrono::milliseconds kPeriod{200};

}  // namespace

ProgressLine::ProgressLine()
    : is_terminal_(isatty(STDERR_FILENO) != 0), last_(std::chrono::steady_clock::now()) {}

ProgressLine::~ProgressLine() {
  if (is_shown_) std::fputs("\r\x1b[K", stderr);
}

std::function<bool(double, std::uint64_t)> ProgressLine::callback() {
  if (!is_terminal_) return {};
  return [this](double t, std::uint64_t work) {
    show(t, work);
    return true;
  };
}

void ProgressLine::show(double t, std::uint64_t work) {
  if (!is_due()) return;
  fmt::print(stderr, "\r\x1b[Kt = {:.6g}, {} events or cell updates", t, work);
  std::fflush(stderr);
}

void ProgressLine::show_search(std::size_t evaluations, double misfit) {
  if (!is_terminal_ || !is_due()) return;
  fmt::print(stderr, "\r\x1b[K{} evaluations, best misfit {:.6g}", evaluations, misfit);
  std::fflush(stderr);
}

bool ProgressLine::is_due() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kPeriod) return false;
  last_ = now;
  is_shown_ = true;
  return true;
}

}  // namespace shearfront::tools
