// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/solve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "shearfront/fv/march.hpp"
#include "shearfront/fv/octaves.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::fv {
namespace {

constexpr std::size_t kMostCells = 100'000'000;  // 6 to 14 GB
constexpr double kMostUpdates = 1e15;            // some days
// The caller is asked for leave to go on after so many cell updates, some hundredths of a second.
constexpr std::uint64_t kUpdatesPerCall = 1 << 24;
// A wave crosses the bed in as many steps as there are cells, at least: no need to look for rest more often.
constexpr std::size_t kLeastSteps = 1024;
// A march at rest this near to the steady state (M, relative to the height) has reached it.
constexpr double kSteadyTolerance = 1e-9;

std::string refusal(const UnimodalFlux& flux, const SolverOptions& options) {
  if (options.cells < 1) return "cells = 0; must be >= 1";
  if (options.cells > kMostCells)
    return "cells = " + std::to_string(options.cells) + "; must be <= " + std::to_string(kMostCells);
  if (!(options.cfl > 0 && options.cfl <= 1))
    return "cfl = " + number_text(options.cfl) + "; must be > 0 and <= 1";
  return flux.refusal;
}

std::vector<double> rates_of(Scheme scheme, const Scene<double>& scene, const Grid& grid,
                             const SolverOptions& options) {
  if (scheme == Scheme::engquist_osher)
    return options.face_coefficient == FaceCoefficient::value ? face_values(scene, grid)
                                                              : face_rates(scene, grid);
  const bool is_smooth = scheme == Scheme::muscl && !scene.is_layered();
  return is_smooth ? face_values(scene, grid) : cell_rates(scene, grid);
}

CellData cell_data(Scheme scheme, const Scene<double>& scene, const Grid& grid,
                   const SolverOptions& options) {
  CellData data{initial_averages(scene, grid), rates_of(scheme, scene, grid, options), {}, {}, 0, 0};
  for (const double width : grid.widths) data.narrowness.push_back(grid.cell_width() / width);
  if (options.local_steps) data.octaves = octaves_of(data);
  return data;
}

/// A march through the times of a request.
class Run {
 public:
  Run(Scheme scheme, const UnimodalFlux& flux, const Kernel& kernel, const Scene<double>& scene,
      const SolverOptions& options)
      : options_(options),
        grid_(options.align_cells ? aligned_grid(scene, options.cells)
                                  : Grid{scene.bottom(), scene.top(), options.cells, {}, {}}),
        march_(kernel, flux, cell_data(scheme, scene, grid_, options), options.cfl),
        steps_per_time_(march_.speed() / (options.cfl * grid_.cell_width())),
        lost_per_step_(kernel.numbers().quantum / 4 / static_cast<double>(grid_.n_cells) *
                       static_cast<double>(march_.updates_per_step()) / static_cast<double>(grid_.n_cells)) {
    std::vector<double> widths(grid_.n_cells, 1.0);
    if (!grid_.widths.empty())
      for (std::size_t j = 0; j < grid_.n_cells; ++j) widths[j] = grid_.widths[j] / grid_.cell_width();
    CompensatedSum<double> total;
    const CellStates start = march_.states(0);
    for (std::size_t j = 0; j < grid_.n_cells; ++j) total += start.phi[j] * widths[j];
    steady_ = steady_state(scheme, flux, total.value(), widths);
    relative_widths_ = std::move(widths);
  }

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] std::uint64_t n_updates() const { return n_updates_; }
  [[nodiscard]] bool is_at_rest() const { return is_at_rest_; }

  /// The states at time t; times must not descend. Empty, with the status changed, if there are none.
  CellStates at(double t, Status& status) {
    if (!std::isfinite(t)) {
      is_at_rest_ = true;
      return {steady_, {}};
    }
    const double steps = t * steps_per_time_, whole = std::floor(steps);
    if (status = march_to(whole, t); status != Status::ok) return {};
    if (is_at_rest_) return march_.states(0);
    n_updates_ += steps > whole ? march_.updates_per_step() : 0;
    return march_.states(steps - whole);
  }

 private:
  Status march_to(double steps, double t) {
    while (!is_at_rest_) {
      const auto done = static_cast<double>(march_.n_steps());
      if (!(done < steps)) return Status::ok;
      if (options_.progress && !options_.progress(t * (done / steps), n_updates_)) return Status::interrupted;
      if (static_cast<double>(n_updates_) > kMostUpdates) return Status::budget_reached;
      const std::uint64_t call = std::clamp<std::uint64_t>(kUpdatesPerCall / march_.updates_per_step(), 1,
                                                           std::max(kLeastSteps, grid_.n_cells));
      const auto n = static_cast<std::uint64_t>(std::min(static_cast<double>(call), steps - done));
      march_.advance(n);
      n_updates_ += n * march_.updates_per_step();
      if (march_.n_steps() >= next_check_) check_rest();
    }
    // What rounding has stopped or will have taken by then is too much if the bed is not steady.
    return is_steady_ || steps * lost_per_step_ < kSteadyTolerance ? Status::ok : Status::not_converged;
  }

