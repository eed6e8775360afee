// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_steady.hpp"

#include <cmath>
#include <utility>

#include "shearfront/diffusion/logistic.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::diffusion {

template <Real Scalar>
SteadyState<Scalar>::SteadyState(Scalar bottom, Scalar top, Scalar rate, Scalar diffusivity, Scalar mean)
    : bottom_(std::move(bottom)),
      top_(std::move(top)),
      height_(top_ - bottom_),
      mean_(std::move(mean)),
      is_up_(rate > 0),
      d_(diffusivity / ((is_up_ ? rate : Scalar(-rate)) * height_)) {
  using std::expm1, std::log;
  const Scalar rest = Scalar(1) - mean_;
  at_wall_ = log(Scalar(expm1(Scalar(-rest / d_)) / expm1(Scalar(-mean_ / d_)))) - mean_ / d_;
}

template <Real Scalar>
Scalar SteadyState<Scalar>::center() const {
  const Scalar distance = -d_ * at_wall_ * height_;
  return is_up_ ? Scalar(bottom_ + distance) : Scalar(top_ - distance);
}

template <Real Scalar>
ColeHopfPoint<Scalar> SteadyState<Scalar>::at(const Scalar& z) const {
  const Scalar from_bottom = (z - bottom_) / height_, from_top = (top_ - z) / height_, unit = d_ * height_;
  if (!is_finite(at_wall_)) return {mean_, Scalar(1) - mean_, mean_ * (z - bottom_), Scalar(0)};
  const Scalar e = (is_up_ ? from_bottom : from_top) / d_ + at_wall_;
  ColeHopfPoint<Scalar> point;
  point.phi = logistic(e);
  point.complement = logistic(Scalar(-e));
  // The part of the bed below z lies between the two exponents.
  point.cumulative = unit * logistic_integral(Scalar(is_up_ ? -at_wall_ : -e), Scalar(from_bottom / d_));
  point.gradient = (is_up_ ? -point.phi : point.phi) * point.complement / unit;
  return point;
}

template class SteadyState<Instantiated>;

}  // namespace shearfront::diffusion
