// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/numeric/scalar.hpp"

/// The two quadratics of an exponential medium, without cancellation and without overflow.
namespace shearfront::exact {

/// Momenta at both ends of the path with (1 - B (1 - p0)) (1 + B p0) = 1 + e.
/// Domain: B > 0, -min(1, B) <= e <= B. Guaranteed: relative accuracy of p0, 1 - p0 and p.
template <Real Scalar>
struct FanMomenta {
  Scalar E, S, p0, one_minus_p0, p;

  /// log_E = (z - z0) / decay, e = E - 1; next to E = 0 the logarithm knows E better.
  FanMomenta(const Scalar& B, const Scalar& log_E, const Scalar& e) : E(stretch(log_E, e)) {
    using std::sqrt;
    const Scalar one(1), half(0.5);
    const Scalar half_B = B * half;
    // Beyond 2^400 the square would overflow a double and E no longer matters.
    const Scalar large = Scalar(std::ldexp(1.0, 400));
    S = B < large ? Scalar(sqrt(Scalar(E + half_B * half_B))) : half_B;
    p0 = half_B < one ? Scalar((B + e) / (B * (S + (one - half_B)))) : Scalar(half + (S - one) / B);
    one_minus_p0 = ((B - e) / B) / (half_B + one + S);
    p = E * ((B + e) / B) / (half_B + E + S);
  }

 private:
  [[nodiscard]] static Scalar stretch(const Scalar& log_E, const Scalar& e) {
    using std::exp;
    return e + e < Scalar(-1) ? Scalar(exp(log_E)) : Scalar(Scalar(1) + e);
  }
};

/// E = exp((z - foot) / decay) = 1 + e for the characteristic of a constant state p0 that reaches z:
/// b^2 p0 (1 - p0) E^2 + (1 - b (2 p0 - 1)) E - 1 = 0, b = s a(z) t / decay > 0. Exactly one positive root,
/// except for p0 = 1 and b >= 1 (the characteristic would have to start at -infinity).
template <Real Scalar>
struct FootRoot {
  bool exists = true;
  Scalar E{1}, e{0};

  FootRoot(const Scalar& b, const Scalar& p0) {
    using std::sqrt;
    const Scalar one(1), zero(0), h = p0 * (one - p0), twist = p0 + (p0 - one);
    const Scalar unit = b > one ? Scalar(one / b) : one;  // scale so that nothing exceeds order 1
    const Scalar bs = b > one ? one : b;
    const Scalar c = unit - bs * twist;
    const Scalar D = sqrt(Scalar(c * c + Scalar(4) * bs * bs * h));
    const Scalar product = Scalar(4) * bs * bs * h;  // (D - c) (D + c)
    const Scalar sum = c < zero ? Scalar(product / (D - c)) : Scalar(c + D);
    if (!(sum > zero)) {
      exists = false;
      return;
    }
    E = Scalar(2) * unit / sum;
    const Scalar rest = c < zero ? Scalar(D - c) : Scalar(product / sum);  // D - c
    e = Scalar(4) * bs * (twist * unit - bs * h) / (sum * (Scalar(2) * unit + rest));
  }

  /// d p / d p0 and d p / d log b of p = p0 - B h with B = b E, h = p0 (1 - p0): h B^2 + (1 / b - 2 p0 + 1) B - 1 = 0
  /// differentiated, and used once more so that nothing cancels.
  [[nodiscard]] Scalar phi_by_state(const Scalar& b, const Scalar& p0) const {
    return E / (Scalar(1) + p0 * (Scalar(1) - p0) * (b * E) * (b * E));
  }
  [[nodiscard]] Scalar phi_by_log_b(const Scalar& b, const Scalar& p0) const {
    return -p0 * (Scalar(1) - p0) * (b * E) * phi_by_state(b, p0);
  }

  /// log E, to a few units in the last place both near E = 1 and near E = 0.
  [[nodiscard]] Scalar log_E() const {
    using std::log;
    using std::log1p;
    return E < Scalar(0.5) ? Scalar(log(E)) : Scalar(log1p(e));
  }
};

}  // namespace shearfront::exact
