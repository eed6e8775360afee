// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/share_integral.hpp"
#include "shearfront/track/packed_profile.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"

namespace shearfront {

namespace {

// A record of 40 bytes per level: beyond this a grid would need more memory than a workstation has.
constexpr double kMaxLevels = 4e8;

template <class Grid>
constexpr bool kIsLevelGrid = std::is_same_v<Grid, LevelGrid<double>>;

/// Why the grid cannot be built; empty if it can.
std::string refusal_of_levels(const LayerStack<double>& stack, const SolverOptions& options) {
  if (options.grid == GridKind::levels) {
    if (const double n = LevelGrid<double>::exact_level_count(stack, options.resolution); n > kMaxLevels)
      return "the grid would need " + number_text(std::floor(n)) + " levels; use a coarser resolution";
    return {};
  }
  double largest = 0;
  for (std::size_t k = 0; k < stack.n_layers(); ++k) largest = std::max(largest, stack.shear_rate(k));
  if (const double n = largest / options.resolution; n > kMaxLevels)
    return "the singular-mapping grid would need " + number_text(std::floor(n)) +
           " levels; use a coarser resolution or the levels grid";
  return {};
}

/// A flux that does not vanish at the ends of its range may bring more to a layer than that can carry.
std::string refusal_between_layers(const Scene<double>& scene) {
  if (is_uniform(scene)) return {};
  for (const Flux<double>& flux : scene.fluxes())
    if (std::string name = std::visit(
            [](const auto& f) {
              const bool vanishes = f.value(f.range().lowest) == 0 && f.value(f.range().highest) == 0;
              return vanishes ? std::string() : std::string(f.kName);
            },
            flux);
        !name.empty())
      return "flux " + name + " must vanish at both ends of its range where a, c or T vary";
  return {};
}

std::string refusal(const Scene<double>& scene, const SolverRequest& request, const LayerStack<double>& stack,
                    const SolverOptions& options) {
  if (options.grid == GridKind::levels && !(options.resolution > 0 && options.resolution <= 1))
    return "resolution = " + number_text(options.resolution) + "; must be > 0 and <= 1";
  if (!(options.resolution > 0)) return "resolution = " + number_text(options.resolution) + "; must be > 0";
  if (scene.has_diffusion()) return "there are no fronts where grains diffuse; use crank-nicolson";
  if (request.timeline && !scene.has_walls()) return "event times are those of a bed between walls";
  if (scene.spec().is_periodic &&
      std::any_of(request.times.begin(), request.times.end(), [](double t) { return !std::isfinite(t); }))
    return "a periodic bed has no steady state; ask for a finite time";
  if (stack.is_plain()) return refusal_of_levels(stack, options);
  if (options.grid != GridKind::levels)
    return "the singular-mapping grid is known for the quadratic flux only";
  if (options.reconstruct != Reconstruction::constant)
    return "the linear reconstruction is known for the quadratic flux only";
  if (LevelGrid<double>::refusal(stack).empty()) return refusal_of_levels(stack, options);
  if (std::string why = UnimodalGrid<double>::refusal(stack, options.resolution); !why.empty()) return why;
  return refusal_between_layers(scene);
}

std::string message_of(Status status, std::uint64_t n_collisions, std::size_t n_unreachable) {
  switch (status) {
    case Status::steady:
      return "steady state reached";
    case Status::budget_reached:
      return "stopped at " + std::to_string(n_collisions) +
             " collisions, the largest number allowed; allow more or use a coarser resolution";
    case Status::interrupted:
      return "interrupted after " + std::to_string(n_collisions) + " collisions";
    default:
      return n_unreachable > 0 ? "some fronts meet only after the largest representable time"
                               : "reached the last time";
  }
}

template <class AnyTracker>
Profile<double> profile_of(const AnyTracker& tracker, const Scene<double>& scene,
                           const LayerStack<double>& stack, Reconstruction reconstruct) {
  if (has_smooth_packing(scene)) return packed_profile(tracker, scene, stack);
  if constexpr (kIsLevelGrid<std::decay_t<decltype(tracker.grid())>>)
    if (reconstruct == Reconstruction::linear) return linear_profile(tracker);
  return tracker.profile();
}

template <class Grid, class Observer>
SolverResult track(const Scene<double>& scene, const SolverRequest& request, const SolverOptions& options,
                   LayerStack<double> stack) {
  SolverResult result;
  Summary& summary = result.summary;
  const TrackingSetup<double, Grid> setup(scene, std::move(stack), options.resolution, options.grid);
  Tracker<Grid, Observer> tracker(setup.grid, setup.pieces, setup.ends);
  summary.levels = setup.grid.n_levels();
  summary.layers = setup.stack.n_layers();

  std::vector<std::size_t> order(request.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return request.times[a] < request.times[b]; });
  result.samples.resize(request.times.size() * request.heights.size());
  const RunLimits limits{options.max_collisions, options.progress};
  Status status = Status::ok;
  const auto is_usable = [&] { return status == Status::ok || status == Status::steady; };
  if (request.profiles) result.profiles.resize(request.times.size());
  if (request.integrand) result.integrals.resize(request.times.size());
  for (const std::size_t i : order) {
    status = tracker.advance_to(request.times[i], limits);
    if (!is_usable()) break;
    Profile<double> profile = profile_of(tracker, scene, setup.stack, options.reconstruct);
    const auto values = profile.at(request.heights);
    for (std::size_t j = 0; j < values.size(); ++j)
      result.samples[i * request.heights.size() + j] = {values[j].phi, values[j].M};
    if (request.integrand) result.integrals[i] = share_integral(scene, profile, request.integrand);
    if (request.profiles) result.profiles[i] = std::move(profile);
  }
  if (request.timeline && is_usable()) {
    status = tracker.run_to_steady(limits);
    if (is_usable()) result.timeline = tracked_timeline(tracker, scene, setup.stack);
  }
  if constexpr (Observer::kActive) {
    tracker.close_record();
    result.fronts = tracker.observer().segments();
  }
  if (!is_usable()) {
    result.profiles.clear();
    result.integrals.clear();
  }
  summary.status = status;
  summary.message = message_of(status, tracker.n_collisions(), tracker.n_unreachable());
  summary.collisions = tracker.n_collisions();
  summary.fronts_max = tracker.n_fronts_max();
  return result;
}

template <class Grid>
SolverResult track_on(const Scene<double>& scene, const SolverRequest& request, const SolverOptions& options,
                      LayerStack<double> stack) {
  return request.fronts ? track<Grid, SegmentRecord<double>>(scene, request, options, std::move(stack))
                        : track<Grid, NoObserver>(scene, request, options, std::move(stack));
}

}  // namespace

SolverResult FrontTrackingSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                        const SolverOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  SolverResult result;
  const double layer_resolution =
      options.resolution > 0 && options.resolution <= 1 ? options.resolution : 1.0;
  LayerStack<double> stack = tracking_layers(scene, layer_resolution, options.layers);
  if (std::string why = refusal(scene, request, stack, options); !why.empty()) {
    result.summary.status = Status::unsupported;
    result.summary.message = std::move(why);
  } else if (LevelGrid<double>::refusal(stack).empty()) {
    result = track_on<LevelGrid<double>>(scene, request, options, std::move(stack));
  } else {
    result = track_on<UnimodalGrid<double>>(scene, request, options, std::move(stack));
  }
  result.summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace shearfront
