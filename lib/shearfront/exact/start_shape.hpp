// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::exact {

/// A smooth start in the coordinates of a canonical form (exact/canonical_form.hpp): u(y, 0) and int u dy. In each layer u is
/// an affine image of the share, and y of z.
///
/// Guarantees: 0 <= u <= 1; between knots() and interfaces u and its slope are monotone; amounts are those of the model's own
/// integral. Where c varies in a layer, they are those of its mean.
template <Real Scalar>
class StartShape {
 public:
  /// Where a layer lies, u = sign (share - zero) / width, and y = bottom_y + stretch (z - bottom_z).
  struct Layer {
    Scalar bottom_z, top_z, bottom_y, top_y, stretch, zero, width;
    bool is_reversed;
  };

  StartShape(std::shared_ptr<const Scene<Scalar>> scene, std::vector<Layer> layers, bool is_identity)
      : scene_(std::move(scene)), layers_(std::move(layers)), is_identity_(is_identity) {
    std::size_t k = 0;
    for (const Scalar& z : scene_->initial_knots()) {
      while (k + 1 < layers_.size() && !(z < layers_[k].top_z)) ++k;
      const Scalar y = image_of(k, z);
      if (y > layers_.front().bottom_y && y < layers_.back().top_y && (knots_.empty() || y > knots_.back()))
        knots_.push_back(y), knot_heights_.push_back(z);
    }
  }

  /// Heights y between which u is smooth, interfaces aside; ascending.
  [[nodiscard]] const std::vector<Scalar>& knots() const { return knots_; }
  [[nodiscard]] Scalar state(std::size_t layer, const Scalar& y) const {
    const Layer& of = layers_[layer];
    const Scalar share = scene_->initial_share(height_of(layer, y));
    if (is_identity_) return share;
    const Scalar u = (of.is_reversed ? of.zero - share : share - of.zero) / of.width;
    return std::clamp(u, Scalar(0), Scalar(1));
  }
  /// du/dy at a height of a layer, at an end or a knot as it is towards `middle`.
  [[nodiscard]] Scalar slope(std::size_t layer, const Scalar& y, const Scalar& middle) const {
    const Layer& of = layers_[layer];
    const Scalar slope = std::visit(
        [&](const auto& model) {
          return Scalar(start_slope(model, height_of(layer, y), height_of(layer, middle)));
        },
        *scene_->spec().initial_state);
    if (is_identity_) return slope;
    return (of.is_reversed ? Scalar(-slope) : slope) / (of.width * of.stretch);
  }
  /// Derivatives by the entries of the model: add(entry, that of u at a height of a layer, that of int u dy from the bottom to there).
  template <class Add>
  void derivatives(std::size_t layer, const Scalar& y, const Add& add) const {
    std::visit(
        [&](const auto& model) {
          for (std::size_t k = 0; k <= layer; ++k) {
            const Layer& of = layers_[k];
            const Scalar z = k == layer ? height_of(k, y) : of.top_z, one(1);
            const Scalar unit = is_identity_ ? one : Scalar((of.is_reversed ? Scalar(-one) : one) / of.width),
                         stretch = is_identity_ ? one : of.stretch;
            start_derivatives(model, of.bottom_z, z,
                              [&](std::size_t entry, const Scalar& value, const Scalar& integral) {
                                add(entry, k == layer ? Scalar(unit * value) : Scalar(0),
                                    Scalar(unit * stretch * integral));
                              });
          }
        },
        *scene_->spec().initial_state);
  }
  /// int u dy between two heights of one layer.
  [[nodiscard]] Scalar amount(std::size_t layer, const Scalar& from, const Scalar& to) const {
    const Layer& of = layers_[layer];
    const Scalar lo = height_of(layer, from), hi = height_of(layer, to);
    const Scalar shares = std::visit([&](const auto& model) { return Scalar(model.integral(lo, hi)); },
                                     *scene_->spec().initial_state);
    if (is_identity_) return shares;
    const Scalar range = of.zero * (hi - lo);
    return of.stretch / of.width * (of.is_reversed ? range - shares : shares - range);
  }
  [[nodiscard]] Scalar total() const {
    CompensatedSum<Scalar> sum;
    for (std::size_t k = 0; k < layers_.size(); ++k) sum += amount(k, layers_[k].bottom_y, layers_[k].top_y);
    return sum.value();
  }

 private:
  [[nodiscard]] Scalar image_of(std::size_t k, const Scalar& z) const {
    const Layer& of = layers_[k];
    return is_identity_ ? z : std::min(of.top_y, Scalar(of.bottom_y + of.stretch * (z - of.bottom_z)));
  }
  [[nodiscard]] Scalar height_of(std::size_t k, const Scalar& y) const {
    const Layer& of = layers_[k];
    if (is_identity_) return y;
    if (!(y < of.top_y)) return of.top_z;
    const auto knot = std::lower_bound(knots_.begin(), knots_.end(), y);
    if (knot != knots_.end() && *knot == y)
      return knot_heights_[static_cast<std::size_t>(knot - knots_.begin())];
    return std::clamp(Scalar(of.bottom_z + (y - of.bottom_y) / of.stretch), of.bottom_z, of.top_z);
  }

  std::shared_ptr<const Scene<Scalar>> scene_;
  std::vector<Layer> layers_;
  bool is_identity_;
  std::vector<Scalar> knots_, knot_heights_;  ///< in y and in z
};

}  // namespace shearfront::exact
