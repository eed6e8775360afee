// SPDX-License-Identifier: BSD-3-Clause
#include "cli/interrupt.hpp"

namespace shearfront::tools {
namespace {

volatile sig_atomic_t interrupted = 0;

extern "C" void remember_interrupt(int /*signal*/) { interrupted = 1; }

}  // namespace

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
