// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/track/layer_state.hpp"
#include "shearfront/track/piece.hpp"

namespace shearfront {

/// The initial state of a scene cut at jumps and interfaces: for each piece its layer, its top and phi / c.
template <Real Scalar>
struct InitialPieces {
  std::vector<LayerState<Scalar>> states;  ///< one per piece, bottom to top
  std::vector<Scalar> tops;
};

/// Cuts the initial data of `scene` by the layers of `stack`. A jump on an interface makes one cut, not two.
/// Cost: O(jumps + layers).
template <Real Scalar>
[[nodiscard]] InitialPieces<Scalar> initial_pieces(const Scene<Scalar>& scene,
                                                   const LayerStack<Scalar>& stack) {
  InitialPieces<Scalar> pieces;
  const std::vector<Scalar>& breaks = scene.initial_breaks();
  std::size_t jump = 0;
  for (std::size_t k = 0; k < stack.n_layers(); ++k) {
    const Scalar& top = stack.boundary(k + 1);
    while (jump < breaks.size() && breaks[jump] < top) {
      if (breaks[jump] > stack.boundary(k)) {
        pieces.states.push_back({k, scene.initial_values()[jump]});
        pieces.tops.push_back(breaks[jump]);
      }
      ++jump;
    }
    pieces.states.push_back({k, scene.initial_values()[jump]});
    pieces.tops.push_back(top);
  }
  return pieces;
}

/// The pieces with the states of a grid, ready for a Tracker. `states`, of which the first are those of the
/// pieces, comes from the grid's factory function.
template <Real Scalar>
[[nodiscard]] std::vector<Piece<Scalar>> on_grid(const InitialPieces<Scalar>& pieces,
                                                 const std::vector<State>& states) {
  std::vector<Piece<Scalar>> result(pieces.states.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {pieces.states[i].layer, pieces.tops[i], states[i]};
  return result;
}

}  // namespace shearfront
