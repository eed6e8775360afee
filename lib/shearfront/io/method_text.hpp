// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/solver/method.hpp"

/// Options of solvers as text: how the command line and files give them, and how they are listed.
namespace shearfront {

/// What an option is, may be, and is if it is not given, for the solvers where that is the same.
struct OptionValues {
  std::string sentence;
  std::string allowed;  ///< "> 0 and <= 1"; empty for flags and names
  std::string initial;  ///< the default
  std::vector<std::string> solvers;
};

/// One option of all solvers that have it. Its name and kind are the same for all of them; what it is and its values
/// need not be.
struct OptionText {
  std::string name;
  std::string kind;  ///< what to give: "N" (a whole number), "X" (a number), "a|b"; empty: a flag
  std::vector<OptionValues> values;

  /// All that have it, in the order of their list.
  [[nodiscard]] std::vector<std::string> solvers() const;
};

/// What a number may be: "> 0 and <= 1".
[[nodiscard]] std::string allowed_text(const OptionRange& range);

/// The options of all solvers, each once. Precondition: options of the same name have the same kind.
[[nodiscard]] std::vector<OptionText> all_options();

/// Sets an option from its text ("true" for a flag). Errors: InputError with `key` as its key and what is allowed.
/// Precondition: method.has_option(name).
void set_option(Method& method, std::string_view name, std::string_view text, const std::string& key);

/// "--resolution 0.01 --grid levels": the options that give the same result again; those left at a default that is no
/// value of its own, and flags that are off, are left out.
[[nodiscard]] std::string settings(const Method& method);

}  // namespace shearfront
