// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/hopf_lax/exponential_medium.hpp"
#include "shearfront/hopf_lax/layered_medium.hpp"
#include "shearfront/hopf_lax/sensitivities.hpp"

/// Derivatives along one path; building blocks of sensitivities().
namespace shearfront::hopf_lax {

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
  Pair start;                    ///< height of the source; M without the change of the initial M
  Scalar phi_start{0};           ///< d phi / d (initial state), constant kind
};

/// Cost: O(layers touched).
template <Real Scalar>
[[nodiscard]] LayeredGradient<Scalar> path_gradient(const LayeredMedium<Scalar>& medium,
                                                    const Candidate<Scalar>& path, const Scalar& z,
                                                    const Scalar& t);

template <Real Scalar>
struct ExponentialGradient {
  Scalar M_log_rate{0}, phi_log_rate{0};  ///< with respect to log(s amplitude)
  Scalar M_decay{0}, phi_decay{0};
  Scalar M_start{0}, phi_start{0};  ///< height of the source; M without the change of the initial M
  Scalar phi_state{0};              ///< d phi / d (initial state), constant kind
};

/// Cost: O(1).
template <Real Scalar>
[[nodiscard]] ExponentialGradient<Scalar> path_gradient(const ExponentialMedium<Scalar>& medium,
                                                        const Candidate<Scalar>& path, const Scalar& z,
                                                        const Scalar& t);

}  // namespace shearfront::hopf_lax
