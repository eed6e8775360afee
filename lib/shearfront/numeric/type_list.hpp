// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>

/// Compile-time lists of models. A list is the only place where a model is registered: names, help, laws and
/// benchmarks are generated from it.
namespace shearfront {

template <class... T>
struct TypeList {
  static constexpr std::size_t kSize = sizeof...(T);
  using Variant = std::variant<T...>;

  /// Calls f.template operator()<T>() for every member, in order.
  template <class F>
  static constexpr void for_each(F&& f) {
    (f.template operator()<T>(), ...);
  }

  /// "a, b, c": the names of all members, for messages and help.
  static std::string names() {
    std::string all;
    ((all += (all.empty() ? "" : ", "), all += T::kName), ...);
    return all;
  }

  static constexpr bool contains(std::string_view name) { return ((name == T::kName) || ...); }
};

}  // namespace shearfront
