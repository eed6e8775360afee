// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// SHEARFRONT_FV_VECTORISED before a function with a plain loop over cells: GCC compiles it for three instruction
/// sets and picks one when the program starts. The same operations in the same order in all, so the results are
/// the same to the bit (no fused operations: -ffp-contract=off). Elsewhere, and under sanitizers, which
/// instrument the choice itself, it is compiled once.
///
/// What the loop calls must be inlined into it: SHEARFRONT_FV_INLINE.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__ELF__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SHEARFRONT_FV_VECTORISED __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define SHEARFRONT_FV_VECTORISED
#endif
#define SHEARFRONT_FV_INLINE inline __attribute__((always_inline))
