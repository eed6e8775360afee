// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/muscl.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fv/vectorised.hpp"

namespace shearfront::fv {
namespace {

SHEARFRONT_FV_INLINE double least(double a, double b) { return a < b ? a : b; }
SHEARFRONT_FV_INLINE double most(double a, double b) { return a > b ? a : b; }

/// `below`, `above`: the differences to the cells below and above, upwards.
template <Limiter limiter>
SHEARFRONT_FV_INLINE double half_rise(double below, double above) {
  const double up = most(least(below, above), 0), down = least(most(below, above), 0);  // one of them is 0
  if constexpr (limiter == Limiter::minmod) return 0.5 * (up + down);
  if constexpr (limiter == Limiter::mc) {
    const double mean = 0.25 * (below + above);
    return most(least(up, mean), 0) + least(most(down, mean), 0);
  }
  // below above / (below + above), in an order that cannot exceed the smaller one by rounding.
  const double smaller = up + down, larger = below + above - smaller;
  return smaller * (larger / (smaller + larger + (smaller < 0 ? -0x1p-200 : 0x1p-200)));
}

template <Limiter limiter>
SHEARFRONT_FV_INLINE void all_half_rises(const double* __restrict v, double* __restrict rises,
                                         std::size_t n) {
  const double* below = v - 1;
  for (std::size_t j = 0; j < n; ++j) rises[j] = half_rise<limiter>(v[j] - below[j], v[j + 1] - v[j]);
}

SHEARFRONT_FV_VECTORISED
void minmod_half_rises(const double* v, double* rises, std::size_t n) {
  all_half_rises<Limiter::minmod>(v, rises, n);
}
SHEARFRONT_FV_VECTORISED
void mc_half_rises(const double* v, double* rises, std::size_t n) {
  all_half_rises<Limiter::mc>(v, rises, n);
}
SHEARFRONT_FV_VECTORISED
void van_leer_half_rises(const double* v, double* rises, std::size_t n) {
  all_half_rises<Limiter::van_leer>(v, rises, n);
}

double half_rise(Limiter limiter, double below, double above) {
  if (limiter == Limiter::minmod) return half_rise<Limiter::minmod>(below, above);
  if (limiter == Limiter::mc) return half_rise<Limiter::mc>(below, above);
  return half_rise<Limiter::van_leer>(below, above);
}

/// The state with flux ratio f(v), on the branch of v; the extremum if there is none.
double mapped(const FluxShape& flux, double v, double ratio) {
  if (flux.is_parabola) return std::copysign(std::sqrt(std::max(0.0, 1 - ratio * (1 - v * v))), v);
  const double wanted = ratio * std::abs(flux.value(flux.share(v))), extremum = flux.state(flux.extremum());
  double far = v > extremum ? 1 : -1, near = extremum;
  constexpr int kHalvings = 60;  // beyond the digits of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double x = near + (far - near) / 2;
    (std::abs(flux.value(flux.share(x))) > wanted ? near : far) = x;
  }
  return far;
}

/// State v of a layer with rate `other` as one with rate `own` sees it.
struct Seen {
  double v, stretch;
};
Seen seen(const FluxShape& flux, double v, double other, double own) {
  if (own == other) return {v, 1};
  const double image = mapped(flux, v, other / own);
  const double speed = std::abs(other * flux.derivative(flux.share(v)));
  const double own_speed = std::abs(own * flux.derivative(flux.share(image)));
  return {image, speed + own_speed > 0 ? 2 * speed / (speed + own_speed) : 1};
}

}  // namespace

Muscl::Muscl(Limiter limiter, std::vector<double> rates) : limiter_(limiter), rates_(std::move(rates)) {
  const std::size_t n = rates_.size();
  for (std::size_t j = 0; j < n; ++j)
    if ((j > 0 && rates_[j - 1] != rates_[j]) || (j + 1 < n && rates_[j + 1] != rates_[j]))
      jumps_.push_back(j);
}

void Muscl::half_rises(const FluxShape& flux, const double* v, double* rises, std::size_t n) const {
  if (limiter_ == Limiter::minmod) minmod_half_rises(v, rises, n);
  if (limiter_ == Limiter::mc) mc_half_rises(v, rises, n);
  if (limiter_ == Limiter::van_leer) van_leer_half_rises(v, rises, n);
  for (const std::size_t j : jumps_) rises[j] = half_rise_at_jump(flux, v, j);
}

double Muscl::half_rise_at_jump(const FluxShape& flux, const double* v, std::size_t j) const {
  const double own = rates_[j];
  const double* below = v - 1;
  const Seen lower = seen(flux, below[j], j > 0 ? rates_[j - 1] : own, own);
  const Seen upper = seen(flux, v[j + 1], j + 1 < rates_.size() ? rates_[j + 1] : own, own);
  const double low = v[j] - lower.v, high = upper.v - v[j];
  const double bound = std::min(std::abs(low), std::abs(high));
  return std::clamp(half_rise(limiter_, low * lower.stretch, high * upper.stretch), -bound, bound);
}

}  // namespace shearfront::fv
