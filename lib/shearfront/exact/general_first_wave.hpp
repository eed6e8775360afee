// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>

#include "shearfront/exact/general_medium.hpp"

namespace shearfront::exact {

/// First time at which phi next to interface i (1 <= i < n_layers) of a general medium leaves its initial
/// states phi_b | phi_a.
///
///   * 0 if the Riemann problem of the two states sends out a wave, i.e. unless both have the flux H0 =
///     min(what the lower layer can send up, what the upper one can take).
///   * Otherwise M(z_i, t) = M0 + H0 t until the first of
///       - the edge of a fan: the characteristic of the state itself, followed back through interfaces at
///         rest to the first point that is not, a travel time in closed form;
///       - a shock: M falls below the line, for good until the edge of a fan arrives. Found by bisection.
/// Empty if nothing ever arrives. `last`: a time after which nothing changes at z_i. Error: a few u for fans,
/// 64 u (height) / (change of the flux) for shocks. Cost: about 60 queries.
template <Real Scalar>
[[nodiscard]] std::optional<Scalar> first_wave(const GeneralMedium<Scalar>& medium, std::size_t i,
                                               const Scalar& mass, const Scalar& last);

extern template std::optional<double> first_wave(const GeneralMedium<double>&, std::size_t, const double&,
                                                 const double&);

}  // namespace shearfront::exact
