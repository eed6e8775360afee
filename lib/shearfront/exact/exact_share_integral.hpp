// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/exact/derivatives.hpp"
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

/// Its derivatives with respect to the entries of the scene, in the order of scene/entries.hpp (0 for entries that are refused):
///
///     int g'(phi / c) dphi dz + sum over shocks of [c g] [dM] / [phi] + sum over boundaries of the bed of -[c g] dz,
///
/// dphi and dM from Derivatives, [.] the value above minus that below; edges of fans add nothing, and cuts within rounding of one another
/// are one. Pieces as above, by the same quadrature after ends have been smoothed: error about 1e-10 of the largest derivative, 1e-6 where
/// a fan of a flux with joints comes through several layers; where pieces stand for the bed some 1e-3, less the more they are. At t = 0
/// one-sided where a jump of the data lies on a jump of c, as Derivatives are. Preconditions: g.slope; `derivatives` are those of `exact`. Cost: once
/// or twice that of share_integral().
[[nodiscard]] std::vector<double> share_integral_derivatives(const ExactSolution<double>& exact,
                                                             const Derivatives<double>& derivatives, double t,
                                                             const ShareFunction& g);

}  // namespace shearfront
