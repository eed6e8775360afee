// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "shearfront/fv/kernel.hpp"

namespace shearfront::fv {
namespace {

// |f| <= largest_slope (hi - lo) / 2 gives |G| <= 1, so h is in [2, 4] where doubles are 2^-51 apart.
constexpr double kRest = 3;
constexpr double kQuantum = 0x1p-51;

class UnimodalKernel final : public Kernel {
 public:
  UnimodalKernel(Scheme scheme, UnimodalFlux flux)
      : scheme_(scheme), flux_(std::move(flux)), at_extremum_(flux_.value(flux_.extremum)) {}

  double step(double* v, const double* c, double h_below, std::size_t n) const override {
    for (std::size_t i = 0; i < n; ++i) {
      const double l = phi(v[i]), r = phi(v[i + 1]);
      const double m = flux_.extremum;
      const double rising = flux_.value(flux_.is_minimum == (l > m) ? l : m);
      const double falling = flux_.value(flux_.is_minimum == (r < m) ? r : m);
      const double h_above = kRest + face(rising, falling, c[i], c[i + 1]);
      // A model's rounding near the ends of its range is unknown here: keep the bounds by force.
      v[i] = std::clamp(v[i] - (h_above - h_below), -1.0, 1.0);
      h_below = h_above;
    }
    return h_below;
  }
  [[nodiscard]] KernelNumbers numbers() const override {
    return {kRest, kQuantum, 2 / ((flux_.hi - flux_.lo) * flux_.largest_slope)};
  }

 private:
  [[nodiscard]] double phi(double v) const { return flux_.lo + (flux_.hi - flux_.lo) * ((v + 1) / 2); }
  [[nodiscard]] double face(double rising, double falling, double c_below, double c_above) const {
    if (scheme_ == Scheme::engquist_osher) return c_above * (rising + (falling - at_extremum_));
    const double below = c_below * rising, above = c_above * falling;
    return flux_.is_minimum == (below > above) ? below : above;
  }

  Scheme scheme_;
  UnimodalFlux flux_;
  double at_extremum_;
};

}  // namespace

std::unique_ptr<Kernel> unimodal_kernel(Scheme scheme, const UnimodalFlux& flux) {
  return std::make_unique<UnimodalKernel>(scheme, flux);
}

}  // namespace shearfront::fv
