// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// One side of a canonical flux G (exact/inverse_flux.hpp) that is a polynomial of degree three at most between its joints: its
/// coefficients, by the distance m from the pure state and, next to the peak, by the distance d from the peak. Says in a few
/// multiplications what InverseFlux says by the model.
///
/// Guarantees: G, G / m and the inverse next to the pure state to a few u of themselves, all else to a few u. Precondition: G is concave
/// and does not fall from m = 0 to the peak. Cost: 2 or 3 steps of third order per inverse.
template <Real Scalar>
class FluxBranch {
 public:
  /// From m = begin up to the next piece: G = G0 + x (slope + x (square + x cube)), x = m - begin.
  struct Piece {
    Scalar begin, G0, slope, square, cube;

    [[nodiscard]] Scalar at(const Scalar& m) const {
      const Scalar x = m - begin;
      return G0 + x * (slope + x * (square + x * cube));
    }
    [[nodiscard]] Scalar slope_at(const Scalar& m) const {
      const Scalar x = m - begin;
      return slope + x * (Scalar(2) * square + Scalar(3) * x * cube);
    }
    [[nodiscard]] Scalar bend_at(const Scalar& m) const {
      return Scalar(2) * square + Scalar(6) * cube * (m - begin);
    }
    /// G / m of the first piece.
    [[nodiscard]] Scalar chord_at(const Scalar& m) const { return slope + m * (square + m * cube); }
  };

  /// e = d (kink + d (square + d cube)) in the last piece.
  FluxBranch(Scalar reach, std::vector<Piece> pieces, Scalar kink, Scalar square, Scalar cube)
      : reach_(std::move(reach)),
        pieces_(std::move(pieces)),
        kink_(std::move(kink)),
        square_(std::move(square)),
        cube_(std::move(cube)) {}

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const Scalar& reach() const { return reach_; }
  [[nodiscard]] const Piece& piece_at(const Scalar& m) const {
    std::size_t i = pieces_.size() - 1;
    while (i > 0 && m < pieces_[i].begin) --i;
    return pieces_[i];
  }

  [[nodiscard]] Scalar lack(const Scalar& d) const {
    if (is_in_last(d)) return d * (kink_ + d * (square_ + d * cube_));
    const Scalar m = reach_ - d;
    return Scalar(1) - piece_at(m).at(m);
  }
  [[nodiscard]] Scalar slope(const Scalar& d) const {
    if (is_in_last(d)) return kink_ + d * (Scalar(2) * square_ + Scalar(3) * d * cube_);
    const Scalar m = reach_ - d;
    return piece_at(m).slope_at(m);
  }
  [[nodiscard]] Scalar bend(const Scalar& d) const {
    if (is_in_last(d)) return Scalar(2) * square_ + Scalar(6) * d * cube_;
    const Scalar m = reach_ - d;
    return -piece_at(m).bend_at(m);
  }
  [[nodiscard]] Scalar height_beside(const Scalar& m) const { return m * chord(m); }
  /// G / m.
  [[nodiscard]] Scalar chord(const Scalar& m) const {
    const Piece& piece = piece_at(m);
    return piece.begin > 0 ? Scalar(piece.at(m) / m) : piece.chord_at(m);
  }
  [[nodiscard]] Scalar slope_beside(const Scalar& m) const { return piece_at(m).slope_at(m); }
  [[nodiscard]] Scalar chord(const Scalar& m1, const Scalar& m2) const {
    const Piece &of1 = piece_at(m1), &of2 = piece_at(m2);
    if (&of1 != &of2) return (of2.at(m2) - of1.at(m1)) / (m2 - m1);
    const Scalar x = m1 - of1.begin, y = m2 - of1.begin;
    return of1.slope + (of1.square * (x + y) + of1.cube * (x * x + (x * y + y * y)));
  }

  /// d(e), 0 < e < 1.
  [[nodiscard]] Scalar inverse(const Scalar& e) const {
    using std::sqrt;
    const Scalar& begin = pieces_.back().begin;
    const Scalar most = reach_ - begin;
    if (begin > 0 && e > lack(most)) return reach_ - distance(Scalar(Scalar(1) - e));
    if (square_ == 0 && cube_ == 0) return std::min(most, Scalar(e / kink_));
    const Scalar root = sqrt(e);
    const Scalar guess = kink_ > 0 ? first_guess(kink_, square_, e)
                                   : Scalar(root / sqrt(Scalar(square_ + cube_ * (most * root))));
    return solve(kink_, square_, cube_, e, guess, most);
  }
  /// m with G(m) = G, 0 < G < 1.
  [[nodiscard]] Scalar distance(const Scalar& G) const {
    std::size_t i = pieces_.size() - 1;
    while (i > 0 && G < pieces_[i].G0) --i;
    const Piece& piece = pieces_[i];
    const Scalar width = (i + 1 < pieces_.size() ? pieces_[i + 1].begin : reach_) - piece.begin;
    const Scalar more = G - piece.G0;
    if (piece.square == 0 && piece.cube == 0)
      return piece.begin + std::min(width, Scalar(more / piece.slope));
    return piece.begin + solve(piece.slope, piece.square, piece.cube, more,
                               first_guess(piece.slope, piece.square, more), width);
  }

 private:
  [[nodiscard]] bool is_in_last(const Scalar& d) const {
    return pieces_.size() == 1 || d <= reach_ - pieces_.back().begin;
  }
  /// Of a parabola; where that does not come so far, of a line.
  [[nodiscard]] static Scalar first_guess(const Scalar& slope, const Scalar& square, const Scalar& y) {
    using std::sqrt;
    const Scalar under = slope * slope + Scalar(4) * square * y;
    return Scalar(2) * y / (slope + (under > 0 ? Scalar(sqrt(under)) : Scalar(0)));
  }
  /// x of [0, most] with x (slope + x (square + x cube)) = y, of which that rises with x: by Halley's steps, the error after one being of the
  /// size of its cube.
  [[nodiscard]] static Scalar solve(const Scalar& slope, const Scalar& square, const Scalar& cube,
                                    const Scalar& y, const Scalar& guess, const Scalar& most) {
    static const Scalar close(std::ldexp(1.0, -4 - std::numeric_limits<Scalar>::digits / 3));
    const Scalar zero(0), half(0.5), one(1), two(2), three(3);
    Scalar x = guess < most ? guess : most, lo = zero, hi = most;
    constexpr int kMostSteps = 200;
    for (int n = 0; n < kMostSteps; ++n) {
      const Scalar over = x * (slope + x * (square + x * cube)) - y, x3 = three * x * cube,
                   by = slope + x * (two * square + x3);
      (over > 0 ? hi : lo) = x;
      Scalar step = over / by;
      if (const Scalar bow = step * (square + x3) / by; bow < half) step /= one - bow;
      if ((step < 0 ? Scalar(-step) : step) <= close * x) return std::min(most, Scalar(x - step));
      Scalar next = x - step;
      if (!(next > lo && next < hi)) {
        if (next >= most && hi == most && x < most) {
          next = most;
        } else {
          next = lo + (hi - lo) * half;
          if (!(next > lo && next < hi)) break;
        }
      }
      x = next;
    }
    return x;
  }

  Scalar reach_;
  std::vector<Piece> pieces_;
  Scalar kink_, square_, cube_;
};

}  // namespace shearfront::exact
