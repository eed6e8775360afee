// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes: cell updates per second of the march on Example 1. docs/performance.md quotes these
// figures.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>

#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront {
namespace {

Scene<double> example_1() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

/// Steps of the whole grid in batches of about 2^22 cell updates, so that the bed is in motion throughout.
void march(benchmark::State& state, fv::Scheme scheme, fv::Simd simd, Limiter limiter = Limiter::mc) {
  if (simd > fv::widest_simd()) {
    state.SkipWithError("not on this processor");
    return;
  }
  const Scene<double> scene = example_1();
  const fv::Grid grid{scene.bottom(), scene.top(), static_cast<std::size_t>(state.range(0)), {}, {}};
  const fv::CellData data{
      fv::initial_averages(scene, grid),
      scheme == fv::Scheme::engquist_osher ? fv::face_rates(scene, grid) : fv::cell_rates(scene, grid),
      {},
      {},
      0,
      0};
  const auto kernel = fv::quadratic_kernel(scheme, limiter, simd);
  const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic<double>{});
  const std::uint64_t steps = std::max<std::uint64_t>(64, (1 << 22) / grid.n_cells);
  // No matter what the states are, the work is the same: there are no branches and no subnormal numbers.
  fv::March run(*kernel, flux, data, 1.0);
  for (auto _ : state) {
    run.advance(steps);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(steps * grid.n_cells));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(400)->Arg(4000)->Arg(10'000)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(march, engquist_osher_avx512, fv::Scheme::engquist_osher, fv::Simd::avx512)->Apply(sizes);
BENCHMARK_CAPTURE(march, engquist_osher_avx2, fv::Scheme::engquist_osher, fv::Simd::avx2)->Apply(sizes);
BENCHMARK_CAPTURE(march, engquist_osher_portable, fv::Scheme::engquist_osher, fv::Simd::portable)
    ->Apply(sizes);
BENCHMARK_CAPTURE(march, godunov_avx512, fv::Scheme::godunov, fv::Simd::avx512)->Apply(sizes);
BENCHMARK_CAPTURE(march, godunov_avx2, fv::Scheme::godunov, fv::Simd::avx2)->Apply(sizes);
BENCHMARK_CAPTURE(march, godunov_portable, fv::Scheme::godunov, fv::Simd::portable)->Apply(sizes);
#define SHEARFRONT_MUSCL_BENCH(limiter)                                                                     \
  BENCHMARK_CAPTURE(march, muscl_##limiter##_avx512, fv::Scheme::muscl, fv::Simd::avx512, Limiter::limiter) \
      ->Apply(sizes);                                                                                       \
  BENCHMARK_CAPTURE(march, muscl_##limiter##_avx2, fv::Scheme::muscl, fv::Simd::avx2, Limiter::limiter)     \
      ->Apply(sizes);                                                                                       \
  BENCHMARK_CAPTURE(march, muscl_##limiter##_portable, fv::Scheme::muscl, fv::Simd::portable,               \
                    Limiter::limiter)                                                                       \
      ->Apply(sizes)
SHEARFRONT_MUSCL_BENCH(minmod);
SHEARFRONT_MUSCL_BENCH(mc);
SHEARFRONT_MUSCL_BENCH(van_leer);

Scene<double> contrast_1000() {
  SceneSpec<double> spec = example_1().spec();
  spec.shear_rate = Piecewise<double>{{0.5}, {1000, 1}};
  return Scene<double>(spec);
}
Scene<double> exponential() {
  SceneSpec<double> spec = example_1().spec();
  spec.shear_rate = Exponential<double>{0.87 / 0.205, 0.205};
  spec.scale = 13.60;
  return Scene<double>(spec);
}

/// A whole run to time t with 800 cells; the argument says whether with local steps.
template <class Solver>
void run_to(benchmark::State& state, const Scene<double>& scene, double t) {
  SolverOptions options;
  options.cells = 800;
  options.local_steps = state.range(0) == 1;
  std::uint64_t updates = 0;
  for (auto _ : state) updates = Solver::solve(scene, {{t}, {0.5}}, options).summary.cell_updates;
  state.counters["updates"] = static_cast<double>(updates);
}
void godunov_to(benchmark::State& state, const Scene<double>& scene, double t) {
  run_to<GodunovSolver>(state, scene, t);
}
void muscl_to(benchmark::State& state, const Scene<double>& scene, double t) {
  run_to<MusclSolver>(state, scene, t);
}
void with_and_without(benchmark::internal::Benchmark* bench) {
  bench->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
}
#define SHEARFRONT_LOCAL_BENCH(name, scene, t)                            \
  BENCHMARK_CAPTURE(godunov_to, name, scene, t)->Apply(with_and_without); \
  BENCHMARK_CAPTURE(muscl_to, name, scene, t)->Apply(with_and_without)
SHEARFRONT_LOCAL_BENCH(example_1, example_1(), 6);
SHEARFRONT_LOCAL_BENCH(contrast_1000, contrast_1000(), 0.4);
SHEARFRONT_LOCAL_BENCH(exponential, exponential(), 0.9);

}  // namespace
}  // namespace shearfront
