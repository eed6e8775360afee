// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "shearfront/scene/scene_spec.hpp"

namespace shearfront {

/// One number of a scene file, by its place among all of them.
struct Entry {
  std::string field;      ///< "shear_rate.values"
  std::size_t index = 0;  ///< inside the array; 0 for a single number
  bool is_element = false;
  Range range = Range::any;
  Measure measure = Measure::number;
  /// "shear_rate.values[1]", "shear_rate.scale"
  [[nodiscard]] std::string name() const {
    return is_element ? field + "[" + std::to_string(index) + "]" : field;
  }
};

/// Every number of the scene, in the order of visit_fields.
template <Real Scalar>
[[nodiscard]] std::vector<Entry> entries(const SceneSpec<Scalar>& spec) {
  std::vector<Entry> all;
  visit_fields(spec, [&](const std::string& field, const FieldInfo& info, const auto& member) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Scalar>) {
      all.push_back({field, 0, false, info.range, info.measure});
    } else {
      for (std::size_t i = 0; i < member.size(); ++i)
        all.push_back({field, i, true, info.range, info.measure});
    }
  });
  return all;
}

/// Where the numbers of entries(spec) are kept, in the same order; valid while the specification is not
/// changed otherwise.
template <Real Scalar>
[[nodiscard]] std::vector<Scalar*> entry_places(SceneSpec<Scalar>& spec) {
  std::vector<Scalar*> places;
  visit_fields(spec, [&](const std::string&, const FieldInfo&, auto& member) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Scalar>) {
      places.push_back(&member);
    } else {
      for (Scalar& x : member) places.push_back(&x);
    }
  });
  return places;
}

}  // namespace shearfront
