// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Exact solution by the Lax-Hopf formula in a bed of pieces (see exact/exact_solution.hpp).
struct ExactSolver {
  static constexpr std::string_view kName = "exact";
  static constexpr std::string_view kDescription = "Lax-Hopf formula, exact to rounding";
  static constexpr std::string_view kScenes = "convex or concave fluxes, walls";

  struct Options {
    std::uint64_t layers = 0;  ///< 0: ExactSolution::default_layers()

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(
          OptionInfo{"layers",
                     "shear rates with no closed form (chute), smooth temperature or solid fraction: number "
                     "of linear pieces or layers",
                     {1, 1e6},
                     {},
                     "256, 1024 where the solid fraction varies, 128 where a flux is no parabola"},
          self.layers);
    }
  };

  static Guarantees guarantees() {
    Guarantees g;
    g.exact = g.conservative = g.bounded = g.has_timeline = true;
    return g;
  }
  static std::string refusal(const Scene<double>& scene, const Options& options);
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch);
  /// See exact/derivatives.hpp.
  static std::string derivative_refusal(const Scene<double>& scene, const Options& options,
                                        const Entry& entry);
  static Linearisation linearise(const Scene<double>& scene, const Options& options,
                                 const std::vector<Place>& places, const std::vector<std::size_t>& entries,
                                 std::any& memory);
};
static_assert(DifferentiableSolver<ExactSolver>);

}  // namespace shearfront
