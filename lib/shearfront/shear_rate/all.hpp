// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/numeric/type_list.hpp"
#include "shearfront/shear_rate/chute.hpp"
#include "shearfront/shear_rate/exponential.hpp"
#include "shearfront/shear_rate/piecewise.hpp"
#include "shearfront/shear_rate/table.hpp"

namespace shearfront {

/// Every shear-rate model a(z). To add one: copy skeleton.hpp, include it here, and name it in the list.
template <Real Scalar>
using ShearRateList = TypeList<Piecewise<Scalar>, Exponential<Scalar>, Table<Scalar>, Chute<Scalar>>;

template <Real Scalar>
using ShearRate = typename ShearRateList<Scalar>::Variant;

}  // namespace shearfront
