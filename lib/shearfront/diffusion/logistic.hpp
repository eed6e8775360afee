// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::diffusion {

/// 1 / (1 + exp(e)), without overflow; relatively exact to (3 + |e|) roundoffs of e.
template <Real S>
[[nodiscard]] S logistic(const S& e) {
  using std::exp;
  if (e > 0) {
    const S small = exp(S(-e));
    return small / (S(1) + small);
  }
  return S(1) / (S(1) + exp(e));
}

/// ln((1 + exp(p)) / (1 + exp(p - step))), the integral of 1 / (1 + exp(-e)) from p - step to p; negative for
/// negative steps. Relatively exact to (4 + |p|) roundoffs for every finite argument: neither exponential
/// overflows and short steps do not cancel. The caller gives p and the step because p - (p - step) loses it.
template <Real S>
[[nodiscard]] S logistic_integral(const S& p, const S& step) {
  using std::exp, std::expm1, std::log1p;
  if (step < 0) return -logistic_integral(S(p - step), S(-step));
  const S q = p - step;
  if (step < 1) return log1p(S(expm1(step) * logistic(S(-q))));
  if (q > 0) return step + log1p(exp(S(-p))) - log1p(exp(S(-q)));
  if (p > 0) return p + log1p(exp(S(-p))) - log1p(exp(q));
  return log1p(exp(p)) - log1p(exp(q));
}

}  // namespace shearfront::diffusion
