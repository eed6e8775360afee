// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>

#include "shearfront/model/depth/model.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// Derivatives of a at both ends of an interval without a knot inside, the ends held fixed: add(entry, by low, by high). By
/// end_value_derivatives() of the model if it has it, else by differences of fourth order as for harmonic means.
template <class Model, Real Scalar, class Add>
void for_each_end_derivative(const Model& model, const Scalar& lo, const Scalar& hi, const Add& add) {
  const auto ignore = [](std::size_t, const Scalar&) {};
  if constexpr (requires { model.end_value_derivatives(lo, hi, ignore, ignore); }) {
    end_value_derivatives(
        model, lo, hi, [&](std::size_t entry, const Scalar& by) { add(entry, by, Scalar(0)); },
        [&](std::size_t entry, const Scalar& by) { add(entry, Scalar(0), by); });
  } else {
    Model moved = model;
    const auto places = model_entries(moved);
    const auto knots = model.knots();
    const auto entry_of = knot_entries(model);
    const Scalar unit = std::ldexp(1.0, -std::numeric_limits<Scalar>::digits / 5 - 2);
    for (std::size_t e = 0; e < places.size(); ++e) {
      const Scalar here = *places[e], size = here < 0 ? Scalar(-here) : here;
      int side = 1;  // a knot at an end moves out of the interval
      for (std::size_t i = 0; i < knots.size(); ++i)
        if (entry_of[i] == e && !(lo < knots[i])) side = -1;
      const Scalar h = (size > 0 ? size : Scalar(1)) * unit * Scalar(side);
      const auto by = [&](const Scalar& z) {
        const auto at = [&](int n) {
          *places[e] = here + h * Scalar(n);
          return Scalar(moved.value(z));
        };
        const Scalar change = Scalar(-25) * at(0) + Scalar(48) * at(1) - Scalar(36) * at(2) +
                              Scalar(16) * at(3) - Scalar(3) * at(4);
        *places[e] = here;
        return Scalar(change / (Scalar(12) * h));
      };
      add(e, by(lo), by(hi));
    }
  }
}

/// da/dz at both ends, seen from inside; by one-sided differences of fourth order where neither a nor log a is linear.
template <class Model, Real Scalar>
EndValues<Scalar> end_slopes(const Model& model, const Scalar& lo, const Scalar& hi) {
  if constexpr (requires { requires Model::kIsLinear; }) {
    const auto ends = end_values(model, lo, hi);
    const Scalar slope = (ends.high - ends.low) / (hi - lo);
    return {slope, slope};
  } else if constexpr (requires { requires Model::kIsExponential; }) {
    using std::log;
    const auto ends = end_values(model, lo, hi);
    const Scalar bend = log(Scalar(ends.high / ends.low)) / (hi - lo);
    return {bend * ends.low, bend * ends.high};
  } else {
    const Scalar h = (hi - lo) * Scalar(std::ldexp(1.0, -std::numeric_limits<Scalar>::digits / 5 - 2));
    const auto slope = [&](const Scalar& z, const Scalar& step) {
      const auto at = [&](int n) { return Scalar(model.value(Scalar(z + step * Scalar(n)))); };
      return Scalar((Scalar(-25) * at(0) + Scalar(48) * at(1) - Scalar(36) * at(2) + Scalar(16) * at(3) -
                     Scalar(3) * at(4)) /
                    (Scalar(12) * step));
    };
    return {slope(lo, h), slope(hi, Scalar(-h))};
  }
}

}  // namespace shearfront::exact
