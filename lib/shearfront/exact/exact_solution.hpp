// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>

#include "shearfront/exact/canonical_form.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// The entropy solution of phi_t + F(z, phi)_z = 0 with closed walls, point by point, from the Lax-Hopf
/// formula in a bed of pieces. For the quadratic flux F = s a(z) phi (phi - 1):
///
///     M(z, t) = int_bottom^z phi = min over paths ending in (z, t) of [ initial M at the start + cost ],
///     phi = dM/dz = momentum of the minimising path at its end,   dM/dt = H = s a phi (1 - phi).
///
/// Every scene is solved in its canonical form (exact/canonical_form.hpp) and mapped back. Value::H = dM/dt = -F is
/// negative for concave fluxes.
///
/// Domain: any scene with an empty refusal() (exact/refusal.hpp); bottom <= z <= top, 0 <= t <= +infinity.
/// t = 0 gives the initial data, t = +infinity the steady state. At a discontinuity phi is the value above
/// it, at the top the value below. Guarantees: (1) layered scenes, a linear in pieces (tables) with fluxes that are
/// parabolas and c, T constant in pieces, and exponential a in a bed of one parabola: exact up to rounding, |M error| <= c u (top - bottom) with c of the order of the layers crossed;
/// phi as well, except within a rounding error of a shock; (2) for c = 1 and the quadratic flux
/// 0 <= phi <= 1, max(0, m - (top - z)) <= M <= min(z - bottom, m), in general the images of these bounds;
/// (3) other smooth a, c, T: the exact solution of linear pieces through the rate, where fluxes are parabolas and c is
/// constant in pieces, of second order in their height (phi of order 3/2 where paths turn), else of a staircase of layers (harmonic
/// means), of order 3/2 (2 where no path turns); Value::M_error and phi_error estimate what is left: three times the change
/// of M, once the change of phi, from half as many layers. Their largest value over a set of points is what
/// to go by: at single points errors change sign; (4) const member functions are safe to call from many
/// threads. Cost: 2 layers < 1 us, 10 layers < 5 us, a table of 20 points < 10 us (tests/bench/exact_bench.cpp) for
/// parabolas; construction
/// O(layers + jumps), up to O(layers * (layers + jumps)) when a is monotone. Errors: none beyond those of
/// Scene. Source: Lax (1957), Hopf (1965); for jumps of a, minimum over refracted and resting paths.
template <Real Scalar>
class ExactSolution {
 public:
  struct Options {
    std::size_t layers = 0;  ///< pieces, or layers of the staircase, for a smooth scene; 0: default_layers()
  };
  static constexpr std::size_t kDefaultPieces = 256;         ///< where pieces are linear
  static constexpr std::size_t kDefaultLayers = 1024;        ///< where the solid fraction varies smoothly
  static constexpr std::size_t kDefaultGeneralLayers = 128;  ///< where a flux is no parabola
  [[nodiscard]] static std::size_t default_layers(const Scene<Scalar>& scene);

  struct Value {
    Scalar phi{0}, M{0}, H{0};
    Scalar M_error{0}, phi_error{0};  ///< estimates, staircases only, otherwise 0
  };

  explicit ExactSolution(const Scene<Scalar>& scene) : ExactSolution(scene, Options{}) {}
  ExactSolution(const Scene<Scalar>& scene, Options options);

  [[nodiscard]] Value at(const Scalar& z, const Scalar& t) const;
  [[nodiscard]] Scalar phi(const Scalar& z, const Scalar& t) const { return at(z, t).phi; }
  [[nodiscard]] Scalar M(const Scalar& z, const Scalar& t) const { return at(z, t).M; }
  [[nodiscard]] Scalar H(const Scalar& z, const Scalar& t) const { return at(z, t).H; }

  /// Where the minimising path of (z, t) comes from, in the coordinates of the canonical form; kind none for
  /// t = 0 and t = +infinity.
  [[nodiscard]] exact::Path<Scalar> path(const Scalar& z, const Scalar& t) const;

  /// The value that belongs to path(z, t), 0 < t < +infinity.
  [[nodiscard]] Value value_of(const exact::Path<Scalar>& path, const Scalar& z, const Scalar& t) const;

  /// The same in the coordinates of the canonical form, without estimates: u, int u dy and H >= 0 at the height y.
  [[nodiscard]] Value image_value(const exact::Path<Scalar>& path, const Scalar& y) const {
    return image_value(*fine_.medium, path, y);
  }

  [[nodiscard]] const Scene<Scalar>& scene() const { return form().scene(); }
  [[nodiscard]] const Scalar& mass() const { return mass_; }
  /// Where the pure states meet in the steady state: bottom + mass for the quadratic flux and c = 1.
  [[nodiscard]] const Scalar& steady_height() const { return steady_height_; }
  /// Layers used (a staircase for smooth scenes), pieces where a is linear; 0 for exponential a by closed forms.
  [[nodiscard]] std::size_t n_layers() const;
  [[nodiscard]] const exact::CanonicalForm<Scalar>& form() const { return *fine_.form; }
  /// The bed of the canonical form.
  [[nodiscard]] const exact::Medium<Scalar>& medium() const { return *fine_.medium; }
  /// Whether the scene is represented without approximation.
  [[nodiscard]] bool is_exact() const { return !coarse_.form; }

 private:
  using Path = exact::Path<Scalar>;
  /// The scene with some number of layers.
  struct Representation {
    std::shared_ptr<const exact::CanonicalForm<Scalar>> form;
    std::shared_ptr<const exact::Medium<Scalar>> medium;
  };
  [[nodiscard]] static Representation represent(std::shared_ptr<const Scene<Scalar>> scene,
                                                std::size_t layers);
  [[nodiscard]] Value in_scene(const Representation& of, Value value, const Scalar& z) const;
  [[nodiscard]] static Value image_value(const exact::Medium<Scalar>& medium, const Path& path,
                                         const Scalar& y);
  [[nodiscard]] Value value_at_rest(const Scalar& z, bool is_initial) const;

  Representation fine_, coarse_;  ///< coarse_: half as many layers, for estimates of the error
  Scalar mass_, steady_height_;
};

extern template class ExactSolution<double>;

}  // namespace shearfront
