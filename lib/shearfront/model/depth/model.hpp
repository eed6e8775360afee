// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Properties of depth functions that a model may state and engines may ask of any: what a model leaves out is found
/// from value(), harmonic_mean() and knots(), more slowly.
namespace shearfront {

/// Whether a model says (kIsLinear) that a(z) is linear between its knots: the exact engine then takes it as it is.
template <class Model>
[[nodiscard]] constexpr bool is_linear_between_knots(const Model& /*model*/) {
  if constexpr (requires { Model::kIsLinear; })
    return Model::kIsLinear;
  else
    return false;
}

/// Likewise (kIsExponential) that log a(z) is.
template <class Model>
[[nodiscard]] constexpr bool is_exponential_between_knots(const Model& /*model*/) {
  if constexpr (requires { Model::kIsExponential; })
    return Model::kIsExponential;
  else
    return false;
}

/// Likewise (kIsRoot) that the square of a(z) is, and falls.
template <class Model>
[[nodiscard]] constexpr bool is_root_between_knots(const Model& /*model*/) {
  if constexpr (requires { Model::kIsRoot; })
    return Model::kIsRoot;
  else
    return false;
}

/// Whether a fit may choose all of its numbers to come close to a given a(z); a model whose numbers must be known of the flow and
/// the grains says kIsGuessable = false.
template <class Model>
[[nodiscard]] constexpr bool is_guessable(const Model& /*model*/) {
  if constexpr (requires { Model::kIsGuessable; })
    return Model::kIsGuessable;
  else
    return true;
}

/// Whether a(z) jumps at a knot: jumps_at() of the model if it has it; models that are constant between knots may at each.
template <class Model, class Scalar>
[[nodiscard]] bool may_jump_at(const Model& model, const Scalar& knot) {
  if constexpr (requires { model.jumps_at(knot); })
    return model.jumps_at(knot);
  else
    return Model::kIsLayered;
}

/// a(z) at both ends of an interval without a knot inside, as seen from within.
template <Real Scalar>
struct EndValues {
  Scalar low, high;
};
template <class Model, class Scalar>
[[nodiscard]] EndValues<Scalar> end_values(const Model& model, const Scalar& lo, const Scalar& hi) {
  if constexpr (requires { model.end_values(lo, hi); })
    return model.end_values(lo, hi);
  else
    return {model.value(lo), model.value(hi)};
}

/// Whether a(z) is 0 at an end of the domain, and only there: vanishes_at() of the model if it has it. It must then reach 0 no
/// faster than a power below 1 of the distance, so that grains reach that end.
template <class Model, class Scalar>
[[nodiscard]] bool may_vanish_at(const Model& model, const Scalar& end) {
  if constexpr (requires { model.vanishes_at(end); })
    return model.vanishes_at(end);
  else
    return false;
}

/// Tells a model that has prepare() the ends of the domain: what depends on them, or takes long, is found once there, and shared by copies.
template <class Model, class Scalar>
void prepare(Model& model, const Scalar& bottom, const Scalar& top) {
  if constexpr (requires { model.prepare(bottom, top); }) model.prepare(bottom, top);
}

/// The shear rate that a model makes a(z) of, where that is another one: shear_rate() of the model if it has it.
template <class Model, class Scalar>
[[nodiscard]] Scalar shear_rate_of(const Model& model, const Scalar& z) {
  if constexpr (requires { model.shear_rate(z); })
    return model.shear_rate(z);
  else
    return model.value(z);
}

/// Derivatives of end_values, the ends held fixed: calls add_low(entry, derivative) and add_high(entry, derivative), entries in
/// the order of fields(); a knot at an end moves out of the interval. Models that are linear or exponential between knots have
/// it.
template <class Model, class Scalar, class AddLow, class AddHigh>
void end_value_derivatives(const Model& model, const Scalar& lo, const Scalar& hi, AddLow&& add_low,
                           AddHigh&& add_high) {
  model.end_value_derivatives(lo, hi, add_low, add_high);
}

/// 1 / (1 - e^-h) - 1 / h, from 1/2 at h = 0 to 1: where in an interval, as a part of it, the slowness e^(z / decay) has
/// its centre of mass. By its series 1/2 + h / 12 - h^3 / 720 + ... where the terms cancel.
template <Real Scalar>
[[nodiscard]] Scalar exponential_mean_place(const Scalar& h) {
  using std::expm1;
  if (h > Scalar(0.5)) return Scalar(-1) / expm1(Scalar(-h)) - Scalar(1) / h;
  // (h - 1 + e^-h) / (h (1 - e^-h)): numerator and denominator over h^2 as power series of the same sign.
  Scalar top(0), term(0.5);
  for (int n = 3; n < 200; ++n) {
    top += term;
    term *= -h / Scalar(n);
    if (!((term < 0 ? Scalar(-term) : term) > unit_roundoff<Scalar>() * top)) break;
  }
  return h > 0 ? Scalar(top * (h / -expm1(Scalar(-h)))) : top;
}

/// Places of the entries of a model, in the order of fields(); valid while the model is not changed otherwise.
template <class Model>
[[nodiscard]] auto model_entries(Model& model) {
  using Scalar = std::remove_cvref_t<decltype(model.value({}))>;
  std::vector<Scalar*> places;
  Model::fields(model, [&](const FieldInfo&, auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, Scalar>) {
      places.push_back(&member);
    } else {
      for (Scalar& x : member) places.push_back(&x);
    }
  });
  return places;
}

