// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace shearfront::diffusion {

/// What a bed with diffusion starts from.
///   uniform  one concentration: UniformStart         steady  the logistic profile: SteadyState
///   kink     a smoothed shock: Kink                  sine    A sin(q z): PeriodicBurgers
enum class ColeHopfStart { uniform, steady, kink, sine, other };

/// What decides whether Cole-Hopf gives the solution of a scene.
struct ColeHopfFacts {
  ColeHopfStart start = ColeHopfStart::other;
  bool has_walls = false;   ///< no flux through both ends
  bool is_neumann = false;  ///< phi_z = 0 at both ends
  bool is_periodic = false;
  bool is_quadratic = false;        ///< one flux, phi (phi - 1)
  bool is_burgers = false;          ///< one flux, phi^2 / 2
  bool is_one_rate = false;         ///< r = s a sqrt(T) is the same everywhere and not 0
  bool is_one_diffusivity = false;  ///< D likewise
};

/// Why there is no exact solution with diffusion for a scene, in one sentence; empty if there is one.
/// With phi^2 / 2 and the rate r, r phi solves PeriodicBurgers with the amplitude r A. Errors: none.
[[nodiscard]] std::string cole_hopf_refusal(const ColeHopfFacts& facts);

}  // namespace shearfront::diffusion
