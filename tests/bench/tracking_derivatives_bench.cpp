// SPDX-License-Identifier: BSD-3-Clause
// Derivatives that fronts carry, on the road of datasets/traffic-us-101 (run in the folder of the project): a plain run with all
// observations; the gradient of the misfit with all 400 states beyond the ends unknown, backwards; columns forwards; and the same
// as a fit and a sampler ask for it, against the value alone. docs/evidence/performance.md quotes the ratios.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <any>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/posterior.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/track/gradient.hpp"
#include "shearfront/track/solver.hpp"

namespace shearfront {
namespace {

const std::string kFolder = "datasets/traffic-us-101/";
const TrackOptions kOptions{.resolution = 0.02};

/// The road, and where a misfit of its bins asks for M.
struct Road {
  Scene<double> scene = read_scene<double>(kFolder + "scene.toml");
  std::vector<Place> places;
  std::vector<double> targets;
  std::vector<std::size_t> outside;  ///< entries

  Road() {
    for (const Observation& bin : read_observations(kFolder + "observations.csv").rows) {
      places.push_back({bin.t, bin.z - bin.width / 2});
      places.push_back({bin.t, bin.z + bin.width / 2});
      targets.push_back(bin.value * bin.width);
    }
    const std::vector<Entry> all = entries(scene.spec());
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].field == "boundary.bottom.values" || all[i].field == "boundary.top.values")
        outside.push_back(i);
  }
  /// Of sum_i (M_i+ - M_i- - target_i)^2 / 2.
  [[nodiscard]] std::vector<Sample> weigh(const std::vector<Sample>& samples) const {
    std::vector<Sample> weights(samples.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double residual = samples[2 * i + 1].M - samples[2 * i].M - targets[i];
      weights[2 * i].M = -residual;
      weights[2 * i + 1].M = residual;
    }
    return weights;
  }
};

void us_101_plain(benchmark::State& state) {
  const Road road;
  std::any memory;
  for (auto _ : state)
    benchmark::DoNotOptimize(FrontTrackingSolver::linearise(road.scene, kOptions, road.places, {}, memory));
}
BENCHMARK(us_101_plain)->Unit(benchmark::kMillisecond);

void us_101_gradient(benchmark::State& state) {
  const Road road;
  for (auto _ : state) {
    const LinearSum result = tracking_gradient(
        road.scene, kOptions, road.places,
        [&](const std::vector<Sample>& samples) { return road.weigh(samples); }, road.outside);
    benchmark::DoNotOptimize(result.gradient.data());
    state.counters["collisions"] = static_cast<double>(result.summary.collisions);
  }
  state.counters["unknowns"] = static_cast<double>(road.outside.size());
}
BENCHMARK(us_101_gradient)->Unit(benchmark::kMillisecond);

void us_101_columns(benchmark::State& state) {
  const Road road;
  std::vector<std::size_t> wanted(road.outside.begin(), road.outside.begin() + state.range(0));
  std::any memory;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        FrontTrackingSolver::linearise(road.scene, kOptions, road.places, wanted, memory));
}
BENCHMARK(us_101_columns)->Arg(1)->Arg(4)->Arg(8)->Arg(16)->Arg(64)->Arg(400)->Unit(benchmark::kMillisecond);

/// The fit of the road with its first n states beyond the ends unknown, or all.
fit::FitSpec fit_of_ends(std::size_t n) {
  fit::FitSpec spec = fit::read_fit(kFolder + "fit.toml");
  const std::vector<Entry> all = entries(spec.scene.spec());
  spec.unknown = {};
  for (const std::size_t i : Road().outside)
    if (spec.unknown.parameters.size() < n) spec.unknown.parameters.push_back(all[i].name());
  return spec;
}

Eigen::VectorXd start_of(const fit::FitSpec& spec) {
  return fit::Parameters(spec.scene, spec.unknown).start();
}

/// Arguments: unknowns; whether with the gradient.
void us_101_posterior(benchmark::State& state) {
  const fit::FitSpec spec = fit_of_ends(static_cast<std::size_t>(state.range(0)));
  const fit::Posterior posterior(spec);
  const Eigen::VectorXd p = start_of(spec);
  for (auto _ : state) benchmark::DoNotOptimize(posterior.at(p, state.range(1) != 0).value);
}
BENCHMARK(us_101_posterior)->ArgsProduct({{1, 4, 5, 400}, {0, 1}})->Unit(benchmark::kMillisecond);

/// What a search by NLopt asks for.
void us_101_objective(benchmark::State& state) {
  const fit::FitSpec spec = fit_of_ends(static_cast<std::size_t>(state.range(0)));
  const fit::Parameters parameters(spec.scene, spec.unknown);
  const fit::Coordinates coordinates(parameters);
  fit::RunControl control(std::numeric_limits<std::size_t>::max());
  fit::Objective objective(parameters, coordinates, spec.forward,
                           fit::rows_of(fit::quantity_of(spec), spec, parameters),
                           fit::find_loss(fit::loss_of(spec), 0), control);
  Eigen::VectorXd u = coordinates.coordinates(parameters.start());
  for (auto _ : state) {
    u[0] *= 1 + 1e-12;  // the last point would not be solved again
    const auto& at = objective.evaluate_misfit(u, state.range(1) != 0);
    if (state.range(1) != 0) benchmark::DoNotOptimize(objective.gradient(at).data());
  }
}
BENCHMARK(us_101_objective)->ArgsProduct({{400}, {0, 1}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace shearfront
