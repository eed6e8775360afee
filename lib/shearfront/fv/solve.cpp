// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "shearfront/fv/run.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fv {
namespace {

constexpr std::size_t kMostCells = 100'000'000;  // 6 to 14 GB

std::string refusal(const Scene<double>& scene, const SolverOptions& options) {
  if (scene.has_diffusion()) return "this scheme knows no diffusion";
  if (options.cells < 1) return "cells = 0; must be >= 1";
  if (options.cells > kMostCells)
    return "cells = " + std::to_string(options.cells) + "; must be <= " + std::to_string(kMostCells);
  if (!(options.cfl > 0 && options.cfl <= 1))
    return "cfl = " + number_text(options.cfl) + "; must be > 0 and <= 1";
  return "";
}

bool is_for_kernels(const Scene<double>& scene, const UnimodalFlux& flux) {
  return scene.fluxes().size() == 1 && scene.has_walls() && flux.refusal.empty();
}

/// Why the plain march cannot solve the scene; empty if it can.
std::string refusal(FaceRule rule, const Scene<double>& scene) {
  const bool has_jumps = !scene.is_uniform();
  for (const Flux<double>& flux : scene.fluxes()) {
    const FluxBranches branches = flux_branches(flux);
    const std::string name = std::visit([](const auto& f) { return std::string(f.kName); }, flux);
    const bool is_reference = rule == FaceRule::classical_godunov || rule == FaceRule::upwind;
    if (is_reference && !branches.is_parabola)
      return "flux " + name + " has no values for shares beyond its range, where this scheme goes";
    if (has_jumps && !(branches.has_one_extremum() && branches.vanishes))
      return "flux " + name +
             " has no exact flux between cells of unequal rate or packing: it must have one extremum and "
             "vanish at both ends of its range";
  }
  return "";
}

std::string message_of(Status status, std::uint64_t n_updates, bool has_walls) {
  switch (status) {
    case Status::steady:
      return "steady state reached";
    case Status::interrupted:
      return "interrupted after " + std::to_string(n_updates) + " cell updates";
    case Status::budget_reached:
      return "stopped at " + std::to_string(n_updates) + " cell updates; use fewer cells or another method";
    case Status::not_converged:
      return has_walls
                 ? "the shear rates differ so much that rounding stops the slow cells; use another method"
                 : "the bed has not come to rest; ask for a finite time";
    case Status::diverged:
      return "the scheme has diverged: its fluxes do not match between unequal cells; use godunov";
    default:
      return "reached the last time";
  }
}

/// False for a scheme that promises no bounds and has left them for good.
bool is_finite(const CellStates& cells) {
  return std::all_of(cells.phi.begin(), cells.phi.end(), [](double phi) { return std::isfinite(phi); });
}

class FvRun final : public shearfront::Run {
 public:
  template <class Make>
  FvRun(const Scene<double>& scene, SolverOptions options, std::shared_ptr<const Kernel> kernel, UnimodalFlux flux,
        Make&& make)
      : scene_(scene), options_(std::move(options)), kernel_(std::move(kernel)), flux_(std::move(flux)),
        run_(make(options_, flux_)), output_(scene, run_->grid()) {}

  Status advance(double t) override {
    field_.reset();
    cells_ = run_->at(t, status_);
    if (status_ == Status::ok && !is_finite(cells_)) status_ = Status::diverged;
    return status_;
  }
  [[nodiscard]] const Field& field() override {
    if (!field_) field_.emplace(scene_, output_.profile(cells_));
    return *field_;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_ == Status::ok && run_->is_at_rest() ? Status::steady : status_;
    summary.message = message_of(summary.status, run_->n_updates(), scene_.has_walls());
    summary.cell_updates = run_->n_updates();
    return summary;
  }

 private:
  const Scene<double>& scene_;
  SolverOptions options_;
  std::shared_ptr<const Kernel> kernel_;
  UnimodalFlux flux_;
  std::unique_ptr<fv::Run> run_;
  CellOutput output_;
  CellStates cells_;
  Status status_ = Status::ok;
  std::optional<ProfileField> field_;
};

UnimodalFlux flux_of(const Scene<double>& scene) {
  return std::visit([](const auto& f) { return unimodal_flux(f); }, scene.fluxes()[0]);
}

FaceRule rule_of(Scheme scheme) { return scheme == Scheme::godunov ? FaceRule::godunov : FaceRule::engquist_osher; }

}  // namespace

Grid grid_of(const Scene<double>& scene, const SolverOptions& options) {
  return options.align_cells ? aligned_grid(scene, options.cells)
                             : Grid{scene.bottom(), scene.top(), options.cells, {}, {}};
}

std::unique_ptr<shearfront::Run> start(Scheme scheme, const UnimodalFlux& flux, std::shared_ptr<const Kernel> kernel,
                                       const Scene<double>& scene, SolverOptions options) {
  return std::make_unique<FvRun>(scene, std::move(options), kernel, flux,
                                 [&](const SolverOptions& own, const UnimodalFlux& own_flux) {
                                   return kernel_run(scheme, own_flux, *kernel, scene, own);
                                 });
}

std::unique_ptr<shearfront::Run> start(FaceRule rule, const Scene<double>& scene, SolverOptions options) {
  return std::make_unique<FvRun>(
      scene, std::move(options), nullptr, UnimodalFlux{},
      [&](const SolverOptions& own, const UnimodalFlux&) { return plain_run(rule, scene, own); });
}

std::unique_ptr<shearfront::Run> start(Scheme scheme, const Scene<double>& scene, SolverOptions options) {
  const UnimodalFlux flux = flux_of(scene);
  if (!is_for_kernels(scene, flux)) return start(rule_of(scheme), scene, std::move(options));
  std::shared_ptr<const Kernel> kernel = flux.is_quadratic ? quadratic_kernel(scheme, options.limiter)
                                                           : unimodal_kernel(scheme, flux, options.limiter);
  return start(scheme, flux, std::move(kernel), scene, std::move(options));
}

std::string refusal(FaceRule rule, const Scene<double>& scene, const SolverOptions& options) {
  std::string why = refusal(scene, options);
  return why.empty() ? refusal(rule, scene) : why;
}

std::string refusal(Scheme scheme, const Scene<double>& scene, const SolverOptions& options) {
  if (std::string why = refusal(scene, options); !why.empty()) return why;
  if (is_for_kernels(scene, flux_of(scene))) return "";
  if (scheme == Scheme::muscl)
    return "muscl takes one flux with one extremum that vanishes at both ends of its range, and walls";
  return refusal(rule_of(scheme), scene);
}

}  // namespace shearfront::fv
