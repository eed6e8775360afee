// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/dual.hpp"

namespace shearfront {

namespace flux_tangent_detail {

/// The same model with the same numbers in another scalar.
template <class To, template <class> class Model, class From>
[[nodiscard]] Model<To> in_scalar(const Model<From>& model) {
  Model<To> copy;
  std::vector<std::vector<From>> numbers;  // of one field after the other
  Model<From>::fields(model, [&](const FieldInfo&, const auto& member) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, From>)
      numbers.push_back({member});
    else
      numbers.push_back(member);
  });
  auto field = numbers.begin();
  Model<To>::fields(copy, [&](const FieldInfo&, auto& member) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, To>)
      member = To(field->front());
    else
      member.assign(field->begin(), field->end());
    ++field;
  });
  std::vector<std::size_t> choices;
  visit_choices(model,
                [&](const ChoiceInfo&, auto choice) { choices.push_back(static_cast<std::size_t>(choice)); });
  auto choice = choices.begin();
  visit_choices(copy, [&](const ChoiceInfo&, auto& member) {
    member = static_cast<std::remove_cvref_t<decltype(member)>>(*choice++);
  });
  return copy;
}

}  // namespace flux_tangent_detail

/// A flux whose numbers may move: values, slopes, secants, extrema and range of it carry the derivative with respect to one of its
/// entries, in the order of fields(), or 0 if none is given. Every model of the list has one, as models are templates over the scalar;
/// a flux that is not in the list, of a user of the library, has none.
[[nodiscard]] inline std::optional<Flux<Dual<1>>> flux_tangent(const Flux<double>& flux,
                                                               std::optional<std::size_t> entry = {}) {
  return with_model(flux, [&]<class Model>(const Model& model) -> std::optional<Flux<Dual<1>>> {
    if constexpr (std::same_as<Model, Flux<double>>) {
      return std::nullopt;
    } else {
      auto moving = flux_tangent_detail::in_scalar<Dual<1>>(model);
      std::size_t n = 0;
      using Moving = decltype(moving);
      const auto seed = [&](Dual<1>& number) {
        if (entry && n++ == *entry) number.d[0] = 1;
      };
      Moving::fields(moving, [&](const FieldInfo&, auto& member) {
        if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, Dual<1>>)
          seed(member);
        else
          for (Dual<1>& number : member) seed(number);
      });
      return Flux<Dual<1>>(std::move(moving));
    }
  });
}

}  // namespace shearfront
