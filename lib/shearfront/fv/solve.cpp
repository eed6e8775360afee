// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/solve.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "shearfront/fv/run.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/share_integral.hpp"

namespace shearfront::fv {
namespace {

constexpr std::size_t kMostCells = 100'000'000;  // 6 to 14 GB

SolverResult unsupported(std::string why) {
  SolverResult result;
  result.summary.status = Status::unsupported;
  result.summary.message = std::move(why);
  return result;
}

std::string refusal(const Scene<double>& scene, const SolverOptions& options) {
  if (scene.has_diffusion()) return "this scheme knows no diffusion; use crank-nicolson";
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
  const bool has_jumps = !is_uniform(scene);
  for (const Flux<double>& flux : scene.fluxes()) {
    const FluxBranches branches = flux_branches(flux);
    const std::string name = std::visit([](const auto& f) { return std::string(f.kName); }, flux);
    const bool is_reference = rule == FaceRule::classical_godunov || rule == FaceRule::upwind;
    if (is_reference && !branches.is_parabola)
      return "flux " + name + " has no values for shares beyond its range, where this scheme goes";
    if (has_jumps && !(branches.has_one_extremum() && branches.vanishes))
      return "flux " + name +
             " has no exact flux between cells of unequal rate or packing: it must have one extremum and "
             "vanish at both ends of its range; front-tracking may cover it";
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

using Clock = std::chrono::steady_clock;

SolverResult outcome(Run& run, const Scene<double>& scene, const SolverRequest& request,
                     Clock::time_point begin) {
  SolverResult result;
  Status status = Status::ok;
  const CellOutput output(scene, run.grid());
  std::vector<std::size_t> order(request.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return request.times[a] < request.times[b]; });
  const std::size_t n = request.heights.size();
  result.samples.resize(request.times.size() * n);
  if (request.profiles) result.profiles.resize(request.times.size());
  if (request.integrand) result.integrals.resize(request.times.size());
  for (const std::size_t i : order) {
    const CellStates cells = run.at(request.times[i], status);
    if (status == Status::ok && !is_finite(cells)) status = Status::diverged;
    if (status != Status::ok) break;
    const auto samples = output.samples(cells, request.heights);
    std::copy(samples.begin(), samples.end(), result.samples.begin() + static_cast<std::ptrdiff_t>(i * n));
    if (!request.integrand && !request.profiles) continue;
    Profile<double> profile = output.profile(cells);
    if (request.integrand) result.integrals[i] = share_integral(scene, profile, request.integrand);
    if (request.profiles) result.profiles[i] = std::move(profile);
  }
  if (status == Status::ok && run.is_at_rest()) status = Status::steady;
  if (status != Status::ok && status != Status::steady) {
    result.samples.clear();
    result.profiles.clear();
    result.integrals.clear();
  }
  result.summary.status = status;
  result.summary.message = message_of(status, run.n_updates(), scene.has_walls());
  result.summary.cell_updates = run.n_updates();
  result.summary.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

}  // namespace

Grid grid_of(const Scene<double>& scene, const SolverOptions& options) {
  return options.align_cells ? aligned_grid(scene, options.cells)
                             : Grid{scene.bottom(), scene.top(), options.cells, {}, {}};
}

SolverResult solve(Scheme scheme, const UnimodalFlux& flux, const Kernel& kernel, const Scene<double>& scene,
                   const SolverRequest& request, const SolverOptions& options) {
  if (std::string why = refusal(scene, options); !why.empty()) return unsupported(std::move(why));
  if (!flux.refusal.empty()) return unsupported(flux.refusal);
  const auto begin = Clock::now();
  return outcome(*kernel_run(scheme, flux, kernel, scene, options), scene, request, begin);
}

SolverResult solve(FaceRule rule, const Scene<double>& scene, const SolverRequest& request,
                   const SolverOptions& options) {
  std::string why = refusal(scene, options);
  if (why.empty()) why = refusal(rule, scene);
  if (!why.empty()) return unsupported(std::move(why));
  const auto begin = Clock::now();
  return outcome(*plain_run(rule, scene, options), scene, request, begin);
}

SolverResult solve(Scheme scheme, const Scene<double>& scene, const SolverRequest& request,
                   const SolverOptions& options) {
  if (std::string why = refusal(scene, options); !why.empty()) return unsupported(std::move(why));
  const UnimodalFlux flux = std::visit([](const auto& f) { return unimodal_flux(f); }, scene.fluxes()[0]);
  if (is_for_kernels(scene, flux)) {
    const auto kernel = flux.is_quadratic ? quadratic_kernel(scheme, options.limiter)
                                          : unimodal_kernel(scheme, flux, options.limiter);
    return solve(scheme, flux, *kernel, scene, request, options);
  }
  if (scheme == Scheme::muscl)
    return unsupported(
        "muscl takes one flux with one extremum that vanishes at both ends of its range, and walls; use "
        "godunov");
  return solve(scheme == Scheme::godunov ? FaceRule::godunov : FaceRule::engquist_osher, scene, request,
               options);
}

}  // namespace shearfront::fv
