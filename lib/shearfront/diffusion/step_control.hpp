// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

namespace shearfront::diffusion {

/// Lengths of adaptive steps of a method of second order: a proportional-integral controller of the local
/// error.
///
/// The error allowed in a step is c tolerance^(3/2) max |phi|: the number of steps then grows as
/// tolerance^(-1/2) and the sum of all local errors is proportional to the tolerance. A part of the error that
/// is of first order is allowed c tolerance^2, with a number of steps that grows as 1 / tolerance.
/// Source: Soederlind & Wang (2006), J. Comput. Appl. Math. 185, 225-243 (PI with 0.7/3, 0.4/3).
class StepControl {
 public:
  explicit StepControl(double tolerance = 0)
      : allowed_(kLocalShare * tolerance * std::sqrt(tolerance)),
        allowed_first_(kLocalShare * tolerance * tolerance),
        tolerance_(tolerance) {}

  /// Wanted length of the next step; 0 before the first.
  [[nodiscard]] double length() const { return length_; }
  /// A first step in which states that change at the rate `rate` (over max |phi|) hardly move.
  void start(double rate, double longest) {
    length_ = rate > 0 ? std::min(longest, 0.1 * std::sqrt(tolerance_) / rate) : longest;
  }
  /// Whether a step of `length` with this local error (over max |phi|) may stand, of which the part of first
  /// order is `first`; sets the next length.
  bool accept(double length, double error, double first) {
    // Errors grow with the third and the second power of the length.
    const double ratio = std::min(allowed_ / std::max(error, 1e-9 * allowed_),
                                  std::pow(allowed_first_ / std::max(first, 1e-6 * allowed_first_), 1.5));
    if (ratio < kRetryBelow) {
      length_ = length * std::max(kMostShrink, kSafety * std::cbrt(ratio));
      last_ratio_ = 1;
      return false;
    }
    const double factor = kSafety * std::pow(ratio, 0.7 / 3) * std::pow(last_ratio_, -0.4 / 3);
    last_ratio_ = ratio;
    // A step that was cut short for an output time must not shorten those after it.
    length_ =
        std::max(length_ * std::min(1.0, factor), length * std::clamp(factor, kMostShrink, kMostGrowth));
    return true;
  }
  /// Without an estimate.
  void grow(double length) { length_ = std::max(length_, kMostGrowth * length); }
  void shorten(double length) { length_ = length; }

 private:
  static constexpr double kLocalShare = 2;
  static constexpr double kRetryBelow = 0.5;
  static constexpr double kSafety = 0.9, kMostShrink = 0.2, kMostGrowth = 1.6;

  double allowed_, allowed_first_, tolerance_, length_ = 0, last_ratio_ = 1;
};

/// When the fluxes of the last two steps were taken, for extrapolation in time.
struct FluxTimes {
  int n = 0;              ///< how many are known, at most 2
  double since_last = 0;  ///< from the last flux to the end of its step
  double between = 0;     ///< from the flux before to the last
  double last_length = 0, before_length = 0;

  /// After a step of `length` whose flux belongs to the time `at` inside it.
  void push(double at, double length) {
    between = since_last + at;
    since_last = length - at;
    before_length = last_length;
    last_length = length;
    n = std::min(n + 1, 2);
  }
  /// q = q_last + factor (q_last - q_before), `at` after the end of the last step.
  [[nodiscard]] double factor(double at) const { return n == 2 ? (since_last + at) / between : 0; }
  /// Bound for the local error of the midpoint rule, h^3 phi''' / 12, over the distance to the parabola
  /// through the last three states, phi''' h (h + h1) (h + h1 + h2) / 6.
  [[nodiscard]] double local_error_share(double length) const {
    const double two = length + last_length, three = two + before_length;
    return 0.5 * (length / two) * (length / three);
  }
  /// Local error of first order, (theta - 1/2) h^2 phi'', over the change h (phi'_now - phi'_last) of the states.
  [[nodiscard]] double turn_share(double theta, double length) const {
    return n > 0 ? (theta - 0.5) * length / (since_last + theta * length) : 0;
  }
};

}  // namespace shearfront::diffusion
