// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fit/misfit/bed_height.hpp"
#include "shearfront/fit/misfit/bin.hpp"
#include "shearfront/fit/misfit/cumulative.hpp"
#include "shearfront/fit/misfit/point.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront::fit {

/// Every way to compare a solution with observations. To add one: copy skeleton.hpp, include it here, and
/// name it in the list.
using MisfitList = TypeList<PointMisfit, BinMisfit, CumulativeMisfit, BedHeightMisfit>;

}  // namespace shearfront::fit
