// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/flow_coordinate.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/sum.hpp"
#include "shearfront/track/solid_profile.hpp"

namespace shearfront {

FlowCoordinate::FlowCoordinate(const Scene<double>& scene, const LayerStack<double>& layers)
    : z_top_(layers.top()), is_identity_(!scene.spec().solid_fraction && scene.fluxes().size() == 1) {
  if (!is_constant_in_pieces<double>(scene.spec().solid_fraction))
    bed_ = std::make_shared<const Scene<double>>(scene);
  CompensatedSum<double> y, pure;
  y += layers.bottom();
  for (std::size_t k = 0; k < layers.n_layers(); ++k) {
    const Flux<double>& flux = layers.flux(k);
    const StateRange<double> range = flux.range();
    const double width = range.highest - range.lowest, lo = layers.boundary(k), hi = layers.boundary(k + 1);
    const bool has_maximum = flux.value(flux.extrema().front()) > 0;
    Layer layer{};
    layer.z = lo;
    layer.y = y.value();
    layer.width = k == 0 ? 1 : width / std::abs(layers_.front().slope);
    layer.offset = has_maximum ? range.highest : range.lowest;
    layer.slope = has_maximum ? -width : width;
    layer.pure = pure.value();
    layer.c = layers.solid_fraction(k);
    layers_.push_back(layer);
    if (is_identity_) break;
    y += layer.width * layer.c * (hi - lo);
    pure += layer.offset * layer.c * (hi - lo);
  }
  y_top_ = is_identity_ ? z_top_ : y.value();
}

std::size_t FlowCoordinate::layer_of(double y) const {
  const auto above = [](double height, const Layer& layer) { return height < layer.y; };
  const auto it = std::upper_bound(layers_.begin() + 1, layers_.end(), y, above);
  return static_cast<std::size_t>(it - layers_.begin()) - 1;
}

double FlowCoordinate::y_of(double z) const {
  if (is_identity_) return z;
  if (!(z < z_top_)) return y_top_;
  const auto above = [](double height, const Layer& layer) { return height < layer.z; };
  const auto it = std::upper_bound(layers_.begin() + 1, layers_.end(), z, above) - 1;
  const double c = bed_ && z > it->z ? bed_->mean_solid_fraction(it->z, z) : it->c;
  return std::min(y_end(static_cast<std::size_t>(it - layers_.begin())), it->y + it->width * c * (z - it->z));
}

double FlowCoordinate::z_of(double y) const {
  if (is_identity_) return y;
  if (!(y < y_top_)) return z_top_;
  const std::size_t k = layer_of(y);
  const Layer& layer = layers_[k];
  const double end = z_end(k);
  if (bed_) return height_holding(*bed_, layer.z, end, (y - layer.y) / (y_end(k) - layer.y));
  return std::min(end, layer.z + (y - layer.y) / (layer.width * layer.c));
}

double FlowCoordinate::fraction(std::size_t k, double z) const {
  return bed_ ? bed_->solid_fraction_at(z) : layer(k).c;
}

SolidLine FlowCoordinate::solid_line(std::size_t k, double from, double to, double dy) const {
  const double low = fraction(k, from), high = fraction(k, to);
  if (!bed_ || !(to > from)) return {low, high};
  const double mean = solid_per_height(k) * dy / (to - from), half = (high - low) / 2;
  return {std::min(low, mean - half), std::min(high, mean + half)};
}

double FlowCoordinate::room() const { return std::abs(layers_.front().slope); }

}  // namespace shearfront
