// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace shearfront::fit {

/// rho and its first two derivatives in s = r^2; the misfit is sum rho(r_i^2) / 2.
struct LossValue {
  double rho = 0, first = 1, second = 0;
};

}  // namespace shearfront::fit
