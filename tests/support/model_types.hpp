// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

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

/// All models of a list, and the skeleton of its folder.
template <class List, class Skeleton>
struct ModelTypes;
template <class... Model, class Skeleton>
struct ModelTypes<TypeList<Model...>, Skeleton> {
  using Type = testing::Types<Model..., Skeleton>;
};

}  // namespace shearfront::support
