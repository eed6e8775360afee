// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/method_text.hpp"
#include "shearfront/solver/solve.hpp"

namespace CLI {
class App;
}

namespace shearfront::tools {

/// The options that choose and steer a solver, the same for every subcommand; made from what the solvers say.
class MethodArguments {
 public:
  void add_to(CLI::App& app);

  /// The solver with its options. Those that only other solvers have are checked and change nothing, which is said on
  /// standard error. Errors: InputError for the first option with a value that is not allowed.
  [[nodiscard]] Method method() const;
  /// Several, where --method may be a list; each with those of the options that it has.
  [[nodiscard]] std::vector<Method> methods() const;
  /// Whether an option was given.
  [[nodiscard]] bool has(std::string_view option) const;
  /// Another solver with those of the options that it has.
  [[nodiscard]] Method with(std::string_view solver) const;

 private:
  struct Given {
    OptionText option;
    std::shared_ptr<std::string> text = std::make_shared<std::string>();
    std::shared_ptr<bool> flag = std::make_shared<bool>(false);
    [[nodiscard]] bool is_set() const { return *flag || !text->empty(); }
  };
  std::string name_{Method().name()};
  std::vector<Given> given_;
};

/// A number among the options of a method; 0 if it has none of this name.
[[nodiscard]] double number_of(const Method& method, std::string_view option);

/// What is known before a run, on standard error: that --layers changes nothing where the shear rate is piecewise constant
/// already, and that the method may have much to do.
void note_before_run(const MethodArguments& arguments, const Method& method, const Scene<double>& scene);

}  // namespace shearfront::tools
