// SPDX-License-Identifier: BSD-3-Clause
#include "cli/method.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <type_traits>

#include "cli/arguments.hpp"
#include "cli/command.hpp"

namespace shearfront::tools {
namespace {

/// "a, b: what it is; from 1 to 9, default 2 (a); from 1 to 5, default 2 (b)", once for all that say the same.
std::string help_of(const OptionText& option) {
  std::string help;
  for (auto some = option.values.begin(); some != option.values.end();) {
    const auto next = std::find_if(some, option.values.end(),
                                   [&](const OptionValues& v) { return v.sentence != some->sentence; });
    std::vector<std::string> solvers;
    std::string values;
    for (auto v = some; v != next; ++v) {
      solvers.insert(solvers.end(), v->solvers.begin(), v->solvers.end());
      if (option.kind.empty()) continue;
      values += fmt::format("{}{}, default {}", v->allowed.empty() ? "" : "; ", v->allowed, v->initial);
      if (next - some > 1) values += fmt::format(" ({})", fmt::join(v->solvers, ", "));
    }
    help +=
        fmt::format("{}{}: {}{}", help.empty() ? "" : "; ", fmt::join(solvers, ", "), some->sentence, values);
    some = next;
  }
  return help;
}

}  // namespace

void MethodArguments::add_to(CLI::App& app) {
  app.add_option("--method", name_, fmt::format("solver; default {}", name_))
      ->type_name(fmt::format("{}", fmt::join(Method::names(), "|")));
  for (OptionText& option : all_options()) {
    const Given& given = given_.emplace_back(Given{std::move(option)});
    const OptionText& o = given.option;
    if (o.kind.empty())
      app.add_flag("--" + o.name, *given.flag, help_of(o));
    else
      app.add_option("--" + o.name, *given.text, help_of(o))->type_name(o.kind);
  }
}

bool MethodArguments::has(std::string_view option) const {
  return std::any_of(given_.begin(), given_.end(),
                     [&](const Given& g) { return g.option.name == option && g.is_set(); });
}

Method MethodArguments::with(std::string_view solver) const {
  Method method(solver);
  for (const Given& g : given_) {
    if (!g.is_set()) continue;
    const std::string key = "--" + g.option.name, text = *g.flag ? "true" : *g.text;
    if (method.has_option(g.option.name)) {
      set_option(method, g.option.name, text, key);
    } else {
      Method other(g.option.values.front().solvers.front());
      set_option(other, g.option.name, text, key);
    }
  }
  return method;
}

Method MethodArguments::method() const {
  (void)choice_option("--method", name_, Method::names());
  return with(name_);
}

std::vector<Method> MethodArguments::methods() const {
  std::vector<Method> all;
  for (const std::string_view name : split(name_, ',')) {
    (void)choice_option("--method", name, Method::names());
    all.push_back(with(name));
  }
  return all;
}

double number_of(const Method& method, std::string_view option) {
  double number = 0;
  method.visit_options([&]<class Value>(const OptionInfo& info, const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>)
      if (info.name == option) number = static_cast<double>(value);
  });
  return number;
}

void note_before_run(const MethodArguments& arguments, const Method& method, const Scene<double>& scene) {
  if (arguments.has("layers") && scene.is_layered())
    note("--layers changes nothing: the shear rate is piecewise constant");
  if (const std::string much = method.forewarning(scene); !much.empty())
    note(fmt::format("{}: {}", method.name(), much));
}

}  // namespace shearfront::tools
