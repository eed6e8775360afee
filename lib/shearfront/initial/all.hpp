// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/initial/kink.hpp"
#include "shearfront/initial/sine.hpp"
#include "shearfront/initial/table.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every smooth initial profile phi(z, 0), for beds with diffusion. To add one: copy skeleton.hpp, include it
/// here, and name it in the list.
template <Real Scalar>
using InitialProfileList = TypeList<KinkInitial<Scalar>, SineInitial<Scalar>, TableInitial<Scalar>>;

template <Real Scalar>
using InitialProfile = typename InitialProfileList<Scalar>::Variant;

}  // namespace shearfront
