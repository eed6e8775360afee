// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::diffusion {

/// An exact solution with diffusion at one place and time.
template <Real Scalar>
struct ColeHopfPoint {
  Scalar phi;         ///< concentration
  Scalar complement;  ///< 1 - phi, accurate also where phi is within rounding of 1
  Scalar cumulative;  ///< M(z, t) = int_bottom^z phi
  Scalar gradient;    ///< phi_z
};

}  // namespace shearfront::diffusion
