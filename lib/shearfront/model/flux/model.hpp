// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <string_view>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// convex: f' never falls; concave: f' never rises; mixed: neither, so waves can be compounds of fans and
/// shocks.
enum class Curvature { convex, concave, mixed };

/// The states a flux is defined for.
template <Real Scalar>
struct StateRange {
  Scalar lowest{0}, highest{1};
};

/// What every model of a flux f(phi) offers. range(), extrema() and curvature() may depend on its entries;
/// they mean something only when check() has found nothing wrong with those.
///
///   value, derivative   f and f' (at a kink of f the slope above it)
///   secant(p, q)        (f(q) - f(p)) / (q - p) without cancellation, f'(p) where p == q
///   extrema             interior extrema of f, ascending
///   range, kStates      the states, as numbers and as text for `shearfront list`
///   kIsParabola         f = 4 f(m) u (1 - u) with u the place of phi in its range and m the extremum: the
///                       engines then use the closed forms of the quadratic flux
///   second_derivative   f'', only if the model has it: otherwise engines take differences of f'
///   joints              places inside the range where f is not analytic, only if there are some: engines cut integrals there
///   kDegree             between extrema and joints f is a polynomial of this degree, at most 3, only if it is: the exact engine then works
///                       with its coefficients
///
/// A flux that is one polynomial of degree two for all real states without being such a parabola says so by
/// kIsQuadraticPolynomial = true.
template <class F, class Scalar>
concept FluxModel = Real<Scalar> && requires(const F& f, const Scalar& phi) {
  { F::kName } -> std::convertible_to<std::string_view>;
  { F::kFormula } -> std::convertible_to<std::string_view>;
  { F::kStates } -> std::convertible_to<std::string_view>;
  { F::kIsParabola } -> std::convertible_to<bool>;
  { f.range() } -> std::same_as<StateRange<Scalar>>;
  { f.extrema() } -> std::same_as<std::vector<Scalar>>;
  { f.curvature() } -> std::same_as<Curvature>;
  { f.value(phi) } -> std::convertible_to<Scalar>;
  { f.derivative(phi) } -> std::convertible_to<Scalar>;
  { f.secant(phi, phi) } -> std::convertible_to<Scalar>;
};

/// Whether f is a straight line from p to q, as far as its slopes can tell; contacts then travel between the states.
template <class F, class Scalar>
[[nodiscard]] bool is_straight(const F& f, const Scalar& p, const Scalar& q) {
  const Scalar third = p + (q - p) / Scalar(3), middle = p + (q - p) / Scalar(2);
  const Scalar slope = f.secant(p, q);
  const Scalar rounding = Scalar(64) * unit_roundoff<Scalar>() * (slope < 0 ? Scalar(-slope) : slope);
  const auto equal = [&](const Scalar& other) {
    return other - slope <= rounding && slope - other <= rounding;
  };
  return equal(f.secant(p, third)) && equal(f.secant(p, middle)) && equal(f.secant(middle, q));
}

/// Of polynomials between extrema and joints; large for any other flux.
template <class F>
[[nodiscard]] constexpr int degree_between_joints() {
  if constexpr (requires { F::kDegree; }) return F::kDegree;
  return F::kIsParabola ? 2 : 1 << 20;
}

template <class F>
[[nodiscard]] constexpr bool is_quadratic_polynomial() {
  if constexpr (requires { F::kIsQuadraticPolynomial; }) return F::kIsQuadraticPolynomial;
  return F::kIsParabola;
}

}  // namespace shearfront
