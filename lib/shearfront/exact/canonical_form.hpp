// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "shearfront/exact/rate_form.hpp"
#include "shearfront/exact/start_shape.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront::exact {

/// A scene whose fluxes are all convex (or all concave), in the coordinates in which every flux is convex
/// with the states 0 .. 1 and solid fraction 1.
///
/// With the states of layer k between c lo and c hi, w = hi - lo, put
///
///     u = (phi / c - lo) / w   for convex fluxes,   u = (hi - phi / c) / w   for concave ones,   dy = c w dz:
///
/// then u_t + (rate_k c_k g_k(u))_y = 0 with g_k(u) = +-f_k <= 0, and int u dy = +-(int phi dz - int c lo dz)
/// (int c hi dz for concave ones). The capacity rate_k c_k |f_k(m_k)| of a layer is that of the quadratic
/// flux with the rate 4 c_k |f_k(m_k)| s a_k sqrt(T_k): these are rates(). A parabola thereby IS the quadratic flux, and
/// the scene of one quadratic flux with c = T = 1 its own canonical form (is_identity()).
///
/// Guarantees: interfaces and initial jumps at the same height stay so; height_of(image_of(z)) = z to
/// rounding; states stay in their range, phi = c(z) (lo + w u) with c(z) itself where c is smooth. Where a(z) or log a(z) is linear between its knots, and c and T are
/// constant in pieces, the image is linear or exponential in pieces as well: has_pieces(). Any other smooth scene is represented by pieces through
/// its rate s a c sqrt(T), each linear or exponential, whichever is nearer in its middle. Precondition: refusal(scene) is empty.
template <Real Scalar>
class CanonicalForm {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static constexpr std::size_t kFewParts =
      32;  ///< of a smooth start, where pieces of a smooth bed cut it as well

  /// `layers`: about how many pieces or layers, where it does not represent the scene exactly.
  CanonicalForm(std::shared_ptr<const Scene<Scalar>> scene, std::size_t layers);

  [[nodiscard]] const Scene<Scalar>& scene() const { return *scene_; }
  [[nodiscard]] bool is_identity() const { return is_identity_; }
  [[nodiscard]] bool is_concave() const { return is_concave_; }
  /// Whether all fluxes are parabolas.
  [[nodiscard]] bool is_parabolic() const { return is_parabolic_; }
  /// Whether it represents the scene without approximation.
  [[nodiscard]] bool is_exact() const { return is_exact_; }
  /// Whether nothing depends on the number of layers: the scene is represented exactly, and paths from a smooth start are not
  /// looked for part by part, as they are where pieces have a sloped rate.
  [[nodiscard]] bool is_final() const { return is_exact_ && !(start_ && has_pieces_); }
  /// Whether the layers are pieces in which the rate is not constant, of the scene itself or through its values at
  /// their ends: then rates() are their harmonic means, and these the values at their lower and upper ends.
  [[nodiscard]] bool has_pieces() const { return has_pieces_; }
  /// How the rate runs between them.
  [[nodiscard]] const std::vector<RateForm>& rate_forms() const { return rate_forms_; }
  /// Whether u does not decrease in z but at shocks and boundaries. It may in pieces: in a linear one in a state, in any where
  /// paths come from others.
  [[nodiscard]] bool is_monotone() const {
    return !start_ && (!has_pieces_ || (is_exponential_ && layers_.n_layers() == 1));
  }
  [[nodiscard]] const std::vector<Scalar>& low_rates() const { return low_rates_; }
  [[nodiscard]] const std::vector<Scalar>& high_rates() const { return high_rates_; }
  /// Layers in the heights of the scene.
  [[nodiscard]] const LayerStack<Scalar>& layers() const { return layers_; }

