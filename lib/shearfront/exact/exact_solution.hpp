// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/canonical_form.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// The entropy solution of phi_t + F(z, phi)_z = 0 with closed walls, point by point, from the Lax-Hopf
/// formula in a layered or exponential medium. For the quadratic flux F = s a(z) phi (phi - 1):
///
///     M(z, t) = int_bottom^z phi = min over paths ending in (z, t) of [ initial M at the start + cost ],
///     phi = dM/dz = momentum of the minimising path at its end,   dM/dt = H = s a phi (1 - phi).
///
/// Every other scene is solved in its canonical form (exact/canonical_form.hpp) and mapped back: parabolas are
/// the quadratic flux there, other convex or concave fluxes use their inverse branches
/// (exact/general_medium.hpp). Value::H = dM/dt = -F is negative for concave fluxes.
///
/// Domain: any scene with an empty refusal() (exact/refusal.hpp); bottom <= z <= top, 0 <= t <= +infinity.
/// t = 0 gives the initial data, t = +infinity the steady state. At a discontinuity phi is the value above
/// it, at the top the value below. Guarantees: (1) layered scenes, and exponential a in a bed of one
/// parabola: exact up to rounding, |M error| <= c u (top - bottom) with c of the order of the layers crossed;
/// phi as well, except within a rounding error of a shock; (2) for c = 1 and the quadratic flux 0 <= phi <=
/// 1, max(0, m - (top - z)) <= M <= min(z - bottom, m), in general the images of these bounds; (3) other
/// smooth a, c, T: the exact solution of a staircase of layers (harmonic means), of order 3/2 in the layer
/// height (2 where no path turns); Value::M_error and phi_error estimate what is left: three times the change
/// of M, once the change of phi, from half as many layers. Their largest value over a set of points is what
/// to go by: at single points errors change sign; (4) const member functions are safe to call from many
/// threads. Cost: 2 layers < 1 us, 10 layers < 5 us (tests/bench/exact_bench.cpp) for parabolas; construction
/// O(layers + jumps), up to O(layers * (layers + jumps)) when a is monotone. Errors: none beyond those of
/// Scene. Source: Lax (1957), Hopf (1965); for jumps of a, minimum over refracted and resting paths.
template <Real Scalar>
class ExactSolution {
 public:
  struct Options {
    std::size_t layers = 0;  ///< layers of the staircase for a smooth scene; 0: default_layers()
  };
  static constexpr std::size_t kDefaultLayers = 1024;
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

  /// The value that belongs to path(z, t).
  [[nodiscard]] Value value_of(const exact::Path<Scalar>& path, const Scalar& z,
                               const Scalar& t) const;

  [[nodiscard]] const Scene<Scalar>& scene() const { return scene_; }
  [[nodiscard]] const Scalar& mass() const { return mass_; }
  /// Where the pure states meet in the steady state: bottom + mass for the quadratic flux and c = 1.
  [[nodiscard]] const Scalar& steady_height() const { return steady_height_; }
  /// Layers used (a staircase for smooth scenes); 0 for exponential a by closed forms.
  [[nodiscard]] std::size_t n_layers() const { return n_layers_; }
  /// The medium of the canonical form.
  [[nodiscard]] const exact::Medium<Scalar>& medium() const { return *medium_; }
  /// The canonical form and the solution in it; nullptr for the scenes of the quadratic flux with c = T = 1.
  [[nodiscard]] const exact::CanonicalForm<Scalar>* canonical_form() const { return form_.get(); }
  [[nodiscard]] const ExactSolution* image() const { return image_.get(); }
  /// Whether the scene is represented without approximation.
  [[nodiscard]] bool is_exact() const {
    return !coarse_ && !coarse_image_ && (!image_ || image_->is_exact());
  }

 private:
  using Form = std::shared_ptr<const exact::CanonicalForm<Scalar>>;
  ExactSolution(const exact::CanonicalForm<Scalar>& form, std::size_t layers);
  [[nodiscard]] Value value_in_scene(const exact::CanonicalForm<Scalar>& form, Value value,
                                     const Scalar& z) const;
  [[nodiscard]] exact::Path<Scalar> best_path(const exact::Medium<Scalar>& medium, const Scalar& z,
                                                      const Scalar& t) const;
  [[nodiscard]] Value value_from(const exact::Path<Scalar>& path, const Scalar& z) const;

  Scene<Scalar> scene_;
  Scalar mass_, steady_height_;
  std::size_t n_layers_ = 0;
  std::shared_ptr<const exact::Medium<Scalar>> medium_, coarse_;
  Form form_, coarse_form_;
  std::shared_ptr<const ExactSolution> image_, coarse_image_;
};

extern template class ExactSolution<double>;

}  // namespace shearfront
