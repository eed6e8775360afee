// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"

/// What a tracker starts from: states wanted of a grid, pieces of the bed, and what lies beyond its ends.
namespace shearfront {

/// A state wanted in a grid: share phi / c, a state of the layer's flux, in one layer.
template <Real Scalar>
struct LayerState {
  std::size_t layer;
  Scalar phi;
};

/// One piece of a piecewise constant state of the bed: from the top of the piece before it up to `top`,
/// inside `layer`.
template <Real Scalar>
struct Piece {
  std::size_t layer;
  Scalar top;
  State state;
};

/// What lies beyond the bottom (0) and the top (1) of the bed: a wall, a state, or the other end.
template <Real Scalar>
struct Ends {
  /// From t on the state beyond this end is another one.
  struct Change {
    Scalar t;
    std::size_t end;
    State state;
  };

  std::array<std::optional<State>, 2> outside{};  ///< a state of the outermost layer; none: a wall
  std::vector<Change> changes{};                  ///< ascending in t
  bool is_periodic = false;                       ///< what leaves at one end comes in at the other
};

}  // namespace shearfront
