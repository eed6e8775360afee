// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/model/complaint.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/scene_spec.hpp"

namespace shearfront {

/// All that is wrong with a specification, in the order of the entries of a scene file; empty if nothing is. Its models are those of a
/// prepared one (prepare(), scene/scene_spec.hpp), as a Scene has it, or take the ends of the domain for 0 and 1 where they ask for them.
template <Real Scalar>
[[nodiscard]] Complaints find_complaints(const SceneSpec<Scalar>& spec);

/// A bed of mixed grains: flux, shear rate a(z), scale s, solid fraction c(z), granular temperature T(z), initial
/// concentration phi(z, 0), and what lies at its ends.
///
///     phi_t + (s a(z) sqrt(T(z)) c(z) f(phi / c(z)))_z = 0 on bottom < z < top.
///
/// f may differ from layer to layer; c = T = 1 unless the scene says otherwise. With diffusion the right side
/// is (D(z) phi_z)_z. The initial phi / c is constant in pieces, or smooth. The ends are walls (no flux),
/// open (a state outside, in the sense of Bardos, LeRoux & Nedelec 1979), or joined (periodic).
///
/// With a velocity u(z) the bed is a steady chute, and x, the distance along it, stands in the place of t:
///
///     (u phi)_x + (s a sqrt(T) c f(phi / c))_z = (D phi_z)_z,    phi(z, 0) what flows in;
///
/// amounts are then what passes in a unit of time, int u phi dz (see chute.hpp). With a velocity and a slab it is
/// phi(x, z, t), periodic in x, and what is said here of phi(z, 0) holds for its mean over x.
/// Class invariant: find_complaints(spec()) is empty. Immutable after construction, and checked there once.
template <Real Scalar = double>
class Scene {
 public:
  /// Errors: InputError that carries all complaints.
  explicit Scene(SceneSpec<Scalar> spec);
  /// The scene, or all that is wrong with it; nothing is thrown.
  [[nodiscard]] static std::variant<Scene, Complaints> make(SceneSpec<Scalar> spec);

  [[nodiscard]] const SceneSpec<Scalar>& spec() const { return spec_; }
  [[nodiscard]] const std::string& name() const { return spec_.name; }
  [[nodiscard]] const std::vector<Flux<Scalar>>& fluxes() const { return spec_.fluxes; }
  /// Heights between the fluxes, one less.
  [[nodiscard]] const std::vector<Scalar>& flux_breaks() const { return spec_.flux_breaks; }
  [[nodiscard]] const DepthFunction<Scalar>& shear_rate() const { return spec_.shear_rate; }
  [[nodiscard]] const Scalar& scale() const { return spec_.scale; }
  [[nodiscard]] const Scalar& bottom() const { return spec_.bottom; }
  [[nodiscard]] const Scalar& top() const { return spec_.top; }
  [[nodiscard]] const std::vector<Scalar>& initial_breaks() const { return spec_.initial_breaks; }
  /// Of phi / c; both empty for a smooth start.
  [[nodiscard]] const std::vector<Scalar>& initial_values() const { return spec_.initial_values; }

  /// Which flux holds at z; at a break the one above.
  [[nodiscard]] std::size_t flux_index(const Scalar& z) const {
    const auto& breaks = spec_.flux_breaks;
    return static_cast<std::size_t>(std::upper_bound(breaks.begin(), breaks.end(), z) - breaks.begin());
  }
  [[nodiscard]] const Flux<Scalar>& flux_at(const Scalar& z) const { return spec_.fluxes[flux_index(z)]; }
  /// The states allowed at z: those of the flux times c(z).
  [[nodiscard]] StateRange<Scalar> range_at(const Scalar& z) const;
  /// Whether phi counts grains that rise, large ones in a bed of two kinds: some flux has a maximum.
  [[nodiscard]] bool counts_rising_grains() const;
  /// Whether all of the scene is the model of May, Shearer & Daniels: one quadratic flux, c = T = 1, walls.
  [[nodiscard]] bool is_plain() const;
  /// Whether no grain can leave or come in.
  [[nodiscard]] bool has_walls() const {
    return !spec_.outside_bottom && !spec_.outside_top && !spec_.is_periodic && !spec_.is_neumann;
  }
  /// Whether x stands in the place of t.
  [[nodiscard]] bool is_chute() const { return spec_.velocity.has_value() && !spec_.slab; }
  /// Whether phi depends on x as well.
  [[nodiscard]] bool is_slab() const { return spec_.slab.has_value(); }
  /// What a height stands for in amounts: int_lo^hi u dz in a chute, else hi - lo.
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const {
    if (!is_chute()) return hi - lo;
    return std::visit([&](const auto& model) { return Scalar(model.flow(lo, hi)); }, *spec_.velocity);
  }
  /// Whether grains diffuse: then phi is smooth, and the engines for D = 0 do not apply.
  [[nodiscard]] bool has_diffusion() const { return spec_.diffusion && spec_.diffusion->D > 0; }
  /// D(z); 0 without diffusion.
  [[nodiscard]] Scalar diffusivity_at(const Scalar& z) const;

