// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes: cell updates per second of the march on Example 1. docs/evidence/performance.md quotes these
// figures.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>

#include "shearfront/fv/march.hpp"
#include "shearfront/model/flux/all.hpp"

namespace shearfront {
namespace {

/// Steps of the whole grid in batches of about 2^22 cell updates, so that the bed is in motion throughout.
void march(benchmark::State& state, const fv::Scheme& scheme,
           const Flux<double>& flux = Quadratic<double>{}) {
  SceneSpec<double> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{0.29}, {2.4, 0.31}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  const Scene<double> scene(spec);
  const auto n_cells = static_cast<std::size_t>(state.range(0));
  const std::uint64_t steps = std::max<std::uint64_t>(64, (1 << 22) / n_cells);
  // No matter what the states are, the work is the same: there are no branches and no subnormal numbers.
  fv::March run(scheme, scene, fv::equal_cells(scene, n_cells));
  for (auto _ : state) {
    for (std::uint64_t i = 0; i < steps; ++i) run.step(run.largest_step());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(steps * n_cells));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Arg(400)->Arg(4000)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
}
const fv::Scheme kGodunov{};
const fv::Scheme kEngquistOsher{fv::Rule::engquist_osher};
BENCHMARK_CAPTURE(march, engquist_osher, kEngquistOsher)->Apply(sizes);
BENCHMARK_CAPTURE(march, godunov, kGodunov)->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_minmod, fv::Scheme{fv::Rule::godunov, {}, Limiter::minmod})->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_mc, fv::Scheme{fv::Rule::godunov, {}, Limiter::mc})->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_van_leer, fv::Scheme{fv::Rule::godunov, {}, Limiter::van_leer})->Apply(sizes);
BENCHMARK_CAPTURE(march, engquist_osher_cubic, kEngquistOsher, Cubic<double>{0.5})->Apply(sizes);
BENCHMARK_CAPTURE(march, godunov_cubic, kGodunov, Cubic<double>{0.5})->Apply(sizes);

}  // namespace
}  // namespace shearfront
