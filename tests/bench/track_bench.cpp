// SPDX-License-Identifier: BSD-3-Clause
// Front tracking: time per collision, building the grid included. docs/performance.md quotes these figures.
#include <benchmark/benchmark.h>

#include <cmath>

#include "shearfront/track/setup.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

Scene<double> example_1() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

Scene<double> exponential() {
  SceneSpec<double> spec;
  spec.shear_rate = Exponential<double>{0.87 / 0.205, 0.205};
  spec.scale = 13.60;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

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

void run(benchmark::State& state, const Scene<double>& scene, double resolution, double t) {
  double collisions = 0, levels = 0, fronts = 0;
  for (auto _ : state) {
    const TrackingSetup<double> setup(scene, resolution);
    Tracker<LevelGrid<double>> tracker(setup.grid, setup.pieces);
    tracker.advance_to(t);
    benchmark::DoNotOptimize(tracker.last_collision());
    collisions = static_cast<double>(tracker.n_collisions());
    levels = static_cast<double>(setup.grid.n_levels());
    fronts = static_cast<double>(tracker.n_fronts_max());
  }
  state.counters["collisions"] = collisions;
  state.counters["levels"] = levels;
  state.counters["fronts"] = fronts;
  state.counters["per_collision"] = benchmark::Counter(
      collisions, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
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
  run(state, exponential(), 1 / static_cast<double>(state.range(0)), 0.9);
}
BENCHMARK(exponential_to_0_9)->Arg(30)->Arg(100)->Arg(200)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace shearfront
