// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fv/run.hpp"

namespace shearfront {

/// Upwind scheme, first order, kept for comparison: the flux of the cell from which the jump between two
/// cells comes, by the sign of its speed (k_r f(x_r) - k_l f(x_l)) / (phi_r - phi_l) (fv::Rule::upwind).
/// Without balance at jumps, like classical-godunov, so phi exceeds c(z); and fans through the extremum of f
/// stay jumps, which are no solutions. Guaranteed: the mass is kept, nothing else. Half the time step of
/// godunov. Parabolas only. Tables: docs/packing.md, also for the source.
struct UpwindSolver {
  static constexpr std::string_view kName = "upwind";
  static constexpr std::string_view kDescription = "upwind scheme by the speed of jumps; overshoots";
  static constexpr std::string_view kScenes = "parabolas, open ends";

  using Options = fv::GridOptions;

  static Guarantees guarantees() {
    Guarantees g;
    g.conservative = g.has_profiles = true;
    return g;
  }
  static std::string refusal(const Scene<double>& scene, const Options& options) {
    return fv::refusal(scheme(options), scene, options);
  }
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch) {
    return fv::start(scheme(options), scene, options, watch);
  }

 private:
  static fv::Scheme scheme(const Options&) { return {fv::Rule::upwind}; }
};
static_assert(Solver<UpwindSolver>);

}  // namespace shearfront
