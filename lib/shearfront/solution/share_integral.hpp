// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/field.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront {

/// int c g(phi / c) dz of a profile of phi in the scene's bed.
///
/// Exact to rounding where x = phi / c is constant between the knots of c and the cells of the profile
/// (finite volumes; front tracking). Elsewhere by adaptive Gauss-Kronrod quadrature, relative error about
/// 1e-10 where x stays off the kinks of g and off singularities of its slope (entropy at 0 and 1), 1e-6
/// there. Cost: O(cells + knots), 15 values of g or more per cell with a slope.
[[nodiscard]] double share_integral(const Scene<double>& scene, const Profile<double>& profile,
                                    const ShareFunction& g);

}  // namespace shearfront
