// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/flux/all.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/scene/field.hpp"
#include "shearfront/shear_rate/all.hpp"

namespace shearfront {

/// Everything a scene file says, unchecked. Fill it in and hand it to Scene.
template <Real Scalar>
struct SceneSpec {
  std::string name;
  Flux flux;
  ShearRate<Scalar> shear_rate;
  Scalar scale{1};                     ///< s, 1/time if a is dimensionless
  std::vector<Scalar> initial_breaks;  ///< heights of the initial jumps, ascending, inside the domain
  std::vector<Scalar> initial_values;  ///< phi between them, bottom to top; one more than breaks
  Scalar bottom{0}, top{1};            ///< the domain, same unit as z
};

/// Adds a problem if s a(z), which every engine computes with, overflows or underflows at a knot or a wall;
/// between them a(z) is monotone. Precondition: the numbers are right one by one.
template <Real Scalar>
void check_scaled_rate(const SceneSpec<Scalar>& spec, Problems& problems) {
  const auto check = [&](const Scalar& z) {
    const Scalar a = std::visit([&](const auto& rate) { return rate.value(z); }, spec.shear_rate);
    const Scalar scaled = spec.scale * a;
    if (scaled > 0 && is_finite(scaled)) return true;
    problems.push_back({"shear_rate.scale", number_text(spec.scale),
                        "must keep s a(z) a positive finite number on the whole domain (a(" + number_text(z) +
                            ") = " + number_text(a) + ")"});
    return false;
  };
  if (!check(spec.bottom) || !check(spec.top)) return;
  for (const Scalar& z : std::visit([](const auto& rate) { return rate.knots(); }, spec.shear_rate))
    if (z > spec.bottom && z < spec.top && !check(z)) return;
}

/// All that is wrong with a specification, in the order of the entries of a scene file; empty if nothing is.
template <Real Scalar>
[[nodiscard]] Problems find_problems(const SceneSpec<Scalar>& spec) {
  Problems problems;
  const auto visit_field = [&](const std::string& prefix) {
    return [&problems, prefix](const FieldInfo& info, const auto& member) {
      check_number(prefix + std::string(info.key), info.range, member, problems);
    };
  };
  check_number("domain.bottom", Range::any, spec.bottom, problems);
  check_number("domain.top", Range::any, spec.top, problems);
  if (is_finite(spec.bottom) && is_finite(spec.top) && !(spec.top > spec.bottom))
    problems.push_back({"domain.top", number_text(spec.top),
                        "must be greater than domain.bottom (" + number_text(spec.bottom) + ")"});
  const bool domain_ok = problems.empty();
  std::visit([&](const auto& flux) { flux.fields(flux, visit_field("flux.")); }, spec.flux);
  std::visit(
      [&](const auto& rate) {
        rate.fields(rate, visit_field("shear_rate."));
        if (domain_ok) rate.check("shear_rate.", spec.bottom, spec.top, problems);
      },
      spec.shear_rate);
  check_number("shear_rate.scale", Range::positive, spec.scale, problems);
  if (problems.empty()) check_scaled_rate(spec, problems);
  check_number("initial.breaks", Range::any, spec.initial_breaks, problems);
  if (domain_ok) check_breaks("initial.breaks", spec.initial_breaks, spec.bottom, spec.top, problems);
  const auto range = std::visit([](const auto& flux) { return flux.kRange; }, spec.flux);
  for (std::size_t i = 0; i < spec.initial_values.size(); ++i) {
    const Scalar& phi = spec.initial_values[i];
    if (!(phi >= Scalar(range[0]) && phi <= Scalar(range[1])))
      problems.push_back({"initial.values[" + std::to_string(i) + "]", number_text(phi),
                          "must be between " + number_text(range[0]) + " and " + number_text(range[1])});
  }
  if (spec.initial_values.size() != spec.initial_breaks.size() + 1)
    problems.push_back(
        {"initial.values", "(" + std::to_string(spec.initial_values.size()) + " entries)",
         "must have one entry more than breaks (" + std::to_string(spec.initial_breaks.size() + 1) + ")"});
  return problems;
}

/// A bed of mixed grains: flux, shear rate a(z), scale s, initial concentration phi(z, 0) and the walls.
///
///     phi_t + (s a(z) f(phi))_z = 0 on bottom < z < top, zero flux through both walls.
///
/// Class invariant: find_problems(spec()) is empty. Immutable after construction.
/// Errors: the constructor throws InputError that carries every problem.
template <Real Scalar>
class Scene {
 public:
  explicit Scene(SceneSpec<Scalar> spec) : spec_(std::move(spec)) {
    if (Problems problems = find_problems(spec_); !problems.empty()) throw InputError(std::move(problems));
  }

