// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "fit.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/fit/bootstrap.hpp"
#include "shearfront/fit/prediction.hpp"
#include "shearfront/fit/rate_band.hpp"
#include "shearfront/fit/staged_search.hpp"

namespace shearfront::python {
namespace {

using fit::Estimate;
using fit::Interval;

nb::object ends_of(const std::optional<Interval>& interval) {
  return interval ? nb::object(nb::make_tuple(interval->low, interval->high)) : nb::none();
}

nb::list parameters_of(const Fitted& self) {
  nb::list all;
  for (const fit::ParameterEstimate& p : self.estimate->parameters) {
    nb::dict row;
    row["name"] = p.name;
    row["start"] = p.start;
    row["estimate"] = p.estimate;
    row["std_error"] = p.std_error;
    row["ci95"] = ends_of(p.ci95);
    row["profile95"] = ends_of(p.profile95);
    row["bootstrap95"] = ends_of(p.bootstrap95);
    row["at_bound"] = p.at_bound;
    row["held_by_shape"] = p.held_by_shape;
    row["ci95_is_doubtful"] = p.check ? nb::object(nb::cast(p.check->is_doubtful())) : nb::none();
    all.append(row);
  }
  return all;
}

nb::dict facts_of(const Fitted& self) {
  const Estimate& e = *self.estimate;
  nb::dict all;
  all["name"] = e.name;
  all["method"] = e.method;
  all["algorithm"] = e.algorithm;
  all["quantity"] = e.quantity;
  all["loss"] = e.loss;
  all["misfit"] = e.misfit;
  all["residual_norm"] = e.residual_norm;
  all["sigma"] = e.sigma;
  all["sigma_is_given"] = e.sigma_is_given;
  all["observations"] = e.observations;
  all["left_out"] = e.left_out;
  all["evaluations"] = e.evaluations;
  all["iterations"] = e.iterations;
  all["wall_s"] = e.wall_s;
  all["aic"] = e.aic;
  all["bic"] = e.bic;
  all["structure"] = nb::none();
  if (e.structure) {
    nb::dict structure;
    structure["lag1_height"] = e.structure->lag1_height;
    structure["lag1_time"] = e.structure->lag1_time;
    structure["runs_z_score"] = e.structure->runs_z_score;
    structure["is_structured"] = e.structure->is_structured;
    all["structure"] = structure;
  }
  all["noise"] = nb::none();
  if (e.noise) {
    nb::dict noise;
    noise["model"] = e.noise->model;
    const auto add = [&](const char* key, double x, const std::optional<fit::Interval>& interval) {
      if (std::isnan(x)) return;
      noise[key] = x;
      if (interval) noise[(std::string(key) + "95").c_str()] = nb::make_tuple(interval->low, interval->high);
    };
    add("length_z", e.noise->length_z, e.noise->length_z95);
    add("length_t", e.noise->length_t, e.noise->length_t95);
    add("independent", e.noise->independent, e.noise->independent95);
    add("tau", e.noise->tau, e.noise->tau95);
    all["noise"] = noise;
  }
  all["order_of_events"] = nb::none();
  if (e.order) {
    nb::dict order;
    order["parameter"] = e.order->parameter;
    order["std_errors"] = e.order->std_errors;
    order["changes"] = e.order->changes;
    all["order_of_events"] = order;
  }
  all["warnings"] = e.warnings;
  all["status"] = std::string(name_of(e.status));
  all["message"] = e.message;
  return all;
}

/// value, lower and upper as matrices.
nb::tuple bands_of(const std::vector<fit::PredictedNumber>& numbers, std::size_t n_rows,
                   std::size_t n_columns) {
  std::vector<double> value, low, high;
  for (const fit::PredictedNumber& n : numbers) {
    value.push_back(n.value);
    low.push_back(n.band ? n.band->low : fit::kUnknown);
    high.push_back(n.band ? n.band->high : fit::kUnknown);
  }
  return nb::make_tuple(matrix_of(std::move(value), n_rows, n_columns),
                        matrix_of(std::move(low), n_rows, n_columns),
                        matrix_of(std::move(high), n_rows, n_columns));
}

nb::tuple predict(const Fitted& self, const Numbers& times, const Numbers& heights, std::size_t draws,
                  std::optional<std::uint64_t> seed) {
  const std::vector<double> t = vector_of(times), z = vector_of(heights);
  fit::DrawnScenes drawn;
  const fit::PredictedSamples samples = without_lock([&](const Progress& progress) {
    drawn =
        fit::scenes_behind(self.parameters(), *self.estimate, draws, seed.value_or(self.spec->search.seed));
    return fit::predict_samples(*self.estimate->scene, drawn, self.spec->forward.method, t, z, progress);
  });
  return nb::make_tuple(bands_of(samples.phi, t.size(), z.size()), bands_of(samples.M, t.size(), z.size()),
                        drawn.why_none, samples.n_failed);
}

nb::dict predict_events(const Fitted& self, std::size_t draws, std::optional<std::uint64_t> seed) {
  const fit::PredictedEvents events = without_lock([&](const Progress& progress) {
    const fit::DrawnScenes drawn =
        fit::scenes_behind(self.parameters(), *self.estimate, draws, seed.value_or(self.spec->search.seed));
    return fit::predict_events(*self.estimate->scene, drawn, self.spec->forward.method, progress);
  });
  nb::dict all;
  all["t0"] = ends_of(events.t0.band);
  all["t1"] = ends_of(events.t1.band);
  all["t_star"] = ends_of(events.t_star.band);
  nb::list interfaces;
  for (const auto& at : events.interfaces)
    interfaces.append(nb::make_tuple(ends_of(at.first.band), ends_of(at.last.band)));
  all["interfaces"] = interfaces;
  return all;
}

nb::tuple rate_band(const Fitted& self) {
  const fit::RateBand band = fit::rate_band(self.parameters(), *self.estimate);
  std::vector<double> z, a, low, high;
  for (const fit::RateRow& row : band.rows) {
    z.push_back(row.z);
    a.push_back(row.a);
    low.push_back(row.band ? row.band->low : fit::kUnknown);
    high.push_back(row.band ? row.band->high : fit::kUnknown);
  }
  return nb::make_tuple(array_of(std::move(z)), array_of(std::move(a)), array_of(std::move(low)),
                        array_of(std::move(high)));
}

nb::tuple bootstrap(const Fitted& self, std::size_t replicates, std::uint64_t seed, std::size_t threads) {
  fit::FitSpec spec = *self.spec;
  spec.uncertainty.bootstrap = replicates;
  spec.uncertainty.seed = seed;
  spec.uncertainty.threads = threads;
  const fit::Bootstrap found = without_lock([&](const fit::Progress& progress) {
    const fit::Refit refit = [](const fit::FitSpec& replicate, const fit::Progress& ask) {
      fit::StagedSearch search(replicate, ask);
      search.find();
      return search.values();
    };
    return fit::bootstrap(spec, self.parameters(), *self.estimate, refit, progress);
  });
  nb::list intervals;
  for (const auto& interval : found.intervals) intervals.append(ends_of(interval));
  return nb::make_tuple(intervals, matrix_of(found.estimates), matrix_of(found.covariance), found.failed,
                        found.warnings);
}

nb::tuple draws(const Fitted& self, std::size_t n, std::uint64_t seed) {
  const fit::DrawnScenes drawn = fit::draw_scenes(self.parameters(), *self.estimate, n, seed);
  nb::list scenes;
  for (const Scene<double>& scene : drawn.scenes) scenes.append(SharedScene(scene));
  return nb::make_tuple(scenes, drawn.why_none);
}

}  // namespace

void bind_estimate(nb::module_& m) {
  nb::class_<Fitted> fitted(m, "Fitted");
  fitted.def_prop_ro("parameters", &parameters_of)
      .def_prop_ro("facts", &facts_of)
      .def_prop_ro("correlation", [](const Fitted& self) { return matrix_of(self.estimate->correlation); })
      .def_prop_ro("predicted", [](const Fitted& self) { return array_of(self.estimate->predicted); })
      .def_prop_ro("scene", [](const Fitted& self) { return SharedScene(*self.estimate->scene); })
      .def("predict", &predict, nb::arg("t"), nb::arg("z"), nb::arg("draws"), nb::arg("seed").none())
      .def("predict_events", &predict_events, nb::arg("draws"), nb::arg("seed").none())
      .def("rate_band", &rate_band)
      .def("draws", &draws)
      .def("bootstrap", &bootstrap);
  bind_state(m, fitted);
}

}  // namespace shearfront::python
