// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/flux/burgers.hpp"
#include "shearfront/model/flux/cubic.hpp"
#include "shearfront/model/flux/lwr.hpp"
#include "shearfront/model/flux/lwr_cubic.hpp"
#include "shearfront/model/flux/quadratic.hpp"
#include "shearfront/model/flux/richardson_zaki.hpp"
#include "shearfront/model/flux/table.hpp"
#include "shearfront/model/flux/triangular.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

/// Every flux of the toolkit. To add one: copy skeleton.hpp, include it here, and name it in the list.
template <Real Scalar>
using FluxList = TypeList<Quadratic<Scalar>, Cubic<Scalar>, Lwr<Scalar>, LwrCubic<Scalar>, Triangular<Scalar>,
                          RichardsonZaki<Scalar>, Burgers<Scalar>, FluxTable<Scalar>>;

template <Real Scalar>
using Flux = typename FluxList<Scalar>::Variant;

/// unit_parabola_sign() of any flux.
template <Real Scalar>
[[nodiscard]] int unit_parabola_sign(const Flux<Scalar>& flux) {
  return std::visit([](const auto& f) { return unit_parabola_sign(f); }, flux);
}

}  // namespace shearfront
