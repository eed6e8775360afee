// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "shearfront/scene/layer_stack.hpp"

namespace shearfront {

struct SolidLine {
  double low, high;
};

/// Heights z of a bed as y = int c w dz, and shares phi / c of its fluxes as u, 0 <= u <= 1: in both the equation is that of one kind
/// of flux in a bed of c = 1. Where the flux has a minimum phi / c = lowest + width u, where it has a maximum highest - width u;
/// w is the width over that of the lowest flux. Where c varies within layers y is an integral by Gauss's rule (Scene::mean_solid_fraction),
/// z by Newton's method.
class FlowCoordinate {
 public:
  /// Precondition: the fluxes all have a minimum, or all a maximum, and one only.
  FlowCoordinate(const Scene<double>& scene, const LayerStack<double>& layers);

  [[nodiscard]] double y_of(double z) const;
  [[nodiscard]] double z_of(double y) const;
  /// Layer at y; on an interface the one above it.
  [[nodiscard]] std::size_t layer_of(double y) const;

  /// phi / c in layer k, and back.
  [[nodiscard]] double share_of(std::size_t k, double u) const {
    return layer(k).offset + layer(k).slope * u;
  }
  [[nodiscard]] double u_of(std::size_t k, double share) const {
    return (share - layer(k).offset) / layer(k).slope;
  }
  /// c between two heights z of layer k, dy apart, as a line with its mean; where c is concave no higher than c.
  [[nodiscard]] SolidLine solid_line(std::size_t k, double from, double to, double dy) const;
  /// c at z in layer k.
  [[nodiscard]] double fraction(std::size_t k, double z) const;
  [[nodiscard]] double phi_of(std::size_t k, double z, double u) const {
    return fraction(k, z) * share_of(k, u);
  }
  /// int c dz / int dy.
  [[nodiscard]] double solid_per_height(std::size_t k) const { return 1 / layer(k).width; }
  /// int phi dz from the bottom up to y for int u dy.
  [[nodiscard]] double amount_of(double y, double amount) const {
    return pure_amount(y) + layers_.front().slope * amount;
  }
  /// int u dy from one height y to another for int phi dz.
  [[nodiscard]] double image_of(double low, double high, double amount) const {
    return (amount - (pure_amount(high) - pure_amount(low))) / layers_.front().slope;
  }
  /// |d(int phi dz) / d(int u dy)|.
  [[nodiscard]] double room() const;

 private:
  struct Layer {
    double z, y;
    double c;              ///< its mean
    double width;          ///< w
    double offset, slope;  ///< phi / c = offset + slope u
    double pure;           ///< int phi dz from the bottom to z for u = 0
  };
  /// Without c and other fluxes all layers are one.
  [[nodiscard]] const Layer& layer(std::size_t k) const { return layers_[is_identity_ ? 0 : k]; }
  /// int phi dz up to y for u = 0.
  [[nodiscard]] double pure_amount(double y) const {
    const Layer& layer = layers_[layer_of(y)];
    return layer.pure + layer.offset * (y - layer.y) / layer.width;
  }

  /// Where layers end.
  [[nodiscard]] double z_end(std::size_t k) const {
    return k + 1 < layers_.size() ? layers_[k + 1].z : z_top_;
  }
  [[nodiscard]] double y_end(std::size_t k) const {
    return k + 1 < layers_.size() ? layers_[k + 1].y : y_top_;
  }

  std::vector<Layer> layers_;
  double z_top_, y_top_;
  bool is_identity_;                          ///< y = z
  std::shared_ptr<const Scene<double>> bed_;  ///< where c varies within layers
};

}  // namespace shearfront
