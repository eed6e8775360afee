// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "shearfront/fv/march.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// The grid that the options ask for: options.cells equal cells, or with options.align_cells about as many with edges
/// on the interfaces.
[[nodiscard]] Grid grid_of(const Scene<double>& scene, const GridOptions& options);

/// Why the scheme cannot solve the scene: diffusion; options out of range; a flux with several extrema, or one
/// that does not vanish at the ends of its range, between cells of unequal rate or solid fraction, or for muscl
/// anywhere; more for muscl than one flux between walls; for the rules without balance all but parabolas.
[[nodiscard]] std::string refusal(const Scheme& scheme, const Scene<double>& scene,
                                  const GridOptions& options);

/// The order of M: contacts, which travel where a flux is straight, spread like the square root of the cells.
[[nodiscard]] double order_M(const Guarantees& promised, const Scene<double>& scene);

/// All finite-volume solvers: a March on grid_of().
///
/// Time steps: dt = cfl C min (int_cell c dz) / (s a c max |f'|), C = 1, 1/2 for muscl and rules without bounds; the same
/// for the whole run. The state at a time t between n dt and (n + 1) dt comes from one shorter step that starts at n dt;
/// the march itself goes on from n dt. So (1) what comes out at t does not depend on the other times asked for; (2) it is
/// a continuous function of t and of the numbers of the scene: where n changes, the shorter step has become a whole one,
/// or nothing (equal steps, n = ceil(t / dt), would jump there). Where a state outside changes, a shorter step ends there
/// and n counts anew.
///
/// A march that has come to rest stops. t = infinity gives the steady state of the grid (March::settled_amounts); where
/// there is none of that kind, a march until nothing changes by more than rounding. Summary::rest_time is when M was
/// nowhere farther than 1e-9 of what the bed can hold from that of the settled state, to a step; unknown where that takes
/// more than 256 steps per cell and 2^22 cell updates, or more than 2^33 (ten seconds; some 2e4 cells).
///
/// Outcomes beside ok and steady: interrupted (watch.progress said so); not_converged (the rates differ so much that
/// rounding stopped the slow cells; no rest after 1000 steps per cell, for t = infinity); diverged (rules without bounds);
/// budget_reached, before it starts, where more than 1e15 cell updates are needed: t / dt per cell, but no more than ten
/// times those in which waves cross the bed if it then rests.
/// Cost: cells * (t / dt) cell updates; tests/bench/fv_bench.cpp.
[[nodiscard]] std::unique_ptr<Run> start(const Scheme& scheme, const Scene<double>& scene,
                                         const GridOptions& options, const Watch& watch);

/// What the finite-volume solvers have in common: all but name, description and options. OptionsOfSolver derives from
/// GridOptions and has scheme().
template <class OptionsOfSolver>
struct GridSolver {
  using Options = OptionsOfSolver;

  static Guarantees guarantees() {
    Guarantees g;
    g.conservative = g.has_profiles = true;
    if (!is_monotone(Options{}.scheme().rule)) return g;
    g.bounded = true;
    g.order_phi = 0.5;
    g.order_M = 1;
    g.least_order_M = 0.5;
    g.where_least = "where the flux is straight between states";
    return g;
  }
  static double order_M(const Scene<double>& scene) { return fv::order_M(guarantees(), scene); }
  static std::string refusal(const Scene<double>& scene, const Options& options) {
    return fv::refusal(options.scheme(), scene, options);
  }
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch) {
    return fv::start(options.scheme(), scene, options, watch);
  }
};

/// Options of a rule that has none but those of the grid.
template <Rule rule>
struct RuleOptions : GridOptions {
  [[nodiscard]] static Scheme scheme() { return {rule}; }
};

}  // namespace shearfront::fv
