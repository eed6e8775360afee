// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <type_traits>

#include "shearfront/numeric/type_list.hpp"

/// The laws of a list of models as typed tests.
namespace shearfront::support {

/// Names tests by their model.
struct ModelName {
  template <class Model>
  static std::string GetName(int) {
    std::string name(Model::kName);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  }
};

/// All models of a list, and the skeleton of its folder if it is given.
template <class List, class... Skeleton>
struct ModelTypes;
template <class... Model, class... Skeleton>
struct ModelTypes<TypeList<Model...>, Skeleton...> {
  using Type = testing::Types<Model..., Skeleton...>;
};

/// Of a list of models those that have a property, for laws that hold for them only: Property<Model>::value.
template <class List, template <class> class Property, class... Kept>
struct ModelsThat;
template <template <class> class Property, class... Kept>
struct ModelsThat<TypeList<>, Property, Kept...> {
  static_assert(sizeof...(Kept) > 0, "a law without a model to test");
  using Type = testing::Types<Kept...>;
};
template <class Model, class... Others, template <class> class Property, class... Kept>
struct ModelsThat<TypeList<Model, Others...>, Property, Kept...>
    : std::conditional_t<Property<Model>::value, ModelsThat<TypeList<Others...>, Property, Kept..., Model>,
                         ModelsThat<TypeList<Others...>, Property, Kept...>> {};

}  // namespace shearfront::support
