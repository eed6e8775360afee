// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_uniform.hpp"

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/diffusion/cole_hopf_steady.hpp"
#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/numeric/scaled_erfc.hpp"
#include "shearfront/numeric/scaled_sum.hpp"

namespace shearfront::diffusion {

/// P = phi w, Q = (1 - phi) w and V of the header.
template <Real Scalar>
struct UniformStart<Scalar>::Sums {
  ScaledSum<Scalar> p, q, v;
};

template <Real Scalar>
struct UniformStart<Scalar>::Image {  // T(distance) or U(distance) times sign * exp(exponent)
  Scalar distance, exponent;
  Wall wall;
  int sign;
  bool is_first;  ///< its term along the start's own motion is part of the free solution
};

template <Real Scalar>
Scalar UniformStart<Scalar>::depth() {
  using std::log;
  static const Scalar value = Scalar(30) - log(unit_roundoff<Scalar>());
  return value;
}

template <Real Scalar>
UniformStart<Scalar>::UniformStart(Scalar bottom, Scalar top, Scalar rate, Scalar diffusivity, Scalar initial)
    : bottom_(std::move(bottom)),
      top_(std::move(top)),
      height_(top_ - bottom_),
      rate_(std::move(rate)),
      diffusivity_(std::move(diffusivity)),
      d_(diffusivity_ / ((rate_ < 0 ? Scalar(-rate_) : rate_) * height_)),
      phi0_(std::move(initial)),
      u0_(Scalar(2) * phi0_ - Scalar(1)),
      spread_(phi0_ * (Scalar(1) - phi0_)) {}

/// The first term of P, Q and V with its images of the same exponent: what of the start is carried to x
/// without having met a wall.
template <Real Scalar>
void UniformStart<Scalar>::add_free(Sums& s, const Scalar& x, const Scalar& y, const Scalar& t) const {
  using std::sqrt;
  const Scalar half(0.5), width = Scalar(2) * sqrt(Scalar(d_ * t));
  const Scalar below = (x - u0_ * t) / width, above = (y + u0_ * t) / width;
  const Scalar offset = -u0_ / (Scalar(2) * d_);
  const auto add = [&](const Scalar& mantissa, const Scalar& exponent) {
    s.p.add(phi0_ * mantissa, exponent);
    s.q.add((Scalar(1) - phi0_) * mantissa, exponent);
    s.v.add(mantissa, exponent);
  };
  const Scalar from_bottom = -(x * x + t * t) / (width * width),
               from_top = offset - (y * y + t * t) / (width * width);
  if (below < 0) {
    add(half * scaled_erfc(Scalar(-below)), from_bottom);
    add(-half * scaled_erfc(above), from_top);
  } else if (above < 0) {
    add(half * scaled_erfc(Scalar(-above)), from_top);
    add(-half * scaled_erfc(below), from_bottom);
  } else {
    add(half * (erf_of(below) + erf_of(above)), offset * x - spread_ * t / d_);
  }
}

/// exp(-(1 - u^2) t / (4 d) - u distance / (2 d)) erfc((distance - u t) / sqrt(4 d t)) / 2 as mantissa and
/// exponent, for the speed u of one of the exponentials.
template <Real Scalar>
struct ImageTerm {
  Scalar argument, exponent;
  [[nodiscard]] Scalar mantissa() const {
    return (argument < 0 ? erfc_of(argument) : scaled_erfc(argument)) / Scalar(2);
  }
};

/// The four terms of one image; adds nothing and returns false if all of them drown.
template <Real Scalar>
bool UniformStart<Scalar>::add_image(Sums& s, const Image& image, const Scalar& t) const {
  using std::sqrt;
  const Scalar width = Scalar(2) * sqrt(Scalar(d_ * t)), decay = spread_ * t / d_, rest = Scalar(1) - phi0_;
  const Scalar far = image.exponent - (image.distance * image.distance + t * t) / (width * width);
  const auto term = [&](const Scalar& speed, const Scalar& loss) {
    const Scalar argument = (image.distance - speed * t) / width;
    return ImageTerm<Scalar>{
        argument,
        argument < 0 ? Scalar(image.exponent - loss - speed * image.distance / (Scalar(2) * d_)) : far};
  };
  const bool of_bottom = image.wall == Wall::bottom;
  const Scalar u = of_bottom ? u0_ : -u0_, share = of_bottom ? phi0_ : rest, other = of_bottom ? rest : phi0_;
  ScaledSum<Scalar>& near = of_bottom ? s.p : s.q;
  ScaledSum<Scalar>& away = of_bottom ? s.q : s.p;
  const auto fast = term(Scalar(1), Scalar(0)), back = term(Scalar(-1), Scalar(0)), along = term(u, decay),
             against = term(-u, decay);
  const auto drowns = [&](const auto& e) { return near.drowns(e, depth()) && away.drowns(e, depth()); };
  if (drowns(fast.exponent) && drowns(back.exponent) && drowns(along.exponent) && drowns(against.exponent))
    return false;
  const Scalar sign(image.sign);
  near.add(sign * fast.mantissa(), fast.exponent);
  away.add(sign * back.mantissa(), back.exponent);
  const auto subtract = [&](const ImageTerm<Scalar>& e, const Scalar& of_near, const Scalar& of_away) {
    const Scalar mantissa = sign * e.mantissa();
    near.add(-of_near * mantissa, e.exponent);
    away.add(-of_away * mantissa, e.exponent);
    s.v.add(-mantissa, e.exponent);
  };
  subtract(against, other, share);
  if (!image.is_first) subtract(along, share, other);
  return true;
}

template <Real Scalar>
typename UniformStart<Scalar>::Sums UniformStart<Scalar>::images(const Scalar& x, const Scalar& y,
                                                                 const Scalar& t) const {
  Sums s;
  const Scalar offset = -u0_ / (Scalar(2) * d_), none(0);
  add_free(s, x, y, t);
  add_image(s, {x, none, Wall::bottom, 1, true}, t);
  add_image(s, {y, offset, Wall::top, 1, true}, t);
  for (int n = 1;; ++n) {
    const Scalar even(2 * n), odd(2 * n - 1);
    bool counts = add_image(s, {odd + x, offset, Wall::bottom, -1, false}, t);
    counts = add_image(s, {odd + y, none, Wall::top, -1, false}, t) || counts;
    counts = add_image(s, {even + x, none, Wall::bottom, 1, false}, t) || counts;
    counts = add_image(s, {even + y, offset, Wall::top, 1, false}, t) || counts;
    if (!counts) return s;
  }
}

template <Real Scalar>
typename UniformStart<Scalar>::Sums UniformStart<Scalar>::series(const Scalar& x, const Scalar& y,
                                                                 const Scalar& t) const {
  using std::cos, std::expm1, std::sin;
  Sums s;
  const Scalar two_d = Scalar(2) * d_, offset = -u0_ / two_d, all = expm1(Scalar(-1 / d_));
  s.p.add(expm1(Scalar(-phi0_ / d_)) / all, -x / two_d);
  s.q.add(expm1(Scalar(-(Scalar(1) - phi0_) / d_)) / all, offset - y / two_d);
  const Scalar pi = boost::math::constants::pi<Scalar>(), a2 = offset * offset;
  const bool is_low = x < y;
  for (int n = 1;; ++n) {
    const Scalar wave = Scalar(n) * pi, decay = Scalar(1) / (Scalar(4) * d_) + d_ * wave * wave;
    const Scalar largest = (offset > 0 ? offset : Scalar(0)) - decay * t;
    if (s.p.drowns(largest, depth()) && s.q.drowns(largest, depth())) return s;
    const Scalar amplitude = Scalar(2) * wave / (a2 + wave * wave);
    const Scalar odd(n % 2 == 0 ? 1 : -1);
    const Scalar sine = is_low ? Scalar(sin(Scalar(wave * x))) : Scalar(-odd * sin(Scalar(wave * y)));
    const Scalar cosine = is_low ? Scalar(cos(Scalar(wave * x))) : Scalar(odd * cos(Scalar(wave * y)));
    const Scalar factor = spread_ / d_ * amplitude / decay, slope = d_ * wave * cosine;
    const auto add = [&](const Scalar& sign, const Scalar& exponent) {
      s.p.add(sign * factor * (sine / 2 - slope), exponent);
      s.q.add(sign * factor * (sine / 2 + slope), exponent);
      s.v.add(sign * amplitude * sine, exponent);
    };
    add(Scalar(1), -decay * t);
    add(-odd, offset - decay * t);
  }
}

/// Logarithm of the first term of the sine series over the smallest tail of the steady state: where it is
/// positive the series drowns that tail in rounding, where it is far below 0 only the steady state is left.
template <Real Scalar>
Scalar UniformStart<Scalar>::departure(const Scalar& t) const {
  const Scalar pi = boost::math::constants::pi<Scalar>(), tilt = u0_ < 0 ? Scalar(-u0_) : u0_;
  return (Scalar(1) + tilt) / (Scalar(2) * d_) - t * (Scalar(1) / (Scalar(4) * d_) + d_ * pi * pi);
}

template <Real Scalar>
ColeHopfPoint<Scalar> UniformStart<Scalar>::at(const Scalar& z, const Scalar& t) const {
  using std::log;
  const bool is_up = rate_ > 0;
  const Scalar low = (z - bottom_) / height_, high = (top_ - z) / height_;
  const Scalar x = is_up ? low : high, y = is_up ? high : low;
  const Scalar time = t * (is_up ? rate_ : Scalar(-rate_)) / height_;
  if (d_ * time < std::numeric_limits<Scalar>::min() || spread_ == 0)
    return {phi0_, Scalar(1) - phi0_, phi0_ * (z - bottom_), Scalar(0)};
  const Scalar left = departure(time);
  if (left < -depth()) return SteadyState<Scalar>(bottom_, top_, rate_, diffusivity_, phi0_).at(z);
  const bool has_few_terms = d_ * time > Scalar(0.05);
  const Sums s = has_few_terms && left < Scalar(1) ? series(x, y, time) : images(x, y, time);
  ColeHopfPoint<Scalar> point;
  // Beyond the guarantees rounding may leave a share below 0.
  const auto share = [](const Scalar& odds) {
    return odds > 0 ? Scalar(Scalar(1) / (Scalar(1) + odds)) : Scalar(1);
  };
  point.phi = share(s.q.over(s.p));
  point.complement = share(s.p.over(s.q));
  ScaledSum<Scalar> w = s.p;
  w.add(s.q.mantissa(), s.q.exponent());
  const Scalar m = x / 2 - d_ * (log(w.mantissa()) + w.exponent());
  point.cumulative = height_ * (is_up ? m : Scalar(phi0_ - m));
  point.gradient = (spread_ * s.v.over(w) - point.phi * point.complement) / (d_ * height_);
  if (!is_up) point.gradient = -point.gradient;
  return point;
}

template class UniformStart<Instantiated>;

}  // namespace shearfront::diffusion
