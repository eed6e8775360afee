// SPDX-License-Identifier: BSD-3-Clause
#include <emscripten.h>

#include <cstddef>
#include <string>
#include <vector>

#include "answer.hpp"
#include "levenberg_marquardt.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/fit/forward.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/io/observations_csv.hpp"

/// Observations, and the fit of the scene to them.
using namespace shearfront;
using namespace shearfront::web;

extern "C" {
/// Of the page: told how a search goes on; 0 ends it.
extern int sf_watch(double evaluations, double misfit, const double* values, std::size_t n);
}

namespace {

fit::FitFile fit_file(const char* text, std::size_t size) {
  if (!work().observations) throw InputError("observations", "", "must be given first");
  return fit::parse_fit({text, size}, "fit.toml", *work().scene, *work().observations);
}

void add(Answer& a, const fit::ParameterEstimate& p) {
  a.add(p.start), a.add(p.estimate), a.add(p.std_error);
  a.add(p.ci95 ? std::optional(p.ci95->low) : std::nullopt);
  a.add(p.ci95 ? std::optional(p.ci95->high) : std::nullopt);
  a.add(p.profile95 ? std::optional(p.profile95->low) : std::nullopt);
  a.add(p.profile95 ? std::optional(p.profile95->high) : std::nullopt);
  a.add(p.at_bound ? 1 : 0);
}

}  // namespace

extern "C" {

/// Reads a file of observations of the scene and keeps them. Numbers: t, z, value, width, sigma of each. Text: the quantity,
/// how the file was understood, then notes, a line each.
EMSCRIPTEN_KEEPALIVE int sf_observations(const char* text, std::size_t size) {
  return answered([&](Answer& a) {
    Observations read = parse_observations(std::string(text, size), "observations.csv", *work().scene);
    for (const Observation& o : read.rows)
      for (const double x : {o.t, o.z, o.value, o.width, o.sigma}) a.add(x);
    a.line(name_of(read.quantity));
    a.line(read.understood);
    for (const std::string& note : read.notes) a.line(note);
    work().observations = std::move(read);
  });
}

/// What the scene says of each observation, in its own quantity, by the forward model of the fit file.
EMSCRIPTEN_KEEPALIVE int sf_predict(const char* text, std::size_t size) {
  return answered([&](Answer& a) {
    const fit::FitSpec spec = fit_file(text, size).spec;
    const fit::Parameters parameters(spec.scene, spec.unknown);
    fit::ResidualRows rows;
    fit::MisfitList::for_each([&]<class M>() {
      if (name_of(spec.observations.quantity) == M::kName)
        rows = M::rows(spec.observations, spec.scene.bottom(), spec.scene.top());
    });
    const fit::Forward forward(parameters, spec.forward, rows.field, rows.points);
    const fit::Prediction at = forward.predict(parameters.start(), false);
    if (!at.is_valid()) throw InputError("forward", "", at.failure);
    const Eigen::VectorXd r = rows.residuals(at.values);
    a.numbers.assign(spec.observations.rows.size(), 0);
    for (std::size_t i = 0; i < rows.rows.size(); ++i)
      a.numbers[rows.data(i).front().index] =
          rows.rows[i].target + r[static_cast<Eigen::Index>(i)] / rows.rows[i].weight;
  });
}

/// Fits the scene to the observations as the fit file says. Numbers: misfit, residual norm, sigma, observations, left out,
/// evaluations, iterations, number P of unknowns; of each start, estimate, standard error, ends of the 95 % interval, of the
/// profile interval, whether it is at a bound; the correlations, P x P; what the estimate says of each observation. Text:
/// status, message, quantity, loss, names of the unknowns, warnings, a line each.
EMSCRIPTEN_KEEPALIVE int sf_fit(const char* text, std::size_t size) {
  return answered([&](Answer& a) {
    const fit::FitSpec spec = fit_file(text, size).spec;
    set_watcher([](std::size_t evaluations, double misfit, const Eigen::VectorXd& values) {
      sf_watch(static_cast<double>(evaluations), misfit, values.data(),
               static_cast<std::size_t>(values.size()));
    });
    const fit::Estimate estimate = fit::fit(spec);
    for (const double x :
         {estimate.misfit, estimate.residual_norm, estimate.sigma, static_cast<double>(estimate.observations),
          static_cast<double>(estimate.left_out), static_cast<double>(estimate.evaluations),
          static_cast<double>(estimate.iterations), static_cast<double>(estimate.parameters.size())})
      a.add(x);
    for (const auto& p : estimate.parameters) add(a, p);
    const auto n = static_cast<Eigen::Index>(estimate.parameters.size());
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        a.add(estimate.correlation.rows() == n ? estimate.correlation(i, j) : fit::kUnknown);
    a.add(estimate.predicted);
    for (const std::string_view line : {name_of(estimate.status), std::string_view(estimate.message),
                                        std::string_view(estimate.quantity), std::string_view(estimate.loss)})
      a.line(line);
    for (const auto& p : estimate.parameters) a.line(p.name);
    for (const std::string& warning : estimate.warnings) a.line(warning);
  });
}
}
