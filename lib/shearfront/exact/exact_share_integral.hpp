// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/solution/field.hpp"

namespace shearfront {

/// int c g(phi / c) dz of the exact solution at time t, 0 <= t <= +infinity.
///
/// The bed is cut at interfaces, shocks and kinks (exact/smooth_pieces.hpp) and where a fan passes a kink
/// of g; each piece by adaptive Gauss-Kronrod quadrature. Guarantee: relative error about 1e-12 for smooth g,
/// 1e-10 where the slope of g is singular (entropy at 0 and 1); where pieces or layers stand for the bed, Gauss's rule with 3
/// points in each, far below their own error. Cost: some 100 to 1000 queries of the exact solution; a
/// few per piece where they stand for the bed.
[[nodiscard]] double share_integral(const ExactSolution<double>& exact, double t, const ShareFunction& g);

}  // namespace shearfront
