// SPDX-License-Identifier: BSD-3-Clause
#include "fit.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/fit/model_comparison.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/solution/observe.hpp"

namespace shearfront::python {
namespace {

using fit::FitFile;

FitProblem problem_of(FitFile file) {
  return {std::make_shared<const fit::FitSpec>(std::move(file.spec)), std::move(file.remarks)};
}

Quantity quantity_named(const std::string& name) {
  for (const Quantity q : {Quantity::point, Quantity::bin, Quantity::cumulative, Quantity::bed_height})
    if (name_of(q) == name) return q;
  throw InputError("quantity", name, "must be one of: point, bin, cumulative, bed-height");
}

/// Checked as those of a file are: by the reader of files.
Observations observations_of(const SharedScene& scene, const std::string& quantity, const Numbers& t,
                             const Numbers& z, const Numbers& values, const std::optional<Numbers>& width,
                             const std::optional<Numbers>& sigma, const std::string& replicates) {
  Observations all;
  all.quantity = quantity_named(quantity);
  all.rows.resize(t.size());
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    Observation& row = all.rows[i];
    row.t = t.data()[i];
    row.z = z.data()[i];
    row.value = values.data()[i];
    if (width) row.width = width->data()[i];
    if (!sigma) continue;
    row.sigma = sigma->data()[i];
    if (!(row.sigma > 0))
      throw InputError("sigma[" + std::to_string(i) + "]", number_text(row.sigma), "must be > 0");
  }
  ObservationFormat format;
  const auto* known = std::find(kReplicatesNames.begin(), kReplicatesNames.end(), replicates);
  if (known == kReplicatesNames.end())
    throw InputError("replicates", replicates, "must be one of: refuse, keep, mean");
  format.replicates = static_cast<Replicates>(known - kReplicatesNames.begin());
  return parse_observations(observations_text(all), "data", *scene.scene, format);
}

nb::tuple columns_of(const Observations& all) {
  std::vector<double> t, z, values, width, sigma;
  for (const Observation& row : all.rows) {
    t.push_back(row.t);
    z.push_back(row.z);
    values.push_back(row.value);
    width.push_back(row.width);
    sigma.push_back(row.sigma);
  }
  return nb::make_tuple(std::string(name_of(all.quantity)), array_of(std::move(t)), array_of(std::move(z)),
                        array_of(std::move(values)), array_of(std::move(width)), array_of(std::move(sigma)));
}

Observations made(const SharedScene& scene, const Method& method, const Numbers& times,
                  const Numbers& heights, const std::string& quantity, double width, double sigma,
                  std::uint64_t seed) {
  const ObservationPlan plan{vector_of(times), vector_of(heights), quantity_named(quantity), width};
  const SolverRequest request = request_of(plan, *scene.scene);
  const SolverResult result =
      without_lock([&](const Progress& progress) { return solve(*scene.scene, method, request, progress); });
  expect_usable(result.summary);
  Observations all = observe(plan, *scene.scene, result);
  add_noise(all, sigma, seed);
  return all;
}

Fitted run(const FitProblem& problem) {
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
  nb::class_<Observations>(m, "Observations")
      .def_prop_ro("columns", &columns_of)
      .def_prop_ro("text", &observations_text)
      .def_prop_ro("notes", [](const Observations& self) { return self.notes; })
      .def_prop_ro("n_missing", [](const Observations& self) { return self.n_missing; })
      .def_prop_ro("understood", [](const Observations& self) { return self.understood; });
  m.def("observations", &observations_of, nb::arg("scene"), nb::arg("quantity"), nb::arg("t"), nb::arg("z"),
        nb::arg("values"), nb::arg("width").none(), nb::arg("sigma").none(), nb::arg("replicates"));
  m.def("read_observations", [](const std::string& path, const SharedScene& scene) {
    return read_observations(path, *scene.scene);
  });
  m.def("observe", &made);

  nb::class_<FitProblem> problem(m, "FitProblem");
  problem.def_prop_ro("name", [](const FitProblem& self) { return self.spec->name; })
      .def_prop_ro("scene", [](const FitProblem& self) { return SharedScene(self.spec->scene); })
      .def_prop_ro("observations", [](const FitProblem& self) { return self.spec->observations; })
      .def_prop_ro("method", [](const FitProblem& self) { return self.spec->forward.method; })
      .def_prop_ro("remarks", [](const FitProblem& self) { return self.remarks; })
      .def("with_uncertainty", &with_uncertainty)
      .def("run", &run);
  bind_fit_state(m, problem);
  m.def("read_fit", [](const std::string& path) { return problem_of(fit::read_fit_file(path)); });
  m.def("is_fit_file", [](const std::string& path) { return fit::is_fit_file(path); });
  m.def("parse_fit", [](std::string text, const SharedScene& scene, const Observations& observations) {
    return problem_of(fit::parse_fit(std::move(text), "fit", *scene.scene, observations));
  });
  m.def("compare_fits", &compare);
}

}  // namespace shearfront::python
