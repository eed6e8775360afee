// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/model/complaint.hpp"
#include "shearfront/scene/scene_spec.hpp"

namespace shearfront {

/// All that is wrong with a specification, in the order of the entries of a scene file; empty if nothing is.
template <Real Scalar>
[[nodiscard]] Complaints find_complaints(const SceneSpec<Scalar>& spec);

}  // namespace shearfront
