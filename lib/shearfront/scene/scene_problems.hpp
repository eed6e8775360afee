// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/input_error.hpp"
#include "shearfront/scene/scene_spec.hpp"

namespace shearfront {

/// All that is wrong with a specification, in the order of the entries of a scene file; empty if nothing is.
template <Real Scalar>
[[nodiscard]] Problems find_problems(const SceneSpec<Scalar>& spec);

extern template Problems find_problems(const SceneSpec<double>&);
extern template Problems find_problems(const SceneSpec<Real50>&);
extern template Problems find_problems(const SceneSpec<Real110>&);

}  // namespace shearfront
