// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/solid_heights.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace shearfront::diffusion {

SolidHeights::SolidHeights(const Scene<double>& scene) : scene_(scene) {
  const auto& c = scene.spec().solid_fraction;
  if (!c) return;
  const double bottom = scene.bottom(), top = scene.top();
  for (const double z : std::visit([](const auto& model) { return model.knots(); }, *c))
    if (z > bottom && z < top && (knots_.empty() || z > knots_.back())) knots_.push_back(z);
  mean_ = scene.solid(bottom, top) / (top - bottom);
  z_ = knots_;
  z_.insert(z_.begin(), bottom);
  z_.push_back(top);
  m_.push_back(bottom);
  for (std::size_t i = 1; i + 1 < z_.size(); ++i)
    m_.push_back(m_.back() + scene.solid(z_[i - 1], z_[i]) / mean_);
  m_.push_back(top);
}

double SolidHeights::coordinate(double z) const {
  if (is_identity()) return z;
  const auto above = std::upper_bound(z_.begin() + 1, z_.end() - 1, z);
  const auto i = static_cast<std::size_t>(above - z_.begin()) - 1;
  if (z == z_[i]) return m_[i];
  if (!(z < z_[i + 1])) return m_[i + 1];
  return std::min(m_[i] + scene_.solid(z_[i], z) / mean_, m_[i + 1]);
}

double SolidHeights::height(double m) const {
  if (is_identity()) return m;
  const auto above = std::upper_bound(m_.begin() + 1, m_.end() - 1, m);
  const auto i = static_cast<std::size_t>(above - m_.begin()) - 1;
  if (m == m_[i]) return z_[i];
  if (!(m < m_[i + 1])) return z_[i + 1];
  // Newton: c is smooth and positive between knots, so it hardly differs from its mean.
  double z = z_[i] + (z_[i + 1] - z_[i]) * ((m - m_[i]) / (m_[i + 1] - m_[i]));
  constexpr int kMostSteps = 60;
  const double rounding = 4e-16 * std::max(std::abs(z_[i]), std::abs(z_[i + 1]));
  for (int k = 0; k < kMostSteps; ++k) {
    const double step = (m_[i] + scene_.solid(z_[i], z) / mean_ - m) / density(z);
    z = std::clamp(z - step, z_[i], z_[i + 1]);
    if (std::abs(step) <= rounding) break;
  }
  return z;
}

double SolidHeights::density(double z) const {
  return is_identity() ? 1 : scene_.solid_fraction_at(z) / mean_;
}

}  // namespace shearfront::diffusion
