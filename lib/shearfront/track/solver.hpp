// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/track.hpp"

namespace shearfront {

/// Event-driven front tracking (see track/tracker.hpp).
///
/// Between fronts phi is constant, or where the rate varies a steady profile; or linear where they are the states of a fan
/// (reconstruct). Event times:
/// scenes between walls; +infinity asks for the steady state, which a periodic bed does not have.
struct FrontTrackingSolver {
  static constexpr std::string_view kName = "front-tracking";
  static constexpr std::string_view kDescription =
      "event-driven front tracking, exact for a polygonal flux and smooth starts in steps";
  static constexpr std::string_view kScenes =
      "any flux in a uniform bed, else with one extremum or none, open ends";

  using Options = TrackOptions;

  static Guarantees guarantees() {
    Guarantees g;
    g.conservative = g.bounded = g.has_fronts = g.has_timeline = g.has_profiles = true;
    g.order_phi = 1;
    g.order_M = 2;
    g.least_order_M = 1;
    g.where_least = "where a, c or T vary and the flux is not convex";
    return g;
  }
  /// Where fronts cannot be curved (curved_scene.hpp) a staircase stands for what varies inside a layer, with steps as large as
  /// those of phi: where paths turn, in the throat of a bed above all, M is wrong by the height of a step.
  static double order_M(const Scene<double>& scene);
  /// States constant between fronts have no derivative in the numbers of the scene; the lines through them
  /// do, and are closer to the solution.
  static void prefer_smooth(const Scene<double>& scene, Options& options);
  /// M of the states themselves is of second order and varies more smoothly than M of the lines through them.
  static void prefer_amounts(Options& options) { options.reconstruct = Reconstruction::constant; }
  static std::string refusal(const Scene<double>& scene, const Options& options) {
    return Tracking::refusal(scene, options);
  }
  /// Where every front may cross every layer: how many collisions that may be, from 1e8 on, which take a minute.
  static std::string forewarning(const Scene<double>& scene, const Options& options);
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch);
  static bool has_steps(const Options& options) { return options.reconstruct == Reconstruction::constant; }
  /// See track/linearise.hpp.
  static std::string derivative_refusal(const Scene<double>& scene, const Options& options,
                                        const Entry& entry);
  static Linearisation linearise(const Scene<double>& scene, const Options& options,
                                 const std::vector<Place>& places, const std::vector<std::size_t>& wanted,
                                 std::any& memory, const Progress& progress = {});
  /// See track/gradient.hpp.
  static bool has_linear_sum(const Options& options) {
    return options.reconstruct == Reconstruction::constant;
  }
  static LinearSum linearise_sum(const Scene<double>& scene, const Options& options,
                                 const std::vector<Place>& places, const SumWeights& weights,
                                 const std::vector<std::size_t>& wanted, const Progress& progress = {});
};
static_assert(DifferentiableSolver<FrontTrackingSolver>);

}  // namespace shearfront
