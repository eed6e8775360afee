// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/lanes.hpp"
#include "shearfront/fv/special_faces.hpp"

namespace shearfront::fv {
namespace {

constexpr double kRest = 1.5;  // |G| <= 1/2, so h is in [1, 2] where doubles are 2^-52 apart
constexpr double kQuantum = 0x1p-52;
constexpr double kCoefficientWeight = 0.5;

/// One pass over the cells, in place: the cells of a vector are written when the fluxes on both sides are
/// known, and of the cells below only their uppermost flux is needed any more.
template <Scheme scheme, bool has_ratio, int width>
SHEARFRONT_FV_INLINE double step(double* v, const Faces& faces, double h_below, std::size_t n) {
  using L = Lanes<width>;
  using Vector = typename L::Vector;
  const Vector zero{};
  Vector last{};  // the fluxes of the vector below; only its uppermost counts
  last[width - 1] = h_below;
  for (std::size_t i = 0; i < n; i += width) {
    const bool is_special = (has_ratio || scheme == Scheme::godunov) && faces.is_special[i / kLanes] != 0;
    Vector l, r, c, g, h;
    L::load(l, v + i);
    L::load(r, v + i + 1);
    L::load(c, faces.above + i + 1);
    if constexpr (scheme == Scheme::engquist_osher) {
      const Vector rising = l > zero ? l * l : zero, falling = r < zero ? r * r : zero;
      g = c * ((rising + falling) - 1.0);
    } else if (!is_special) [[likely]] {
      // Roundings are monotone: this is the maximum of both sides to the bit.
      const Vector most = l > -r ? l : -r, size = most > zero ? most : zero;
      g = c * (size * size - 1.0);
    } else {
      Vector c_below;
      L::load(c_below, faces.below + i + 1);
      if constexpr (has_ratio)
        for (int lane = 0; lane < width; ++lane)
          c[lane] = coefficient_above(faces, static_cast<std::ptrdiff_t>(i) + 1 + lane);
      const Vector rising = l > zero ? l * l : zero, falling = r < zero ? r * r : zero;
      const Vector from_below = c_below * (rising - 1.0), from_above = c * (falling - 1.0);
      g = from_below > from_above ? from_below : from_above;
    }
    Vector h_above = g + kRest, up = h_above;  // in the units of the cells above
    if (has_ratio && is_special) [[unlikely]] {
      double below[width], above[width];
      for (int lane = 0; lane < width; ++lane) {
        const FaceFlux flux = step_flux(faces, static_cast<std::ptrdiff_t>(i) + 1 + lane, g[lane], l[lane],
                                        r[lane], kRest, kQuantum);
        below[lane] = flux.below;
        above[lane] = flux.above;
      }
      L::load(h_above, below);
      L::load(up, above);
    }
    L::lower(h, last, up);
    last = up;
    L::store(v + i, l - (h_above - h));
    if (has_ratio && is_special) [[unlikely]]
      hold_back_excess(faces, static_cast<std::ptrdiff_t>(i), v + i, width);
  }
  return last[width - 1];
}

using Step = double (*)(double*, const Faces&, double, std::size_t);

#define SHEARFRONT_FV_STEP(name, scheme, width, target)                              \
  template <bool has_ratio>                                                          \
  target double name(double* v, const Faces& faces, double h_below, std::size_t n) { \
    return step<scheme, has_ratio, width>(v, faces, h_below, n);                     \
  }

SHEARFRONT_FV_STEP(engquist_osher_portable, Scheme::engquist_osher, 2, )
SHEARFRONT_FV_STEP(godunov_portable, Scheme::godunov, 2, )
#if SHEARFRONT_FV_X86
SHEARFRONT_FV_STEP(engquist_osher_avx2, Scheme::engquist_osher, 4, SHEARFRONT_FV_AVX2)
SHEARFRONT_FV_STEP(godunov_avx2, Scheme::godunov, 4, SHEARFRONT_FV_AVX2)
SHEARFRONT_FV_STEP(engquist_osher_avx512, Scheme::engquist_osher, 8, SHEARFRONT_FV_AVX512)
SHEARFRONT_FV_STEP(godunov_avx512, Scheme::godunov, 8, SHEARFRONT_FV_AVX512)
#endif

template <bool has_ratio>
Step step_of(Scheme scheme, [[maybe_unused]] Simd simd) {
  const bool is_godunov = scheme == Scheme::godunov;
#if SHEARFRONT_FV_X86
  if (simd == Simd::avx512) return is_godunov ? godunov_avx512<has_ratio> : engquist_osher_avx512<has_ratio>;
  if (simd == Simd::avx2) return is_godunov ? godunov_avx2<has_ratio> : engquist_osher_avx2<has_ratio>;
#endif
  return is_godunov ? godunov_portable<has_ratio> : engquist_osher_portable<has_ratio>;
}

class QuadraticKernel final : public Kernel {
 public:
  QuadraticKernel(Scheme scheme, Simd simd)
      : step_(step_of<false>(scheme, simd)), step_with_ratio_(step_of<true>(scheme, simd)) {}
  FaceBelow step(double* v, const Faces& faces, const FaceBelow& below, std::size_t n) const override {
    const Step chosen = faces.ratio != nullptr ? step_with_ratio_ : step_;
    return {chosen(v, faces, below.h, n), 0, 0, 0};
  }
  void half_rises(const double*, const Faces&, double* rises, std::size_t n) const override {
    std::fill_n(rises, n, 0.0);
  }
  [[nodiscard]] KernelNumbers numbers() const override {
    return {kRest, kQuantum, 1, kCoefficientWeight, false, true};
  }

 private:
  Step step_, step_with_ratio_;
};

}  // namespace

Simd widest_simd() {
#if SHEARFRONT_FV_X86
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return Simd::avx512;
  if (__builtin_cpu_supports("avx2")) return Simd::avx2;
#endif
  return Simd::portable;
}

std::unique_ptr<Kernel> quadratic_kernel(Scheme scheme, Limiter limiter, Simd simd) {
  if (scheme == Scheme::muscl) return quadratic_muscl_kernel(limiter, simd);
  return std::make_unique<QuadraticKernel>(scheme, simd);
}

}  // namespace shearfront::fv
