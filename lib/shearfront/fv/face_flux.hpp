// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/riemann/flux_course.hpp"

namespace shearfront::fv {

/// Numerical fluxes at a face between x_l in the cell below and x_r above, x = phi / c. k is the coefficient
/// s a sqrt(T) c of a cell, f its flux with the extremum m, here a minimum (for a maximum exchange min and max,
/// and the orders of states):
///
///   godunov             max( k_l f_l(max(x_l, m_l)), k_r f_r(min(x_r, m_r)) )
///   engquist_osher      k_face ( f(max(x_l, m)) + f(min(x_r, m)) - f(m) ); between unequal f as godunov
///   upwind              the smaller one of k_l f_l(x_l) and k_r f_r(x_r) where phi rises across the face, the
///                       larger one where it falls: the flux of the side the jump comes from
///   classical_godunov   the same, and the extremum of f, with the larger k, in a fan that has it between
///
/// The first two are non-decreasing in x_l and non-increasing in x_r, so a step with k |f'| dt <= int c dz is a
/// monotone scheme: bounded, order-preserving, L1-contractive; and both vanish between equal pure states.
/// Godunov's is the exact flux of the Riemann problem of the two cells. Engquist-Osher takes one coefficient for
/// all three terms, also where a jumps: any value between the two sides will do, the cells next to the jump
/// adapt. With each side's own coefficient in its term nothing could stand for f(m): to vanish, the flux between
/// (0 | 0) needs k_l f(m), that between (1 | 1) needs k_r f(m); without any f(m) the scheme does not converge.
/// A monotone flux has its minimum at an end of its range, and both are then Godunov's: the flux of the side the waves
/// come from (that no layer is given more than it can take: riemann/overload.hpp). For a flux with several extrema they
/// take the extremum of f between the states and f(lo) + rise(x_l) + fall(x_r), with equal k. The other two lack the balance k_l f_l = k_r f_r at jumps.
/// Sources: Engquist & Osher (1981), Math. Comp. 36; Towers (2000), SIAM J. Numer. Anal. 38 (coefficients
/// staggered against states); Adimurthi, Jaffre & Veerappa Gowda (2004), SIAM J. Numer. Anal. 42 (Godunov);
/// classical_godunov and upwind: the thesis named in docs/evidence/packing.md, Sections 4.2, 4.3.
enum class Rule { godunov, engquist_osher, classical_godunov, upwind };

[[nodiscard]] constexpr bool is_monotone(Rule rule) {
  return rule == Rule::godunov || rule == Rule::engquist_osher;
}

/// A flux f(x) on [lo, hi] with any number of extrema, as the schemes see it.
///
/// Marches count in v = sign (2 (x - lo) / (hi - lo) - 1), the state of the grains that sink: -sign f has its
/// maximum, so what holds for a minimum holds for both. share(state(x)) == x to rounding, exact at both ends.
struct FluxShape {
  explicit FluxShape(const Flux<double>& flux);

  [[nodiscard]] bool has_one_extremum() const { return turns.size() == 3; }
  [[nodiscard]] bool is_monotone() const { return turns.size() == 2; }
  /// Falls to one state and rises after it, or the other way round; that state may be an end of its range.
  [[nodiscard]] bool has_two_branches() const { return has_one_extremum() || is_monotone(); }
  [[nodiscard]] double value(double x) const { return flux.value(x); }
  [[nodiscard]] double derivative(double x) const { return flux.derivative(x); }
  /// Where f has its extremum; of a monotone f the end of its range where it is least.
  [[nodiscard]] double extremum() const { return turn; }
  /// Least and largest f between two states.
  struct Extent {
    double least, most;
  };
  [[nodiscard]] Extent extent(double a, double b) const;
  /// f(x) = f(lo) + rise + fall, the integrals of max(f', 0) and min(f', 0) from lo to x.
  struct Parts {
    double rise, fall;
  };
  [[nodiscard]] Parts parts(double x) const;

  [[nodiscard]] double share(double v) const {
    const double u = sign * v, half = (hi - lo) / 2;
    return u > 0 ? hi - half * (1 - u) : lo + half * (1 + u);
  }
  [[nodiscard]] double state(double x) const {
    const double half = (hi - lo) / 2;
    return sign * (x - lo > half ? 1 - (hi - x) / half : (x - lo) / half - 1);
  }

  Flux<double> flux;
  double lo = 0, hi = 1;
  double turn = 0;                  ///< turning_state(), if f has two branches
  double sign = 1;                  ///< 1: the extremum is a minimum, or there is not one; -1: a maximum
  std::vector<double> turns;        ///< lo, the extrema, hi
  std::vector<double> turn_values;  ///< f there
  double largest_slope = 0;         ///< max |f'|, by a fine sampling that includes both ends
  bool vanishes = true;             ///< f(lo) == f(hi) == 0
  bool is_parabola = false;         ///< known beyond [lo, hi], too
};

/// One side of a face.
struct FaceSide {
  const FluxShape* flux;
  double coefficient;     ///< k
  double solid_fraction;  ///< c
  double x;
};

/// Cost: a few evaluations of f. The marches use loops of their own for fluxes with one extremum.
[[nodiscard]] double face_flux(Rule rule, const FaceSide& below, const FaceSide& above,
                               double face_coefficient);

}  // namespace shearfront::fv
