// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/scene/scene.hpp"

namespace shearfront::exact {

/// Why the Lax-Hopf formula does not give the solution of a scene, in one sentence; empty if it does.
///
/// It does between walls, for fluxes that are all convex or all concave, have one extremum and vanish at both
/// ends of their range. Errors: none.
template <Real Scalar>
[[nodiscard]] std::string refusal(const Scene<Scalar>& scene);

extern template std::string refusal<double>(const Scene<double>&);

}  // namespace shearfront::exact
