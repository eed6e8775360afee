// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction

namespace shearfront::tools {

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
