// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront {

namespace scene_detail {

template <Real To, Real From>
[[nodiscard]] To number_cast(const From& x) {
  if constexpr (std::same_as<To, double>) {
    return to_double(x);
  } else {
    return To(x);
  }
}

template <Real To, Real From>
[[nodiscard]] std::vector<To> numbers_cast(const std::vector<From>& xs) {
  std::vector<To> ys;
  ys.reserve(xs.size());
  for (const From& x : xs) ys.push_back(number_cast<To>(x));
  return ys;
}

/// The same entries in another scalar.
template <Real To, Real From, class ModelTo, class ModelFrom>
[[nodiscard]] ModelTo entries_cast(const ModelFrom& model) {
  ModelTo copy;
  std::vector<std::vector<To>> arrays;
  std::vector<To> singles;
  const auto read = [&](const FieldInfo&, const auto& member) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, From>) {
      singles.push_back(number_cast<To>(member));
    } else {
      arrays.push_back(numbers_cast<To>(member));
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
  ModelFrom::fields(model, read);
  ModelTo::fields(copy, write);
  std::vector<std::size_t> choices;
  visit_choices(model,
                [&](const ChoiceInfo&, auto member) { choices.push_back(static_cast<std::size_t>(member)); });
  std::size_t n_choices = 0;
  visit_choices(copy, [&](const ChoiceInfo&, auto& member) {
    member = static_cast<std::decay_t<decltype(member)>>(choices[n_choices++]);
  });
  return copy;
}

/// The same model in another scalar, entry by entry.
template <Real To, template <class> class Model, Real From>
[[nodiscard]] Model<To> model_cast(const Model<From>& model) {
  return entries_cast<To, From, Model<To>>(model);
}
template <Real To, template <class> class Shear, Real From>
[[nodiscard]] Scaling<Shear<To>> model_cast(const Scaling<Shear<From>>& model) {
  return entries_cast<To, From, Scaling<Shear<To>>>(model);
}

}  // namespace scene_detail

/// The same scene in another scalar, number by number (exact when To has at least the precision of From).
template <Real To, Real From>
[[nodiscard]] Scene<To> scene_cast(const Scene<From>& scene) {
  using namespace scene_detail;
  const SceneSpec<From>& from = scene.spec();
  SceneSpec<To> to;
  to.name = from.name;
  to.remarks = from.remarks;
  to.fluxes.clear();
  for (const Flux<From>& flux : from.fluxes)
    to.fluxes.push_back(with_model(flux, []<class Model>(const Model& f) -> Flux<To> {
      if constexpr (std::same_as<Model, Flux<From>>)
        throw std::logic_error("a flux that is not in the list has no other scalar");
      else
        return model_cast<To>(f);
    }));
  to.flux_breaks = numbers_cast<To>(from.flux_breaks);
  const auto function = [](const DepthFunction<From>& model) {
    return std::visit([](const auto& m) -> DepthFunction<To> { return model_cast<To>(m); }, model);
  };
  to.shear_rate = function(from.shear_rate);
  to.scale = number_cast<To>(from.scale);
  if (from.solid_fraction) to.solid_fraction = function(*from.solid_fraction);
  if (from.temperature) to.temperature = function(*from.temperature);
  if (from.diffusion) {
    to.diffusion.emplace();
    to.diffusion->D = number_cast<To>(from.diffusion->D);
    if (from.diffusion->variation) to.diffusion->variation = function(*from.diffusion->variation);
    to.diffusion->follows_shear_rate = from.diffusion->follows_shear_rate;
  }
  if (from.initial_state)
    to.initial_state = std::visit([](const auto& model) -> InitialState<To> { return model_cast<To>(model); },
                                  *from.initial_state);
  if (from.close_packing)
    to.close_packing = std::visit([](const auto& law) -> ClosePacking<To> { return model_cast<To>(law); },
                                  *from.close_packing);
  if (from.velocity)
    to.velocity =
        std::visit([](const auto& model) -> Velocity<To> { return model_cast<To>(model); }, *from.velocity);
  if (from.slab) throw std::logic_error("slabs are computed in doubles");
  to.initial_breaks = numbers_cast<To>(from.initial_breaks);
  to.initial_values = numbers_cast<To>(from.initial_values);
  to.bottom = number_cast<To>(from.bottom);
  to.top = number_cast<To>(from.top);
  const auto outside = [](const std::optional<OutsideState<From>>& state) {
    std::optional<OutsideState<To>> copy;
    if (state) copy = {numbers_cast<To>(state->breaks), numbers_cast<To>(state->values)};
    return copy;
  };
  to.outside_bottom = outside(from.outside_bottom);
  to.outside_top = outside(from.outside_top);
  to.is_neumann = from.is_neumann;
  to.is_periodic = from.is_periodic;
  return Scene<To>(std::move(to));
}

}  // namespace shearfront
