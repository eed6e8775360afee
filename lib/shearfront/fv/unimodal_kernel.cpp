// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/muscl_pass.hpp"

namespace shearfront::fv {
namespace {

/// What MusclPass needs to know, by calls of the flux, lane by lane.
class UnimodalRule {
 public:
  using Vector = Vectors<2>::Type;
  // |f| <= largest_slope (hi - lo) / 2 gives |G| <= 1, so h is in [2, 4] where doubles are 2^-51 apart.
  static constexpr double kRest = 3, kQuantum = 0x1p-51;

  explicit UnimodalRule(UnimodalFlux flux) : flux_(std::move(flux)) {}

  void flux(Vector& g, const Vector& top, const Vector& minus_bottom, const Vector& c) const {
    flux_at_jump(g, top, minus_bottom, c, c);
  }
  void flux_at_jump(Vector& g, const Vector& top, const Vector& minus_bottom, const Vector& c_below,
                    const Vector& c_above) const {
    for (int lane = 0; lane < 2; ++lane)
      g[lane] = godunov(rising(top[lane]), falling(-minus_bottom[lane]), c_below[lane], c_above[lane]);
  }
  /// By bisection between the extremum and the pure state.
  [[nodiscard]] double mapped(double v, double ratio) const {
    const double wanted = ratio * value(v), extremum = state(flux_.extremum);
    double far = v > extremum ? 1 : -1, near = extremum;
    constexpr int kHalvings = 60;  // beyond the digits of a double
    for (int i = 0; i < kHalvings; ++i) {
      const double x = near + (far - near) / 2;
      (std::abs(value(x)) > std::abs(wanted) ? near : far) = x;
    }
    return far;
  }

  /// f' up to a factor.
  [[nodiscard]] double slope(double v) const { return flux_.derivative(phi(v)); }

  [[nodiscard]] double rising(double v) const {
    const double m = flux_.extremum, l = phi(v);
    return flux_.value(flux_.is_minimum == (l > m) ? l : m);
  }
  [[nodiscard]] double falling(double v) const {
    const double m = flux_.extremum, r = phi(v);
    return flux_.value(flux_.is_minimum == (r < m) ? r : m);
  }
  [[nodiscard]] double godunov(double rising, double falling, double c_below, double c_above) const {
    const double below = c_below * rising, above = c_above * falling;
    return flux_.is_minimum == (below > above) ? below : above;
  }
  [[nodiscard]] double coefficient_weight() const {
    return 2 / ((flux_.hi - flux_.lo) * flux_.largest_slope);
  }

 private:
  [[nodiscard]] double phi(double v) const { return flux_.lo + (flux_.hi - flux_.lo) * ((v + 1) / 2); }
  [[nodiscard]] double state(double phi) const { return 2 * (phi - flux_.lo) / (flux_.hi - flux_.lo) - 1; }
  [[nodiscard]] double value(double v) const { return flux_.value(phi(v)); }

  UnimodalFlux flux_;
};

class UnimodalKernel final : public Kernel {
 public:
  UnimodalKernel(Scheme scheme, const UnimodalFlux& flux)
      : scheme_(scheme), rule_(flux), at_extremum_(flux.value(flux.extremum)) {}

  FaceBelow step(double* v, const Faces& faces, const FaceBelow& below, std::size_t n) const override {
    double h_below = below.h;
    for (std::size_t i = 0; i < n; ++i) {
      const auto face = static_cast<std::ptrdiff_t>(i + 1);
      const double rising = rule_.rising(v[i]), falling = rule_.falling(v[i + 1]);
      const double g =
          scheme_ == Scheme::engquist_osher
              ? faces.above[face] * (rising + (falling - at_extremum_))
              : rule_.godunov(rising, falling, faces.below[face], coefficient_above(faces, face));
      constexpr double kRest = UnimodalRule::kRest;
      FaceFlux h{kRest + g, kRest + g};
      if (faces.ratio != nullptr)
        h = step_flux(faces, face, g, v[i], v[i + 1], kRest, UnimodalRule::kQuantum);
      v[i] -= h.below - h_below;
      if (faces.ratio != nullptr) hold_back_excess(faces, face - 1, v + i, 1);
      // A model's rounding near the ends of its range is unknown here: keep the bounds by force.
      v[i] = std::clamp(v[i], -1.0, 1.0);
      h_below = h.above;
    }
    return {h_below, 0, 0, 0};
  }
  void half_rises(const double*, const Faces&, double* rises, std::size_t n) const override {
    std::fill_n(rises, n, 0.0);
  }
  [[nodiscard]] KernelNumbers numbers() const override {
    return {UnimodalRule::kRest, UnimodalRule::kQuantum, 1, rule_.coefficient_weight(), false};
  }

 private:
  Scheme scheme_;
  UnimodalRule rule_;
  double at_extremum_;
};

template <Limiter limiter>
class UnimodalMusclKernel final : public Kernel {
 public:
  template <bool has_ratio>
  using Pass = MusclPass<UnimodalRule, limiter, has_ratio, 2>;

  explicit UnimodalMusclKernel(const UnimodalFlux& flux) : rule_(flux) {}

  FaceBelow step(double* v, const Faces& faces, const FaceBelow& below, std::size_t n) const override {
    const FaceBelow above = faces.ratio != nullptr ? Pass<true>(rule_, v, faces).advance(below, n)
                                                   : Pass<false>(rule_, v, faces).advance(below, n);
    for (std::size_t i = 0; i < n; ++i) v[i] = std::clamp(v[i], -1.0, 1.0);
    return above;
  }
  void half_rises(const double* v, const Faces& faces, double* rises, std::size_t n) const override {
    Pass<true>::half_rises(rule_, v, faces, rises, n);
  }
  [[nodiscard]] KernelNumbers numbers() const override {
    return {UnimodalRule::kRest, UnimodalRule::kQuantum, 0.5, rule_.coefficient_weight(), true};
  }

 private:
  UnimodalRule rule_;
};

}  // namespace

std::unique_ptr<Kernel> unimodal_kernel(Scheme scheme, const UnimodalFlux& flux, Limiter limiter) {
  if (scheme != Scheme::muscl) return std::make_unique<UnimodalKernel>(scheme, flux);
  if (limiter == Limiter::minmod) return std::make_unique<UnimodalMusclKernel<Limiter::minmod>>(flux);
  if (limiter == Limiter::mc) return std::make_unique<UnimodalMusclKernel<Limiter::mc>>(flux);
  return std::make_unique<UnimodalMusclKernel<Limiter::van_leer>>(flux);
}

}  // namespace shearfront::fv
