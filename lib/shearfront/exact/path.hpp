// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// How a path that ends in (z, t) begins.
enum class PathKind : std::uint8_t {
  none,         ///< no path (value +infinity)
  bottom_wall,  ///< leaves the bottom with phi = 1, H = 0
  top_wall,     ///< leaves the top with phi = 0, H = 0
  fan,          ///< leaves an initial jump or an interface at t = 0 and never rests
  waiting,      ///< as fan, but rests at an interface at its capacity H = s min(a_below, a_above) / 4
  constant      ///< leaves the inside of an initial state that is constant, or curved
};

/// One admissible path of the Lax-Hopf formula: M(z, t) is the least value over all of them.
template <Real Scalar>
struct Path {
  Scalar value = infinity<Scalar>();  ///< initial cumulative at the start + cost of the path
  Scalar p{0};                        ///< dM/dz at its end, the concentration if this path is the best
  Scalar H{0};                        ///< conserved along the path, dM/dt at its end
  PathKind kind = PathKind::none;
  bool upward = false;     ///< arrives from below
  bool turned = false;     ///< sloped pieces: it set out the other way and has turned
  bool is_state = false;   ///< waiting: `source` is the cell of Cells inside which it starts
  std::size_t source = 0;  ///< fan, waiting: point of Cells; constant: cell of Cells
  std::size_t interface =
      0;           ///< waiting: boundary index of the interface; sloped pieces: point of Cells where it
                   ///< rests; turned: cell where it turns
  Scalar foot{0};  ///< height where it starts
  /// Layered media: 4 H = r_reference (1 - x^2), so that what layer k lacks to its capacity,
  /// (r_k - r_reference + r_reference x^2) / r_k, keeps its accuracy near the capacity, where H alone does not.
  Scalar r_reference{0}, x{1};
  /// r_reference - 4 H.
  [[nodiscard]] Scalar lost() const { return r_reference * x * x; }

  /// Smaller value first; at a tie (a shock passes through z) the smaller p, which is the state above.
  [[nodiscard]] bool better_than(const Path& other) const {
    return value < other.value || (value == other.value && p < other.p);
  }
};

/// What M(z, .) comes to in the end: z - bottom (phi = 1 all the way below z), the whole mass, or, at the
/// steady height, both.
enum class FinalAmount : std::uint8_t { full_below, all_mass, both };

}  // namespace shearfront::exact
