// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/scene/chute.hpp"
#include "shearfront/solution/field.hpp"

namespace shearfront {

/// int_bottom^z phi dz in a steady chute at many heights, in any order: Field::volumes from the field of its bed.
///
/// Over a part of the chute in which the mean velocity is U and the flow of grains Delta M
///
///     int phi dz = Delta M / U + int phi (1 - u / U) dz :
///
/// the first term is as exact as M, the second is small of the order of the part and vanishes where u or phi is
/// constant. It is found by Gauss-Kronrod quadrature; parts are halved until what is left is below kTolerance of the height, which
/// at a jump of phi, where a part counts with the square of its height, takes some twenty halvings. u may vanish at the bottom.
/// Guarantee: as exact as phi and M of the field, up to kTolerance. Cost: 15 samples for each part, 300 for each jump; of
/// a field with profiles its cells are the parts.
struct ChuteVolume {
  static constexpr double kTolerance = 1e-13;
  static constexpr int kMostHalvings = 40;
};
[[nodiscard]] std::vector<double> chute_volumes(const SteadyChute<double>& chute, const Field& bed,
                                                const std::vector<double>& heights);

}  // namespace shearfront
