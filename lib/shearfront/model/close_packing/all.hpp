// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/close_packing/polynomial.hpp"
#include "shearfront/model/close_packing/table.hpp"
#include "shearfront/model/close_packing/upper_bound.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every law of random close packing. To add one: copy skeleton.hpp, include it here, name it in the list.
template <Real Scalar>
using ClosePackingList = TypeList<PackingPolynomial<Scalar>, PackingUpperBound<Scalar>, PackingTable<Scalar>>;

template <Real Scalar>
using ClosePacking = typename ClosePackingList<Scalar>::Variant;

}  // namespace shearfront
