// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/exact/exponential_medium.hpp"
#include "shearfront/exact/general_medium.hpp"
#include "shearfront/exact/layered_medium.hpp"
#include "shearfront/exact/sensitivities.hpp"

/// Derivatives along one path; building blocks of sensitivities().
namespace shearfront::exact {

/// Momentum at the start of a path and what it lacks to 1, each to a few units in the last place.
template <Real Scalar>
struct StartMomentum {
  Scalar p{0}, missing{1};

  /// d M / d (height of an initial jump from `below` to anything), the path starting there.
  [[nodiscard]] Scalar against(const Scalar& below) const {
    return p > missing ? Scalar((below - Scalar(1)) + missing) : Scalar(below - p);
  }
};

/// Derivatives of M and phi with respect to what a layered path depends on besides the initial data: every
/// rate r_k = s a_k, every inner boundary, and the height of its start (at fixed initial M).
template <Real Scalar>
struct LayeredGradient {
  struct Pair {
    Scalar M{0}, phi{0};
  };
  std::size_t first = 0;         ///< layer of rates[0]
  std::vector<Pair> rates;       ///< layers first, first + 1, ...: those the path touches
  std::vector<Pair> boundaries;  ///< boundaries[n]: boundary first + n, n >= 1
  StartMomentum<Scalar> start;
  Scalar phi_start{0};      ///< d phi / d (height of the source), fan kind
  Scalar phi_state{0};      ///< d phi / d (initial state), constant kind
  Scalar phi_log_scale{0};  ///< d phi / d log s
};

/// Cost: O(layers touched).
template <Real Scalar>
[[nodiscard]] LayeredGradient<Scalar> path_gradient(const LayeredMedium<Scalar>& medium,
                                                    const Path<Scalar>& path, const Scalar& z,
                                                    const Scalar& t);

/// The same for other fluxes (general_gradient.cpp); phi needs e'' of the laws.
template <Real Scalar>
[[nodiscard]] LayeredGradient<Scalar> path_gradient(const GeneralMedium<Scalar>& medium,
                                                    const Path<Scalar>& path, const Scalar& z,
                                                    const Scalar& t);

template <Real Scalar>
struct ExponentialGradient {
  Scalar M_log_rate{0}, phi_log_rate{0};  ///< with respect to log(s amplitude)
  Scalar M_decay{0}, phi_decay{0};
  StartMomentum<Scalar> start;
  Scalar phi_start{0};  ///< d phi / d (height of the source), fan kind
  Scalar phi_state{0};  ///< d phi / d (initial state), constant kind
};

/// Cost: O(1).
template <Real Scalar>
[[nodiscard]] ExponentialGradient<Scalar> path_gradient(const ExponentialMedium<Scalar>& medium,
                                                        const Path<Scalar>& path, const Scalar& z,
                                                        const Scalar& t);

}  // namespace shearfront::exact
