// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/flux/quadratic.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every flux of the toolkit. To add one: copy skeleton.hpp, include it here, and name it in the list.
using FluxList = TypeList<Quadratic>;
using Flux = FluxList::Variant;

}  // namespace shearfront
