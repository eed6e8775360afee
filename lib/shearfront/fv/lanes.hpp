// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <utility>

#if defined(__x86_64__)
#define SHEARFRONT_FV_X86 1
// No "fma": a contracted operation would round differently.
#define SHEARFRONT_FV_AVX2 __attribute__((target("avx2")))
#define SHEARFRONT_FV_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl")))
#else
#define SHEARFRONT_FV_X86 0
#endif

// The loops of the kernels are written with vectors of the compiler, not left to its loop vectoriser: GCC 12
// turns the maxima into branches where there are no masked operations. They must be inlined into functions
// for one instruction set each; hence the attribute, and vectors that are local variables only.
#define SHEARFRONT_FV_INLINE inline __attribute__((always_inline))

namespace shearfront::fv {

/// `width` doubles in one register, and the same in memory at any address.
template <int width>
struct Vectors {
  typedef double Type __attribute__((vector_size(8 * width)));
  typedef double InMemory __attribute__((vector_size(8 * width), aligned(8), may_alias));
};

/// Operations on the lanes of `width` neighbouring cells or faces.
template <int width>
struct Lanes {
  using Vector = typename Vectors<width>::Type;
  using InMemory = typename Vectors<width>::InMemory;

  SHEARFRONT_FV_INLINE static void load(Vector& x, const double* from) {
    x = *reinterpret_cast<const InMemory*>(from);
  }
  SHEARFRONT_FV_INLINE static void store(double* to, const Vector& x) {
    *reinterpret_cast<InMemory*>(to) = x;
  }
  /// The lanes one cell lower: the last of `below`, then all of `here` but its last.
  SHEARFRONT_FV_INLINE static void lower(Vector& x, const Vector& below, const Vector& here) {
    lower(x, below, here, std::make_integer_sequence<int, width>());
  }
  /// The lanes one cell higher: all of `here` but its first, then the first of `above`.
  SHEARFRONT_FV_INLINE static void higher(Vector& x, const Vector& here, const Vector& above) {
    higher(x, here, above, std::make_integer_sequence<int, width>());
  }

 private:
  template <int... lane>
  SHEARFRONT_FV_INLINE static void lower(Vector& x, const Vector& below, const Vector& here,
                                         std::integer_sequence<int, lane...>) {
    x = __builtin_shufflevector(below, here, (width - 1 + lane)...);
  }
  template <int... lane>
  SHEARFRONT_FV_INLINE static void higher(Vector& x, const Vector& here, const Vector& above,
                                          std::integer_sequence<int, lane...>) {
    x = __builtin_shufflevector(here, above, (1 + lane)...);
  }
};

}  // namespace shearfront::fv
