// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/model/flux/burgers.hpp"
#include "shearfront/model/flux/cubic.hpp"
#include "shearfront/model/flux/flux.hpp"
#include "shearfront/model/flux/lwr.hpp"
#include "shearfront/model/flux/lwr_cubic.hpp"
#include "shearfront/model/flux/quadratic.hpp"
#include "shearfront/model/flux/richardson_zaki.hpp"
#include "shearfront/model/flux/table.hpp"
#include "shearfront/model/flux/triangular.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront {

namespace detail {
template <class Model, class... Others, class AnyFlux, class Visit>
decltype(auto) with_model_of(TypeList<Model, Others...>, const AnyFlux& flux, Visit& visit) {
  if constexpr (sizeof...(Others) > 0)
    if (!flux.template as<Model>()) return with_model_of(TypeList<Others...>{}, flux, visit);
  const Model* model = flux.template as<Model>();
  SHEARFRONT_EXPECTS(model, "a flux of the list");
  return visit(*model);
}
}  // namespace detail

/// Every flux of the toolkit. To add one: copy skeleton.hpp, include it here, and name it in the list.
template <Real Scalar>
using FluxList = TypeList<Quadratic<Scalar>, Cubic<Scalar>, Lwr<Scalar>, LwrCubic<Scalar>, Triangular<Scalar>,
                          RichardsonZaki<Scalar>, Burgers<Scalar>, FluxTable<Scalar>>;

/// Calls visit(model) for the model that a flux holds: for loops that evaluate it many times.
template <Real Scalar, class Visit>
decltype(auto) with_model(const Flux<Scalar>& flux, Visit&& visit) {
  return detail::with_model_of(FluxList<Scalar>{}, flux, visit);
}

}  // namespace shearfront
