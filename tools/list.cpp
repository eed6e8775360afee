// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <type_traits>

#include "cli/command.hpp"
#include "cli/method.hpp"
#include "cli/table.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/entries.hpp"
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
    FieldInfo alone = info;
    alone.also = {};
    if (const std::string range = range_text(alone); !range.empty()) all += " " + range;
    if (!info.also.empty()) all += fmt::format(" ({})", info.also);
    if (info.is_optional) all += " (optional)";
  });
  visit_choices(model, [&](const ChoiceInfo& info, const auto&) {
    all += fmt::format("{}{} {}", all.empty() ? "" : ", ", info.key, fmt::join(info.names, "|"));
  });
  return all;
}

std::string promise_of(const Guarantees& g, std::string_view scenes) {
  std::string all;
  const auto say = [&](bool holds, const std::string& text) {
    if (holds) all += (all.empty() ? "" : ", ") + text;
  };
  say(g.exact, "exact");
  say(g.order_phi > 0, fmt::format("phi of order {}", g.order_phi));
  say(g.order_M > 0 && g.least_order_M == 0, fmt::format("M of order {}", g.order_M));
  say(g.least_order_M > 0, fmt::format("M of order {} ({} {})", g.order_M, g.least_order_M, g.where_least));
  say(g.conservative, "conservative");
  say(g.bounded, "bounded");
  say(true, std::string(scenes));
  say(g.has_timeline, "event times");
  say(g.has_fronts, "fronts");
  say(g.has_profiles, "whole profiles");
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

/// Name and description of every member of a list.
template <class List>
std::string described_list() {
  TextTable table({"name", "what it is"});
  List::for_each([&]<class M>() { table.add({std::string(M::kName), std::string(M::kDescription)}); });
  return indented(table.text());
}

/// The numeric fields of scene files with the models that have them, empty for those of every scene.
std::string unknowns() {
  struct Field {
    std::string name, range, models;
  };
  std::vector<Field> fields;
  const auto visit = [&](const SceneSpec<double>& spec, const std::string& prefix, std::string_view model) {
    visit_fields(spec, [&](const std::string& name, const FieldInfo& info, const auto&) {
      const std::string range = range_text(info);
      const auto is_same = [&](const Field& f) { return f.name == name && f.range == range; };
      auto field = std::find_if(fields.begin(), fields.end(), is_same);
      if (field == fields.end()) field = fields.insert(field, {name, range, ""});
      // Scale stands beside the models in the file, but every scene has it.
      const bool is_of_model =
          !prefix.empty() && name.starts_with(prefix) && name != "shear_rate.scale" && name != "diffusion.D";
      if (is_of_model && field->models.find(model) == std::string::npos)
        field->models += (field->models.empty() ? "" : ", ") + std::string(model);
    });
  };
  DepthFunctionList<double>::for_each([&]<class A>() {
    SceneSpec<double> spec;
    spec.shear_rate = A{};
    visit(spec, "shear_rate.", A::kName);
  });
  FluxList<double>::for_each([&]<class F>() {
    SceneSpec<double> spec;
    spec.fluxes = {F{}};
    visit(spec, "flux.", F::kName);
  });
  InitialStateList<double>::for_each([&]<class P>() {
    SceneSpec<double> spec;
    spec.initial_state = P{};
    visit(spec, "initial.", P::kName);
  });
  ClosePackingList<double>::for_each([&]<class C>() {
    SceneSpec<double> spec;
    spec.close_packing = C{};
    visit(spec, "close_packing.", C::kName);
  });
  DepthFunctionList<double>::for_each([&]<class A>() {
    SceneSpec<double> spec;
    spec.solid_fraction = A{};
    spec.temperature = A{};
    spec.diffusion.emplace().variation = A{};
    for (const char* prefix : {"solid_fraction.", "temperature.", "diffusion."})
      visit(spec, prefix, A::kName);
  });
  VelocityList<double>::for_each([&]<class U>() {
    SceneSpec<double> spec;
    spec.velocity = U{};
    visit(spec, "velocity.", U::kName);
  });
  SceneSpec<double> plain;
  plain.outside_bottom.emplace();
  plain.outside_top.emplace();
  plain.fluxes.push_back(plain.fluxes.front());
  plain.flux_breaks.push_back(0);
  visit(plain, "initial.", "without a model");
  std::stable_partition(fields.begin(), fields.end(), [](const Field& f) { return !f.models.empty(); });
  TextTable table({"name", "must be", "models"});
  for (const Field& field : fields) table.add({field.name, field.range, field.models});
  return indented(table.text());
}

int list() {
  std::string all = "Fluxes (flux.model)\n";
  TextTable fluxes({"name", "f(phi)", "states", "entries"});
  FluxList<double>::for_each([&]<class F>() {
    fluxes.add({std::string(F::kName), std::string(F::kFormula), std::string(F::kStates), entries<F>()});
  });
  all += indented(fluxes.text()) + "\nShear rates (shear_rate.model)\n";
  TextTable rates({"name", "a(z)", "entries"});
  DepthFunctionList<double>::for_each([&]<class A>() {
    rates.add({std::string(A::kName), std::string(A::kFormula), entries<A>()});
  });
  all += indented(rates.text()) + "\nSmooth initial states (initial.model)\n";
  TextTable initial({"name", "phi(z, 0) / c(z)", "entries"});
  InitialStateList<double>::for_each([&]<class P>() {
    initial.add({std::string(P::kName), std::string(P::kFormula), entries<P>()});
  });
  all += indented(initial.text()) + "\nVelocities of steady chutes and slabs (velocity.model)\n";
  TextTable velocities({"name", "u(z)", "entries"});
  VelocityList<double>::for_each([&]<class U>() {
    velocities.add({std::string(U::kName), std::string(U::kFormula), entries<U>()});
  });
  all += indented(velocities.text()) + "\nRandom close packings of mixtures (close_packing.model)\n";
  TextTable packings({"name", "c(x), x the share of small grains", "entries"});
  ClosePackingList<double>::for_each([&]<class C>() {
    packings.add({std::string(C::kName), std::string(C::kFormula), entries<C>()});
  });
  all += indented(packings.text()) + "\nSolvers (--method)\n";
  TextTable solvers({"name", "what it is", "guarantees"});
  SolverList::for_each([&]<class S>() {
    solvers.add(
        {std::string(S::kName), std::string(S::kDescription), promise_of(S::guarantees(), S::kScenes)});
  });
  all += indented(solvers.text());
  TextTable options({"name", "what it is", "values", "default", "solvers"});
  for (const OptionText& o : all_options())
    for (const OptionValues& some : o.values)
      options.add({"--" + o.name, some.sentence,
                   o.kind.find('|') != std::string::npos ? o.kind : some.allowed, some.initial,
                   fmt::format("{}", fmt::join(some.solvers, ", "))});
  all += "\nOptions of solvers (in fit files with _ for -)\n" + indented(options.text());
  all += "\nEntries of a scene that can be unknown (unknown.parameters of a fit file)\n" + unknowns();
  all += "\nQuantities compared in a fit (misfit.quantity)\n" + described_list<fit::MisfitList>();
  all += "\nLosses of a fit (misfit.loss)\n" + described_list<fit::LossList>();
  all += fmt::format("\nNoise of a fit (noise.model)\n  {}\n", fmt::join(fit::kNoiseModelNames, "\n  "));
  all += fmt::format("\nSearches of a fit (search.algorithm)\n  {}\n",
                     fmt::join(fit::algorithm_names(), "\n  "));
  OutputFile out("-");
  out.write(all);
  out.commit();
  return kDone;
}

}  // namespace

Command add_list(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("list", "List fluxes, shear rates, solvers, grids, and what fit files may name");
  return {app, "", [] { return list(); }};
}

}  // namespace shearfront::tools
