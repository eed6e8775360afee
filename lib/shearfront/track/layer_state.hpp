// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A state wanted in a grid: share phi / c, a state of the layer's flux, in one layer.
template <Real Scalar>
struct LayerState {
  std::size_t layer;
  Scalar phi;
};

}  // namespace shearfront
