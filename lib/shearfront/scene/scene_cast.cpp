// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/scene_cast.hpp"

namespace shearfront {

template Scene<Real50> scene_cast(const Scene<double>&);
template Scene<double> scene_cast(const Scene<Real50>&);

}  // namespace shearfront
