// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"

namespace shearfront {

/// Derivatives of one quantity with respect to every number of a scene file, under the file's own names.
///
///   shear_rate_values   values of a: one per layer (piecewise) or per point (table); empty for exponential a
///   shear_rate_breaks   heights of the interfaces (piecewise); empty otherwise
///   amplitude, decay    exponential a; 0 otherwise
///   scale               s
///   initial_breaks      heights of the initial jumps
///   initial_values      initial concentrations
template <Real Scalar>
class Gradient {
 public:
  Scalar scale{0}, amplitude{0}, decay{0};

  Gradient() = default;
  Gradient(std::size_t n_values, std::size_t n_rate_breaks, std::size_t n_jumps)
      : n_values_(n_values),
        n_breaks_(n_rate_breaks),
        n_jumps_(n_jumps),
        numbers_(n_values + n_rate_breaks + 2 * n_jumps + 1, Scalar(0)) {}

  [[nodiscard]] std::span<const Scalar> shear_rate_values() const { return part(0, n_values_); }
  [[nodiscard]] std::span<const Scalar> shear_rate_breaks() const { return part(n_values_, n_breaks_); }
  [[nodiscard]] std::span<const Scalar> initial_breaks() const {
    return part(n_values_ + n_breaks_, n_jumps_);
  }
  [[nodiscard]] std::span<const Scalar> initial_values() const {
    return part(n_values_ + n_breaks_ + n_jumps_, numbers_.empty() ? 0 : n_jumps_ + 1);
  }
  [[nodiscard]] Scalar& shear_rate_value(std::size_t i) { return numbers_[i]; }
  [[nodiscard]] Scalar& shear_rate_break(std::size_t i) { return numbers_[n_values_ + i]; }
  [[nodiscard]] Scalar& initial_break(std::size_t i) { return numbers_[n_values_ + n_breaks_ + i]; }
  [[nodiscard]] Scalar& initial_value(std::size_t i) {
    return numbers_[n_values_ + n_breaks_ + n_jumps_ + i];
  }

 private:
  [[nodiscard]] std::span<const Scalar> part(std::size_t from, std::size_t n) const {
    return std::span<const Scalar>(numbers_).subspan(from, n);
  }
  std::size_t n_values_ = 0, n_breaks_ = 0, n_jumps_ = 0;
  std::vector<Scalar> numbers_;
};

template <Real Scalar>
struct Sensitivities {
  typename ExactSolution<Scalar>::Value value;  ///< phi, M and H themselves, as ExactSolution::at
  Gradient<Scalar> M, phi;
};

/// phi, M and their exact derivatives at (z, t); the domain walls stay where they are.
///
/// M by the envelope theorem (the minimising path held fixed): with T_k the time the path spends in layer k,
///     dM/da_k = H T_k / a_k  (+ (s / 4) (time at rest) if layer k limits the interface at which it rests),
///     dM/ds = H t / s,   dM/dz_i = +-(p_below - p_above) for an interface crossed (+ going up),
///     dM/dx_j = (phi_below - p_start) for the jump where the path starts, (phi_below - phi_above) for jumps
///     below it.
/// phi by the implicit function theorem: T(H) = t for a fan, H = s min(a) / 4 for a path at rest, H = s a
/// f(phi_0) for a constant state; then phi = (1 +- q(H)) / 2 in the layer of z. Exponential a: the closed
/// forms differentiated. Tabulated a: the gradient of the staircase by the chain rule (entries of initial
/// data and scale likewise).
///
/// Guarantees: exact up to rounding wherever M (phi) is differentiable, i.e. away from shocks (phi), from the
/// edges of fans (phi), and for M away from points reached by two minimising paths. One-sided there: the
/// derivative belongs to the path ExactSolution chose. A break of a(z) and an initial jump at the same height
/// are moved one at a time, as are two layers of equal a at an interface where a path rests (the derivative
/// is given to the layer above). t = 0 and t = +infinity: the initial data and the steady state
/// differentiated. Heights of a table (its z) are not parameters. Cost: one query of ExactSolution plus
/// O(layers + jumps) for the vectors.
///
/// Other fluxes, solid fraction and temperature: the derivatives of the canonical form by the chain rule, for the same
/// entries (shear_rate.*, initial.*); the entries of fluxes, solid fraction and temperature have none. An initial
/// jump on a jump of c, T or the flux is moved into the layer above. Precondition: sensitivity_refusal() is
/// empty.
template <Real Scalar>
[[nodiscard]] Sensitivities<Scalar> sensitivities(const ExactSolution<Scalar>& solution, const Scalar& z,
                                                  const Scalar& t);

/// Why there are no exact derivatives of a solution, in one sentence; empty if there are: where c, T or a
/// general flux vary smoothly, or a break of a(z) lies on a jump of c, T or the flux.
template <Real Scalar>
[[nodiscard]] std::string sensitivity_refusal(const ExactSolution<Scalar>& solution);

extern template Sensitivities<double> sensitivities(const ExactSolution<double>&, const double&,
                                                    const double&);
extern template std::string sensitivity_refusal(const ExactSolution<double>&);

}  // namespace shearfront
