// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

#include "shearfront/exact/flux_branch.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// Means over m, from m1 to m2, of functions of a flux that is a cubic in pieces (exact/flux_branch.hpp).
///
/// In the first piece, where G = m c(m) with a quadratic c, what is integrated is rational without a pole at m = 0, 1 / G after
///
///     1 / G = 1 / (c(0) m) - (c'(0) + m c'' / 2) / (c(0) c(m)),
///
/// and G is concave: the zeros of c lie no nearer to the piece than 0.6 of its length. In other pieces [a, b] with b <= 2 a those of G do. With
/// the ellipse through them, of half axes that add up to R = 3.6 halves of the piece or more, Gauss and Legendre's rule of n points errs by some
/// R^-2n (Trefethen, Approximation Theory and Approximation Practice, 2013, Theorem 19.3): 1e-22 for n = 20, 1e-111 for n = 100. Less is enough
/// where the ends are nearer to one another.
template <Real Scalar>
class BranchMeans {
 public:
  BranchMeans(const FluxBranch<Scalar>& branch, const Scalar& m1, const Scalar& m2)
      : branch_(branch), lo_(std::min(m1, m2)), hi_(std::max(m1, m2)), width_(hi_ - lo_) {}

  /// Of 1 / G.
  [[nodiscard]] Scalar inverse() const {
    using std::log1p;
    const Scalar one(1);
    if (!(width_ > 0)) return one / branch_.height_beside(lo_);
    Scalar all(0);
    const Piece& first = branch_.pieces().front();
    const Scalar first_end = std::min(hi_, end_of_first());
    if (lo_ < first_end) {
      const Scalar to = first_end - lo_;
      all = log1p(Scalar(to / lo_)) / first.slope;
      if (first.square != 0 || first.cube != 0)
        all -= over(lo_, first_end,
                    [&](const Scalar& m) {
                      return Scalar((first.square + m * first.cube) / first.chord_at(m));
                    }) /
               first.slope;
    }
    all += over_others([&](const Piece& piece, const Scalar& m) { return Scalar(one / piece.at(m)); });
    return all / width_;
  }
  /// Of (G - m G') / G = -m c' / c.
  [[nodiscard]] Scalar bow() const {
    return mean(
        [](const Scalar& chord, const Scalar& fall, const Scalar& m) { return Scalar(m * fall / chord); });
  }
  /// Of (G - m G') / G^2 = -c' / c^2.
  [[nodiscard]] Scalar bow_over_height() const {
    return mean([](const Scalar& chord, const Scalar& fall, const Scalar&) {
      return Scalar(fall / (chord * chord));
    });
  }

 private:
  using Piece = typename FluxBranch<Scalar>::Piece;
  static constexpr bool kIsDouble = std::numeric_limits<Scalar>::digits == 53;
  using Few = boost::math::quadrature::gauss<Scalar, kIsDouble ? 6 : 30>;
  using Some = boost::math::quadrature::gauss<Scalar, kIsDouble ? 10 : 60>;
  using Many = boost::math::quadrature::gauss<Scalar, kIsDouble ? 20 : 100>;

  [[nodiscard]] const Scalar& end_of_first() const {
    return branch_.pieces().size() > 1 ? branch_.pieces()[1].begin : branch_.reach();
  }
  /// Of f(c, -c', m).
  template <class F>
  [[nodiscard]] Scalar mean(const F& f) const {
    const Piece& first = branch_.pieces().front();
    const auto in_first = [&](const Scalar& m) {
      return Scalar(f(first.chord_at(m), Scalar(-(first.square + Scalar(2) * m * first.cube)), m));
    };
    const auto in_other = [&](const Piece& piece, const Scalar& m) {
      const Scalar chord = piece.at(m) / m;
      return Scalar(f(chord, Scalar((chord - piece.slope_at(m)) / m), m));
    };
    if (!(width_ > 0)) {
      const Piece& piece = branch_.piece_at(lo_);
      return piece.begin > 0 ? in_other(piece, lo_) : in_first(lo_);
    }
    Scalar all(0);
    const Scalar first_end = std::min(hi_, end_of_first());
    if (lo_ < first_end && (first.square != 0 || first.cube != 0)) all = over(lo_, first_end, in_first);
    return (all + over_others(in_other)) / width_;
  }
  /// Of the pieces but for the first, in parts of which none is longer than its lower end.
  template <class F>
  [[nodiscard]] Scalar over_others(const F& f) const {
    Scalar all(0);
    const auto& pieces = branch_.pieces();
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const Piece& piece = pieces[i];
      Scalar from = std::max(lo_, piece.begin);
      const Scalar to = std::min(hi_, i + 1 < pieces.size() ? pieces[i + 1].begin : branch_.reach());
      while (from < to) {
        const Scalar end = std::min(to, Scalar(Scalar(2) * from));
        all += over(from, end, [&](const Scalar& m) { return f(piece, m); });
        from = end;
      }
    }
    return all;
  }
  template <class F>
  [[nodiscard]] static Scalar over(const Scalar& lo, const Scalar& hi, const F& f) {
    const Scalar width = hi - lo;
    if (width <= lo / Scalar(16)) return rule<Few>(lo, width, f);
    if (width <= lo / Scalar(2)) return rule<Some>(lo, width, f);
    return rule<Many>(lo, width, f);
  }
  template <class Nodes, class F>
  [[nodiscard]] static Scalar rule(const Scalar& lo, const Scalar& width, const F& f) {
    const auto& x = Nodes::abscissa();
    const auto& w = Nodes::weights();
    const Scalar half = width / Scalar(2), middle = lo + half;
    Scalar all(0);
    for (std::size_t n = 0; n < x.size(); ++n)  // an even rule: no abscissa is 0
      all += w[n] * (f(Scalar(middle - half * x[n])) + f(Scalar(middle + half * x[n])));
    return all * half;
  }

  const FluxBranch<Scalar>& branch_;
  Scalar lo_, hi_, width_;
};

}  // namespace shearfront::exact
