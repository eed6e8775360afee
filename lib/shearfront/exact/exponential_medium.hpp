// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/exact/medium.hpp"

namespace shearfront::exact {

/// The Lax-Hopf formula for a(z) = amplitude exp(-z / decay), in closed form.
///
/// With R = s a(z0) at the start, B = R t / decay and E = exp((z - z0) / decay), the momentum falls linearly,
/// p = p0 - H t / decay, and R p0 (1 - p0) = H = s a(z) p (1 - p) gives for a path from z0 to z in the time t
///
///     (1 - B (1 - p0)) (1 + B p0) = E:    p0 = 1/2 + (S - 1) / B,   p = 1/2 + (E - S) / B,
///     S = sqrt(E + B^2 / 4),              cost = decay [ log(1 + B p0) - B p0 (1 - p0) ],
///
/// one path per source, no iteration. A constant initial state p0 gives a quadratic for E, hence the foot
/// point. Rising paths turn at s a = 4 H; those that would turn above the top are not admissible (the wall is
/// better). All differences are evaluated in conjugate form: p, 1 - p and p0 keep their relative accuracy.
/// Cost of a query: about 30 ns per source within reach. Immutable, safe to share between threads.
template <Real Scalar>
class ExponentialMedium final : public Medium<Scalar> {
 public:
  /// Precondition: form.exponential().
  explicit ExponentialMedium(const CanonicalForm<Scalar>& form);

  [[nodiscard]] const std::vector<Scalar>& boundaries() const override { return boundaries_; }
  /// amplitude, decay
  [[nodiscard]] std::size_t numbers_per_piece() const override { return 2; }

  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const override;
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override;
  [[nodiscard]] Scalar pure_travel_time(const Scalar& z1, const Scalar& z2) const override;
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override;
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override;
  [[nodiscard]] Scalar flux_at(const Scalar& z, const Scalar& phi) const override {
    return rate_at(z) * phi * (Scalar(1) - phi);
  }
  [[nodiscard]] std::optional<Scalar> first_wave(std::size_t /*i*/) const override { return {}; }
  /// The closed forms differentiated. Cost: O(1).
  [[nodiscard]] PathGradient<Scalar> gradient(const Path<Scalar>& path, const Scalar& z,
                                              const Scalar& t) const override;

 private:
  using Medium<Scalar>::cells_;

  [[nodiscard]] Path<Scalar> search(const Scalar& z, const Scalar& t, bool moving_only) const;
  void try_source(const Scalar& z, const Scalar& t, std::size_t i, Path<Scalar>& best) const;
  void try_cell(const Scalar& z, const Scalar& t, std::size_t i, Path<Scalar>& best) const;
  [[nodiscard]] bool turns_outside(const Scalar& p0, const Scalar& p, const Scalar& H) const;

  Scalar scale_, amplitude_, decay_;
  std::vector<Scalar> boundaries_;  ///< bottom and top
  std::vector<Scalar> rate_;        ///< s a at the points of cells_
};

}  // namespace shearfront::exact
