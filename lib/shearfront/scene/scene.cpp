// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/scene.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

template class Scene<Instantiated>;

}  // namespace shearfront
