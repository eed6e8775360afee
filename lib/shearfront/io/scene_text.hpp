// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/scene/scene_spec.hpp"

namespace shearfront {

/// The text of a scene file (TOML) that reads back to the same scene: every number to the bit, with the shortest text;
/// entries at their defaults are written too, but for ends and the domain 0 to 1. Comments of the file the scene came
/// from are not kept. Precondition: every flux is of FluxList.
[[nodiscard]] std::string scene_text(const SceneSpec<double>& spec);

}  // namespace shearfront
