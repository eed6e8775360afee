// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

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
/// Smooth starts (Scene::has_smooth_start): guarantee (1) in layered scenes; elsewhere paths from them are looked for in parts of the bed,
/// which are halved, and whose error is estimated, as (3) says.
///
/// Domain: any scene with an empty refusal() (exact/refusal.hpp); bottom <= z <= top, 0 <= t <= +infinity.
/// t = 0 gives the initial data, t = +infinity the steady state. At a discontinuity phi is the value above
/// it, at the top the value below. Guarantees: (1) layered scenes, and a linear (tables) or exponential in pieces with c, T
/// constant in pieces: exact up to rounding, |M error| <= c u (top - bottom) with c of the order
/// of the pieces crossed;
/// phi as well, except within a rounding error of a shock; (2) for c = 1 and the quadratic flux
/// 0 <= phi <= 1, max(0, m - (top - z)) <= M <= min(z - bottom, m), in general the images of these bounds;
/// (3) any other smooth a, c, T: the exact solution of pieces through the rate, each linear or exponential,
/// of second order in their height (phi of order 3/2 where paths turn; where a is 0 at an end they thin towards it, and first
/// arrivals there are of first order in their number), halved until the estimated error of M is at most Options::tolerance
/// times the height of the bed at a set of probe points (probed_error(); kMostPieces if that does not suffice). Value::M_error and
/// phi_error estimate what is left, by the change from half as many
/// pieces; their largest value over a set of points is what to go by: at
/// single points errors change sign; (4) const member functions are safe to call from many
/// threads. Cost: 2 layers < 1 us, 10 layers < 5 us, a table of 20 points < 10 us (tests/bench/exact_bench.cpp) for
/// parabolas, of other fluxes some 100 times as much on sloped pieces; construction O(layers + jumps), up to O(layers * (layers + jumps)) when a is monotone, in (3) some 100
/// queries besides. Errors: none beyond those of
/// Scene. Source: Lax (1957), Hopf (1965); for jumps of a, minimum over refracted and resting paths.
template <Real Scalar>
class ExactSolution {
 public:
  struct Options {
    /// So many pieces where the scene has to be approximated; 0: as many as the tolerance takes.
    std::size_t layers = 0;
    double tolerance = 1e-6;  ///< error of M aimed at, in heights of the bed
  };
  static constexpr std::size_t kFirstPieces = 32, kMostPieces = 4096;
  static constexpr std::size_t kMostParts = 512;  ///< of a bed that is exact but for its smooth start

  struct Value {
    Scalar phi{0}, M{0}, H{0};
    Scalar M_error{0}, phi_error{0};  ///< estimates; 0 where the scene is represented exactly
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

  /// The same at many heights, ascending, 0 < t < +infinity: faster where they lie close together.
  [[nodiscard]] std::vector<exact::Path<Scalar>> paths(const std::vector<Scalar>& z, const Scalar& t) const;
  /// Values there: as at(), up to rounding.
  [[nodiscard]] std::vector<Value> at(const std::vector<Scalar>& z, const Scalar& t) const;

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
  /// Layers or pieces used.
  [[nodiscard]] std::size_t n_layers() const;
  [[nodiscard]] const exact::CanonicalForm<Scalar>& form() const { return *fine_.form; }
  /// The bed of the canonical form.
  [[nodiscard]] const exact::Medium<Scalar>& medium() const { return *fine_.medium; }
  /// Whether the scene is represented without approximation.
  [[nodiscard]] bool is_exact() const { return !coarse_.form; }
  /// The Options::layers that give the same pieces, whatever the tolerance.
  [[nodiscard]] std::size_t resolution() const { return resolution_; }
  /// Whether pieces were refined until probed_error() was at most the tolerance: not where their number
  /// was given or has come to kMostPieces.
  [[nodiscard]] bool meets_tolerance() const { return meets_tolerance_; }
  /// Largest M_error at the probe points, in heights of the bed; 0 where there is no tolerance to meet.
  [[nodiscard]] const Scalar& probed_error() const { return probed_error_; }
  /// The same scene by half as many pieces; of its own, empty if is_exact().
  [[nodiscard]] const std::shared_ptr<const exact::CanonicalForm<Scalar>>& coarse_form() const {
    return coarse_.form;
  }
  [[nodiscard]] const exact::Medium<Scalar>& coarse_medium() const { return *coarse_.medium; }

 private:
  using Path = exact::Path<Scalar>;
  /// The scene with some number of layers.
  struct Representation {
    std::shared_ptr<const exact::CanonicalForm<Scalar>> form;
    std::shared_ptr<const exact::Medium<Scalar>> medium;
  };
  [[nodiscard]] static Representation represent(std::shared_ptr<const Scene<Scalar>> scene,
                                                std::size_t layers);
  void represent_within(const std::shared_ptr<const Scene<Scalar>>& scene, double tolerance);
  [[nodiscard]] Scalar probe() const;
  [[nodiscard]] Value in_scene(const Representation& of, Value value, const Scalar& z) const;
  [[nodiscard]] static Value image_value(const exact::Medium<Scalar>& medium, const Path& path,
                                         const Scalar& y);
  [[nodiscard]] static std::vector<Path> paths(const Representation& of, const std::vector<Scalar>& z,
                                               const Scalar& t);
  [[nodiscard]] Value with_errors(Value value, const Path& coarse_path, const Scalar& z) const;
  [[nodiscard]] Value value_at_rest(const Scalar& z, bool is_initial) const;

  Representation fine_, coarse_;  ///< coarse_: half as many layers, for estimates of the error
  Scalar mass_, steady_height_, probed_error_{0};
  std::size_t resolution_ = 0;
  bool meets_tolerance_ = false;
};

extern template class ExactSolution<double>;

}  // namespace shearfront
