// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// A steady chute as an ordinary bed, in which the distance x plays the part of time (von Mises' variables). With
///
///     psi(z) = int_bottom^z u dz,  U = psi(top) / (top - bottom),  zeta = bottom + psi / U,
///
/// (u phi)_x + (s a c f(phi / c))_z = (D phi_z)_z becomes
///
///     phi_x + ((s / U) a c f(phi / c))_zeta = ((D u / U^2) phi_zeta)_zeta,   bottom < zeta < top:
///
/// a, c, T, D, the flux and the start are taken over from z to zeta, the scale is s / U, D is D u / U^2, and
/// U M of the bed is what passes below z in the chute. This is the only place that knows of it: solvers see the bed.
///
/// Guaranteed: (1) uniform u: the same models, s / u and D / u, nothing is rounded but these; (2) what is constant in
/// pieces stays so, with its breaks at zeta(z); (3) what varies otherwise becomes a table with kPoints points a piece
/// between the knots of the function and of u, thicker at its ends, where u, a or their slopes may vanish: it is off by
/// less than 1.2e-6 height^2 max |a''|. is_sampled() says whether there are such; (4) zeta(bottom) = bottom, zeta(top) =
/// top, and a knot of the scene keeps its height to the bit on the way back.
/// Cost: O(kPoints pieces) once. Source: von Mises (1927), Z. angew. Math. Mech. 7, 425-431.
template <Real Scalar = double>
class SteadyChute {
 public:
  static constexpr std::size_t kPoints = 512;

  /// Precondition: scene.is_chute().
  explicit SteadyChute(const Scene<Scalar>& scene);

  [[nodiscard]] const Scene<Scalar>& bed() const { return bed_; }
  /// U.
  [[nodiscard]] const Scalar& mean_velocity() const { return mean_velocity_; }
  [[nodiscard]] Scalar bed_height(const Scalar& z) const;
  [[nodiscard]] std::vector<Scalar> bed_heights(const std::vector<Scalar>& heights) const;
  /// Its inverse, to rounding.
  [[nodiscard]] Scalar height(const Scalar& zeta) const;
  [[nodiscard]] bool is_sampled() const { return is_sampled_; }
  /// u(z).
  [[nodiscard]] Scalar velocity(const Scalar& z) const;
  /// int_lo^hi u dz.
  [[nodiscard]] Scalar flow(const Scalar& lo, const Scalar& hi) const;
  /// Heights inside the chute where u or its slope jumps, ascending.
  [[nodiscard]] std::vector<Scalar> velocity_knots() const;

 private:
  [[nodiscard]] Scene<Scalar> make_bed();
  [[nodiscard]] DepthFunction<Scalar> carried(const DepthFunction<Scalar>& function);
  /// u / U, times the function if there is one.
  [[nodiscard]] DepthFunction<Scalar> carried_diffusivity(const DepthFunction<Scalar>* function,
                                                          bool follows_shear_rate);
  [[nodiscard]] InitialState<Scalar> carried(const InitialState<Scalar>& start);
  [[nodiscard]] std::vector<Scalar> cuts(std::vector<Scalar> knots) const;
  template <class Ends, class Value>
  void sample(const std::vector<Scalar>& knots, const Ends& ends, const Value& value, std::vector<Scalar>& z,
              std::vector<Scalar>& values);

  const Velocity<Scalar> velocity_;
  const Scalar bottom_, top_, mean_velocity_;
  std::vector<Scalar> known_, known_in_bed_;  ///< heights that come back to the bit
  bool is_sampled_ = false;
  const SceneSpec<Scalar>* spec_;  ///< during construction
  Scene<Scalar> bed_;
};

extern template class SteadyChute<double>;

}  // namespace shearfront
