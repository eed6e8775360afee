// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/scene.hpp"

namespace shearfront {

template class Scene<double>;
template class Scene<Real50>;
template class Scene<Real110>;

}  // namespace shearfront
