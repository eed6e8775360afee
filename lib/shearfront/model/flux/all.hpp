// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/flux/buckley_leverett.hpp"
#include "shearfront/model/flux/burgers.hpp"
#include "shearfront/model/flux/cubic.hpp"
#include "shearfront/model/flux/flux.hpp"
#include "shearfront/model/flux/lwr.hpp"
#include "shearfront/model/flux/lwr_cubic.hpp"
#include "shearfront/model/flux/quadratic.hpp"
#include "shearfront/model/flux/richardson_zaki.hpp"
#include "shearfront/model/flux/table.hpp"
#include "shearfront/model/flux/triangular.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

namespace detail {
template <class Model, class... Others, class AnyFlux, class Visit>
decltype(auto) with_model_of(TypeList<Model, Others...>, const AnyFlux& flux, Visit& visit) {
  if (const Model* model = flux.template as<Model>()) return visit(*model);
  if constexpr (sizeof...(Others) > 0)
    return with_model_of(TypeList<Others...>{}, flux, visit);
  else
    return visit(flux);
}
}  // namespace detail

/// Every flux of the toolkit. To add one: copy skeleton.hpp, include it here, and name it in the list.
template <Real Scalar>
using FluxList =
    TypeList<Quadratic<Scalar>, Cubic<Scalar>, Lwr<Scalar>, LwrCubic<Scalar>, Triangular<Scalar>,
             RichardsonZaki<Scalar>, BuckleyLeverett<Scalar>, Burgers<Scalar>, FluxTable<Scalar>>;

/// Calls visit(model) for the model that a flux holds: for loops that evaluate it many times. For a model that is not in
/// the list, one of a user of the library, it calls visit(flux): the same loop with a virtual call per evaluation.
template <Real Scalar, class Visit>
decltype(auto) with_model(const Flux<Scalar>& flux, Visit&& visit) {
  return detail::with_model_of(FluxList<Scalar>{}, flux, visit);
}

}  // namespace shearfront
