// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "shearfront/diffusion/problem.hpp"

namespace shearfront::diffusion {

/// Approximation of the flux F = r f(phi) - D phi_z at the face between the states l (below) and u (above):
///
///   central  r (f(l) + f(u)) / 2 - D (u - l) / dz
///   raised   the same with D h(P) for D,  P = |r| W dz / (2 D),  W = max |f'|,  h(P) = max(1, P) but for a smooth
///            bend between 0.9 and 1.1 (see raised_share)
///   fitted   the same with D P coth(P) for D
///
/// Between unequal cells dz is the distance of their middles, and central interpolates f linearly from the
/// middles to the face, which keeps the order of both where cells are halved (the error of the flux there is
/// O(dz), but a flux off in one face shifts phi by dz times as much only: Manteuffel & White 1986, Math.
/// Comp. 47, 511-535).
///
/// central is second order. Of the means (1 - a) f((l + u) / 2) + a (f(l) + f(u)) / 2 that with a = 1 is the
/// most accurate for kinks and steady profiles of the quadratic flux: there the error of the cell means is
///
///   phi (1 - phi) (r dz / D)^2 (x / 12 - (1/12 + a/8) tanh(x / 2)),     x = r (z - z0) / D,
///
/// at most 0.003 (r dz / D)^2 for a = 1 and 0.011 (r dz / D)^2 for a = 0.
/// raised is central where P <= 0.9, to the last bit, and upwind elsewhere: monotone with hardly more diffusion than
/// makes the central flux so. (Between unequal cells dz in P is the wider one.)
/// fitted is second order for P -> 0 and upwind, with the viscosity |r| W dz / 2, for P -> infinity and for
/// D = 0. It never falls as l rises and never rises as u does (is monotone), for all states in the range of f
/// and any r, D >= 0 and dz, because P coth(P) >= P. W is exact for fluxes that are convex or concave and
/// comes from 4097 samples of f' for the others.
/// Source: Il'in (1969), Math. Notes 6, 596-602; Scharfetter & Gummel (1969), IEEE Trans. Electron Devices
/// 16, 64-77.
enum class Scheme { central, raised, fitted };

/// P up to which Scheme::raised is central. A flux with max(1, P) would have a kink in D and r, which fits meet.
inline constexpr double kCentralUpTo = 0.9;

/// h(P) of Scheme::raised: 1 up to p = kCentralUpTo, P from 2 - p on, and between them the parabola with the same
/// slopes, which is above both.
[[nodiscard]] constexpr double raised_share(double p) {
  const double past = p - kCentralUpTo, bend = 2 * (1 - kCentralUpTo);
  return past <= 0 ? 1 : past >= bend ? p : 1 + past * past / (2 * bend);
}

/// The largest P = |r| W dz / (2 D) of a face that a flux passes, as in Scheme. Cost: O(N).
[[nodiscard]] double largest_cell_peclet(const Problem& problem);

/// F / u at the N + 1 faces and u / dz times the derivatives of that with respect to the states of the cells
/// on both sides, dz being the width of those cells; u = dz if all are equal, else 1.
struct FaceFluxes {
  explicit FaceFluxes(std::size_t n_faces) : value(n_faces), by_below(n_faces), by_above(n_faces) {}
  std::vector<double> value, by_below, by_above;
};

/// Computes them for one Problem. Outside the range of a flux f goes on along its tangents (parabolas and
/// Burgers' flux if central: along themselves).
///
/// Layout of states: cells in v[1..N]; v[0] and v[N+1] belong to the ends and must hold v[1] and v[N]
/// (walls, neumann) or v[N] and v[1] (periodic).
/// Cost: O(N), one evaluation of f and f' a cell.
class FaceRule {
 public:
  static std::unique_ptr<FaceRule> make(const Problem& problem, Scheme scheme);
  virtual ~FaceRule() = default;

  /// At the states v.
  virtual void evaluate(const double* v, FaceFluxes& out) = 0;
  /// Derivative of `value` with respect to a parameter of the problem, the states unchanged. Precondition:
  /// equal cells.
  virtual void evaluate_tangent(const double* v, const Tangent& tangent, std::span<double> out) = 0;
  /// Largest L for which an explicit step of length 1 / L is monotone with the fitted flux.
  [[nodiscard]] virtual double explicit_rate() const = 0;
};

}  // namespace shearfront::diffusion
