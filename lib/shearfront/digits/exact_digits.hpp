// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/io/scene_file.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront {

/// The most digits exact_digits() gives, and how many its numbers have.
inline constexpr int kMostDigits = 100, kComputedDigits = 110;

/// Event times of the text of a scene file by the exact solver with 1 <= digits <= kMostDigits significant digits, the numbers of
/// the file read as the decimals they are.
/// Precondition: the exact solver takes the scene and represents it exactly. `file` is its name in messages.
/// Errors: as parse_scene(). Cost: milliseconds per event.
[[nodiscard]] TimelineText exact_digits(std::string text, const std::string& file, int digits,
                                        const SceneChanges& changes = {});

}  // namespace shearfront
