// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/steady_logistic.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "shearfront/diffusion/logistic.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::diffusion {
namespace {

using SteadyRule = boost::math::quadrature::gauss<double, 10>;

template <class Function>
double steady_integral(const Function& f, double lo, double hi) {
  return hi > lo ? SteadyRule::integrate(f, lo, hi) : 0.0;
}

}  // namespace

std::string SteadyLogistic::refusal(const Scene<double>& scene) {
  if (!scene.has_diffusion()) return "grains do not diffuse in this bed (no D > 0)";
  if (scene.fluxes().size() > 1 || unit_parabola_sign(scene.fluxes()[0]) == 0)
    return "a steady state in closed form needs the flux phi (phi - 1) or phi (1 - phi)";
  if (scene.spec().solid_fraction) return "a steady state in closed form needs c = 1";
  if (!scene.has_walls()) return "a steady state in closed form needs walls at both ends";
  return {};
}

SteadyLogistic::SteadyLogistic(const Scene<double>& scene)
    : scene_(scene), sign_(unit_parabola_sign(scene.fluxes()[0])), mass_(scene.mass()) {
  z_ = {scene_.bottom()};
  e_ = {0};
  for (const double knot : scene_.knots()) add_panels(z_.back(), knot);
  add_panels(z_.back(), scene_.top());
  const double height = scene_.top() - scene_.bottom();
  if (!(mass_ > 0) || !(mass_ < height)) return;
  const auto all = [&](double log_C) {
    log_C_ = log_C;
    CompensatedSum<double> sum;
    for (std::size_t k = 0; k + 1 < z_.size(); ++k) sum += amount(k, z_[k + 1]);
    return sum.value();
  };
  // phi = 1/2 somewhere in the bed, or nearly pure all over it.
  const auto [least, most] = std::minmax_element(e_.begin(), e_.end());
  const double lean = std::log(mass_ / (height - mass_));
  double lo = *least + std::min(lean, 0.0) - 1, hi = *most + std::max(lean, 0.0) + 1;
  constexpr int kMost = 200;
  for (int n = 0; n < kMost && hi - lo > 1e-15 * std::max({1.0, std::abs(lo), std::abs(hi)}); ++n) {
    const double middle = lo + (hi - lo) / 2;
    if (!(middle > lo && middle < hi)) break;
    (all(middle) < mass_ ? lo : hi) = middle;
  }
  log_C_ = lo + (hi - lo) / 2;
  CompensatedSum<double> sum;
  M_ = {0};
  for (std::size_t k = 0; k + 1 < z_.size(); ++k) {
    sum += amount(k, z_[k + 1]);
    M_.push_back(sum.value());
  }
}

double SteadyLogistic::exponent(double from, double to) const {
  return steady_integral(
      [&](double z) { return sign_ * scene_.scale() * (scene_.rate_at(z) / scene_.diffusivity_at(z)); }, from,
      to);
}

void SteadyLogistic::add_panels(double lo, double hi) {
  if (!(hi > lo)) return;
  const double whole = std::abs(exponent(lo, hi));
  const double n =
      std::clamp(std::ceil(whole), static_cast<double>(kLeastPanels), static_cast<double>(kMostPanels));
  const auto panels = static_cast<std::size_t>(n);
  const auto add = [&](double z) {
    if (!(z > z_.back())) return;
    e_.push_back(e_.back() + exponent(z_.back(), z));
    z_.push_back(z);
  };
  // Next to an end where the rate vanishes as a root, ever smaller panels: what is left there no longer counts.
  constexpr int kHalvings = 36;
  const double width = (hi - lo) / n;
  if (scene_.rate_at(lo) == 0)
    for (int j = kHalvings; j > 0; --j) add(lo + std::ldexp(width, -j));
  for (std::size_t i = 1; i < panels; ++i) add(lo + (hi - lo) * (static_cast<double>(i) / n));
  if (scene_.rate_at(hi) == 0)
    for (int j = 1; j <= kHalvings; ++j) add(hi - std::ldexp(width, -j));
  add(hi);
}

double SteadyLogistic::amount(std::size_t k, double to) const {
  return steady_integral([&](double z) { return logistic(e_[k] + exponent(z_[k], z) - log_C_); }, z_[k], to);
}

ClosedFormValue SteadyLogistic::at(double z) const {
  if (M_.empty()) {
    const double phi = mass_ > 0 ? 1.0 : 0.0;
    return {phi, phi * (z - scene_.bottom())};
  }
  const auto above = std::upper_bound(z_.begin() + 1, z_.end() - 1, z);
  const auto k = static_cast<std::size_t>(above - z_.begin()) - 1;
  const double M = z == scene_.top() ? mass_ : std::min(M_[k] + amount(k, z), mass_);
  return {logistic(e_[k] + exponent(z_[k], z) - log_C_), M};
}

}  // namespace shearfront::diffusion
