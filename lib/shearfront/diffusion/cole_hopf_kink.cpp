// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_kink.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/diffusion/logistic.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::diffusion {

template <Real Scalar>
Kink<Scalar>::Kink(Scalar bottom, Scalar rate, Scalar diffusivity, Scalar center, Scalar speed)
    : bottom_(std::move(bottom)),
      center_(std::move(center)),
      speed_(std::move(speed)),
      rate_(std::move(rate)),
      diffusivity_(std::move(diffusivity)),
      state_(Scalar(1) + speed_ / rate_),
      steepness_((rate_ + speed_) / diffusivity_),
      gap_(-speed_ / rate_) {}

template <Real Scalar>
ColeHopfPoint<Scalar> Kink<Scalar>::at(const Scalar& z, const Scalar& t) const {
  const Scalar front = center_ + speed_ * t, e = steepness_ * (z - front), share = logistic(e),
               rest = logistic(Scalar(-e));
  ColeHopfPoint<Scalar> point;
  point.phi = state_ * share;
  point.complement = gap_ + state_ * rest;
  point.cumulative =
      state_ / steepness_ *
      logistic_integral(Scalar(steepness_ * (front - bottom_)), Scalar(steepness_ * (z - bottom_)));
  point.gradient = -steepness_ * state_ * share * rest;
  return point;
}

template <Real Scalar>
Scalar Kink<Scalar>::end_effect(const Scalar& top, const Scalar& t) const {
  using std::exp;
  if (!(t > 0)) return Scalar(0);
  const Scalar front = center_ + speed_ * t;
  if (!is_finite(t) || front <= bottom_ || center_ >= top) return state_;
  const Scalar lasting = speed_ == 0 ? t : std::min(t, Scalar(Scalar(-1) / (steepness_ * speed_)));
  // What an end leaves in phi beside it, and moves the kink by, if its layer E lasts that long and its trace so long.
  const auto effect = [&](const Scalar& distance, const Scalar& trace) {
    const Scalar layer = state_ * exp(-(steepness_ * distance)), slope = steepness_ * layer;
    const Scalar left = layer + rate_ * slope * lasting;
    return left + steepness_ / Scalar(4) * (rate_ * left * trace + diffusivity_ * slope * lasting);
  };
  return std::min(state_, Scalar(effect(front - bottom_, lasting) + effect(top - center_, t)));
}

template class Kink<Instantiated>;

}  // namespace shearfront::diffusion
