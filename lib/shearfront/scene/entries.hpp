// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// Calls visit(key, Range, member) for every numeric field of a scene file, in the order of the file; key is
/// the full name ("shear_rate.values"), member a Scalar or a vector of them, const as the specification is.
template <class Spec, class Visit>
void visit_fields(Spec& spec, Visit&& visit) {
  const auto with_prefix = [&](const std::string& prefix) {
    return [&visit, prefix](const FieldInfo& info, auto& member) {
      visit(prefix + std::string(info.key), info.range, member);
    };
  };
  std::visit([&](auto& flux) { flux.fields(flux, with_prefix("flux.")); }, spec.flux);
  std::visit([&](auto& rate) { rate.fields(rate, with_prefix("shear_rate.")); }, spec.shear_rate);
  visit(std::string("shear_rate.scale"), Range::positive, spec.scale);
  visit(std::string("initial.breaks"), Range::any, spec.initial_breaks);
  visit(std::string("initial.values"), Range::any, spec.initial_values);
  visit(std::string("domain.bottom"), Range::any, spec.bottom);
  visit(std::string("domain.top"), Range::any, spec.top);
}

/// One number of a scene file, by its place among all of them.
struct Entry {
  std::string field;      ///< "shear_rate.values"
  std::size_t index = 0;  ///< inside the array; 0 for a single number
  bool is_element = false;
  Range range = Range::any;
  /// "shear_rate.values[1]", "shear_rate.scale"
  [[nodiscard]] std::string name() const {
    return is_element ? field + "[" + std::to_string(index) + "]" : field;
  }
};

/// Every number of the scene, in the order of visit_fields.
template <Real Scalar>
[[nodiscard]] std::vector<Entry> entries(const SceneSpec<Scalar>& spec) {
  std::vector<Entry> all;
  visit_fields(spec, [&](const std::string& field, Range range, const auto& member) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Scalar>) {
      all.push_back({field, 0, false, range});
    } else {
      for (std::size_t i = 0; i < member.size(); ++i) all.push_back({field, i, true, range});
    }
  });
  return all;
}

/// Where the numbers of entries(spec) are kept, in the same order; valid while the specification is not
/// changed otherwise.
template <Real Scalar>
[[nodiscard]] std::vector<Scalar*> entry_places(SceneSpec<Scalar>& spec) {
  std::vector<Scalar*> places;
  visit_fields(spec, [&](const std::string&, Range, auto& member) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Scalar>) {
      places.push_back(&member);
    } else {
      for (Scalar& x : member) places.push_back(&x);
    }
  });
  return places;
}

}  // namespace shearfront
