// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>

#include "shearfront/fv/muscl_pass.hpp"

namespace shearfront::fv {
namespace {

/// G = c (max(v_l, 0)^2 - 1) and so on, see quadratic_kernel().
template <int width>
struct QuadraticRule {
  using Vector = typename Vectors<width>::Type;
  // |G| <= 1/4, so h is in [1, 2] where doubles are 2^-52 apart
  static constexpr double kRest = 1.5, kQuantum = 0x1p-52;

  SHEARFRONT_FV_INLINE static void flux(Vector& g, const Vector& top, const Vector& minus_bottom,
                                        const Vector& c) {
    const Vector zero{};
    const Vector most = top > minus_bottom ? top : minus_bottom, size = most > zero ? most : zero;
    g = c * (size * size - 1.0);
  }
  SHEARFRONT_FV_INLINE static void flux_at_jump(Vector& g, const Vector& top, const Vector& minus_bottom,
                                                const Vector& c_below, const Vector& c_above) {
    const Vector zero{};
    const Vector rising = top > zero ? top : zero, falling = minus_bottom > zero ? minus_bottom : zero;
    const Vector from_below = c_below * (rising * rising - 1.0);
    const Vector from_above = c_above * (falling * falling - 1.0);
    g = from_below > from_above ? from_below : from_above;
  }
  static double mapped(double v, double ratio) {
    return std::copysign(std::sqrt(std::max(0.0, 1 - ratio * ((1 - v) * (1 + v)))), v);
  }
  static double slope(double v) { return v; }
};

using Step = FaceBelow (*)(double*, const Faces&, const FaceBelow&, std::size_t);

#define SHEARFRONT_FV_MUSCL(name, width, target)                                                         \
  template <Limiter limiter, bool has_ratio>                                                             \
  target FaceBelow name(double* v, const Faces& faces, const FaceBelow& below, std::size_t n) {          \
    const QuadraticRule<width> rule;                                                                     \
    return MusclPass<QuadraticRule<width>, limiter, has_ratio, width>(rule, v, faces).advance(below, n); \
  }

SHEARFRONT_FV_MUSCL(portable, 2, )
#if SHEARFRONT_FV_X86
SHEARFRONT_FV_MUSCL(avx2, 4, SHEARFRONT_FV_AVX2)
SHEARFRONT_FV_MUSCL(avx512, 8, SHEARFRONT_FV_AVX512)
#endif

template <Limiter limiter, bool has_ratio>
Step step_of([[maybe_unused]] Simd simd) {
#if SHEARFRONT_FV_X86
  if (simd == Simd::avx512) return avx512<limiter, has_ratio>;
  if (simd == Simd::avx2) return avx2<limiter, has_ratio>;
#endif
  return portable<limiter, has_ratio>;
}

template <Limiter limiter>
class QuadraticMusclKernel final : public Kernel {
 public:
  explicit QuadraticMusclKernel(Simd simd)
      : step_(step_of<limiter, false>(simd)), step_with_ratio_(step_of<limiter, true>(simd)) {}
  FaceBelow step(double* v, const Faces& faces, const FaceBelow& below, std::size_t n) const override {
    return (faces.ratio != nullptr ? step_with_ratio_ : step_)(v, faces, below, n);
  }
  void half_rises(const double* v, const Faces& faces, double* rises, std::size_t n) const override {
    const QuadraticRule<2> rule;
    MusclPass<QuadraticRule<2>, limiter, true, 2>::half_rises(rule, v, faces, rises, n);
  }
  [[nodiscard]] KernelNumbers numbers() const override {
    return {QuadraticRule<2>::kRest, QuadraticRule<2>::kQuantum, 0.5, 0.5, true, true};
  }

 private:
  Step step_, step_with_ratio_;
};

}  // namespace

std::unique_ptr<Kernel> quadratic_muscl_kernel(Limiter limiter, Simd simd) {
  if (limiter == Limiter::minmod) return std::make_unique<QuadraticMusclKernel<Limiter::minmod>>(simd);
  if (limiter == Limiter::mc) return std::make_unique<QuadraticMusclKernel<Limiter::mc>>(simd);
  return std::make_unique<QuadraticMusclKernel<Limiter::van_leer>>(simd);
}

}  // namespace shearfront::fv
