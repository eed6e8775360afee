// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <string>
#include <utility>

#include "fit.hpp"
#include "outcome.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/solution/observation.hpp"
#include "state.hpp"

/// Estimates and observations as lists, for pickles.
namespace shearfront {

template <python::Of<Observation> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.t), visit(x.z), visit(x.value), visit(x.width), visit(x.sigma);
}

template <python::Of<ObservationUnits> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.t), visit(x.z), visit(x.value);
}

template <python::Of<Observations> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.quantity), visit(x.rows), visit(x.n_missing), visit(x.comments), visit(x.units),
      visit(x.understood);
  visit(x.notes);
}

namespace fit {

template <python::Of<Interval> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.low), visit(x.high);
}

template <python::Of<IntervalCheck> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.low), visit(x.high), visit(x.failure);
}

template <python::Of<SearchStep> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.evaluations), visit(x.misfit), visit(x.stage);
}

template <python::Of<ResidualStructure> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.lag1_height), visit(x.lag1_time), visit(x.runs_z_score), visit(x.is_structured);
}

template <python::Of<NoiseEstimate> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.model), visit(x.length_z), visit(x.length_t), visit(x.independent), visit(x.tau),
      visit(x.length_z95);
  visit(x.length_t95), visit(x.independent95), visit(x.tau95), visit(x.estimated);
}

template <python::Of<OrderOfEvents> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.parameter), visit(x.std_errors), visit(x.changes);
}

template <python::Of<ParameterEstimate> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.name), visit(x.start), visit(x.estimate), visit(x.std_error), visit(x.ci95), visit(x.profile95);
  visit(x.bootstrap95), visit(x.check), visit(x.at_bound), visit(x.held_by_shape);
}

/// All but the scene.
template <python::Of<Estimate> T, class Visit>
void members(T& x, Visit&& visit) {
  visit(x.name), visit(x.method), visit(x.algorithm), visit(x.quantity), visit(x.loss), visit(x.parameters);
  visit(x.misfit), visit(x.residual_norm), visit(x.sigma), visit(x.freedom), visit(x.sigma_is_given);
  visit(x.observations), visit(x.left_out), visit(x.evaluations), visit(x.iterations), visit(x.wall_s);
  visit(x.correlation), visit(x.replicates), visit(x.aic), visit(x.bic), visit(x.structure), visit(x.noise),
      visit(x.order), visit(x.predicted), visit(x.steps);
  visit(x.warnings), visit(x.status), visit(x.message);
}

}  // namespace fit

namespace python {
namespace {

nb::object state_of_fitted(const Fitted& self) {
  return nb::make_tuple(scene_text(self.estimate->scene->spec()), StateWriter::written(*self.estimate));
}

Fitted fitted_of_state(const FitProblem& problem, const std::string& scene, const nb::list& list) {
  fit::Estimate estimate;
  StateReader::read(list, estimate);
  estimate.scene = parse_scene<double>(scene, "scene");
  return {problem.spec, std::make_shared<const fit::Estimate>(std::move(estimate))};
}

}  // namespace

void bind_state(nb::module_& m, nb::class_<Fitted>& fitted) {
  fitted.def_prop_ro("state", &state_of_fitted);
  m.def("fitted_of_state", &fitted_of_state);
}

void bind_state(nb::module_& m, nb::class_<Observations>& observations) {
  observations.def_prop_ro("state", [](const Observations& self) { return StateWriter::written(self); });
  m.def("observations_of_state", [](const nb::list& list) {
    Observations all;
    StateReader::read(list, all);
    return all;
  });
}

}  // namespace python
}  // namespace shearfront
