// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {
namespace quadrature_detail {

template <Real Scalar, class Integrand>
Scalar halved(const Integrand& f, const Scalar& lo, const Scalar& hi, unsigned halvings,
              const Scalar& tolerance, const Scalar& enough) {
  using std::abs;
  const Scalar half = (hi - lo) / Scalar(2), middle = lo + half;
  Scalar error(0);
  const Scalar rule = boost::math::quadrature::gauss_kronrod<Scalar, 15>::integrate(
      [&](const Scalar& x) { return Scalar(f(Scalar(middle + half * x))); }, Scalar(-1), Scalar(1), 0U,
      Scalar(0), &error);
  const Scalar value = half * rule, own = tolerance * Scalar(abs(value));
  const Scalar wanted = enough < 0 ? own : enough;
  if (halvings == 0 || !(half * error > std::max(own, wanted))) return value;
  const Scalar part = wanted / Scalar(2);
  return halved<Scalar>(f, lo, middle, halvings - 1, tolerance, part) +
         halved<Scalar>(f, middle, hi, halvings - 1, tolerance, part);
}

}  // namespace quadrature_detail

/// int_lo^hi f dz of what is smooth between lo < hi, by the Gauss-Kronrod rule of 15 points: halved until the difference of its
/// two rules is below `tolerance` times the integral, at most so many times. Cost: 15 values of f, as many again for each half.
///
/// The rule is Boost's on (-1, 1). Its own halving (1.74, Debian 12) holds the error on (-1, 1) against a tolerance for (lo, hi): a
/// narrow interval, or a bed in other units, is never good enough, and costs 2^halvings rules.
template <Real Scalar, class Integrand>
[[nodiscard]] Scalar integral_of_smooth(const Integrand& f, const Scalar& lo, const Scalar& hi,
                                        unsigned halvings, const Scalar& tolerance) {
  return quadrature_detail::halved<Scalar>(f, lo, hi, halvings, tolerance, Scalar(-1));
}

}  // namespace shearfront
