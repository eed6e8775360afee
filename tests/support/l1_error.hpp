// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/hopf_lax/exact_solution.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront::support {

/// Errors of a profile against the exact solution at time t.
struct ProfileErrors {
  double l1 = 0;     ///< int |phi - exact|
  double M_max = 0;  ///< largest |M - exact M| at the edges of the profile's cells
};

/// The L1 error without quadrature: on a piece where phi - exact keeps its sign its integral is a difference
/// of M, and M is exact on both sides. Every cell is cut into at least `cuts` pieces no wider than `widest`;
/// a piece in which the sign changes counts too little by a part of itself only, so the sum converges from
/// below as pieces shrink.
inline ProfileErrors errors_against(const ExactSolution<double>& exact, const Profile<double>& profile,
                                    double t, int cuts = 4, double widest = 2.5e-3) {
  ProfileErrors errors;
  double z = profile.z().front();
  double last = 0;
  for (std::size_t i = 0; i < profile.n_cells(); ++i) {
    const double begin = profile.z()[i], width = profile.z()[i + 1] - begin;
    if (!(width > 0)) continue;
    const int n = std::max(cuts, static_cast<int>(std::ceil(width / widest)));
    for (int j = 1; j <= n; ++j) {
      z = j == n ? profile.z()[i + 1] : begin + width * j / n;
      const double d = z - begin;
      const double slope = (profile.above()[i] - profile.below()[i]) / width;
      const double M = profile.cumulative()[i] + d * (profile.below()[i] + slope * d / 2);
      const double difference = M - exact.M(z, t);
      errors.l1 += std::abs(difference - last);
      last = difference;
    }
    errors.M_max = std::max(errors.M_max, std::abs(last));
  }
  return errors;
}

}  // namespace shearfront::support
