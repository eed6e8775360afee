// SPDX-License-Identifier: BSD-3-Clause
// Finite volumes: cell updates per second of the march on Example 1. docs/performance.md quotes these
// figures.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>

#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/march.hpp"

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
  const fv::UnimodalFlux flux = fv::unimodal_flux(Quadratic{});
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
BENCHMARK_CAPTURE(march, muscl_minmod_avx512, fv::Scheme::muscl, fv::Simd::avx512, Limiter::minmod)
    ->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_mc_avx512, fv::Scheme::muscl, fv::Simd::avx512, Limiter::mc)->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_van_leer_avx512, fv::Scheme::muscl, fv::Simd::avx512, Limiter::van_leer)
    ->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_mc_avx2, fv::Scheme::muscl, fv::Simd::avx2, Limiter::mc)->Apply(sizes);
BENCHMARK_CAPTURE(march, muscl_mc_portable, fv::Scheme::muscl, fv::Simd::portable, Limiter::mc)->Apply(sizes);

}  // namespace
}  // namespace shearfront
