// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Beds with diffusion by diffusion::CrankNicolson: second order in space and time, conservative, with
/// adaptive steps unless time_step is given.
///
/// Domain: scenes with an empty diffusion::refusal(). Steady state: march until the bed is at rest. Errors: Summary
/// with Status::unsupported, not_converged, budget_reached, interrupted. Cost: O(cells) a step. Small D: with
/// cell_tolerance the cost of a step hardly depends on D, where equal cells take 1 / D of them.
///
/// Fluxes are central, with D raised where cells are too wide for that (diffusion::Scheme::raised): phi stays in
/// the range of the flux up to the tolerance. The remark of the Summary says so. Cells are 400 unless given, or as
/// many as make it needless (cell_choice.hpp).
///
/// Derivatives are those of what the scheme computes: one run, in which every step solves one more system of equations
/// per entry; relative error 1e-8 (from those of the coefficients, problem_tangents.hpp), for entries of shear_rate,
/// temperature, diffusion, initial and heights of layers with another flux; equal cells only. Adaptive steps are chosen
/// once and then repeated (`memory`), so that the solution is a smooth function of the numbers of the scene and not one
/// with noise of the size of the tolerance. They are chosen anew when a number has moved by more than kReach of its
/// value since: so they always belong to numbers that near, and what renewing changes (a part of the error of time
/// stepping, which is below the tolerance) happens only while a search still makes longer steps. The solution has kinks
/// where a break passes the middle or the edge of a cell. Cost: (1 + entries / 2) runs.
struct CrankNicolsonSolver {
  static constexpr std::string_view kName = "crank-nicolson";
  static constexpr std::string_view kDescription = "beds with diffusion: conservative Crank-Nicolson scheme";
  static constexpr std::string_view kScenes = "beds with diffusion";
  static constexpr double kReach = 0.01;

  struct Options {
    std::uint64_t cells = 0;  ///< 0: diffusion::chosen_cells()
    double time_step = 0;     ///< 0: chosen by the tolerance
    double tolerance = 1e-5;
    double cell_tolerance = 0;  ///< 0: equal cells
    bool monotone = false;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(
          OptionInfo{
              "cells", "number of cells", {2, 1e7}, {}, "400, or 800 or 1600 where fronts are narrower"},
          self.cells);
      visit(OptionInfo{"time-step", "fixed time step", {0, 1e300, true}, {}, "chosen by the tolerance"},
            self.time_step);
      visit(
          OptionInfo{
              "tolerance", "aim for the error that time steps make in phi; cells make another", {0, 1, true}},
          self.tolerance);
      visit(
          OptionInfo{
              "cell-tolerance",
              "halve cells, beginning with the number given, where phi bends by more than this from one to "
              "the next",
              {1e-6, 0.1},
              {},
              "equal cells"},
          self.cell_tolerance);
      visit(OptionInfo{"monotone",
                       "fitted fluxes, which do not wiggle where cells are coarse (first order there)"},
            self.monotone);
    }
  };

  static Guarantees guarantees() {
    Guarantees g;
    g.diffusion = g.conservative = g.has_profiles = true;
    g.order_phi = g.order_M = 2;
    return g;
  }
  static std::string refusal(const Scene<double>& scene, const Options& options);
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch);
  /// A number of cells that does not change with the numbers of the scene.
  static void prefer_smooth(const Scene<double>& scene, Options& options);
  static std::string derivative_refusal(const Scene<double>& scene, const Options& options,
                                        const Entry& entry);
  static Linearisation linearise(const Scene<double>& scene, const Options& options,
                                 const std::vector<Place>& places, const std::vector<std::size_t>& entries,
                                 std::any& memory, const Progress& progress = {});
};
static_assert(DifferentiableSolver<CrankNicolsonSolver>);

}  // namespace shearfront
