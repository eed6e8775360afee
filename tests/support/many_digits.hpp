// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront::support {

/// What rounding does to the exact solution: M and phi at random places of a scene of height and time about 1, against the
/// same in 110 digits. `where` names the scene when they differ.
inline void expect_same_in_many_digits(const Scene<double>& scene, SceneMaker& make, int n_places,
                                       double M_rounding, double phi_rounding, const std::string& where) {
  const ExactSolution<double> exact(scene);
  const ExactSolution<Real110> precise(scene_cast<Real110>(scene));
  for (int i = 0; i < n_places; ++i) {
    const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 1));
    const auto mine = exact.at(z, t);
    const auto theirs = precise.at(Real110(z), Real110(t));
    EXPECT_NEAR(mine.M, to_double(theirs.M), M_rounding) << where << " z " << z << " t " << t;
    EXPECT_NEAR(mine.phi, to_double(theirs.phi), phi_rounding) << where << " z " << z << " t " << t;
  }
}

}  // namespace shearfront::support
