// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/bed_height.hpp"

#include <algorithm>
#include <variant>

namespace shearfront {

std::string BedHeight::refusal(const Scene<double>& scene) {
  if (scene.is_chute()) return "a steady chute flows past with the height it is given";
  if (scene.spec().outside_bottom || scene.spec().outside_top)
    return "grains come and go at the open ends of this bed: it has no height of its own";
  for (const Flux<double>& flux : scene.fluxes()) {
    const StateRange<double> range = flux.range();
    if (range.lowest < 0 || range.highest > 1)
      return "the states of this bed are no shares of grains: they must lie between 0 and 1";
  }
  return "";
}

BedHeight::BedHeight(const Scene<double>& scene) {
  const auto law = scene.spec().close_packing.value_or(PackingPolynomial<double>{});
  const bool is_large = scene.counts_rising_grains();
  const auto close = [law, is_large](double x) {
    const double share = std::clamp(x, 0.0, 1.0);
    return std::visit([&](const auto& model) { return model.value(is_large ? 1 - share : share); }, law);
  };
  integrand_.value = [close](double x) { return 1 / close(x); };
  integrand_.slope = [law, is_large, close](double x) {
    const double share = std::clamp(x, 0.0, 1.0), here = close(x);
    const double slope =
        std::visit([&](const auto& model) { return model.derivative(is_large ? 1 - share : share); }, law);
    return (is_large ? slope : -slope) / (here * here);
  };
  integrand_.kinks = std::visit([](const auto& model) { return model.kinks(); }, law);
  if (is_large) {
    for (double& x : integrand_.kinks) x = 1 - x;
    std::reverse(integrand_.kinks.begin(), integrand_.kinks.end());
  }
  const double mass = scene.mass(), solid = scene.solid(scene.bottom(), scene.top());
  const double height = scene.top() - scene.bottom();
  scale_ = height / (mass / close(1) + (solid - mass) / close(0));
  scale_by_mass_ = scale_ * scale_ / height * (1 / close(0) - 1 / close(1));
}

}  // namespace shearfront
