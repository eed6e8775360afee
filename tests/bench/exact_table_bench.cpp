// SPDX-License-Identifier: BSD-3-Clause
// Cost of the exact solution of tables: per place, with the derivatives by all entries, and of whole profiles at one time.
#include <benchmark/benchmark.h>

#include <any>
#include <cmath>
#include <vector>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/random_scene.hpp"

namespace {

using namespace shearfront;
using support::SceneMaker;

enum Bed { smooth, noisy, many_jumps, two_jumps };

/// A rate that falls by e^4 over the bed, at so many knots.
Scene<double> scene_of(int bed, int knots) {
  SceneMaker make(5);
  SceneSpec<double> spec;
  Table<double> table;
  for (int i = 0; i < knots; ++i) {
    const double z = static_cast<double>(i) / (knots - 1);
    table.z.push_back(z);
    table.values.push_back(4 * std::exp(-4 * z) *
                           (bed == smooth || bed == two_jumps ? 1 : std::exp(make.uniform(-0.3, 0.3))));
  }
  spec.shear_rate = table;
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  if (bed == two_jumps) {
    spec.initial_breaks = {0.3, 0.6};
    spec.initial_values = {0.1, 0.9, 0.4};
  } else if (bed == many_jumps) {
    spec.initial_breaks = {0.1, 0.25, 0.4, 0.55, 0.7, 0.85};
    spec.initial_values = {0.2, 0.8, 0.1, 1, 0.4, 0.9, 0.6};
  }
  return Scene<double>(spec);
}

/// Spread over the bed and over the time to the steady state.
std::vector<Place> places_of(const Scene<double>& scene) {
  SceneMaker make(4);
  const double t_star = *exact_timeline(scene).t_star;
  std::vector<Place> places;
  for (int i = 0; i < 2000; ++i) places.push_back({make.uniform(0, t_star), make.uniform(0, 1)});
  return places;
}

void per_place(benchmark::State& state, std::size_t n) {
  state.counters["per_place"] = benchmark::Counter(
      static_cast<double>(n), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void BM_TablePlaces(benchmark::State& state) {
  const auto scene = scene_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const ExactSolution<double> solution(scene);
  const auto places = places_of(scene);
  for (auto _ : state)
    for (const Place& place : places) benchmark::DoNotOptimize(solution.at(place.z, place.t));
  per_place(state, places.size());
}
void linearise(benchmark::State& state, const Scene<double>& scene, const std::vector<Place>& places) {
  std::vector<std::size_t> wanted;
  const std::vector<Entry> all = entries(scene.spec());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (ExactSolver::derivative_refusal(scene, {}, all[i]).empty()) wanted.push_back(i);
  for (auto _ : state) {
    std::any memory;
    benchmark::DoNotOptimize(ExactSolver::linearise(scene, {}, places, wanted, memory));
  }
  per_place(state, places.size());
}
void BM_TablePlacesWithDerivatives(benchmark::State& state) {
  const auto scene = scene_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  linearise(state, scene, places_of(scene));
}
/// 1000 heights at each of five times.
SolverRequest profiles_of(const Scene<double>& scene) {
  const double t_star = *exact_timeline(scene).t_star;
  SolverRequest request;
  for (const double share : {0.05, 0.15, 0.3, 0.5, 0.8}) request.times.push_back(share * t_star);
  for (int i = 0; i < 1000; ++i) request.heights.push_back((i + 0.5) / 1000);
  return request;
}
void BM_TableProfiles(benchmark::State& state) {
  const auto scene = scene_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const SolverRequest request = profiles_of(scene);
  const Method exact = Method::of<ExactSolver>();
  for (auto _ : state) benchmark::DoNotOptimize(solve(scene, exact, request));
  per_place(state, request.times.size() * request.heights.size());
}
void BM_TableProfilesWithDerivatives(benchmark::State& state) {
  const auto scene = scene_of(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const SolverRequest request = profiles_of(scene);
  std::vector<Place> places;
  for (const double t : request.times)
    for (const double z : request.heights) places.push_back({t, z});
  linearise(state, scene, places);
}

void beds(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"bed", "knots"})->Unit(benchmark::kMicrosecond);
  for (const int bed : {smooth, noisy, many_jumps, two_jumps})
    for (const int knots : {8, 20, 64, 256}) bench->Args({bed, knots});
}
BENCHMARK(BM_TablePlaces)->Apply(beds);
BENCHMARK(BM_TablePlacesWithDerivatives)->Apply(beds);
BENCHMARK(BM_TableProfiles)->Apply(beds);
BENCHMARK(BM_TableProfilesWithDerivatives)->Apply(beds);

}  // namespace
