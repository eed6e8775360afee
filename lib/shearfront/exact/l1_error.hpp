// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront {

/// Errors of a profile against the exact solution at one time.
template <Real Scalar>
struct ProfileErrors {
  Scalar l1{0};        ///< int |phi - exact phi| dz over the domain
  Scalar l1_bound{0};  ///< |l1 - true value| is at most this: rounding and the ends of pieces
  Scalar M_max{0};     ///< largest |M - exact M| at the ends of pieces (cells, interfaces, shocks, kinks)
  std::size_t n_pieces = 0;  ///< pieces on which phi - exact phi keeps its sign
};

/// int |phi - exact phi| dz without quadrature. On a piece where phi - exact phi keeps its sign the integral
/// is the change of M - exact M over the piece, and both sides know their M. The domain is cut
///   (1) at the edges of the profile's cells and at the interfaces;
///   (2) at shocks and kinks: where the minimising path begins in another way. Optimal paths do not cross, so
///       the heights served by one source in one way are an interval, and its ends are found by bisection
///       (where phi jumps down, sped up by intersecting the values of M of both sides);
///   (3) where phi - exact phi changes its sign. Between the cuts (1) and (2) the exact phi does not decrease
///       and is smooth: against constant cells there is at most one change, by TOMS 748. Against linear cells, and
///       in beds of sloped pieces (there phi may fall inside a state), there may be more: the piece is halved until the difference is monotone or away from 0, as judged by
///       its second difference with a factor of two in hand.
/// Differences of M that are no more than rounding are replaced by the trapezoidal rule, which is exact where
/// the exact phi is linear (fans in their first layer, constant states).
///
/// Other fluxes, solid fraction and temperature: |phi - exact phi| dz = |u - exact u| dy in the canonical form, where
/// all of the above is done; M_max is that of int u dy.
///
/// Domain: the profile covers the scene's domain; 0 <= t <= +infinity. Guarantee: |l1 - true| <= l1_bound, which is
/// 16 u (top - bottom) n_pieces for a constant, linear or exponential in pieces, u the unit roundoff; about 1e-15 per piece in
/// double, as a rule much less. Other beds: the error against the exact solution of the pieces or layers that stand for them
/// (see ExactSolution). Cost: one query of the exact solution per cell and interface, 1 to 7 more per change of
/// sign, about 20 per shock and 50 per kink. 1e5 cells of a two-layer scene: 0.1 s.
template <Real Scalar>
[[nodiscard]] ProfileErrors<Scalar> errors_against(const ExactSolution<Scalar>& exact,
                                                   const Profile<Scalar>& profile, const Scalar& t);

extern template ProfileErrors<double> errors_against(const ExactSolution<double>&, const Profile<double>&,
                                                     const double&);

}  // namespace shearfront
