// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/kernel.hpp"

#if defined(__x86_64__)
#define SHEARFRONT_FV_X86 1
#endif

namespace shearfront::fv {
namespace {

constexpr double kRest = 1.5;  // |G| <= 1/2, so h is in [1, 2] where doubles are 2^-52 apart
constexpr double kQuantum = 0x1p-52;
constexpr double kCoefficientWeight = 0.5;

#define SHEARFRONT_FV_INLINE inline __attribute__((always_inline))

// "a > b ? a : b" is the one form of a maximum that both compilers turn into one instruction.
SHEARFRONT_FV_INLINE double rising(double v) { return v > 0.0 ? v : 0.0; }
SHEARFRONT_FV_INLINE double falling(double v) { return v < 0.0 ? v : 0.0; }

SHEARFRONT_FV_INLINE void update(double* __restrict v, const double* __restrict h, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) v[i] -= h[i + 1] - h[i];
}

SHEARFRONT_FV_INLINE void engquist_osher(double* __restrict v, const double* __restrict c,
                                         double* __restrict h, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const double p = rising(v[i]), m = falling(v[i + 1]);
    h[i + 1] = c[i + 1] * ((p * p + m * m) - 1.0) + kRest;
  }
  update(v, h, n);
}

SHEARFRONT_FV_INLINE void godunov(double* __restrict v, const double* __restrict c, double* __restrict h,
                                  std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const double p = rising(v[i]), m = falling(v[i + 1]);
    const double below = c[i] * (p * p - 1.0), above = c[i + 1] * (m * m - 1.0);
    h[i + 1] = (below > above ? below : above) + kRest;
  }
  update(v, h, n);
}

using Step = void (*)(double*, const double*, double*, std::size_t);

#define SHEARFRONT_FV_STEPS(isa, target)                                                   \
  target void engquist_osher_##isa(double* v, const double* c, double* h, std::size_t n) { \
    engquist_osher(v, c, h, n / kLanes * kLanes);                                          \
  }                                                                                        \
  target void godunov_##isa(double* v, const double* c, double* h, std::size_t n) {        \
    godunov(v, c, h, n / kLanes * kLanes);                                                 \
  }

SHEARFRONT_FV_STEPS(portable, )
#if SHEARFRONT_FV_X86
// No "fma": a contracted operation would round differently.
SHEARFRONT_FV_STEPS(avx2, __attribute__((target("avx2"))))
SHEARFRONT_FV_STEPS(avx512, __attribute__((target("avx512f,avx512dq,avx512vl"))))
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
  void step(double* v, const double* c, double* h, std::size_t n) const override { step_(v, c, h, n); }
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