  void check_rest() {
    next_check_ = march_.n_steps() + std::max(kLeastSteps, grid_.n_cells);
    is_at_rest_ = march_.is_at_rest();
    if (!is_at_rest_) return;
    double amount = 0, largest = 0;
    const auto phi = march_.states(0).phi;
    for (std::size_t j = 0; j < phi.size(); ++j)
      largest = std::max(largest, std::abs(amount += (phi[j] - steady_[j]) * relative_widths_[j]));
    is_steady_ = largest <= kSteadyTolerance * static_cast<double>(phi.size());
  }

  const SolverOptions& options_;
  Grid grid_;
  March march_;
  double steps_per_time_;
  double lost_per_step_;  ///< bound for what rounding takes from M / height in a step
  std::vector<double> steady_, relative_widths_;
  std::uint64_t n_updates_ = 0, next_check_ = 0;
  bool is_at_rest_ = false, is_steady_ = false;
};

std::string message_of(Status status, std::uint64_t n_updates) {
  switch (status) {
    case Status::steady:
      return "steady state reached";
    case Status::interrupted:
      return "interrupted after " + std::to_string(n_updates) + " cell updates";
    case Status::budget_reached:
      return "stopped at " + std::to_string(n_updates) + " cell updates; use fewer cells or another method";
    case Status::not_converged:
      return "the shear rates differ so much that rounding stops the slow cells; use another method";
    default:
      return "reached the last time";
  }
}

}  // namespace

std::vector<Sample> sample_cells(const Grid& grid, const CellStates& cells,
                                 const std::vector<double>& depths) {
  std::vector<std::size_t> order(depths.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return depths[a] < depths[b]; });
  std::vector<Sample> samples(depths.size());
  CompensatedSum<double> below;
  std::size_t cell = 0;
  // In the order of operations of Profile: the same to the bit.
  for (const std::size_t i : order) {
    for (; cell + 1 < grid.n_cells && grid.edge(cell + 1) <= depths[i]; ++cell)
      below += (grid.edge(cell + 1) - grid.edge(cell)) * ((cells.at_bottom(cell) + cells.at_top(cell)) / 2);
    const double d = depths[i] - grid.edge(cell), width = grid.edge(cell + 1) - grid.edge(cell);
    const double bottom = cells.at_bottom(cell), top = cells.at_top(cell);
    const double phi = bottom == top ? top : bottom + (top - bottom) * (d / width);
    samples[i] = {phi, below.value() + d * (bottom == top ? top : (bottom + phi) / 2)};
  }
  return samples;
}

Profile<double> profile_of_cells(const Grid& grid, const CellStates& cells) {
  std::vector<double> edges(grid.n_cells + 1), below(grid.n_cells), above(grid.n_cells);
  for (std::size_t j = 0; j <= grid.n_cells; ++j) edges[j] = grid.edge(j);
  for (std::size_t j = 0; j < grid.n_cells; ++j) {
    below[j] = cells.at_bottom(j);
    above[j] = cells.at_top(j);
  }
  return {std::move(edges), std::move(below), std::move(above)};
}

SolverResult solve(Scheme scheme, const UnimodalFlux& flux, const Kernel& kernel, const Scene<double>& scene,
                   const SolverRequest& request, const SolverOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  SolverResult result;
  Status status = Status::ok;
  if (std::string why = refusal(flux, options); !why.empty()) {
    result.summary.status = Status::unsupported;
    result.summary.message = std::move(why);
    return result;
  }
  Run run(scheme, flux, kernel, scene, options);
  std::vector<std::size_t> order(request.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return request.times[a] < request.times[b]; });
  const std::size_t n = request.depths.size();
  result.samples.resize(request.times.size() * n);
  if (request.profiles) result.profiles.resize(request.times.size());
  for (const std::size_t i : order) {
    const CellStates cells = run.at(request.times[i], status);
    if (status != Status::ok) break;
    const auto samples = sample_cells(run.grid(), cells, request.depths);
    std::copy(samples.begin(), samples.end(), result.samples.begin() + static_cast<std::ptrdiff_t>(i * n));
    if (request.profiles) result.profiles[i] = profile_of_cells(run.grid(), cells);
  }
  if (status == Status::ok && run.is_at_rest()) status = Status::steady;
  if (status != Status::ok && status != Status::steady) {
    result.samples.clear();
    result.profiles.clear();
  }
  result.summary.status = status;
  result.summary.message = message_of(status, run.n_updates());
  result.summary.cell_updates = run.n_updates();
  result.summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

SolverResult solve(Scheme scheme, const Scene<double>& scene, const SolverRequest& request,
                   const SolverOptions& options) {
  const UnimodalFlux flux = std::visit([](const auto& f) { return unimodal_flux(f); }, scene.flux());
  const auto kernel = flux.is_quadratic ? quadratic_kernel(scheme, options.limiter)
                                        : unimodal_kernel(scheme, flux, options.limiter);
  return solve(scheme, flux, *kernel, scene, request, options);
}

}  // namespace shearfront::fv
