// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Exact solution by the Lax-Hopf formula in a bed of pieces (see exact/exact_solution.hpp).
struct ExactSolver {
  static constexpr std::string_view kName = "exact";
  static constexpr std::string_view kDescription =
      "Lax-Hopf formula, exact to rounding where a is constant, linear or exponential in pieces; from smooth "
      "starts where it is constant";
  static constexpr std::string_view kScenes = "convex or concave fluxes, walls";

  struct Options {
    double tolerance = 0;      ///< 0: that of ExactSolution::Options
    std::uint64_t layers = 0;  ///< 0: by the tolerance

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(
          OptionInfo{"tolerance",
                     "aim for the error of M, in heights of the bed, where pieces stand for a smooth bed or "
                     "a smooth start is searched by parts",
                     {0, 1, true},
                     {},
                     "1e-6"},
          self.tolerance);
      visit(OptionInfo{"layers",
                       "so many pieces for a smooth bed, or parts of a smooth start in one of pieces, "
                       "instead of the tolerance",
                       {1, 1e6},
                       {},
                       "as the tolerance asks"},
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
                                 std::any& memory, const Progress& progress = {});
  /// See exact/exact_share_integral.hpp.
  static LinearIntegrals linearise_integrals(const Scene<double>& scene, const Options& options,
                                             const std::vector<double>& times, const ShareFunction& g,
                                             const std::vector<std::size_t>& entries, std::any& memory,
                                             const Progress& progress = {});
  /// See exact/timeline_derivatives.hpp.
  static LinearTimeline linearise_timeline(const Scene<double>& scene, const Options& options,
                                           const std::vector<std::size_t>& entries, std::any& memory);
};
static_assert(DifferentiableSolver<ExactSolver>);

}  // namespace shearfront
