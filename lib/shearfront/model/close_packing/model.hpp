// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// What every law of random close packing offers: the largest part of the volume that a random mixture of
/// small and large grains can fill, as a function of the share x of small grains in it.
///
///   value(x)       c_rcp(x), positive and continuous for x in [0, 1]
///   derivative(x)  its slope; at a kink that above it
///   kinks          where its slope jumps, ascending
template <class Law, class Scalar>
concept ClosePackingLaw = Real<Scalar> && requires(const Law& law, const Scalar& x) {
  { Law::kName } -> std::convertible_to<std::string_view>;
  { Law::kFormula } -> std::convertible_to<std::string_view>;
  { law.value(x) } -> std::convertible_to<Scalar>;
  { law.derivative(x) } -> std::convertible_to<Scalar>;
  { law.kinks() } -> std::same_as<std::vector<Scalar>>;
};

/// Random close packing of equal spheres.
template <Real Scalar>
[[nodiscard]] Scalar packing_of_spheres() {
  return Scalar(633) / Scalar(1000);
}

}  // namespace shearfront
