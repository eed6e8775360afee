// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_kink.hpp"

#include <utility>

#include "shearfront/diffusion/logistic.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::diffusion {

template <Real Scalar>
Kink<Scalar>::Kink(Scalar bottom, Scalar rate, Scalar diffusivity, Scalar center, Scalar speed)
    : bottom_(std::move(bottom)),
      center_(std::move(center)),
      speed_(std::move(speed)),
      state_(Scalar(1) + speed_ / rate),
      steepness_((rate + speed_) / diffusivity),
      gap_(-speed_ / rate) {}

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

template class Kink<Instantiated>;

}  // namespace shearfront::diffusion
