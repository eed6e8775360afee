// SPDX-License-Identifier: BSD-3-Clause
// A fit of all twelve shear rates of a bed given as a table, from exact amounts at 40 times and 42 heights.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "support/identification.hpp"
#include "support/table_bed.hpp"

namespace {

using namespace shearfront;

void BM_FitOfTwelveShearRates(benchmark::State& state) {
  support::Identification problem;
  problem.name = "42 mm";
  problem.truth = support::bed_of_42_mm();
  const auto& table = std::get<Table<double>>(problem.truth.shear_rate);
  for (const double z : table.z) problem.start.push_back(0.4 * std::exp(-z / 16));
  for (int i = 0; i < 40; ++i) problem.times.push_back(20 * std::pow(1.12, i));
  for (int i = 0; i < 42; ++i) problem.heights.push_back(0.5 + i);
  const fit::FitSpec spec = support::fit_of(problem, support::exact_data(problem, Quantity::cumulative));
  fit::Estimate estimate;
  for (auto _ : state) estimate = fit::fit(spec);
  double worst = 0;
  for (std::size_t i = 0; i < table.values.size(); ++i)
    worst = std::max(worst, std::abs(estimate.parameters[i].estimate / table.values[i] - 1));
  state.counters["evaluations"] = static_cast<double>(estimate.evaluations);
  state.counters["worst_error"] = worst;
}
BENCHMARK(BM_FitOfTwelveShearRates)->Unit(benchmark::kMillisecond);

}  // namespace
