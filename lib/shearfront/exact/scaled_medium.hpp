// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/exact/medium.hpp"

namespace shearfront::exact {

/// A medium in another unit of time: rates are those of `inner` times `unit`, a power of two, so nothing is rounded. It
/// keeps products of rates, which closed forms need, away from overflow whatever the unit of the user's times.
template <Real Scalar>
class ScaledMedium final : public Medium<Scalar> {
 public:
  ScaledMedium(std::unique_ptr<const Medium<Scalar>> inner, Scalar unit)
      : Medium<Scalar>(inner->cells(), inner->mass()), inner_(std::move(inner)), unit_(std::move(unit)) {}

  [[nodiscard]] const std::vector<Scalar>& boundaries() const override { return inner_->boundaries(); }
  [[nodiscard]] std::size_t numbers_per_piece() const override { return inner_->numbers_per_piece(); }
  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const override {
    return outward(inner_->best_free(z, time(t), upper));
  }
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override {
    return outward(inner_->best_moving(z, time(t)));
  }
  [[nodiscard]] std::vector<Path<Scalar>> best_paths(const std::vector<Scalar>& z,
                                                     const Scalar& t) const override {
    std::vector<Path<Scalar>> paths = inner_->best_paths(z, time(t));
    for (Path<Scalar>& path : paths) path = outward(std::move(path));
    return paths;
  }
  [[nodiscard]] Scalar pure_travel_time(const Scalar& from, const Scalar& to) const override {
    return inner_->pure_travel_time(from, to) / unit_;
  }
  [[nodiscard]] bool is_reached_from(bool is_bottom, const Scalar& z, const Scalar& t) const override {
    return inner_->is_reached_from(is_bottom, z, time(t));
  }
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override {
    return inner_->shortfall(inward(path), z, time(t), amount);
  }
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override { return inner_->rate_at(z) * unit_; }
  [[nodiscard]] Scalar flux_at(const Scalar& z, const Scalar& phi) const override {
    return inner_->flux_at(z, phi) * unit_;
  }
  [[nodiscard]] std::optional<Scalar> first_wave(std::size_t i) const override {
    auto t = inner_->first_wave(i);
    if (t) *t /= unit_;
    return t;
  }
  [[nodiscard]] PathGradient<Scalar> gradient(const Path<Scalar>& path, const Scalar& z,
                                              const Scalar& t) const override {
    PathGradient<Scalar> gradient = inner_->gradient(inward(path), z, time(t));
    for (auto& by : gradient.pieces) by.M /= unit_, by.phi /= unit_;
    return gradient;
  }

 private:
  /// Later than all finite times is as late as the last of them.
  [[nodiscard]] Scalar time(const Scalar& t) const {
    return std::min(Scalar(t * unit_), Scalar(std::numeric_limits<double>::max()));
  }
  [[nodiscard]] Path<Scalar> outward(Path<Scalar> path) const {
    path.H *= unit_, path.r_reference *= unit_;
    return path;
  }
  [[nodiscard]] Path<Scalar> inward(Path<Scalar> path) const {
    path.H /= unit_, path.r_reference /= unit_;
    return path;
  }

  std::unique_ptr<const Medium<Scalar>> inner_;
  Scalar unit_;
};

}  // namespace shearfront::exact
