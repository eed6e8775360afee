// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/solver.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/model/flux/all.hpp"

/// Scenes with every shear rate and every flux that the exact solver solves. The shear rates are parameters of a test, not its types: one
/// long body for all of them takes a compiler far less time than one for each.
namespace shearfront::support {

struct NamedDepthFunction {
  std::string name;
  std::vector<DepthFunction<double>> samples;

  friend std::ostream& operator<<(std::ostream& out, const NamedDepthFunction& of) { return out << of.name; }
};

[[nodiscard]] inline std::vector<NamedDepthFunction> every_depth_function() {
  std::vector<NamedDepthFunction> all;
  DepthFunctionList<double>::for_each([&]<class Model>() {
    NamedDepthFunction function{std::string(Model::kName), {}};
    std::replace(function.name.begin(), function.name.end(), '-', '_');
    for (const Model& sample : Model::samples()) function.samples.emplace_back(sample);
    all.push_back(std::move(function));
  });
  return all;
}

[[nodiscard]] inline std::string name_of_parameter(const testing::TestParamInfo<NamedDepthFunction>& info) {
  return info.param.name;
}

/// The first sample of every flux, or all.
[[nodiscard]] inline std::vector<Flux<double>> every_flux(bool are_all_samples) {
  std::vector<Flux<double>> all;
  FluxList<double>::for_each([&]<class Model>() {
    for (const Model& sample : Model::samples()) {
      all.emplace_back(sample);
      if (!are_all_samples) break;
    }
  });
  return all;
}

/// An initial state by shares of the range of a flux.
struct ShareOfRange {
  std::vector<double> breaks, states;
};

/// Calls visit(spec) for every scene of these fluxes and starts between 0 and `top` that the exact solver solves.
template <class Visit>
void for_each_exact_scene(const DepthFunction<double>& shear_rate, const std::vector<Flux<double>>& fluxes,
                          const std::vector<ShareOfRange>& starts, double top, Visit&& visit) {
  for (const Flux<double>& flux : fluxes)
    for (const ShareOfRange& start : starts) {
      SceneSpec<double> spec;
      spec.fluxes = {flux};
      spec.shear_rate = shear_rate;
      spec.top = top;
      spec.initial_breaks = start.breaks;
      const auto range = flux.range();
      for (const double x : start.states)
        spec.initial_values.push_back(range.lowest + x * (range.highest - range.lowest));
      if (!find_complaints(spec).empty() || !ExactSolver::refusal(Scene<double>(spec), {}).empty()) continue;
      SCOPED_TRACE(std::string(flux.name()) + " and " + std::to_string(start.breaks.size()) + " jumps from " +
                   std::to_string(start.states[0]));
      visit(spec);
    }
}

}  // namespace shearfront::support