  /// The image: heights of bottom, interfaces and top; 4 times the capacity of each layer; initial data (empty for a smooth
  /// start, which has a start() instead); int u dy.
  [[nodiscard]] const std::vector<Scalar>& boundaries() const {
    return is_identity_ ? layers_.boundaries() : y_;
  }
  [[nodiscard]] const std::vector<Scalar>& rates() const { return rates_; }
  [[nodiscard]] const std::vector<Scalar>& initial_breaks() const {
    return is_identity_ ? scene_->initial_breaks() : initial_breaks_;
  }
  [[nodiscard]] const std::vector<Scalar>& initial_values() const {
    return is_identity_ ? scene_->initial_values() : initial_values_;
  }
  /// The image of a smooth start; null for data constant in pieces.
  [[nodiscard]] const std::shared_ptr<const StartShape<Scalar>>& start() const { return start_; }
  /// In how many parts of the bed paths from it are looked for where pieces have a sloped rate.
  [[nodiscard]] std::size_t n_start_parts() const { return n_start_parts_; }
  [[nodiscard]] const Scalar& mass() const { return mass_; }

  /// dy / dz in layer k.
  [[nodiscard]] Scalar stretch(std::size_t k) const { return is_identity_ ? Scalar(1) : stretch_[k]; }
  /// rates() in layer k over s a sqrt(T): the factor 4 c |f(m)|.
  [[nodiscard]] Scalar rate_factor(std::size_t k) const { return is_identity_ ? Scalar(1) : rate_factor_[k]; }
  /// +1 for convex fluxes, -1 for concave ones: the sign of d(int phi dz) / d(int u dy).
  [[nodiscard]] Scalar sign() const { return Scalar(is_concave_ ? -1 : 1); }
  /// d(phi / c) / du in layer k.
  [[nodiscard]] Scalar state_slope(std::size_t k) const {
    return is_identity_ ? Scalar(1) : sign() * width_[layers_.flux_index(k)];
  }
  /// u of the share phi / c in layer k, and back.
  [[nodiscard]] Scalar state_of(const Scalar& share, std::size_t k) const;
  [[nodiscard]] Scalar share_of(const Scalar& u, std::size_t k) const;
  /// Piece of the scene's initial data to which piece j of the image's belongs.
  [[nodiscard]] std::size_t initial_piece(std::size_t j) const {
    return is_identity_ ? j : initial_piece_[j];
  }
  /// Lowest layer of piece j of the image's initial data; all of its layers have the same flux.
  [[nodiscard]] std::size_t initial_layer(std::size_t j) const {
    return is_identity_ ? 0 : initial_layer_[j];
  }
  /// Initial jump of the scene that jump j of the image's data is; kNone where only the range of states
  /// jumps.
  [[nodiscard]] std::size_t initial_break(std::size_t j) const {
    return is_identity_ ? j : initial_break_[j];
  }

  [[nodiscard]] Scalar image_of(const Scalar& z) const;
  [[nodiscard]] Scalar height_of(const Scalar& y) const;
  [[nodiscard]] Scalar phi_of(const Scalar& z, const Scalar& u) const;
  /// int_bottom^z phi for int u dy = `amount`.
  [[nodiscard]] Scalar amount_of(const Scalar& z, const Scalar& amount) const;
  /// phi as a profile of u over y, cut at the interfaces. Cost: O(cells + layers).
  [[nodiscard]] Profile<Scalar> image_of(const Profile<Scalar>& profile) const;

 private:
  void set_layers();
  void set_end_rates();
  void set_initial_data();
  void set_start();
  [[nodiscard]] Scalar image_mass() const;
  [[nodiscard]] EndValues<Scalar> solid_fractions(std::size_t k, const Scalar& lo, const Scalar& hi) const;

  std::shared_ptr<const Scene<Scalar>> scene_;
  bool is_identity_, is_concave_, is_parabolic_, has_pieces_, is_exponential_, is_root_, is_exact_;
  LayerStack<Scalar> layers_;
  // Empty in the identity:
  std::vector<Scalar> lowest_, highest_, width_;  ///< per flux
  std::vector<Scalar> stretch_, rate_factor_;     ///< per layer
  std::vector<Scalar> y_;
  std::vector<Scalar> least_, most_;  ///< per boundary: int c lo dz and int c hi dz from the bottom
  std::vector<Scalar> initial_breaks_, initial_values_;
  std::vector<std::size_t> initial_piece_, initial_layer_, initial_break_;

  std::vector<Scalar> rates_, low_rates_, high_rates_;
  std::vector<RateForm> rate_forms_;
  std::shared_ptr<const StartShape<Scalar>> start_;
  std::size_t n_start_parts_ = 1;
  Scalar mass_{0};
};

}  // namespace shearfront::exact
