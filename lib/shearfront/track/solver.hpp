// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "shearfront/solver/solver.hpp"

namespace shearfront {

enum class GridKind { levels, singular_mapping };
enum class Reconstruction { constant, linear };
/// Their names in files and on the command line, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> kGridNames{"levels", "singular-mapping"};
inline constexpr std::array<std::string_view, 2> kReconstructionNames{"constant", "linear"};

/// Event-driven front tracking (see track/tracker.hpp).
///
/// phi is constant between fronts, or linear where they are the states of a fan (reconstruct). Event times: scenes
/// between walls; +infinity asks for the steady state, which a periodic bed does not have.
struct FrontTrackingSolver {
  static constexpr std::string_view kName = "front-tracking";
  static constexpr std::string_view kDescription = "event-driven front tracking, exact for a polygonal flux";
  static constexpr std::string_view kScenes = "fluxes with one extremum, open ends";

  struct Options {
    double resolution = 0.01;
    GridKind grid = GridKind::levels;
    Reconstruction reconstruct = Reconstruction::constant;
    std::uint64_t layers = 0;
    std::uint64_t max_collisions = 4'000'000'000;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(OptionInfo{"resolution", "largest step of phi in a fan, or delta of the singular mapping", {0, 1, true}},
            self.resolution);
      visit(OptionInfo{"grid", "grid of states", {}, kGridNames}, self.grid);
      visit(OptionInfo{"reconstruct", "phi between fronts", {}, kReconstructionNames}, self.reconstruct);
      visit(OptionInfo{"layers", "smooth shear rates: number of layers of the staircase", {1, 1e6}, {},
                       "as many as the resolution asks for"},
            self.layers);
      visit(OptionInfo{"max-collisions", "stop after so many collisions", {1, 1e15}}, self.max_collisions);
    }
  };

  static Guarantees guarantees() {
    Guarantees g;
    g.conservative = g.bounded = g.has_fronts = g.has_timeline = g.has_profiles = true;
    g.order_phi = 1;
    g.order_M = 2;
    return g;
  }
  /// States constant between fronts have no derivative in the numbers of the scene; the lines through them do, and are
  /// closer to the solution: for the fluxes that have them.
  static void prefer_smooth(const Scene<double>& scene, Options& options);
  /// M of the states themselves is of second order and varies more smoothly than M of the lines through them.
  static void prefer_amounts(Options& options) { options.reconstruct = Reconstruction::constant; }
  static std::string refusal(const Scene<double>& scene, const Options& options);
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options& options, const Watch& watch);
};
static_assert(Solver<FrontTrackingSolver>);

}  // namespace shearfront
