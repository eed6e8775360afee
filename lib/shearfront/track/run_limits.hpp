// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>

namespace shearfront {

/// What may stop a run before its end.
struct RunLimits {
  std::uint64_t max_collisions = UINT64_MAX;
  /// Called now and then with (a time in the run, collisions so far); false stops with Status::interrupted.
  std::function<bool(double, std::uint64_t)> keep_going;
};

}  // namespace shearfront
