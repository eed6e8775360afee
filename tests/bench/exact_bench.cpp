// SPDX-License-Identifier: BSD-3-Clause
// Cost of the exact solution per point, with and without derivatives, of its event times and its
// construction.
#include <benchmark/benchmark.h>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace {

using namespace shearfront;
using support::SceneMaker;

enum Kind { step_falling, step_rising, step_random, ten_jumps, exponential, table };

Scene<double> scene_of(Kind kind, int layers) {
  SceneMaker make(3);
  SceneSpec<double> spec;
  switch (kind) {
    case step_falling:
      spec = make.step(layers, SceneMaker::Order::falling);
      break;
    case step_rising:
      spec = make.step(layers, SceneMaker::Order::rising);
      break;
    case ten_jumps:
      while (spec.initial_breaks.size() < 10) spec = make.data(layers, SceneMaker::Order::random, 12);
      break;
    default:
      spec = make.step(layers, SceneMaker::Order::random);
  }
  if (kind == exponential) spec.shear_rate = Exponential<double>{0.87 / 0.205, 0.205};
  if (kind == table) spec.shear_rate = Table<double>{{0, 0.4, 1}, {2, 1, 0.5}};
  return Scene<double>(spec);
}

/// Points spread over the domain and over the time to the steady state.
std::vector<std::pair<double, double>> points_of(const Scene<double>& scene) {
  SceneMaker make(4);
  const double t_star = *exact_timeline(scene).t_star;
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < 1024; ++i) points.emplace_back(make.uniform(0, 1), make.uniform(0, t_star));
  return points;
}

void BM_Point(benchmark::State& state) {
  const auto scene = scene_of(static_cast<Kind>(state.range(0)), static_cast<int>(state.range(1)));
  const ExactSolution<double> solution(scene);
  const auto points = points_of(scene);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [z, t] = points[i++ % points.size()];
    benchmark::DoNotOptimize(solution.at(z, t));
  }
}
void BM_PointWithAllDerivatives(benchmark::State& state) {
  const auto scene = scene_of(static_cast<Kind>(state.range(0)), static_cast<int>(state.range(1)));
  const ExactSolution<double> solution(scene);
  const Derivatives<double> derivatives(solution);
  const auto points = points_of(scene);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [z, t] = points[i++ % points.size()];
    benchmark::DoNotOptimize(derivatives.at(z, t));
  }
}
void BM_Timeline(benchmark::State& state) {
  const auto scene = scene_of(static_cast<Kind>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(exact_timeline(scene));
}
void BM_Construction(benchmark::State& state) {
  const auto scene = scene_of(static_cast<Kind>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(ExactSolution<double>(scene));
}
void BM_Point50Digits(benchmark::State& state) {
  const auto scene = scene_of(static_cast<Kind>(state.range(0)), static_cast<int>(state.range(1)));
  const ExactSolution<Real110> solution(scene_cast<Real110>(scene));
  const auto points = points_of(scene);
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [z, t] = points[i++ % points.size()];
    benchmark::DoNotOptimize(solution.at(Real110(z), Real110(t)));
  }
}

void scenes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"kind", "layers"});
  for (const int kind : {step_falling, step_rising, step_random, ten_jumps})
    for (const int layers : {2, 10}) bench->Args({kind, layers});
  bench->Args({exponential, 1})->Args({table, 1})->Args({step_falling, 100});
}
BENCHMARK(BM_Point)->Apply(scenes);
BENCHMARK(BM_PointWithAllDerivatives)->Apply(scenes);
BENCHMARK(BM_Timeline)->Apply(scenes);
BENCHMARK(BM_Construction)->Apply(scenes);
BENCHMARK(BM_Point50Digits)->ArgNames({"kind", "layers"})->Args({step_falling, 2})->Args({step_falling, 10});

}  // namespace
