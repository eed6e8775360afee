// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>

#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// Whether flux, a, c and T are the same all over the bed.
[[nodiscard]] inline bool is_uniform(const Scene<double>& scene) {
  return scene.is_layered() && scene.knots().empty();
}

/// Which fluxes a solver takes; each kind includes those before it. Where a, c or T vary every solver needs
/// fluxes with one extremum that vanish at both ends of their range: others leave Riemann problems between
/// layers without a solution.
enum class FluxScope {
  parabola,           ///< with one extremum, zero at both ends of its range
  convex_or_concave,  ///< with one extremum, zero at both ends
  one_extremum,
  any
};

/// Which scenes a solver takes, between those of one quadratic flux between walls, which every solver takes,
/// and all.
struct Scope {
  FluxScope flux = FluxScope::any;
  bool several_fluxes = true;  ///< different ones in different layers
  bool open_ends = true;       ///< open or periodic ends
  bool diffusion = false;      ///< beds with diffusion, and no others
  bool closed_form = false;    ///< of those, the ones ColeHopfSolver lists; covers() does not tell them apart

  /// Whether the scene is one of them. Cost: O(knots).
  [[nodiscard]] bool covers(const Scene<double>& scene) const {
    if (scene.has_diffusion() != diffusion) return false;
    if (diffusion) return covers_diffusion(scene);
    if (!several_fluxes && scene.fluxes().size() > 1) return false;
    if (!open_ends && !scene.has_walls()) return false;
    const bool uniform = is_uniform(scene);
    return std::all_of(scene.fluxes().begin(), scene.fluxes().end(), [&](const Flux<double>& f) {
      return std::visit([&](const auto& model) { return covers_flux(model, uniform); }, f);
    });
  }
  /// One flux of any kind, or phi (phi - 1) and phi (1 - phi) in different layers; c = 1; walls, Neumann or
  /// periodic ends.
  [[nodiscard]] static Scope with_diffusion() {
    Scope scope;
    scope.diffusion = true;
    return scope;
  }
  [[nodiscard]] static Scope with_closed_form_of_diffusion() {
    Scope scope = with_diffusion();
    scope.closed_form = true;
    return scope;
  }
  /// "fluxes with one extremum, open ends".
  [[nodiscard]] std::string text() const {
    if (diffusion)
      return closed_form ? "uniform starts, kinks and periodic Burgers with diffusion"
                         : "beds with diffusion";
    constexpr std::array<std::string_view, 4> kFluxes{"parabolas", "convex or concave fluxes",
                                                      "fluxes with one extremum",
                                                      "any flux in a uniform bed, else with one extremum"};
    return std::string(kFluxes[static_cast<std::size_t>(flux)]) +
           (several_fluxes ? "" : ", the same everywhere") + (open_ends ? ", open ends" : ", walls");
  }

 private:
  [[nodiscard]] static bool covers_diffusion(const Scene<double>& scene) {
    const bool is_one = scene.fluxes().size() == 1;
    const bool are_parabolas =
        std::all_of(scene.fluxes().begin(), scene.fluxes().end(), [](const Flux<double>& f) {
          return std::visit(
              [](const auto& m) {
                const double at_extremum = m.kIsParabola ? m.value(0.5) : 0;
                return m.range().lowest == 0 && m.range().highest == 1 &&
                       (at_extremum == 0.25 || at_extremum == -0.25);
              },
              f);
        });
    return (is_one || are_parabolas) && !scene.spec().solid_fraction && !scene.spec().outside_bottom &&
           !scene.spec().outside_top;
  }
  template <class Model>
  [[nodiscard]] bool covers_flux(const Model& model, bool uniform) const {
    const bool has_one = model.extrema().size() == 1;
    const bool vanishes = model.value(model.range().lowest) == 0 && model.value(model.range().highest) == 0;
    if (!uniform && !(has_one && vanishes)) return false;
    switch (flux) {
      case FluxScope::parabola:
        return Model::kIsParabola;
      case FluxScope::convex_or_concave:
        return model.curvature() != Curvature::mixed && has_one && vanishes;
      case FluxScope::one_extremum:
        return has_one;
      case FluxScope::any:
        return true;
    }
    return false;
  }
};

}  // namespace shearfront