  /// True if flux, a, c and T are constant between the knots().
  [[nodiscard]] bool is_layered() const;
  /// Whether flux, a, c and T are the same all over the bed.
  [[nodiscard]] bool is_uniform() const { return is_layered() && knots().empty(); }
  /// Heights inside the domain where the flux, a, c, T or one of their slopes jumps; ascending.
  [[nodiscard]] std::vector<Scalar> knots() const;
  /// Whether the flux, a, c or T jumps at z: there the scene has an interface of its own.
  [[nodiscard]] bool jumps_at(const Scalar& z) const;

  /// a(z), without the scale s and the temperature.
  [[nodiscard]] Scalar shear_rate_at(const Scalar& z) const;
  [[nodiscard]] Scalar solid_fraction_at(const Scalar& z) const;
  /// a(z) sqrt(T(z)): what moves the grains, without the scale s.
  [[nodiscard]] Scalar rate_at(const Scalar& z) const;
  /// Harmonic mean of rate_at over [lo, hi], which must not contain a knot inside. To rounding for T = 1 or
  /// a layered one, else by quadrature (7 points of Gauss).
  [[nodiscard]] Scalar mean_rate(const Scalar& lo, const Scalar& hi) const;
  /// Mean of c over [lo, hi], which must not contain a knot inside.
  [[nodiscard]] Scalar mean_solid_fraction(const Scalar& lo, const Scalar& hi) const;

  /// Whether phi(z, 0) / c(z) is an InitialState: continuous, not constant in pieces.
  [[nodiscard]] bool has_smooth_start() const { return spec_.initial_state.has_value(); }
  /// phi(z, 0) / c(z); at a jump the value above it. Cost: O(log jumps).
  [[nodiscard]] Scalar initial_share(const Scalar& z) const {
    if (spec_.initial_state)
      return std::visit([&](const auto& model) { return Scalar(model.value(z)); }, *spec_.initial_state);
    const auto& breaks = spec_.initial_breaks;
    const auto k = std::upper_bound(breaks.begin(), breaks.end(), z) - breaks.begin();
    return spec_.initial_values[static_cast<std::size_t>(k)];
  }
  /// Heights inside the domain between which phi(z, 0) / c(z) is constant (the initial jumps), or it and its slope are monotone
  /// (of a smooth start); ascending.
  [[nodiscard]] std::vector<Scalar> initial_knots() const {
    if (!spec_.initial_state) return spec_.initial_breaks;
    return std::visit([&](const auto& model) { return model.knots(spec_.bottom, spec_.top); },
                      *spec_.initial_state);
  }
  /// phi(z, 0); at a jump the value above it. Cost: O(log jumps).
  [[nodiscard]] Scalar initial_phi(const Scalar& z) const;
  /// Amount of small grains, int phi(z, 0) dz (compensated sum). Constant in time between walls.
  [[nodiscard]] Scalar mass() const;
  /// int_lo^hi phi(z, 0) dz. Cost: O(jumps, or points of the initial state).
  [[nodiscard]] Scalar initial_amount(const Scalar& lo, const Scalar& hi) const;
  /// Height of the jump in the steady state between walls: grains of a flux with a minimum have sunk below
  /// it, those of one with a maximum have risen above it.
  [[nodiscard]] Scalar steady_height() const;
  /// int phi dz over [lo, hi] if phi is as high, or as low, as it can be. Cost: O(fluxes + knots of c).
  [[nodiscard]] Scalar amount(const Scalar& lo, const Scalar& hi, bool is_highest) const;
  /// int_lo^hi c dz, in a chute int c u dz; flow(lo, hi) without solid fraction. Cost: O(knots) with one.
  [[nodiscard]] Scalar solid(const Scalar& lo, const Scalar& hi) const;

 private:
  struct Checked {};
  Scene(SceneSpec<Scalar> spec, Checked) : spec_(std::move(spec)) { complete(); }
  void complete();

  SceneSpec<Scalar> spec_;
};

}  // namespace shearfront
