// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// How the rate r = s a runs between the ends of a piece: r(z) = r_1 + bend (z - z_1), or r_1 exp(bend (z - z_1)). A constant
/// one is linear.
enum class RateForm : std::uint8_t { linear, exponential };

/// The bend of a piece: slope, or slope of log r.
template <Real Scalar>
[[nodiscard]] Scalar bend_between(RateForm form, const Scalar& low, const Scalar& high, const Scalar& width) {
  using std::log;
  return form == RateForm::linear ? Scalar((high - low) / width) : Scalar(log(Scalar(high / low)) / width);
}

/// What r gains from where it is `rate` to a place `d` higher (lower where d < 0).
template <Real Scalar>
[[nodiscard]] Scalar rise_of(RateForm form, const Scalar& bend, const Scalar& rate, const Scalar& d) {
  using std::expm1;
  return form == RateForm::linear ? Scalar(bend * d) : Scalar(rate * expm1(Scalar(bend * d)));
}

/// The distance over which r gains `rise` from where it is `rate`: the inverse.
template <Real Scalar>
[[nodiscard]] Scalar distance_of(RateForm form, const Scalar& bend, const Scalar& rate, const Scalar& rise) {
  using std::log1p;
  return form == RateForm::linear ? Scalar(rise / bend) : Scalar(log1p(Scalar(rise / rate)) / bend);
}

/// dr/dz where r is `rate`.
template <Real Scalar>
[[nodiscard]] Scalar slope_at(RateForm form, const Scalar& bend, const Scalar& rate) {
  return form == RateForm::linear ? bend : Scalar(bend * rate);
}

}  // namespace shearfront::exact
