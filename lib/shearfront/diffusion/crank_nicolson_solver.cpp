// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/crank_nicolson_solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "shearfront/diffusion/refinement.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/share_integral.hpp"

namespace shearfront {

std::string diffusion::refusal(const Scene<double>& scene, const SolverOptions& options) {
  constexpr std::size_t kMostCells = 10'000'000;
  if (std::string why = refusal(scene); !why.empty()) return why;
  if (options.cells < 2 || options.cells > kMostCells)
    return "cells = " + std::to_string(options.cells) + "; must be >= 2 and <= " + std::to_string(kMostCells);
  if (!(options.time_step >= 0 && std::isfinite(options.time_step)))
    return "time_step = " + number_text(options.time_step) + "; must be >= 0";
  if (!(options.tolerance > 0 && options.tolerance <= 1))
    return "tolerance = " + number_text(options.tolerance) + "; must be > 0 and <= 1";
  if (options.cell_tolerance != 0 && !(options.cell_tolerance >= 1e-6 && options.cell_tolerance <= 0.1))
    return "cell_tolerance = " + number_text(options.cell_tolerance) + "; must be >= 1e-6 and <= 0.1, or 0";
  if (options.cell_tolerance > 0 && options.cells > Refinement::kMostCells)
    return "cells = " + std::to_string(options.cells) +
           "; must be <= " + std::to_string(Refinement::kMostCells) + " with a cell_tolerance";
  return "";
}

diffusion::Options diffusion::options_of(const SolverOptions& options) {
  Options own;
  own.dt = options.time_step;
  own.tolerance = options.tolerance;
  own.scheme = options.monotone ? Scheme::fitted : Scheme::central;
  own.progress = options.progress;
  return own;
}

namespace {

/// On to time t, or until the bed is at rest.
Status march(diffusion::CrankNicolson& engine, double t) {
  if (std::isfinite(t)) return engine.advance_to(t);
  constexpr double kLongest = 1e150;
  for (double next = std::max(engine.time(), 1.0); next < kLongest; next *= 4) {
    const Status status = engine.advance_to(next);
    if (status != Status::ok) return status;
    if (engine.is_steady()) return Status::steady;
  }
  return Status::not_converged;
}

/// Lets the engine change its grid, and stop where that fails.
void follow(diffusion::Refinement& refinement, diffusion::Options& options) {
  options.regrid = [&](const diffusion::Problem& present, std::span<const double> states) {
    return refinement.next(present, states);
  };
  options.progress = [&refinement, ask = options.progress](double t, std::uint64_t n_steps) {
    return !refinement.is_exhausted() && (!ask || ask(t, n_steps));
  };
}

}  // namespace

SolverResult CrankNicolsonSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                        const SolverOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  SolverResult result;
  Summary& summary = result.summary;
  if (summary.message = diffusion::refusal(scene, options); !summary.message.empty()) {
    summary.status = Status::unsupported;
    return result;
  }
  if (options.time_step > 0 &&
      std::any_of(request.times.begin(), request.times.end(), [](double t) { return std::isinf(t); })) {
    summary.status = Status::unsupported;
    summary.message = "fixed steps do not reach the steady state: leave time_step out";
    return result;
  }
  diffusion::Options own = diffusion::options_of(options);
  std::optional<diffusion::Refinement> refinement;
  if (options.cell_tolerance > 0)
    follow(refinement.emplace(scene, options.cells, options.cell_tolerance), own);
  diffusion::CrankNicolson engine(
      refinement ? refinement->start() : diffusion::problem_of(scene, options.cells), own);
  const std::size_t n = request.heights.size();
  std::vector<std::size_t> order(request.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return request.times[a] < request.times[b]; });
  result.samples.resize(request.times.size() * n);
  if (request.profiles) result.profiles.resize(request.times.size());
  if (request.integrand) result.integrals.resize(request.times.size());
  Status status = Status::ok;
  const auto is_usable = [&] { return status == Status::ok || status == Status::steady; };
  for (const std::size_t i : order) {
    status = march(engine, request.times[i]);
    if (!is_usable()) break;
    Profile<double> profile = diffusion::profile_of(engine.problem(), engine.states());
    const auto values = profile.at(request.heights);
    for (std::size_t j = 0; j < n; ++j) result.samples[i * n + j] = {values[j].phi, values[j].M};
    if (request.integrand) result.integrals[i] = share_integral(scene, profile, request.integrand);
    if (request.profiles) result.profiles[i] = std::move(profile);
  }
  if (refinement && refinement->is_exhausted()) status = Status::budget_reached;
  if (!is_usable()) result.samples.clear(), result.profiles.clear(), result.integrals.clear();
  summary.status = status;
  summary.message = refinement && refinement->is_exhausted()
                        ? "more than " + std::to_string(diffusion::Refinement::kMostCells) +
                              " cells wanted, or narrower ones than heights can tell apart, at t = " +
                              number_text(engine.time()) + "; take a larger cell_tolerance"
                    : !is_usable()       ? engine.message()
                    : engine.is_steady() ? "steady state reached"
                                         : "reached the last time";
  summary.message += ", " + std::to_string(engine.n_steps()) + " steps";
  summary.cell_updates = engine.n_cell_updates();
  summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace shearfront
