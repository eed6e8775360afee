// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "shearfront/track/track.hpp"

namespace shearfront::track_detail {

/// A tracker with its bed, whatever its grid.
class AnyTracking {
 public:
  virtual ~AnyTracking() = default;
  [[nodiscard]] virtual std::unique_ptr<AnyTracking> copy() const = 0;
  virtual Status advance(double t) = 0;
  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] virtual Profile<double> profile() const = 0;
  /// The scene outlives it.
  [[nodiscard]] virtual std::unique_ptr<Field> field(const Scene<double>& scene) const {
    return std::make_unique<ProfileField>(scene, profile());
  }
  [[nodiscard]] virtual std::vector<FrontSegment<double>> fronts() const = 0;
  [[nodiscard]] virtual std::vector<Collision> collisions() const = 0;
  [[nodiscard]] virtual std::optional<Timeline<double>> timeline() = 0;
  [[nodiscard]] virtual Summary summary() const = 0;
};

}  // namespace shearfront::track_detail
