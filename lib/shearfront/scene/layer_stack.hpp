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

/// A stack of layers with constant shear rate: layer k occupies [boundary(k), boundary(k+1)].
///
/// Invariant: at least one layer, boundaries strictly increasing, shear rates positive and finite.
template <Real Scalar>
class LayerStack {
 public:
  /// `is_break[i]` tells whether interior boundary i + 1 is a break of the scene's own a(z) (true) or only an
  /// edge of a staircase that stands for a smooth a(z) (false).
  LayerStack(std::vector<Scalar> boundaries, std::vector<Scalar> shear_rates, Scalar scale,
             std::vector<bool> is_break)
      : boundaries_(std::move(boundaries)),
        shear_rates_(std::move(shear_rates)),
        scale_(std::move(scale)),
        is_break_(std::move(is_break)) {
    SHEARFRONT_EXPECTS(!shear_rates_.empty() && boundaries_.size() == shear_rates_.size() + 1 &&
                           is_break_.size() + 1 == shear_rates_.size(),
                       "sizes of a layer stack");
  }

  [[nodiscard]] std::size_t n_layers() const { return shear_rates_.size(); }
  [[nodiscard]] const Scalar& bottom() const { return boundaries_.front(); }
  [[nodiscard]] const Scalar& top() const { return boundaries_.back(); }
  [[nodiscard]] const Scalar& boundary(std::size_t k) const { return boundaries_[k]; }
  [[nodiscard]] const std::vector<Scalar>& boundaries() const { return boundaries_; }
  [[nodiscard]] const Scalar& shear_rate(std::size_t k) const { return shear_rates_[k]; }
  [[nodiscard]] const Scalar& scale() const { return scale_; }
  /// s a_k: the flux of layer k is rate(k) f(phi).
  [[nodiscard]] Scalar rate(std::size_t k) const { return scale_ * shear_rates_[k]; }
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
};

/// The layers of a scene whose shear rate is piecewise constant, nothing rounded.
/// Precondition: scene.is_layered().
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> exact_layers(const Scene<Scalar>& scene) {
  SHEARFRONT_EXPECTS(scene.is_layered(), "a layered shear rate");
  const auto knots = std::visit([](const auto& rate) { return rate.knots(); }, scene.shear_rate());
  std::vector<Scalar> boundaries{scene.bottom()}, rates;
  boundaries.insert(boundaries.end(), knots.begin(), knots.end());
  boundaries.push_back(scene.top());
  for (std::size_t k = 0; k + 1 < boundaries.size(); ++k)
    rates.push_back(
        std::visit([&](const auto& a) { return a.harmonic_mean(boundaries[k], boundaries[k + 1]); },
                   scene.shear_rate()));
  return {std::move(boundaries), std::move(rates), scene.scale(), std::vector<bool>(knots.size(), true)};
}

/// A smooth shear rate as a staircase: every piece between knots is cut into equal layers no higher than
/// (top - bottom) / n_layers, each with the harmonic mean of a. Travel times of pure states (H = 0) across
/// whole layers are then exact; M(z, t) is second order in the layer height where no path turns and of
/// order 3/2 where paths do (a falling along them), phi first order. Cost:
/// O(n_layers + knots).
template <Real Scalar>
[[nodiscard]] LayerStack<Scalar> staircase(const Scene<Scalar>& scene, std::size_t n_layers) {
  using std::ceil;
  std::vector<Scalar> cuts{scene.bottom()};
  for (const Scalar& z : std::visit([](const auto& rate) { return rate.knots(); }, scene.shear_rate()))
    if (z > scene.bottom() && z < scene.top()) cuts.push_back(z);
  cuts.push_back(scene.top());
  const Scalar height = scene.top() - scene.bottom();
  std::vector<Scalar> boundaries{scene.bottom()}, rates;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Scalar piece = cuts[i + 1] - cuts[i];
    const double share = to_double(Scalar(piece / height)) * static_cast<double>(n_layers);
    const std::size_t n = std::max<std::size_t>(1, static_cast<std::size_t>(ceil(share - 1e-9)));
    for (std::size_t j = 1; j <= n; ++j) {
      const Scalar z =
          j == n ? cuts[i + 1]
                 : cuts[i] + piece * Scalar(static_cast<double>(j)) / Scalar(static_cast<double>(n));
      if (!(z > boundaries.back())) continue;  // the piece is too thin for n distinct numbers
      rates.push_back(std::visit([&](const auto& a) { return a.harmonic_mean(boundaries.back(), z); },
                                 scene.shear_rate()));
      boundaries.push_back(z);
    }
  }
  const std::size_t n_interfaces = rates.size() - 1;
  return {std::move(boundaries), std::move(rates), scene.scale(), std::vector<bool>(n_interfaces, false)};
}

}  // namespace shearfront
