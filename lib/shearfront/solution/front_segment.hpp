// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// One front of a front-tracking solution from its birth to its end: a straight segment of the (t, z) plane
/// with the states on both sides. Interfaces and walls are not fronts and appear in no list of segments.
template <Real Scalar>
struct FrontSegment {
  std::size_t layer;
  Scalar t_begin, z_begin, t_end, z_end;
  Scalar phi_below, phi_above;
};

}  // namespace shearfront
