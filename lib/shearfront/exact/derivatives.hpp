// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/entries.hpp"

namespace shearfront {

/// Why the exact solution has no derivative with respect to an entry of a scene, in one clause; empty if it has one.
///
/// It has for shear_rate.* (every model), initial.breaks and initial.values, and the entries of a smooth start, where c and T are
/// constant in pieces.
/// Left out is a knot of a(z) on a jump of c, T or the flux: moving it makes another layer.
template <Real Scalar>
[[nodiscard]] std::string derivative_refusal(const Scene<Scalar>& scene, const Entry& entry);

/// phi, M and their exact derivatives with respect to the entries of a scene; the domain walls stay where they are.
///
/// M by the envelope theorem (the minimising path held fixed): with T_k the time the path spends in layer k,
///
///     dM/da_k = H T_k / a_k  (+ (s / 4) (time at rest) if layer k limits the interface at which it rests),
///     dM/ds   = H t / s,
///     dM/dz_i = +-(p_below - p_above) for an interface crossed (+ going up),
///     dM/dx_j = (phi_below - p_start) for the jump where the path starts, (phi_below - phi_above) for jumps below it.
///
/// phi by the implicit function theorem: T(H) = t for a fan, H = s min(a) / 4 for a path at rest, H the flux of the state
/// for a constant one; then p(H) in the layer of z. From the numbers of the pieces to the entries of the scene by the
/// chain rule: a layer's mean by the model's harmonic_mean_derivatives, its ends by the knots they lie between. So the
/// derivatives of pieces or layers that stand for a bed are those of what ExactSolution computes.
///
/// From a smooth start u0 the same: M sees its height of start y only by int u0 dy (dM/dy = 0 there), phi sees u0(y) and moves
/// y by its slope. Where paths are looked for part by part the derivatives are those of the path found.
///
/// Guarantees: exact up to rounding wherever M (phi) is differentiable, i.e. away from shocks (phi), from the
/// edges of fans (phi), and for M away from points reached by two minimising paths. One-sided there: the
/// derivative belongs to the path ExactSolution chose. A break of a(z) and an initial jump at the same height
/// are moved one at a time, as are two layers of equal a at an interface where a path rests (the derivative
/// is given to the layer above). An initial jump on a jump of c, T or the flux is moved into the layer above. t = 0 and
/// t = +infinity: the initial data and the steady state differentiated. Immutable, safe to share between threads.
/// Cost: O(layers + entries) once; one query of ExactSolution plus O(layers touched + entries) per point.
template <Real Scalar>
class Derivatives {
 public:
  struct At {
    typename ExactSolution<Scalar>::Value value;  ///< phi, M and H themselves, as ExactSolution::at
    std::vector<Scalar> M, phi;  ///< in the order of scene/entries.hpp; 0 for entries that are refused
  };

  /// `solution` must live as long as this.
  explicit Derivatives(const ExactSolution<Scalar>& solution);

  [[nodiscard]] At at(const Scalar& z, const Scalar& t) const {
    At out;
    at(z, t, out);
    return out;
  }
  /// The same into what another place has left: without a call for memory.
  void at(const Scalar& z, const Scalar& t, At& out) const;
  /// Along the path of (z, t), 0 < t < +infinity.
  void along(const exact::Path<Scalar>& path, const Scalar& z, const Scalar& t, At& out) const;

  /// Of the height of boundary k of solution.form().layers().
  [[nodiscard]] std::vector<Scalar> boundary(std::size_t k) const;
  [[nodiscard]] std::size_t n_entries() const { return n_entries_; }
  /// The entry by which time goes faster: d phi / d s = t / s d phi / dt.
  [[nodiscard]] std::size_t scale_entry() const { return scale_; }

 private:
  using Pair = typename exact::PathGradient<Scalar>::Pair;
  /// d(something) / d(entry).
  struct Term {
    std::size_t entry;
    Scalar factor;
  };
  /// Lists of terms, one after the other.
  struct Chain {
    std::vector<std::size_t> begin{0};
    std::vector<Term> terms;
    void close() { begin.push_back(terms.size()); }
  };
  struct Cut;
  [[nodiscard]] std::vector<Cut> cuts() const;
  void add_boundaries();
  void add_pieces();
  void add_sloped_pieces();
  void add_initial();
  void spread(const Chain& chain, std::size_t n, const Pair& by, At& out) const;
  void clear(At& out) const;
  void scale_to_scene(const Scalar& z, At& out) const;
  void add_start_shape(const Scalar& y, const Scalar& by_amount, const Scalar& by_state, At& out) const;
  void add_initial_cumulative(const Scalar& y, bool include_jump_at_y, At& out) const;
  void add_path(const exact::Path<Scalar>& path, const Scalar& y, const Scalar& t, At& out) const;
  void add_start(const exact::Path<Scalar>& path, const exact::PathGradient<Scalar>& gradient, At& out) const;

  const ExactSolution<Scalar>& solution_;
  const exact::CanonicalForm<Scalar>& form_;
  std::size_t n_entries_, first_rate_, scale_, first_jump_, first_state_,
      first_start_;   ///< places among the entries
  Chain boundaries_;  ///< heights of the image's boundaries
  Chain pieces_;      ///< numbers of its pieces
  Chain jumps_;       ///< heights of its initial jumps
  Chain states_;      ///< its initial states
};

extern template class Derivatives<double>;
extern template std::string derivative_refusal(const Scene<double>&, const Entry&);

}  // namespace shearfront
