// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "fit.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/io/method_text.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/numeric/number_text.hpp"

/// A fit as texts, to be sent to other processes: there it is the same to the bit.
namespace shearfront::python {
namespace {

/// The settings but for the method, as a fit file says them.
std::string settings_text(const fit::FitSpec& spec) {
  constexpr std::array<const char*, 3> kShapes{"none", "decreasing", "convex"};
  std::string text = "[unknown]\nparameters = [";
  for (const std::string& name : spec.unknown.parameters) text += "\"" + name + "\", ";
  text += "]\n";
  const auto number = [](double x) {
    return std::isinf(x) ? std::string(x > 0 ? "inf" : "-inf") : number_text(x);
  };
  const auto numbers = [&](const char* key, const std::vector<double>& values) {
    if (values.empty()) return;
    text += std::string(key) + " = [";
    for (const double x : values) text += number(x) + ", ";
    text += "]\n";
  };
  const auto line = [&](const char* key, const std::string& value) {
    text += std::string(key) + " = " + value + "\n";
  };
  const auto word = [](const std::string& value) { return "\"" + value + "\""; };
  const auto yes = [](bool value) { return std::string(value ? "true" : "false"); };
  numbers("start", spec.unknown.start);
  numbers("lower", spec.unknown.lower);
  numbers("upper", spec.unknown.upper);
  line("shape", word(kShapes[static_cast<std::size_t>(spec.unknown.shape)]));
  text += "[misfit]\n";
  if (!spec.misfit.quantity.empty()) line("quantity", word(spec.misfit.quantity));
  if (!spec.misfit.loss.empty()) line("loss", word(spec.misfit.loss));
  if (spec.misfit.loss_scale) line("loss_scale", number(*spec.misfit.loss_scale));
  if (spec.misfit.two_stage) line("two_stage", yes(*spec.misfit.two_stage));
  text += "[search]\n";
  line("algorithm", word(spec.search.algorithm));
  line("starts", std::to_string(spec.search.starts));
  line("seed", std::to_string(spec.search.seed));
  line("max_evaluations", std::to_string(spec.search.max_evaluations));
  line("tolerance", number(spec.search.tolerance));
  text += "[uncertainty]\n";
  line("profile", yes(spec.uncertainty.profile));
  line("bootstrap", std::to_string(spec.uncertainty.bootstrap));
  line("seed", std::to_string(spec.uncertainty.seed));
  line("threads", std::to_string(spec.uncertainty.threads));
  if (spec.noise.model != fit::NoiseModel::independent) {
    text += "[noise]\n";
    const auto estimated = [&](const char* key, const std::optional<double>& value) {
      line(key, value ? number(*value) : word("estimated"));
    };
    line("model", word(std::string(fit::kNoiseModelNames[static_cast<std::size_t>(spec.noise.model)])));
    estimated("length_z", spec.noise.length_z);
    estimated("length_t", spec.noise.length_t);
    if (spec.noise.model == fit::NoiseModel::exponential) {
      estimated("independent", spec.noise.independent);
    } else {
      estimated("tau", spec.noise.tau);
      if (spec.noise.length_z_prior) line("length_z_prior", number(*spec.noise.length_z_prior));
      if (spec.noise.length_t_prior) line("length_t_prior", number(*spec.noise.length_t_prior));
      if (spec.noise.tau_prior) line("tau_prior", number(*spec.noise.tau_prior));
    }
  }
  text += "[prior]\n";
  for (const fit::Prior& prior : spec.priors) {
    text += word(prior.parameter) + " = { " +
            std::string(fit::kPriorNames[static_cast<std::size_t>(prior.kind)]) + " = [" +
            number(prior.first);
    if (prior.kind != fit::PriorKind::half_normal) text += ", " + number(prior.second);
    text += "] }\n";
  }
  return text;
}

using OptionTexts = std::vector<std::pair<std::string, std::string>>;

/// Options that are not left at a default outside their range.
OptionTexts options_of(const Method& method) {
  OptionTexts all;
  for (const Option& option : method.options()) {
    const std::string text = std::visit(
        [&]<class Value>(const Value& value) -> std::string {
          if constexpr (std::is_same_v<Value, bool>)
            return value ? "true" : "false";
          else if constexpr (std::is_same_v<Value, OptionChoice>)
            return std::string(option.info.names[value.index]);
          else
            return option.info.range.contains(static_cast<double>(value))
                       ? number_text(static_cast<double>(value))
                       : "";
        },
        option.value);
    if (!text.empty()) all.emplace_back(option.info.name, text);
  }
  return all;
}

/// name, settings, scene, observations, method, options.
nb::object state_of(const FitProblem& problem) {
  const fit::FitSpec& spec = *problem.spec;
  return nb::make_tuple(spec.name, settings_text(spec), scene_text(spec.scene.spec()),
                        observations_text(spec.observations), std::string(spec.forward.method.name()),
                        options_of(spec.forward.method));
}

FitProblem problem_of_state(const std::string& name, const std::string& settings, const std::string& scene_of,
                            const std::string& data, const std::string& method, const OptionTexts& options) {
  Scene<double> scene = parse_scene<double>(scene_of, "scene");
  ObservationFormat format;
  format.replicates = Replicates::kept;
  Observations observations = parse_observations(data, "data", scene, format);
  fit::FitSpec spec = fit::parse_fit(settings, "fit", std::move(scene), std::move(observations)).spec;
  spec.name = name;
  spec.forward.method = Method(method);
  for (const auto& [option, text] : options) set_option(spec.forward.method, option, text, option);
  return {std::make_shared<const fit::FitSpec>(std::move(spec)), {}};
}

FitProblem with_scene(const FitProblem& problem, const SharedScene& scene) {
  fit::FitSpec spec = *problem.spec;
  spec.scene = *scene.scene;
  return {std::make_shared<const fit::FitSpec>(std::move(spec)), problem.remarks};
}

}  // namespace

void bind_fit_state(nb::module_& m, nb::class_<FitProblem>& problem) {
  problem.def_prop_ro("state", &state_of).def("with_scene", &with_scene);
  m.def("problem_of_state", &problem_of_state);
}

}  // namespace shearfront::python
