// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>

#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/sloped_bed.hpp"

namespace shearfront::exact {

/// Where derivatives along a path through sloped pieces are gathered: the rates at both ends of each piece, and the boundaries.
template <Real Scalar>
class PieceNumbers {
 public:
  using Pair = typename PathGradient<Scalar>::Pair;

  /// `out` for pieces `lowest` to `highest` and their neighbours.
  PieceNumbers(const SlopedPieces<Scalar>& pieces, PathGradient<Scalar>& out) : pieces_(pieces), out_(out) {}
  void make_room(std::size_t lowest, std::size_t highest) {
    out_.first = lowest > 0 ? lowest - 1 : 0;
    highest = std::min(highest + 1, pieces_.size() - 1);
    out_.pieces.resize(2 * (highest - out_.first + 1));
    out_.boundaries.resize(highest - out_.first + 1);
  }

  [[nodiscard]] Scalar at(std::size_t k, const Scalar& z) const { return pieces_.rate(k, z); }
  /// Derivatives of the rate at z by the rates at both ends of its piece, which has the rate `rate` there.
  struct EndParts {
    Scalar low, high;
  };
  [[nodiscard]] EndParts parts(std::size_t k, const Scalar& z) const {
    const Scalar high = (z - pieces_.boundaries[k]) / pieces_.width(k), low = Scalar(1) - high;
    if (pieces_.form[k] == RateForm::linear) return {low, high};
    const Scalar rate = at(k, z);
    return {low * (rate / pieces_.low[k]), high * (rate / pieces_.high[k])};
  }
  [[nodiscard]] Pair& number(std::size_t k, bool is_high) {
    return out_.pieces[2 * (k - out_.first) + (is_high ? 1 : 0)];
  }
  /// Adds to the numbers of piece k what the rate at z does.
  void add_at(std::size_t k, const Scalar& z, const Scalar& M, const Scalar& phi) {
    const auto [low, high] = parts(k, z);
    number(k, false).M += low * M;
    number(k, false).phi += low * phi;
    number(k, true).M += high * M;
    number(k, true).phi += high * phi;
  }
  /// The same at an end of the piece.
  void add_at_end(std::size_t k, bool is_high, const Scalar& M, const Scalar& phi) {
    number(k, is_high).M += M;
    number(k, is_high).phi += phi;
  }
  [[nodiscard]] Pair& boundary(std::size_t k) { return out_.boundaries[k - out_.first]; }
  /// Forgets what phi has gathered.
  void clear_phi() {
    for (Pair& pair : out_.pieces) pair.phi = Scalar(0);
    for (Pair& pair : out_.boundaries) pair.phi = Scalar(0);
  }
  void multiply_phi(const Scalar& factor) {
    for (Pair& pair : out_.pieces) pair.phi *= factor;
    for (Pair& pair : out_.boundaries) pair.phi *= factor;
  }
  /// Moving a boundary between the slopes b_- and b_+ changes r next to it as changing the rates there by -b_- and -b_+ does.
  void move_boundaries() {
    for (std::size_t n = 1; n < out_.boundaries.size(); ++n) {
      const std::size_t k = out_.first + n;
      const Pair &below = number(k - 1, true), &above = number(k, false);
      const Scalar slope_below = pieces_.end_slope(k - 1, true), slope_above = pieces_.end_slope(k, false);
      out_.boundaries[n].M -= slope_below * below.M + slope_above * above.M;
      out_.boundaries[n].phi -= slope_below * below.phi + slope_above * above.phi;
    }
  }

 private:
  const SlopedPieces<Scalar>& pieces_;
  PathGradient<Scalar>& out_;
};

}  // namespace shearfront::exact
