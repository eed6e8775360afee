// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "shearfront/diffusion/closed_form.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::diffusion {

/// The steady state of phi_t + (r(z) phi (phi - 1))_z = (D(z) phi_z)_z between walls, for any rate r = s a sqrt(T) and D > 0 inside:
///
///     phi / (1 - phi) = C exp(-int r / D dz),   C from the mass.
///
/// Logistic in int r / D: where D is constant and a = du/dz, in the velocity itself. r and D may vanish at an end alone. (Upside down for the
/// flux phi (1 - phi).)
///
/// Domain: one flux, a parabola on [0, 1], c = 1, walls, D > 0. int r / D by Gauss's rule of ten points on panels over which it changes by
/// at most 1 (kMostPanels of them, at least kLeastPanels between knots, ever smaller ones next to an end where r vanishes), phi by the same
/// rule, C by halving. Accuracy: about 1e-13 of phi and M where r and D are smooth between knots. Cost: some ms, and 1 us a point.
class SteadyLogistic {
 public:
  static constexpr std::size_t kLeastPanels = 32, kMostPanels = 1 << 14;
  explicit SteadyLogistic(const Scene<double>& scene);
  /// Empty, or why a scene has none: one clause.
  [[nodiscard]] static std::string refusal(const Scene<double>& scene);

  [[nodiscard]] ClosedFormValue at(double z) const;

 private:
  /// int r / D.
  [[nodiscard]] double exponent(double from, double to) const;
  [[nodiscard]] double amount(std::size_t panel, double to) const;
  void add_panels(double lo, double hi);

  Scene<double> scene_;
  double sign_, mass_, log_C_ = 0;
  std::vector<double> z_, e_, M_;  ///< ends of panels, with their exponents and amounts below
};

}  // namespace shearfront::diffusion
