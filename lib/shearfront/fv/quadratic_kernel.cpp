// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "shearfront/fv/kernel.hpp"

#if defined(__x86_64__)
#define SHEARFRONT_FV_X86 1
#else
#define SHEARFRONT_FV_X86 0
#endif

namespace shearfront::fv {
namespace {

constexpr double kRest = 1.5;  // |G| <= 1/2, so h is in [1, 2] where doubles are 2^-52 apart
constexpr double kQuantum = 0x1p-52;
constexpr double kCoefficientWeight = 0.5;

// The loops below are written with vectors of the compiler, not left to its loop vectoriser: GCC 12 turns the
// maxima into branches where there are no masked operations. They must be inlined into functions for one
// instruction set each; hence the attribute, and vectors that are local variables only.
#define SHEARFRONT_FV_INLINE inline __attribute__((always_inline))

template <int width>
struct Vectors {
  typedef double Type __attribute__((vector_size(8 * width)));
  typedef double InMemory __attribute__((vector_size(8 * width), aligned(8), may_alias));
};

/// One pass over the cells, in place: the cells of a vector are written when the fluxes on both sides are
/// known, and of the cells below only their uppermost flux is needed any more.
template <Scheme scheme, int width, std::size_t... lane>
SHEARFRONT_FV_INLINE double step(double* v, const double* c, double h_below, std::size_t n,
                                 std::index_sequence<lane...>) {
  using Vector = typename Vectors<width>::Type;
  using InMemory = typename Vectors<width>::InMemory;
  const Vector zero{};
  Vector last{};  // the fluxes of the vector below; only its uppermost counts
  last[width - 1] = h_below;
  for (std::size_t i = 0; i < n; i += width) {
    const Vector l = *reinterpret_cast<const InMemory*>(v + i);
    const Vector r = *reinterpret_cast<const InMemory*>(v + i + 1);
    const Vector c_above = *reinterpret_cast<const InMemory*>(c + i + 1);
    const Vector rising = l > zero ? l * l : zero, falling = r < zero ? r * r : zero;
    Vector h_above;
    if constexpr (scheme == Scheme::engquist_osher) {
      h_above = c_above * ((rising + falling) - 1.0) + kRest;
    } else {
      const Vector c_below = *reinterpret_cast<const InMemory*>(c + i);
      const Vector from_below = c_below * (rising - 1.0), from_above = c_above * (falling - 1.0);
      h_above = (from_below > from_above ? from_below : from_above) + kRest;
    }
    const Vector h = __builtin_shufflevector(last, h_above, (width - 1 + static_cast<int>(lane))...);
    last = h_above;
    *reinterpret_cast<InMemory*>(v + i) = l - (h_above - h);
  }
  return last[width - 1];
}

using Step = double (*)(double*, const double*, double, std::size_t);

#define SHEARFRONT_FV_STEP(name, scheme, width, target)                              \
  target double name(double* v, const double* c, double h_below, std::size_t n) {    \
    return step<scheme, width>(v, c, h_below, n, std::make_index_sequence<width>()); \
  }

SHEARFRONT_FV_STEP(engquist_osher_portable, Scheme::engquist_osher, 2, )
SHEARFRONT_FV_STEP(godunov_portable, Scheme::godunov, 2, )
#if SHEARFRONT_FV_X86
// No "fma": a contracted operation would round differently.
#define SHEARFRONT_FV_AVX2 __attribute__((target("avx2")))
#define SHEARFRONT_FV_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl")))
SHEARFRONT_FV_STEP(engquist_osher_avx2, Scheme::engquist_osher, 4, SHEARFRONT_FV_AVX2)
SHEARFRONT_FV_STEP(godunov_avx2, Scheme::godunov, 4, SHEARFRONT_FV_AVX2)
SHEARFRONT_FV_STEP(engquist_osher_avx512, Scheme::engquist_osher, 8, SHEARFRONT_FV_AVX512)
SHEARFRONT_FV_STEP(godunov_avx512, Scheme::godunov, 8, SHEARFRONT_FV_AVX512)
#endif

Step step_of(Scheme scheme, [[maybe_unused]] Simd simd) {
  const bool is_godunov = scheme == Scheme::godunov;
#if SHEARFRONT_FV_X86
  if (simd == Simd::avx512) return is_godunov ? godunov_avx512 : engquist_osher_avx512;
  if (simd == Simd::avx2) return is_godunov ? godunov_avx2 : engquist_osher_avx2;
#endif
  return is_godunov ? godunov_portable : engquist_osher_portable;
}

class QuadraticKernel final : public Kernel {
 public:
  QuadraticKernel(Scheme scheme, Simd simd) : step_(step_of(scheme, simd)) {}
  double step(double* v, const double* c, double h_below, std::size_t n) const override {
    return step_(v, c, h_below, n);
  }
  [[nodiscard]] KernelNumbers numbers() const override { return {kRest, kQuantum, kCoefficientWeight}; }

 private:
  Step step_;
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

std::unique_ptr<Kernel> quadratic_kernel(Scheme scheme, Simd simd) {
  return std::make_unique<QuadraticKernel>(scheme, simd);
}

}  // namespace shearfront::fv
