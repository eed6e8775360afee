// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/depth/bagnold.hpp"
#include "shearfront/model/depth/chute.hpp"
#include "shearfront/model/depth/exponential.hpp"
#include "shearfront/model/depth/kinetic.hpp"
#include "shearfront/model/depth/piecewise.hpp"
#include "shearfront/model/depth/scaling.hpp"
#include "shearfront/model/depth/table.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every depth function: what a(z), c(z), T(z) and D(z) may be. To add one: copy skeleton.hpp, include it here,
/// and name it in the list.
template <Real Scalar>
using DepthFunctionList =
    TypeList<Piecewise<Scalar>, Exponential<Scalar>, Table<Scalar>, Chute<Scalar>, Kinetic<Scalar>,
             Bagnold<Scalar>, Scaling<VelocityPoints<Scalar>>, Scaling<Table<Scalar>>,
             Scaling<Exponential<Scalar>>, Scaling<KineticShear<Scalar>>, Scaling<Bagnold<Scalar>>>;

template <Real Scalar>
using DepthFunction = typename DepthFunctionList<Scalar>::Variant;

}  // namespace shearfront
