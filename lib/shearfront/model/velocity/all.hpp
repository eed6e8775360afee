// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/velocity/bagnold.hpp"
#include "shearfront/model/velocity/linear.hpp"
#include "shearfront/model/velocity/table.hpp"
#include "shearfront/model/velocity/uniform.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every velocity profile u(z). To add one: copy skeleton.hpp, include it here, and name it in the list.
template <Real Scalar>
using VelocityList =
    TypeList<UniformVelocity<Scalar>, LinearVelocity<Scalar>, TableVelocity<Scalar>, BagnoldVelocity<Scalar>>;

template <Real Scalar>
using Velocity = typename VelocityList<Scalar>::Variant;

}  // namespace shearfront
