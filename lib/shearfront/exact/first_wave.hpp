// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>

#include "shearfront/exact/layered_medium.hpp"

namespace shearfront::exact {

/// First time at which phi next to interface i (1 <= i < n_layers) leaves its initial states phi_b | phi_a.
///
///   * 0 if the Riemann problem of the two states sends out a wave, i.e. unless both have the flux
///     H0 = min(s a_b h(max(phi_b, 1/2)), s a_a h(min(phi_a, 1/2))), h(p) = p (1 - p).
///   * Otherwise M(z_i, t) = M0 + H0 t until the first of
///       - the edge of a fan: the characteristic of the state itself, followed back through interfaces at
///       rest to the
///         first point that is not, a travel time in closed form;
///       - a shock: the first root of value(t) = M0 + H0 t over all other paths. A fan's value is convex in t
///       with
///         slope H(t), so it dips below the line only if it is below it where H(t) = H0, and Newton from its
///         first arrival increases to the root.
/// Empty if nothing ever arrives. Cost: O(layers) per point.
template <Real Scalar>
[[nodiscard]] std::optional<Scalar> first_wave(const LayeredMedium<Scalar>& medium, std::size_t i,
                                               const Scalar& mass);

extern template std::optional<double> first_wave(const LayeredMedium<double>&, std::size_t, const double&);

}  // namespace shearfront::exact
