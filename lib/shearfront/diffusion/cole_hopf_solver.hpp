// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Beds with diffusion that have a closed form (Cole-Hopf transformation), all with constant s a sqrt(T) and
/// D and one flux:
///   - a uniform start between walls, flux phi (phi - 1) or phi (1 - phi) (diffusion::UniformStart);
///   - the travelling kink, initial.model = "kink" with above = 0 and width = D / (s a below), Neumann ends
///     (diffusion::Kink): as long as its ends change phi by less than 1e-5, which is said; Status::unsupported
///     beyond;
///   - Burgers' flux from a sine in a periodic domain of whole wavelengths (diffusion::PeriodicBurgers).
///   - with the option `steady`, the steady state (t = infinity) alone of any s a sqrt(T) and D between walls
///     (diffusion::SteadyLogistic): Status::unsupported at other times.
/// Guarantees: those of the classes. Cost: 0.1 to 10 us a point.
struct ColeHopfSolver {
  static constexpr std::string_view kName = "cole-hopf";
  static constexpr std::string_view kDescription = "beds with diffusion that have a closed form: exact";
  static constexpr std::string_view kScenes = "uniform starts, kinks and periodic Burgers with diffusion";

  struct Options {
    bool steady = false;
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(OptionInfo{"steady", "only the steady state, t = inf, but of any a(z), T(z) and D(z)"},
            self.steady);
    }
  };

  static Guarantees guarantees() {
    Guarantees g;
    g.diffusion = g.exact = g.conservative = g.bounded = true;
    return g;
  }
  static std::string refusal(const Scene<double>& scene, const Options& options);
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch);
};
static_assert(Solver<ColeHopfSolver>);

}  // namespace shearfront
