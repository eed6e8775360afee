// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <variant>

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

template <Real Scalar>
[[nodiscard]] Scalar value(const DepthFunction<Scalar>& function, const Scalar& z) {
  return std::visit([&](const auto& model) { return Scalar(model.value(z)); }, function);
}
template <Real Scalar>
[[nodiscard]] bool is_constant_in_pieces(const DepthFunction<Scalar>& function) {
  return std::visit([](const auto& model) { return bool(model.kIsLayered); }, function);
}
/// One that is not given is constant.
template <Real Scalar>
[[nodiscard]] bool is_constant_in_pieces(const std::optional<DepthFunction<Scalar>>& function) {
  return !function || is_constant_in_pieces<Scalar>(*function);
}
/// At both ends of an interval without a knot inside, as seen from within.
template <Real Scalar>
[[nodiscard]] EndValues<Scalar> end_values_of(const DepthFunction<Scalar>& function, const Scalar& lo,
                                              const Scalar& hi) {
  return std::visit(
      [&](const auto& model) -> EndValues<Scalar> {
        if (model.kIsLayered) return {model.value(lo), model.value(lo)};
        return end_values(model, lo, hi);
      },
      function);
}

}  // namespace shearfront