  [[nodiscard]] const SceneSpec<Scalar>& spec() const { return spec_; }
  [[nodiscard]] const std::string& name() const { return spec_.name; }
  [[nodiscard]] const Flux& flux() const { return spec_.flux; }
  [[nodiscard]] const ShearRate<Scalar>& shear_rate() const { return spec_.shear_rate; }
  [[nodiscard]] const Scalar& scale() const { return spec_.scale; }
  [[nodiscard]] const Scalar& bottom() const { return spec_.bottom; }
  [[nodiscard]] const Scalar& top() const { return spec_.top; }
  [[nodiscard]] const std::vector<Scalar>& initial_breaks() const { return spec_.initial_breaks; }
  [[nodiscard]] const std::vector<Scalar>& initial_values() const { return spec_.initial_values; }

  /// True if a(z) is constant between its knots.
  [[nodiscard]] bool is_layered() const {
    return std::visit([](const auto& rate) { return rate.kIsLayered; }, spec_.shear_rate);
  }
  /// a(z) without the scale s.
  [[nodiscard]] Scalar shear_rate_at(const Scalar& z) const {
    return std::visit([&](const auto& rate) { return rate.value(z); }, spec_.shear_rate);
  }
  /// phi(z, 0); at a jump the value above it. Cost: O(log jumps).
  [[nodiscard]] Scalar initial_phi(const Scalar& z) const {
    const auto& breaks = spec_.initial_breaks;
    const auto k = std::upper_bound(breaks.begin(), breaks.end(), z) - breaks.begin();
    return spec_.initial_values[static_cast<std::size_t>(k)];
  }
  /// Amount of small grains, int phi(z, 0) dz (compensated sum). Constant in time.
  [[nodiscard]] Scalar mass() const {
    CompensatedSum<Scalar> sum;
    const auto& breaks = spec_.initial_breaks;
    for (std::size_t i = 0; i < spec_.initial_values.size(); ++i) {
      const Scalar& lo = i == 0 ? spec_.bottom : breaks[i - 1];
      const Scalar& hi = i == breaks.size() ? spec_.top : breaks[i];
      sum += (hi - lo) * spec_.initial_values[i];
    }
    // No more than the height: where all of the bed is pure, that is the mass to the bit.
    const Scalar height = spec_.top - spec_.bottom;
    const auto [least, most] = std::minmax_element(spec_.initial_values.begin(), spec_.initial_values.end());
    return std::clamp(sum.value(), Scalar(*least * height), Scalar(*most * height));
  }

 private:
  SceneSpec<Scalar> spec_;
};

/// The same scene in another scalar, number by number (exact when To has at least the precision of From).
template <Real To, Real From>
[[nodiscard]] Scene<To> scene_cast(const Scene<From>& scene) {
  const auto number = [](const From& x) {
    if constexpr (std::same_as<To, double>) {
      return to_double(x);
    } else {
      return To(x);
    }
  };
  const auto numbers = [&](const std::vector<From>& xs) {
    std::vector<To> ys;
    ys.reserve(xs.size());
    for (const From& x : xs) ys.push_back(number(x));
    return ys;
  };
  const SceneSpec<From>& from = scene.spec();
  SceneSpec<To> to;
  to.name = from.name;
  to.flux = from.flux;
  std::visit(
      [&]<template <class> class Model>(const Model<From>& rate) {
        Model<To> copy;
        std::vector<std::vector<To>> arrays;
        std::vector<To> singles;
        const auto read = [&](const FieldInfo&, const auto& member) {
          if constexpr (std::is_same_v<std::decay_t<decltype(member)>, From>) {
            singles.push_back(number(member));
          } else {
            arrays.push_back(numbers(member));
          }
        };
        std::size_t n_arrays = 0, n_singles = 0;
        const auto write = [&](const FieldInfo&, auto& member) {
          if constexpr (std::is_same_v<std::decay_t<decltype(member)>, To>) {
            member = singles[n_singles++];
          } else {
            member = arrays[n_arrays++];
          }
        };
        Model<From>::fields(rate, read);
        Model<To>::fields(copy, write);
        to.shear_rate = std::move(copy);
      },
      from.shear_rate);
  to.scale = number(from.scale);
  to.initial_breaks = numbers(from.initial_breaks);
  to.initial_values = numbers(from.initial_values);
  to.bottom = number(from.bottom);
  to.top = number(from.top);
  return Scene<To>(std::move(to));
}

}  // namespace shearfront
