// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/diffusion/cole_hopf_point.hpp"

namespace shearfront::diffusion {

template <Real Scalar>
class UniformStart {
 public:
  UniformStart(Scalar bottom, Scalar top, Scalar rate, Scalar diffusivity, Scalar initial);

  [[nodiscard]] ColeHopfPoint<Scalar> at(const Scalar& z, const Scalar& t) const;

 private:
  enum class Wall { bottom, top };
  struct Sums;
  struct Image;
  [[nodiscard]] Sums images(const Scalar& x, const Scalar& y, const Scalar& t) const;
  [[nodiscard]] Sums series(const Scalar& x, const Scalar& y, const Scalar& t) const;
  [[nodiscard]] bool series_is_safe(const Scalar& t) const;
  void add_free(Sums& sums, const Scalar& x, const Scalar& y, const Scalar& t) const;
  bool add_image(Sums& sums, const Image& image, const Scalar& t) const;
  /// How far below the largest exponent a term is dropped: e^-30 roundoffs.
  [[nodiscard]] static Scalar depth();

  Scalar bottom_, top_, height_, rate_, diffusivity_, initial_;
  Scalar d_, phi0_, u0_, spread_;  ///< D / (|r| height); 2 phi0 - 1; phi0 (1 - phi0)
};

extern template class UniformStart<double>;
extern template class UniformStart<Real50>;
extern template class UniformStart<Real110>;

}  // namespace shearfront::diffusion
