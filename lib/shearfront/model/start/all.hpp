// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/start/kink.hpp"
#include "shearfront/model/start/sine.hpp"
#include "shearfront/model/start/table.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every smooth initial state phi(z, 0) / c(z). To add one: copy skeleton.hpp, include it here, and name it in the list.
template <Real Scalar>
using InitialStateList = TypeList<KinkInitial<Scalar>, SineInitial<Scalar>, TableInitial<Scalar>>;

template <Real Scalar>
using InitialState = typename InitialStateList<Scalar>::Variant;

}  // namespace shearfront
