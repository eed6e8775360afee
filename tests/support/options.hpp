// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string_view>
#include <type_traits>
#include <variant>

#include "shearfront/solver/method.hpp"

/// Options of solvers by name, for tests that run over the list of solvers.
namespace shearfront::support {

/// Names and numbers: of an enumeration the place of the enumerator, of a flag 0 or 1.
using OptionNumbers = std::map<std::string_view, double>;

/// Sets an option that `numbers` names; the others are those of other solvers.
struct SetOption {
  const OptionNumbers& numbers;
  template <class Member>
  void operator()(const OptionInfo& info, Member& member) const {
    if (const auto number = numbers.find(info.name); number != numbers.end())
      member = static_cast<Member>(number->second);
  }
};

template <class Solver>
[[nodiscard]] typename Solver::Options options_of(const OptionNumbers& numbers) {
  typename Solver::Options options;
  Solver::Options::fields(options, SetOption{numbers});
  return options;
}

[[nodiscard]] inline Method method_of(std::string_view name, const OptionNumbers& numbers) {
  Method method(name);
  for (Option option : method.options()) {
    const auto number = numbers.find(option.info.name);
    if (number == numbers.end()) continue;
    std::visit(
        [&]<class Value>(Value& value) {
          if constexpr (std::is_same_v<Value, OptionChoice>)
            value.index = static_cast<std::size_t>(number->second);
          else
            value = static_cast<Value>(number->second);
        },
        option.value);
    method.set(option.info.name, option.value);
  }
  return method;
}

}  // namespace shearfront::support
