// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Slabs, phi(x, z, t), by slab::SlabMarch. The field is the mean over x, its slab() the whole.
///
/// Domain: scenes with a table slab, walls, solid fraction 1; with D > 0 what Crank-Nicolson takes, else what MUSCL or Godunov's
/// scheme take. Finite times only. Errors: Summary with Status::unsupported, not_converged, interrupted.
struct SlabSolver {
  static constexpr std::string_view kName = "slab";
  static constexpr std::string_view kDescription =
      "slabs that repeat along x: columns, carried rows, columns (Strang)";
  static constexpr std::string_view kScenes = "scenes with a table slab";

  struct Options {
    std::uint64_t cells = 64, cells_x = 0, threads = 0;
    double time_step = 0;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(OptionInfo{"cells", "number of cells over the height", {2, 1e4}}, self.cells);
      visit(OptionInfo{"cells-x", "number of cells along x", {3, 1e4}, {}, "such that cells are square"},
            self.cells_x);
      visit(OptionInfo{"time-step", "longest time step", {0, 1e300, true}, {}, "chosen for the cells"},
            self.time_step);
      visit(OptionInfo{.name = "threads",
                       .sentence = "cores to use; results do not depend on it",
                       .range = {1, 1024},
                       .unset = "all, where there are many cells",
                       .leaves_samples = true},
            self.threads);
    }
  };

  static Guarantees guarantees() {
    Guarantees g;
    g.has_slab = g.conservative = g.has_profiles = true;
    g.order_phi = g.order_M = 2;
    return g;
  }
  static std::string refusal(const Scene<double>& scene, const Options& options);
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch);
};
static_assert(Solver<SlabSolver>);

}  // namespace shearfront
