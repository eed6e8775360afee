// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_burgers.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <concepts>
#include <utility>

#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::diffusion {

namespace {

/// -ln of the relative size below which terms are dropped.
template <Real S>
S depth() {
  using std::log;
  static const S value = S(6) - log(unit_roundoff<S>());
  return value;
}

/// I_n(k) / I_0(k) for n = 0 .. count - 1 by Miller's backward recurrence, begun where I_n / I_0, which falls
/// like exp(-n^2 / (2 k)), is below rounding.
template <Real S>
std::vector<S> bessel_ratios(const S& k, std::size_t count) {
  const double digits = to_double(depth<S>());
  const auto start = static_cast<std::size_t>(20.0 + digits + std::sqrt(2.0 * to_double(k) * digits)) + count;
  std::vector<S> ratios(count, S(1));
  S ratio(0);  // I_n / I_(n-1), which cannot overflow
  for (std::size_t n = start; n > 0; --n) {
    ratio = S(1) / (S(2) * S(static_cast<double>(n)) / k + ratio);
    if (n < count) ratios[n] = ratio;
  }
  for (std::size_t n = 1; n < count; ++n) ratios[n] *= ratios[n - 1];
  return ratios;
}

}  // namespace

/// X = n pi + offset: the node u = 0 beside X, which is a shock for odd n (of A > 0), and the way to it.
template <Real Scalar>
struct PeriodicBurgers<Scalar>::Place {
  bool is_shock, is_behind;  ///< is_behind: X lies below the node
  Scalar distance;           ///< in [0, pi / 2]
};

/// u, u_X and ln w, up to a constant.
template <Real Scalar>
struct PeriodicBurgers<Scalar>::Means {
  Scalar value, gradient, log_w;
};

template <Real Scalar>
PeriodicBurgers<Scalar>::PeriodicBurgers(Scalar viscosity, Scalar amplitude, Scalar wave_number)
    : wave_number_(std::move(wave_number)),
      speed_(amplitude < 0 ? Scalar(-amplitude) : amplitude),
      is_negative_(amplitude < 0),
      m_(viscosity * wave_number_ / speed_),
      k_(Scalar(1) / (Scalar(2) * m_)) {
  const double terms = std::sqrt(to_double(depth<Scalar>()));
  ratios_ = bessel_ratios(k_, static_cast<std::size_t>(terms) + 2);
}

template <Real Scalar>
typename PeriodicBurgers<Scalar>::Place PeriodicBurgers<Scalar>::place(const Scalar& x) const {
  using std::floor;
  const Scalar pi = boost::math::constants::pi<Scalar>(), at = wave_number_ * x;
  const Scalar n = floor(Scalar(at / pi + Scalar(0.5)));
  const TwoProduct<Scalar> node(n, pi);
  Scalar offset = (at - node.high) - node.low;
  // pi in two parts, so that u is relatively exact beside its nodes.
  if constexpr (std::same_as<Scalar, double>) offset -= n * 1.2246467991473532e-16;
  const bool is_odd = n - Scalar(2) * floor(Scalar(n / 2)) != Scalar(0), is_behind = offset < 0;
  return {is_odd != is_negative_, is_behind, is_behind ? Scalar(-offset) : offset};
}

template <Real Scalar>
typename PeriodicBurgers<Scalar>::Means PeriodicBurgers<Scalar>::series(const Place& place,
                                                                        const Scalar& t) const {
  using std::cos, std::exp, std::log, std::sin;
  Scalar w(1), w1(0), w2(0);
  for (std::size_t n = 1; n < ratios_.size(); ++n) {
    const Scalar order(static_cast<int>(n)), angle = order * place.distance;
    Scalar term = Scalar(2) * ratios_[n] * exp(Scalar(-m_ * order * order * t));
    if (place.is_shock && n % 2 == 1) term = -term;
    w += term * cos(angle);
    w1 -= order * term * sin(angle);
    w2 -= order * order * term * cos(angle);
  }
  const Scalar value = -Scalar(2) * m_ * w1 / w;
  return {value, k_ * value * value - Scalar(2) * m_ * w2 / w, log(w)};
}

/// Step of the trapezoidal rule. Moving the path by i eta multiplies the integrand by at most
/// exp(eta^2 / (2 variance) + k (cosh eta - 1)) and the error of the rule by exp(-2 pi eta / step).
template <Real Scalar>
Scalar PeriodicBurgers<Scalar>::step(const Scalar& variance) const {
  using std::cosh, std::sqrt;
  const Scalar digits = depth<Scalar>();
  const Scalar best = sqrt(Scalar(Scalar(2) * digits / (Scalar(1) / variance + k_)));
  const Scalar eta = std::min(best, Scalar(2.5));
  const Scalar growth = eta * eta / (Scalar(2) * variance) + k_ * (cosh(eta) - Scalar(1));
  return Scalar(2) * boost::math::constants::pi<Scalar>() * eta / (digits + growth);
}

