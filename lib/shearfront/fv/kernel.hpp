// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>

#include "shearfront/fv/unimodal_flux.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// Numerical flux at a face between l (below) and r (above), for f with one minimum, at m (for a maximum
/// exchange min and max):
///
///   engquist_osher  F = s a_face ( f(max(l, m)) + f(min(r, m)) - f(m) ),  one coefficient per face
///   godunov         F = max( s a_l f(max(l, m)), s a_r f(min(r, m)) ),    one coefficient per cell
///
/// Both are non-decreasing in l and non-increasing in r, so a step with s max a |f'| dt / dz <= 1 is a
/// monotone scheme: bounded, order-preserving, L1-contractive; and both vanish between equal pure states.
/// Godunov's is the exact flux of the Riemann problem of the two cells. Engquist-Osher takes one coefficient
/// for all three terms, also where a jumps: any value between the two sides will do, the cells next to the
/// jump adapt (the errors of Example 1 are the same to 0.1 % for either side's, their mean and their harmonic
/// mean). With each side's own coefficient in its term nothing can stand for f(m): to vanish, the flux
/// between (0 | 0) needs a_l f(m), that between (1 | 1) needs a_r f(m). Errors grow by half or double;
/// without any f(m) the scheme does not converge. Sources: Engquist & Osher (1981), Math. Comp. 36; Towers
/// (2000), SIAM J. Numer. Anal. 38 (coefficients staggered against states); Adimurthi, Jaffre & Veerappa
/// Gowda (2004), SIAM J. Numer. Anal. 42 (Godunov).
enum class Scheme { engquist_osher, godunov, muscl };

/// Constants of the numbers a kernel computes with; see Kernel.
struct KernelNumbers {
  double rest;                 ///< h of a face without flux
  double quantum;              ///< states v are multiples of it
  double largest_courant;      ///< the bounds of phi are proved up to this s a largest_slope dt / dz
  double coefficient_weight;   ///< coefficient = Courant number times this
  bool has_slopes;             ///< v is linear in a cell, not constant
  bool is_for_minima = false;  ///< f has a minimum; of one with a maximum v counts downwards
};

/// Cells are handled in groups of so many.
inline constexpr std::size_t kLanes = 8;
inline constexpr std::size_t kReadAhead = 4 * kLanes;

/// Of the two cells at a face, the one with the shorter time step, if they belong to different sections.
enum class FasterSide : unsigned char { none, below, above };

/// Coefficients of the faces; face i lies between the cells i - 1 and i. Where a is continuous both sides
/// have the same. A face with 0 on one side carries no flux: the walls.
///
/// A flux is counted in changes of v of the cell below the face. For cells of another width or with another
/// time step above, the change there is `ratio` times as large; what its rounding leaves waits in
/// `remainder` for the next step. Coefficients of cells (below + 1 == above) are in the units of their cell,
/// those of faces in units of the cell below.
struct Faces {
  const double* below;              ///< below[i]: coefficient of face i on its lower side
  const double* above;              ///< on its upper side
  const unsigned char* is_special;  ///< whether sides differ, or ratio != 1, at a face 8 i ... 8 i + 8
  const double* ratio = nullptr;    ///< none: 1 everywhere, and none of the following
  double* remainder = nullptr;
  const FasterSide* faster_side = nullptr;
  double* carry = nullptr;  ///< between sections: flux that is less than a quantum of the faster cell
};

/// What a step leaves at a face for the cells above it: the cell below has gone on to the next step.
struct FaceBelow {
  double h;        ///< flux of the step
  double h_stage;  ///< muscl: of its first stage
  double v;        ///< muscl: the cell below at the beginning of the step
  double w;        ///< muscl: and after the first stage
};

/// One explicit step on a run of cells, in fixed-point numbers.
///
/// A state phi in [lo, hi] is stored as v = 2 (phi - lo) / (hi - lo) - 1 in [-1, 1], a multiple of `quantum`.
/// A flux is stored as h = rest + G, where G is the change of v it makes in one step, rounded to a multiple
/// of `quantum` by this very addition. Differences of such numbers are exact. Hence
///   (1) the sum of v over all cells never changes, not even by rounding (quadratic kernel);
///   (2) tails do not fade into subnormal numbers, which cost a hundred times the time of normal ones;
///   (3) a face without flux (walls, rest) has h == rest exactly: steady states are kept forever;
///   (4) v stays in [-1, 1]: in first order |G| at a face is at most the room its two cells leave, a whole
///       number of quanta, and rounding is monotone; second order: fv/muscl_pass.hpp; faces between cells
///       with unequal steps: fv/section.hpp; with unequal widths what does not fit waits in `remainder`.
/// Price: a flux that changes v by less than quantum / 2 in a step is lost. The scheme for M is monotone too,
/// so errors of M at most add up: |error of M| <= quantum / 4 * dz * steps, about 1e-16 s a_max t.
class Kernel {
 public:
  Kernel() = default;
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;
  virtual ~Kernel() = default;

  /// Advances v[0 .. n-1] by one step. `below` is what the steps of the cells below have left at the lowest
  /// face; returns the same for the uppermost. Reads v[n .. n + kLanes - 1], the cells above, and the memory
  /// up to kReadAhead beyond n.
  /// Precondition: n is a multiple of kLanes; the arrays do not overlap.
  virtual FaceBelow step(double* v, const Faces& faces, const FaceBelow& below, std::size_t n) const = 0;
  /// Half the rise of v across every cell, rises[0 .. n-1]; v[-1] and v[n] are read.
  virtual void half_rises(const double* v, const Faces& faces, double* rises, std::size_t n) const = 0;
  [[nodiscard]] virtual KernelNumbers numbers() const = 0;
};

/// Instruction sets for which the quadratic kernel is compiled. Results are the same to the bit in all.
enum class Simd { portable, avx2, avx512 };

/// The widest instruction set this processor has.
[[nodiscard]] Simd widest_simd();

/// Kernel for f = phi (phi - 1) on [0, 1]. With v = 2 phi - 1 the flux is G = c (max(v_l, 0)^2 +
/// min(v_r, 0)^2 - 1) for Engquist-Osher, c half the Courant number, and G = max(c_l (max(v_l, 0)^2 - 1),
/// c_r (min(v_r, 0)^2 - 1)) for Godunov. Cost per cell: 10 and 13 additions, multiplications or comparisons.
/// Precondition: the processor has `simd`.
[[nodiscard]] std::unique_ptr<Kernel> quadratic_kernel(Scheme scheme, Limiter limiter = Limiter::mc,
                                                       Simd simd = widest_simd());

/// quadratic_kernel() for Scheme::muscl.
[[nodiscard]] std::unique_ptr<Kernel> quadratic_muscl_kernel(Limiter limiter, Simd simd);

/// Kernel for any flux with one extremum, by calls of its value; slower by a factor of ten or more.
[[nodiscard]] std::unique_ptr<Kernel> unimodal_kernel(Scheme scheme, const UnimodalFlux& flux,
                                                      Limiter limiter = Limiter::mc);

}  // namespace shearfront::fv