/// The entry of the model that each knot is, in the order of knots(); kNoEntry for knots that are none. By
/// knot_entries() if the model has it, else by moving each entry: O(entries (entries + knots)).
inline constexpr std::size_t kNoEntry = static_cast<std::size_t>(-1);
template <class Model>
[[nodiscard]] std::vector<std::size_t> knot_entries(const Model& model) {
  if constexpr (requires { model.knot_entries(); }) {
    return model.knot_entries();
  } else {
    using Scalar = std::remove_cvref_t<decltype(model.value({}))>;
    const auto knots = model.knots();
    std::vector<std::size_t> found(knots.size(), kNoEntry);
    Model moved = model;
    const auto places = model_entries(moved);
    for (std::size_t e = 0; e < places.size(); ++e) {
      const Scalar here = *places[e];
      *places[e] = here + Scalar(1) / Scalar(1 << 20);
      const auto other = moved.knots();
      for (std::size_t i = 0; i < knots.size() && i < other.size(); ++i)
        if (knots[i] == here && other[i] == *places[e]) found[i] = e;
      *places[e] = here;
    }
    return found;
  }
}

/// Derivatives of harmonic_mean(lo, hi), the ends held fixed: calls add(entry, derivative) for every entry, in the order
/// of fields(), that has one. By harmonic_mean_derivatives(lo, hi, add) if the model has it, else by differences of
/// fourth order with steps of 2^(-p/5 - 2): relative error about 1e-12 in double. Precondition: no knot inside;
/// a knot at an end moves away from the interval.
template <class Model, class Scalar, class Add>
void harmonic_mean_derivatives(const Model& model, const Scalar& lo, const Scalar& hi, Add&& add) {
  if constexpr (requires { model.harmonic_mean_derivatives(lo, hi, add); }) {
    model.harmonic_mean_derivatives(lo, hi, add);
  } else {
    Model moved = model;
    const auto places = model_entries(moved);
    const auto knots = model.knots();
    const auto entry_of = knot_entries(model);
    const Scalar unit = std::ldexp(1.0, -std::numeric_limits<Scalar>::digits / 5 - 2);
    for (std::size_t e = 0; e < places.size(); ++e) {
      const Scalar here = *places[e];
      int side = 0;
      for (std::size_t i = 0; i < knots.size(); ++i)
        if (entry_of[i] == e) side = !(lo < knots[i]) ? -1 : !(knots[i] < hi) ? 1 : 0;
      const Scalar size = here < 0 ? Scalar(-here) : here;
      const Scalar h = (size > 0 ? size : Scalar(1)) * unit;
      const auto at = [&](int steps) {
        *places[e] = here + h * Scalar(steps);
        return Scalar(moved.harmonic_mean(lo, hi));
      };
      const Scalar change =
          side == 0 ? Scalar(Scalar(8) * (at(1) - at(-1)) - (at(2) - at(-2)))
                    : Scalar(Scalar(side) *
                             (Scalar(-25) * at(0) + Scalar(48) * at(side) - Scalar(36) * at(2 * side) +
                              Scalar(16) * at(3 * side) - Scalar(3) * at(4 * side)));
      *places[e] = here;
      if (change != Scalar(0)) add(e, Scalar(change / (Scalar(12) * h)));
    }
  }
}

}  // namespace shearfront
