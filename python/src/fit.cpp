// SPDX-License-Identifier: BSD-3-Clause
#include "fit.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/fit/model_comparison.hpp"
#include "shearfront/fit/noise_reml.hpp"

namespace shearfront::python {
namespace {

using fit::FitFile;

FitProblem problem_of(FitFile file) {
  return {std::make_shared<const fit::FitSpec>(std::move(file.spec)), std::move(file.remarks)};
}

Fitted run_fit(const FitProblem& problem) {
  fit::Estimate estimate =
      without_lock([&](const fit::Progress& progress) { return fit::fit(*problem.spec, progress); });
  if (!estimate.usable()) throw Unusable(estimate.status, estimate.message);
  return {problem.spec, std::make_shared<const fit::Estimate>(std::move(estimate))};
}

/// The same fit with other [uncertainty].
FitProblem with_uncertainty(const FitProblem& problem, bool profile, std::size_t bootstrap,
                            std::uint64_t seed, std::size_t threads) {
  auto spec = std::make_shared<fit::FitSpec>(*problem.spec);
  spec->uncertainty = {profile, bootstrap, seed, threads};
  return {std::move(spec), problem.remarks};
}

/// The same fit with the correlation of its noise as this fit found it, so that it is known.
FitProblem with_noise_of(const FitProblem& problem, const Fitted& found) {
  auto spec = std::make_shared<fit::FitSpec>(*problem.spec);
  spec->noise = fit::known_noise(*found.spec, *found.estimate);
  return {std::move(spec), problem.remarks};
}

/// By unknown the place of the last of these names that is its own or that of its field, or None.
nb::dict last_named_by(const FitProblem& problem, const std::vector<std::string>& names) {
  const fit::Parameters parameters(problem.spec->scene, problem.spec->unknown);
  const auto places = parameters.last_named_by(names);
  nb::dict all;
  for (std::size_t i = 0; i < places.size(); ++i) all[parameters[i].name().c_str()] = nb::cast(places[i]);
  return all;
}

nb::list compare(const std::vector<std::string>& names, const std::vector<Fitted>& fits) {
  std::vector<fit::Estimate> estimates;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (const std::string why = fit::incomparable(*fits[0].spec, *fits[i].spec); !why.empty())
      throw InputError(names[i], "", "cannot be compared with " + names[0] + ": " + why);
    estimates.push_back(*fits[i].estimate);
  }
  nb::list rows;
  for (const fit::ComparedModel& m : fit::compare_models(names, estimates))
    rows.append(nb::make_tuple(m.model, m.parameters, m.misfit, m.aic, m.daic, m.aic_weight, m.bic, m.dbic));
  return rows;
}

}  // namespace

void bind_fit(nb::module_& m) {
  nb::class_<FitProblem> problem(m, "FitProblem");
  problem.def_prop_ro("name", [](const FitProblem& self) { return self.spec->name; })
      .def_prop_ro("scene", [](const FitProblem& self) { return SharedScene(self.spec->scene); })
      .def_prop_ro("observations", [](const FitProblem& self) { return self.spec->observations; })
      .def_prop_ro("method", [](const FitProblem& self) { return self.spec->forward.method; })
      .def_prop_ro("priors",
                   [](const FitProblem& self) {
                     std::vector<std::tuple<std::string, std::string, double, double>> all;
                     for (const fit::Prior& prior : self.spec->priors)
                       all.emplace_back(prior.parameter,
                                        fit::kPriorNames[static_cast<std::size_t>(prior.kind)], prior.first,
                                        prior.second);
                     return all;
                   })
      .def_prop_ro("remarks", [](const FitProblem& self) { return self.remarks; })
      .def("with_uncertainty", &with_uncertainty)
      .def_prop_ro(
          "has_noise_model",
          [](const FitProblem& self) { return self.spec->noise.model != fit::NoiseModel::independent; })
      .def("with_noise_of", &with_noise_of)
      .def("last_named_by", &last_named_by)
      .def("run", &run_fit);
  bind_fit_state(m, problem);
  m.def("read_fit", [](const std::string& path, const Changes& changes) {
    return problem_of(fit::read_fit_file(path, changes_of(changes)));
  });
  m.def("is_fit_file", [](const std::string& path) { return fit::is_fit_file(path); });
  m.def("parse_fit", [](std::string text, const SharedScene& scene, const Observations& observations) {
    return problem_of(fit::parse_fit(std::move(text), "fit", *scene.scene, observations));
  });
  m.def("compare_fits", &compare);
}

}  // namespace shearfront::python