template <Real Scalar>
typename PeriodicBurgers<Scalar>::Means PeriodicBurgers<Scalar>::integral(const Place& place,
                                                                          const Scalar& t) const {
  using std::ceil, std::cos, std::exp, std::expm1, std::log, std::sin, std::sqrt;
  const Scalar variance = Scalar(2) * m_ * t, h = step(variance), digits = depth<Scalar>();
  const Scalar pi = boost::math::constants::pi<Scalar>(), &x = place.distance, half_x = x / 2;
  const auto start = [&](const Scalar& half_y) {
    const Scalar s = place.is_shock ? Scalar(cos(half_y)) : Scalar(sin(half_y));
    return Scalar(-Scalar(2) * k_ * s * s);
  };
  const Scalar peak = place.is_shock ? Scalar(pi - x) : x;
  const Scalar deficit = std::min(Scalar(-start(half_x)), Scalar(peak * peak / (Scalar(2) * variance)));
  const Scalar reach = sqrt(Scalar(Scalar(2) * variance * (digits + deficit)));
  // Nodes on both sides of Y = 0 mirror each other, which keeps u relatively exact beside X = 0; far from
  // there the mirror drowns, and nodes about X are exact for the shortest times.
  const bool is_far = x > reach;
  const Scalar origin = is_far ? x : Scalar(0), last = is_far ? reach : Scalar(x + reach);
  struct Node {
    Scalar y, exponent, weight, mirror, sine;  ///< mirror: the weight of -Y over that of Y
  };
  std::vector<Node> nodes;
  Scalar largest = -deficit;
  for (Scalar j = is_far ? Scalar(-ceil(Scalar(reach / h))) : Scalar(0); j * h <= last; j += 1) {
    const Scalar y = origin + j * h, gap = is_far ? Scalar(-j * h) : Scalar(x - y);
    const Scalar exponent = start(Scalar(y / 2)) - gap * gap / (Scalar(2) * variance);
    if (exponent < largest - digits) continue;
    largest = std::max(largest, exponent);
    nodes.push_back({y, exponent, Scalar(is_far || j != 0 ? 1 : 0.5), Scalar(0), Scalar(0)});
  }
  Scalar w(0), odd(0), even(0);
  for (Node& e : nodes) {
    const Scalar less = -expm1(Scalar(-Scalar(2) * x * e.y / variance));
    e.sine = sin(e.y);
    e.mirror = Scalar(1) - less;
    e.weight *= exp(Scalar(e.exponent - largest));
    w += e.weight * (Scalar(2) - less);
    odd += e.weight * less * e.sine;
    even += e.weight * (Scalar(2) - less) * cos(e.y);
  }
  const Scalar mean = odd / w;
  Scalar spread(0);
  for (const Node& e : nodes)
    spread += e.weight * ((e.sine - mean) * (e.sine - mean) + e.mirror * (e.sine + mean) * (e.sine + mean));
  const Scalar cosine = even / w;
  return {place.is_shock ? Scalar(-mean) : mean,
          (place.is_shock ? Scalar(-cosine) : cosine) - k_ * spread / w, log(w) + largest};
}

template <Real Scalar>
BurgersPoint<Scalar> PeriodicBurgers<Scalar>::at(const Scalar& x, const Scalar& t) const {
  using std::cos, std::sin;
  const Place here = place(x), origin{is_negative_, false, Scalar(0)};
  const Scalar time = speed_ * wave_number_ * t;
  const Scalar side(here.is_behind ? -1 : 1), scale = speed_ / wave_number_;
  if (time == 0) {
    const Scalar sign(here.is_shock ? -1 : 1);
    const Scalar s = sin(Scalar(wave_number_ * x / 2));
    return {speed_ * side * sign * sin(here.distance), scale * Scalar(is_negative_ ? -2 : 2) * s * s,
            speed_ * wave_number_ * sign * cos(here.distance)};
  }
  const auto means = [&](const Place& p) {
    return m_ * time < Scalar(1) ? integral(p, time) : series(p, time);
  };
  const Means e = means(here);
  return {speed_ * side * e.value, scale * Scalar(2) * m_ * (means(origin).log_w - e.log_w),
          speed_ * wave_number_ * e.gradient};
}

template class PeriodicBurgers<Instantiated>;

}  // namespace shearfront::diffusion
