// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// One piece of a piecewise constant state of the bed: from the top of the piece before it up to `top`,
/// inside `layer`.
template <Real Scalar>
struct Piece {
  std::size_t layer;
  Scalar top;
  State state;
};

}  // namespace shearfront
