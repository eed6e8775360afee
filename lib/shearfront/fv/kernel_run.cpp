// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fv/octaves.hpp"
#include "shearfront/fv/run.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::fv {
namespace {

// A march at rest this near to the steady state (M, relative to the height) has reached it.
constexpr double kSteadyTolerance = 1e-9;

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
  for (const double capacity : capacities(scene, grid))
    data.narrowness.push_back(grid.cell_width() / capacity);
  if (options.local_steps) data.octaves = octaves_of(data);
  return data;
}

class KernelRun final : public Run {
 public:
  KernelRun(Scheme scheme, const UnimodalFlux& flux, const Kernel& kernel, const Scene<double>& scene,
            const SolverOptions& options)
      : Run(grid_of(scene, options)),
        options_(options),
        march_(kernel, flux, cell_data(scheme, scene, grid_, options), options.cfl),
        steps_per_time_(march_.speed() / (options.cfl * grid_.cell_width())),
        lost_per_step_(kernel.numbers().quantum / 4 / static_cast<double>(grid_.n_cells) *
                       static_cast<double>(march_.updates_per_step()) / static_cast<double>(grid_.n_cells)) {
    std::vector<double> widths = capacities(scene, grid_);
    for (double& width : widths) width /= grid_.cell_width();
    widths.resize(grid_.n_cells, 1.0);
    CompensatedSum<double> total;
    const CellStates start = march_.states(0);
    for (std::size_t j = 0; j < grid_.n_cells; ++j) total += start.phi[j] * widths[j];
    steady_ = steady_state(scheme, flux, total.value(), widths);
    relative_widths_ = std::move(widths);
  }

  CellStates at(double t, Status& status) override {
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
  March march_;
  double steps_per_time_;
  double lost_per_step_;  ///< bound for what rounding takes from M / height in a step
  std::vector<double> steady_, relative_widths_;
  std::uint64_t next_check_ = 0;
  bool is_steady_ = false;
};

}  // namespace

std::unique_ptr<Run> kernel_run(Scheme scheme, const UnimodalFlux& flux, const Kernel& kernel,
                                const Scene<double>& scene, const SolverOptions& options) {
  return std::make_unique<KernelRun>(scheme, flux, kernel, scene, options);
}

}  // namespace shearfront::fv
