// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>

#include "shearfront/solver/method.hpp"

namespace shearfront::web {

/// "front-tracking resolution=0.02 reconstruct=linear": a solver and its options. Errors: InputError.
[[nodiscard]] Method method_of(std::string_view text);

}  // namespace shearfront::web
