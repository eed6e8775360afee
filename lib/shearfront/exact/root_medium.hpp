// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/exact/medium.hpp"

namespace shearfront::exact {

/// The Lax-Hopf formula in a bed that is one piece in which the rate falls as a root, r(z) = A y, y = sqrt(surface - z), to 0 if the
/// surface is its top. Parabolas, states constant in pieces.
///
/// H = r q, q = p (1 - p), is constant along a path, so that y q = kappa = H / A, and momenta fall:
///
///     t = (2 kappa / A) (G(p0) - G(p)),   G(p) = (2 p - 1) / q + 2 log(p / (1 - p)),   G' = 1 / q^2,
///     value = M0 + p0 y0^2 - p y^2 + kappa^2 (G(p0) - G(p)).
///
/// With psi = q G = 2 p - 1 + 2 q log(p / (1 - p)), the state p0 comes to y where q(p) G(p0) - psi(p) = t A / (2 y): concave in p, up to two
/// starts. A fan between y0 and y has one unknown, the momentum u at that end of the two whose y is less, counted from the
/// side it moves on to: (2 / A) (y_least psi(u) + y_most phi(y_least q(u) / y_most)) = t with phi = psi of a momentum above 1/2; the root
/// wanted is that at which t rises with u. Each by bracketed Newton steps. A rising path with H > 0 turns below the surface, none
/// turns below; none rests. Pure grains come to the surface in finite time, after 2 y / A.
///
/// Accuracy: a few u of the height (M), of 1 (phi) but within rounding of a shock. Cost: some us per source. Immutable, safe to
/// share. Source: characteristics of the equation; checked by tables of many points.
template <Real Scalar>
class RootMedium final : public Medium<Scalar> {
 public:
  /// Rates at both ends, low > high >= 0.
  RootMedium(Scalar low, Scalar high, Cells<Scalar> cells, Scalar mass);

  [[nodiscard]] const std::vector<Scalar>& boundaries() const override { return boundaries_; }
  /// The rates at both ends.
  [[nodiscard]] std::size_t numbers_per_piece() const override { return 2; }
  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const override;
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override;
  [[nodiscard]] Scalar pure_travel_time(const Scalar& from, const Scalar& to) const override;
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override;
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override;
  [[nodiscard]] Scalar flux_at(const Scalar& z, const Scalar& phi) const override {
    return rate_at(z) * phi * (Scalar(1) - phi);
  }
  /// There is no inner boundary.
  [[nodiscard]] std::optional<Scalar> first_wave(std::size_t) const override { return std::nullopt; }
  [[nodiscard]] PathGradient<Scalar> gradient(const Path<Scalar>& path, const Scalar& z,
                                              const Scalar& t) const override;

 private:
  using Medium<Scalar>::cells_;
  /// A momentum by its odds p / (1 - p) = e^x.
  struct Momentum {
    Scalar x, p, missing, q;
    explicit Momentum(const Scalar& log_odds);
    /// q G.
    [[nodiscard]] Scalar psi() const { return (p - missing) + Scalar(2) * q * x; }
  };
  /// The momentum above 1/2 with q, and phi, phi' there.
  struct Upper {
    Scalar p, missing, phi, phi_q;
    explicit Upper(const Scalar& q);
  };
  /// Square root of the depth below the surface.
  [[nodiscard]] Scalar root(const Scalar& z) const;
  [[nodiscard]] Path<Scalar> search(const Scalar& z, const Scalar& t, bool moving_only) const;
  void fan(std::size_t point, const Scalar& z, const Scalar& t, Path<Scalar>& best) const;
  void state(std::size_t cell, const Scalar& z, const Scalar& t, bool moving_only, Path<Scalar>& best) const;
  void pure(std::size_t cell, const Scalar& z, const Scalar& t, Path<Scalar>& best) const;
  /// (2 / A) (...) of a fan and its derivative by u.
  struct FanTime {
    Scalar t, by_u;
  };
  [[nodiscard]] FanTime fan_time(const Scalar& least, const Scalar& most, const Momentum& u) const;
  /// What the value of a path is above M0: p0 y0^2 - p y^2 + kappa A t / 2.
  [[nodiscard]] Scalar gain(const Scalar& p0, const Scalar& missing0, const Scalar& y0, const Scalar& p,
                            const Scalar& missing, const Scalar& y, const Scalar& H, const Scalar& t) const;

  std::vector<Scalar> boundaries_;
  Scalar low_, high_, A_{0}, A2_{0}, below_surface_{0};  ///< of the top
};

extern template class RootMedium<double>;

}  // namespace shearfront::exact
