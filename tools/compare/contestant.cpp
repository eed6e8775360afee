// SPDX-License-Identifier: BSD-3-Clause
#include "compare/contestant.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/arguments.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

/// solver:option. `by_default` variants take part when no methods are named.
struct Variant {
  std::string_view solver, option;
  bool by_default, is_drawing;
  const char *name, *value;  ///< of the option that is set
};

constexpr Variant kVariants[] = {
    {"front-tracking", "linear", true, true, "reconstruct", "linear"},
    {"front-tracking", "singular-mapping", false, false, "grid", "singular-mapping"},
    {"engquist-osher", "align-cells", false, false, "align-cells", "true"},
    {"engquist-osher", "face-value", false, false, "face-coefficient", "value"},
    {"godunov", "align-cells", false, false, "align-cells", "true"},
    {"muscl", "minmod", false, false, "limiter", "minmod"},
    {"muscl", "van-leer", false, false, "limiter", "van-leer"},
    {"muscl", "align-cells", false, false, "align-cells", "true"},
};

LadderKind kind_of(const Guarantees& g) {
  if (g.exact) return LadderKind::points;
  return g.has_fronts ? LadderKind::resolution : LadderKind::cells;
}

const Variant* variant_of(const Contestant& contestant) {
  for (const Variant& v : kVariants)
    if (contestant.name == fmt::format("{}:{}", v.solver, v.option)) return &v;
  return nullptr;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Contestant& c : all_contestants()) all.push_back(c.name);
  return all;
}

}  // namespace

SolverOptions Contestant::options(double rung) const {
  SolverOptions options{Method(solver), {}};
  if (kind == LadderKind::cells) set_option(options.method, "cells", fmt::format("{:.0f}", rung), "cells");
  if (kind == LadderKind::resolution) set_option(options.method, "resolution", fmt::format("{}", rung), "resolution");
  if (option) set_option(options.method, option, value, option);
  return options;
}

const std::vector<Contestant>& all_contestants() {
  static const std::vector<Contestant> contestants = [] {
    std::vector<Contestant> all;
    SolverList::for_each([&]<class S>() {
      const Guarantees g = S::guarantees();
      if ((!g.exact && !g.has_profiles) || g.diffusion) return;  // errors are those against exact
      all.push_back({std::string(S::kName), S::kName, kind_of(g), nullptr, nullptr, false});
      for (const Variant& v : kVariants)
        if (v.solver == S::kName)
          all.push_back(
              {fmt::format("{}:{}", v.solver, v.option), S::kName, kind_of(g), v.name, v.value, v.is_drawing});
    });
    return all;
  }();
  return contestants;
}

std::vector<Contestant> contestants_of(std::string_view option, const std::string* list) {
  std::vector<Contestant> chosen;
  if (!list) {
    for (const Contestant& c : all_contestants())
      if (const Variant* v = variant_of(c); !v || v->by_default) chosen.push_back(c);
    return chosen;
  }
  std::string_view left = *list;
  for (;;) {
    const std::size_t cut = left.find(',');
    const std::string name(left.substr(0, cut));
    const auto& all = all_contestants();
    const auto is_named = [&](const Contestant& c) { return c.name == name; };
    const auto it = std::find_if(all.begin(), all.end(), is_named);
    if (it == all.end()) {
      std::string constraint = fmt::format("must be one of: {}", fmt::join(names(), ", "));
      if (const auto meant = nearest_name(name, names()))
        constraint += fmt::format(" (did you mean {}?)", *meant);
      refuse(option, name, constraint);
    }
    if (std::none_of(chosen.begin(), chosen.end(), is_named)) chosen.push_back(*it);
    if (cut == std::string_view::npos) return chosen;
    left.remove_prefix(cut + 1);
  }
}

const std::vector<double>& Ladders::of(LadderKind kind) const {
  if (kind == LadderKind::cells) return cells;
  return kind == LadderKind::resolution ? resolutions : points;
}

Ladders default_ladders(bool longest) {
  Ladders ladders;
  for (double n = 100; n <= (longest ? 2e6 : 3200); n *= 2) ladders.cells.push_back(n);
  ladders.resolutions = {0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5};
  if (longest) ladders.resolutions.insert(ladders.resolutions.end(), {3e-6, 1e-6});
  ladders.points = {1000};
  return ladders;
}

}  // namespace shearfront::tools
