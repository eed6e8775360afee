// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <functional>
#include <string>
#include <string_view>

namespace shearfront::fit {

/// What is known of an unknown before the data: [prior] of a fit file. The misfit of a fit does not see it; its posterior does
/// (posterior.hpp).
enum class PriorKind {
  uniform,     ///< [low, high]
  normal,      ///< [mean, standard deviation]
  lognormal,   ///< [median, standard deviation of the logarithm]
  half_normal  ///< [standard deviation], of the normal number whose absolute value it is
};
inline constexpr std::array<std::string_view, 4> kPriorNames{"uniform", "normal", "lognormal", "half_normal"};

/// The logarithm of a density up to a constant, and its derivative.
struct PriorDensity {
  double log = 0, slope = 0;
};

/// A distribution of one unknown p, in the unit of its entry.
struct Prior {
  std::string parameter;  ///< an unknown, or a field for all of its entries
  PriorKind kind = PriorKind::uniform;
  double first = 0, second = 0;  ///< the numbers above; second is 0 where there is one only
  /// A density of one's own, asked between first and second, the ends of a uniform one. Empty: that of `kind`.
  std::function<PriorDensity(double)> own = {};

  /// Where it ends: those of a uniform one, which may be infinite, 0 of what is positive.
  [[nodiscard]] double low() const;
  [[nodiscard]] double high() const;
  /// Up to a constant, with r = (p - mean) / sd of a normal, log(p / median) / s of a log-normal, p / sd of a half-normal:
  ///   normal, half-normal   -r^2 / 2
  ///   log-normal            -r^2 / 2 - log p
  ///   uniform               0
  /// -infinity, and a slope of 0, outside the ends; of a log-normal at 0 as well.
  [[nodiscard]] PriorDensity log_density(double p) const;
  /// What is wrong with the numbers; empty if nothing is.
  [[nodiscard]] std::string refusal() const;
  /// "normal [2.4, 0.1]"
  [[nodiscard]] std::string text() const;
};

}  // namespace shearfront::fit
