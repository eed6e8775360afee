// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <utility>

#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/fv/plain_march.hpp"
#include "shearfront/fv/unimodal_flux.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// A march through the times of a request.
class Run {
 public:
  explicit Run(Grid grid) : grid_(std::move(grid)) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  virtual ~Run() = default;

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] std::uint64_t n_updates() const { return n_updates_; }
  [[nodiscard]] bool is_at_rest() const { return is_at_rest_; }

  /// The shares x = phi / c of the cells at time t; times must not descend. Empty, with the status changed,
  /// if there are none. Valid until the next call.
  virtual CellStates at(double t, Status& status) = 0;

 protected:
  static constexpr double kMostUpdates = 1e15;  ///< some days
  /// The caller is asked for leave to go on after so many cell updates, some hundredths of a second.
  static constexpr std::uint64_t kUpdatesPerCall = 1 << 24;
  /// A wave crosses the bed in as many steps as there are cells, at least: no need to look for rest more
  /// often.
  static constexpr std::size_t kLeastSteps = 1024;

  Grid grid_;
  std::uint64_t n_updates_ = 0;
  bool is_at_rest_ = false;
};

/// The grid that the options ask for.
[[nodiscard]] Grid grid_of(const Scene<double>& scene, const SolverOptions& options);

/// By March: one flux with one extremum, walls. The options, the kernel and the scene must outlive the run.
[[nodiscard]] std::unique_ptr<Run> kernel_run(Scheme scheme, const UnimodalFlux& flux, const Kernel& kernel,
                                              const Scene<double>& scene, const SolverOptions& options);

/// By PlainMarch: every scene for which refusal_of() is empty. The options must outlive the run.
[[nodiscard]] std::unique_ptr<Run> plain_run(FaceRule rule, const Scene<double>& scene,
                                             const SolverOptions& options);

}  // namespace shearfront::fv
