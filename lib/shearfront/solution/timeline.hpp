// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// The event times an experimenter looks for (May et al. 2010, Section 3). A time that never comes is empty.
///
///   t0      first wave at the bottom wall: phi next to the wall leaves its initial value. 0 if the wall
///           itself sends out a wave at once (initial phi there is neither 0 nor 1), empty if it never changes.
///   t1      the same at the top wall.
///   first   first wave at an interface: 0 if the initial states there are not at rest.
///   last    last wave at an interface: afterwards phi keeps its final value on both sides. Empty if there is
///           none at all.
///   t_star  steady time: nothing moves any more. 0 if the initial state is steady.
template <Real Scalar>
struct Timeline {
  struct InterfaceTimes {
    Scalar z;
    std::optional<Scalar> first, last;
  };
  std::optional<Scalar> t0, t1, t_star;
  std::vector<InterfaceTimes> interfaces;  ///< breaks of a(z), bottom to top; none for smooth a(z)
  Scalar mass{0};                          ///< int phi dz
  Scalar steady_height{0};                 ///< bottom + mass: phi = 1 below it and 0 above in the end
};

}  // namespace shearfront
