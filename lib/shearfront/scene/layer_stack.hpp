// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// What a layer has besides its shear rate, where it is not one quadratic flux in a bed of solid fraction 1.
template <Real Scalar>
struct LayerMaterial {
  std::vector<Flux<Scalar>> fluxes{Quadratic<Scalar>{}};
  std::vector<std::size_t> flux_index;  ///< per layer; empty: the first flux everywhere
  std::vector<Scalar> solid_fraction;   ///< c per layer; empty: 1 everywhere
};

/// A stack of layers with constant shear rate, solid fraction and flux: layer k occupies
/// [boundary(k), boundary(k+1)], and its flux is rate(k) solid_fraction(k) f(phi / solid_fraction(k)).
///
/// Invariant: at least one layer, boundaries strictly increasing, shear rates and solid fractions positive and
/// finite.
template <Real Scalar>
class LayerStack {
 public:
  /// `is_break[i]` tells whether interior boundary i + 1 is a break of the scene's own a(z) (true) or only an
  /// edge of a staircase that stands for a smooth a(z) (false).
  LayerStack(std::vector<Scalar> boundaries, std::vector<Scalar> shear_rates, Scalar scale,
             std::vector<bool> is_break, LayerMaterial<Scalar> material = {})
      : boundaries_(std::move(boundaries)),
        shear_rates_(std::move(shear_rates)),
        scale_(std::move(scale)),
        is_break_(std::move(is_break)),
        material_(std::move(material)) {
    const auto fits = [&](std::size_t n) { return n == 0 || n == shear_rates_.size(); };
    SHEARFRONT_EXPECTS(!shear_rates_.empty() && boundaries_.size() == shear_rates_.size() + 1 &&
                           is_break_.size() + 1 == shear_rates_.size() &&
                           fits(material_.solid_fraction.size()) && fits(material_.flux_index.size()),
                       "sizes of a layer stack");
  }

  [[nodiscard]] std::size_t n_layers() const { return shear_rates_.size(); }
  [[nodiscard]] const Scalar& bottom() const { return boundaries_.front(); }
  [[nodiscard]] const Scalar& top() const { return boundaries_.back(); }
  [[nodiscard]] const Scalar& boundary(std::size_t k) const { return boundaries_[k]; }
  [[nodiscard]] const std::vector<Scalar>& boundaries() const { return boundaries_; }
  [[nodiscard]] const Scalar& shear_rate(std::size_t k) const { return shear_rates_[k]; }
  [[nodiscard]] const Scalar& scale() const { return scale_; }
  /// s a_k sqrt(T_k): the speed of a state is rate(k) f'(phi / solid_fraction(k)).
  [[nodiscard]] Scalar rate(std::size_t k) const { return scale_ * shear_rates_[k]; }
  /// c_k: states are phi = solid_fraction(k) times a state of flux(k).
  [[nodiscard]] Scalar solid_fraction(std::size_t k) const {
    return material_.solid_fraction.empty() ? Scalar(1) : material_.solid_fraction[k];
  }
  [[nodiscard]] std::size_t flux_index(std::size_t k) const {
    return material_.flux_index.empty() ? 0 : material_.flux_index[k];
  }
  [[nodiscard]] const Flux<Scalar>& flux(std::size_t k) const { return material_.fluxes[flux_index(k)]; }
  [[nodiscard]] const std::vector<Flux<Scalar>>& fluxes() const { return material_.fluxes; }
  /// One quadratic flux in a bed of solid fraction 1: everything but the shear rates is the same in all layers.
  [[nodiscard]] bool is_plain() const {
    return material_.fluxes.size() == 1 && material_.solid_fraction.empty() &&
           unit_parabola_sign(material_.fluxes[0]) == 1;
  }
  /// Whether the interface below layer k (1 <= k < n_layers) belongs to the scene itself.
  [[nodiscard]] bool is_break(std::size_t k) const { return is_break_[k - 1]; }
  /// Index of the layer that contains z; an interface belongs to the layer above it, the top to the last
  /// layer.
  [[nodiscard]] std::size_t layer_at(const Scalar& z) const {
    const auto it = std::upper_bound(boundaries_.begin() + 1, boundaries_.end() - 1, z);
    return static_cast<std::size_t>(it - boundaries_.begin()) - 1;
  }

 private:
  std::vector<Scalar> boundaries_, shear_rates_;
  Scalar scale_;
  std::vector<bool> is_break_;
  LayerMaterial<Scalar> material_;
};

/// Flux and solid fraction of the layers between `boundaries`, which must include every knot of the scene.
template <Real Scalar>
[[nodiscard]] LayerMaterial<Scalar> material_of(const Scene<Scalar>& scene,
                                                const std::vector<Scalar>& boundaries);

/// One layer between each two knots, with the harmonic mean of a: where the scene is constant in pieces, nothing is rounded.
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> pieces_between_knots(const Scene<Scalar>& scene);
/// The layers of a scene whose shear rate is piecewise constant. Precondition: scene.is_layered().
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> exact_layers(const Scene<Scalar>& scene) {
  SHEARFRONT_EXPECTS(scene.is_layered(), "a layered shear rate");
  return pieces_between_knots(scene);
}

/// A smooth scene as a staircase: every piece between knots is cut into equal layers no higher than
/// (top - bottom) / n_layers, each with the harmonic mean of a. Travel times of pure states (H = 0) across
/// whole layers are then exact; M(z, t) is second order in the layer height where no path turns and of
/// order 3/2 where paths do (a falling along them), phi first order. With a solid fraction, layers also end at
/// the initial jumps: the layers, each with the mean of c, then hold what the bed does.
/// `is_graded`: towards an end where a is 0 they get thinner as the squares of 1 / n, 2 / n, ..., so that a root falls by as much in each.
/// Cost: O(n_layers + knots).
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> staircase(const Scene<Scalar>& scene, std::size_t n_layers,
                                           bool is_graded = false);

extern template LayerMaterial<double> material_of(const Scene<double>&, const std::vector<double>&);
extern template LayerStack<double> pieces_between_knots(const Scene<double>&);
extern template LayerStack<double> staircase(const Scene<double>&, std::size_t, bool);

}  // namespace shearfront
