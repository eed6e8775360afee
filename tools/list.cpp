// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <type_traits>

#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/table.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

/// "breaks[], values[] > 0": the entries of a model in a scene file.
template <class Model>
std::string entries() {
  std::string all;
  Model model{};
  Model::fields(model, [&](const FieldInfo& info, const auto& member) {
    if (!all.empty()) all += ", ";
    all += info.key;
    if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, double>) all += "[]";
    if (info.range == Range::positive) all += " > 0";
  });
  return all;
}

std::string described(const Guarantees& g) {
  std::string all;
  const auto say = [&](bool holds, const std::string& text) {
    if (holds) all += (all.empty() ? "" : ", ") + text;
  };
  say(g.exact, "exact");
  say(g.order_phi > 0, fmt::format("phi of order {}", g.order_phi));
  say(g.order_M > 0, fmt::format("M of order {}", g.order_M));
  say(g.conservative, "conservative");
  say(g.bounded, "bounded");
  say(g.any_scene, "any scene");
  say(g.has_timeline, "event times");
  say(g.has_fronts, "fronts");
  return all;
}

std::string indented(const std::string& text) {
  std::string all;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    all += "  " + text.substr(begin, end - begin + 1);
    begin = end + 1;
  }
  return all;
}

int list() {
  std::string all = "Fluxes (flux.model)\n";
  TextTable fluxes({"name", "f(phi)", "range", "entries"});
  FluxList::for_each([&]<class F>() {
    fluxes.add({std::string(F::kName), std::string(F::kFormula),
                fmt::format("{} <= phi <= {}", F::kRange[0], F::kRange[1]), entries<F>()});
  });
  all += indented(fluxes.text()) + "\nShear rates (shear_rate.model)\n";
  TextTable rates({"name", "a(z)", "entries"});
  ShearRateList<double>::for_each([&]<class A>() {
    rates.add({std::string(A::kName), std::string(A::kFormula), entries<A>()});
  });
  all += indented(rates.text()) + "\nSolvers (--method)\n";
  TextTable solvers({"name", "what it is", "guarantees"});
  SolverList::for_each([&]<class S>() {
    solvers.add({std::string(S::kName), std::string(S::kDescription), described(S::guarantees())});
  });
  all += indented(solvers.text());
  all += fmt::format("\nGrids of states (--grid)\n  {}\n", fmt::join(grid_names(), "\n  "));
  all += fmt::format("\nReconstructions between fronts (--reconstruct)\n  {}\n",
                     fmt::join(reconstruction_names(), "\n  "));
  OutputFile out("-");
  out.write(all);
  out.commit();
  return kDone;
}

}  // namespace

Command add_list(CLI::App& program) {
  CLI::App* app = program.add_subcommand("list", "List fluxes, shear rates, solvers, grids");
  return {app, "", [] { return list(); }};
}

}  // namespace shearfront::tools
