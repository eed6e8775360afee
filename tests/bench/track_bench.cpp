// SPDX-License-Identifier: BSD-3-Clause
// Front tracking: time per collision, building the grid included. docs/evidence/performance.md quotes these figures.
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/random_scene.hpp"
#include "support/source_examples.hpp"

namespace shearfront {
namespace {

using support::example_1;
using support::example_2;

Scene<double> random_jumps(std::size_t n) {
  support::SceneMaker maker(1);
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  for (std::size_t i = 1; i <= n; ++i) {
    spec.initial_breaks.push_back(static_cast<double>(i) / static_cast<double>(n + 1));
    spec.initial_values.push_back(maker.uniform(0, 1));
  }
  spec.initial_values.push_back(maker.uniform(0, 1));
  return Scene<double>(spec);
}

template <class Grid = LevelGrid<double>>
void run(benchmark::State& state, const Scene<double>& scene, double resolution, double t) {
  double collisions = 0, levels = 0, fronts = 0;
  std::clock_t building = 0, all = 0;
  for (auto _ : state) {
    const std::clock_t begin = std::clock();
    const TrackingSetup<double, Grid> setup(scene, resolution);
    building += std::clock() - begin;
    Tracker<Grid> tracker(setup);
    tracker.advance_to(t);
    benchmark::DoNotOptimize(tracker.last_collision());
    collisions = static_cast<double>(tracker.n_collisions());
    levels = static_cast<double>(setup.grid.n_levels());
    fronts = static_cast<double>(tracker.n_fronts_max());
    all += std::clock() - begin;
  }
  state.counters["collisions"] = collisions;
  state.counters["levels"] = levels;
  state.counters["fronts"] = fronts;
  state.counters["per_collision"] = benchmark::Counter(
      collisions, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["without_grid"] =
      static_cast<double>(all - building) / CLOCKS_PER_SEC /
      (collisions * static_cast<double>(state.iterations()));  // seconds per collision
}

void example_1_to_steady(benchmark::State& state) {
  // About 1.43 / resolution collisions.
  run(state, example_1(), 1.43 / static_cast<double>(state.range(0)), infinity<double>());
}
BENCHMARK(example_1_to_steady)->RangeMultiplier(10)->Range(100, 10'000'000)->Unit(benchmark::kMillisecond);

void random_data_to_steady(benchmark::State& state) {
  run(state, random_jumps(static_cast<std::size_t>(state.range(0))), 0.1, infinity<double>());
}
BENCHMARK(random_data_to_steady)
    ->RangeMultiplier(10)
    ->Range(10'000, 1'000'000)
    ->Unit(benchmark::kMillisecond);

void exponential_to_0_9(benchmark::State& state) {
  run(state, example_2(), 1 / static_cast<double>(state.range(0)), 0.9);
}
BENCHMARK(exponential_to_0_9)->Arg(30)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

/// One flux of every kind; the first one is what the others are compared with.
const std::vector<std::pair<std::string, Flux<double>>>& fluxes() {
  static const std::vector<std::pair<std::string, Flux<double>>> all{
      {"quadratic", Quadratic<double>{}},
      {"lwr_1", Lwr<double>{}},
      {"lwr", Lwr<double>{0.125}},
      {"cubic_0.25", Cubic<double>{0.25}},
      {"cubic_0.9", Cubic<double>{0.9}},
      {"cubic_0.9_scaled", Cubic<double>{0.9, CubicScaling::quadratic_extremum}},
      {"triangular", Triangular<double>{0.25, 1}},
      {"richardson-zaki", RichardsonZaki<double>{4.7}},
      {"table", FluxTable<double>{{0, 0.1, 0.4, 0.7, 1}, {0, -0.125, -0.25, -0.0625, 0}}}};
  return all;
}

/// Layers, with the share of the range that opens a fan below the jump, and the other one above.
SceneSpec<double> step_of(const Flux<double>& flux) {
  SceneSpec<double> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  const auto [lowest, highest] = flux.range();
  const bool has_minimum = flux.value(flux.extrema().front()) < 0;
  spec.initial_values = {has_minimum ? lowest : highest, has_minimum ? highest : lowest};
  return spec;
}

/// 1000 jumps between 32 states, drawn at random.
SceneSpec<double> jumps_of(const Flux<double>& flux) {
  support::SceneMaker maker(2);
  SceneSpec<double> spec = step_of(flux);
  const double highest = flux.range().highest;
  spec.initial_breaks.clear();
  spec.initial_values.clear();
  for (int i = 0; i <= 1000; ++i) {
    if (i > 0) spec.initial_breaks.push_back(i / 1001.0);
    spec.initial_values.push_back(highest * maker.integer(0, 31) / 31);
  }
  return spec;
}

/// Of an exponential a(z): every layer has a grid of its own.
SceneSpec<double> staircase_of(const Flux<double>& flux) {
  SceneSpec<double> spec = step_of(flux);
  spec.shear_rate = Exponential<double>{4, 0.2};
  return spec;
}

void any_flux(benchmark::State& state, const SceneSpec<double>& spec, double resolution, double t) {
  const Scene<double> scene(spec);
  state.SetLabel(fluxes()[static_cast<std::size_t>(state.range(0))].first);
  if (LevelGrid<double>::refusal(tracking_layers(scene, resolution)).empty())
    run<LevelGrid<double>>(state, scene, resolution, t);
  else
    run<UnimodalGrid<double>>(state, scene, resolution, t);
}
const Flux<double>& flux_of(const benchmark::State& state) {
  return fluxes()[static_cast<std::size_t>(state.range(0))].second;
}
void flux_step_to_steady(benchmark::State& state) {
  any_flux(state, step_of(flux_of(state)), 1e-4, infinity<double>());
}
void flux_jumps_to_steady(benchmark::State& state) {
  any_flux(state, jumps_of(flux_of(state)), 0.01, infinity<double>());
}
void flux_staircase_to_3(benchmark::State& state) { any_flux(state, staircase_of(flux_of(state)), 0.03, 3); }
void every_flux(benchmark::internal::Benchmark* bench) {
  for (std::size_t i = 0; i < fluxes().size(); ++i) bench->Arg(static_cast<std::int64_t>(i));
  bench->Unit(benchmark::kMillisecond);
}
BENCHMARK(flux_step_to_steady)->Apply(every_flux);
BENCHMARK(flux_jumps_to_steady)->Apply(every_flux);
BENCHMARK(flux_staircase_to_3)->Apply(every_flux);

}  // namespace
}  // namespace shearfront
