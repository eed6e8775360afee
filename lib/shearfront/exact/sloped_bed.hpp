// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/sloped_crossing.hpp"
#include "shearfront/exact/sloped_stretches.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// Pieces in which the rate r = s a is linear or exponential in z; it may jump between them.
template <Real Scalar>
struct SlopedPieces {
  std::vector<Scalar> boundaries;
  std::vector<Scalar> low, high;   ///< r at the lower and upper end of each piece
  std::vector<std::size_t> piece;  ///< to which each cell belongs
  std::vector<RateForm> form;
  std::vector<Scalar> bend;  ///< exact/rate_form.hpp; its sign is that of the slope

  SlopedPieces(std::vector<Scalar> heights, std::vector<Scalar> lows, std::vector<Scalar> highs,
               std::vector<RateForm> forms)
      : boundaries(std::move(heights)), low(std::move(lows)), high(std::move(highs)), form(std::move(forms)) {
    for (std::size_t k = 0; k < size(); ++k) {
      if (low[k] == high[k]) form[k] = RateForm::linear;
      bend.push_back(bend_between(form[k], low[k], high[k], width(k)));
    }
  }

  [[nodiscard]] std::size_t size() const { return low.size(); }
  [[nodiscard]] Scalar width(std::size_t k) const { return boundaries[k + 1] - boundaries[k]; }
  /// dr/dz at the end of a piece, seen from inside.
  [[nodiscard]] Scalar end_slope(std::size_t k, bool is_high) const {
    return slope_at(form[k], bend[k], is_high ? high[k] : low[k]);
  }
  /// An inner boundary belongs to the piece above it, the top to the last.
  [[nodiscard]] std::size_t piece_at(const Scalar& z) const {
    const auto it = std::upper_bound(boundaries.begin() + 1, boundaries.end() - 1, z);
    return static_cast<std::size_t>(it - boundaries.begin()) - 1;
  }
  /// r at a height of piece k, from the nearer end.
  [[nodiscard]] Scalar rate(std::size_t k, const Scalar& z) const {
    const Scalar below = z - boundaries[k], above = boundaries[k + 1] - z;
    return below < above ? rate_beyond(form[k], bend[k], low[k], below)
                         : rate_beyond(form[k], bend[k], high[k], Scalar(-above));
  }
};

/// The bed as a path sees it that sets out upwards, cut at all boundaries and all initial jumps. The other view, of
/// those that set out downwards, is the same turned upside down: heights -z, momenta 1 - p, amounts as they are.
template <Real Scalar>
struct SlopedView {
  bool is_mirror = false;
  std::vector<Scalar> x;           ///< nodes, ascending
  std::vector<Scalar> M;           ///< int phi(z, 0) dz from the true bottom, at the nodes
  std::vector<Scalar> low, high;   ///< r at the ends of each cell
  std::vector<std::size_t> piece;  ///< to which each cell belongs
  std::vector<RateForm> form;
  std::vector<Scalar> bend;  ///< of r in each cell
  std::vector<RelativeBends<Scalar>> bends;
  std::vector<Scalar> p,
      missing;  ///< initial state of each cell, and what it lacks to 1; of a curved one at its lower end
  std::vector<Scalar> p_high;                       ///< at its upper end
  std::vector<Scalar> q0;                           ///< 2 p - 1
  std::vector<Scalar> pure_time;                    ///< int dz / r over each cell
  std::vector<bool> emits;                          ///< a fan can leave the node upwards
  std::shared_ptr<const StartShape<Scalar>> shape;  ///< of a smooth start

  SlopedView(const SlopedPieces<Scalar>& pieces, const Cells<Scalar>& cells, bool mirrored)
      : is_mirror(mirrored), M(cells.M), shape(cells.shape) {
    const Scalar one(1);
    for (const Scalar& z : cells.x) x.push_back(mirrored ? Scalar(-z) : z);
    for (std::size_t i = 0; i < cells.n_cells(); ++i) {
      const std::size_t k = cells.layer[i];
      const Scalar lo = cells.x[i] == pieces.boundaries[k] ? pieces.low[k] : pieces.rate(k, cells.x[i]);
      const Scalar hi =
          cells.x[i + 1] == pieces.boundaries[k + 1] ? pieces.high[k] : pieces.rate(k, cells.x[i + 1]);
      low.push_back(mirrored ? hi : lo);
      high.push_back(mirrored ? lo : hi);
      piece.push_back(k);
      form.push_back(pieces.form[k]);
      bend.push_back(mirrored ? Scalar(-pieces.bend[k]) : pieces.bend[k]);
      const Scalar &phi = mirrored ? cells.phi_high[i] : cells.phi[i],
                   &phi_high = mirrored ? cells.phi[i] : cells.phi_high[i];
      p.push_back(mirrored ? Scalar(one - phi) : phi);
      p_high.push_back(mirrored ? Scalar(one - phi_high) : phi_high);
      missing.push_back(mirrored ? phi : Scalar(one - phi));
      q0.push_back(mirrored ? Scalar(one - Scalar(2) * phi) : Scalar(Scalar(2) * phi - one));
    }
    if (mirrored) {
      for (auto* all : {&x, &M, &low, &high, &bend, &p, &p_high, &missing, &q0})
        std::reverse(all->begin(), all->end());
      std::reverse(form.begin(), form.end());
      std::reverse(piece.begin(), piece.end());
    }
    for (std::size_t i = 0; i < n_cells(); ++i) bends.emplace_back(form[i], bend[i], low[i], high[i]);
    emits.assign(x.size(), false);
    for (std::size_t i = 0; i < n_cells(); ++i) {
      pure_time.push_back(Crossing<Scalar>(form[i], x[i + 1] - x[i], low[i], one, high[i], one, Scalar(0)).T);
      emits[i] = i > 0 && may_emit(i);
    }
  }

  [[nodiscard]] std::size_t n_cells() const { return low.size(); }
  [[nodiscard]] bool is_jump(std::size_t node) const { return high[node - 1] != low[node]; }
  /// r at a height of a cell, from the nearer end.
  [[nodiscard]] Scalar rate(std::size_t cell, const Scalar& z) const {
    const Scalar below = z - x[cell], above = x[cell + 1] - z;
    const Scalar r = below < above ? rate_beyond(form[cell], bend[cell], low[cell], below)
                                   : rate_beyond(form[cell], bend[cell], high[cell], Scalar(-above));
    return std::clamp(r, std::min(low[cell], high[cell]), std::max(low[cell], high[cell]));
  }
  [[nodiscard]] bool is_curved(std::size_t cell) const { return shape && p[cell] != p_high[cell]; }
  /// Initial amount below a height of a cell, in the true orientation.
  [[nodiscard]] Scalar amount(std::size_t cell, const Scalar& z) const {
    if (is_curved(cell))
      return M[cell] + (is_mirror ? Scalar(-shape->amount(piece[cell], Scalar(-z), Scalar(-x[cell])))
                                  : shape->amount(piece[cell], x[cell], z));
    return is_mirror ? Scalar(M[cell] - missing[cell] * (z - x[cell]))
                     : Scalar(M[cell] + p[cell] * (z - x[cell]));
  }
  /// The least of the same in a cell.
  [[nodiscard]] Scalar least_amount(std::size_t cell) const { return std::min(M[cell], M[cell + 1]); }
  /// 4 H of the state of a cell where the rate is r.
  [[nodiscard]] Scalar h(std::size_t cell, const Scalar& r) const {
    return Scalar(4) * p[cell] * missing[cell] * r;
  }

  /// A path rests at a node at its capacity if leaving it to either side only gains capacity: at jumps next to whose
  /// lower side the rate does not fall, at kinks with a minimum, at the ends of flat minima.
  [[nodiscard]] bool is_throat(std::size_t node) const {
    const Scalar &below = high[node - 1], &above = low[node];
    if (below < above) return !(bend[node - 1] > 0);
    if (below > above) return !(bend[node] < 0);
    return !(bend[node - 1] > 0) && !(bend[node] < 0) && (bend[node - 1] != 0 || bend[node] != 0);
  }
  [[nodiscard]] Scalar throat_h(std::size_t node) const { return std::min(high[node - 1], low[node]); }

 private:
  /// Moving the start must not pay: state below <= p on its lower side, p on its upper side <= state above; upwards p >=
  /// 1/2. The slack keeps rounding from dropping a borderline source.
  [[nodiscard]] bool may_emit(std::size_t node) const {
    const Scalar slack = Scalar(1) / Scalar(1 << 20), one(1);
    const std::size_t b = node - 1, a = node;
    if (!(p_high[b] < p[a]) && !is_jump(node)) return false;
    if (q0[a] < -slack) return false;
    const Scalar least = q0[a] > 0 ? h(a, low[a]) : low[a];
    const Scalar below =
        p_high[b] + p_high[b] > one ? Scalar(Scalar(4) * p_high[b] * (one - p_high[b]) * high[b]) : high[b];
    const Scalar most = std::min(low[a], below);
    // Between pure states a fan is no more than the path of the state, which is no moving one.
    return most > 0 && least <= most * (one + slack);
  }
};

/// A height of a view with the cells below and above it, the same one inside a cell, and r there.
template <Real Scalar>
struct SlopedPlace {
  Scalar z;
  std::size_t below, above;
  Scalar rate_below, rate_above;

  SlopedPlace(const SlopedView<Scalar>& view, const Scalar& height) : z(height) {
    const auto it = std::upper_bound(view.x.begin() + 1, view.x.end() - 1, z);
    above = static_cast<std::size_t>(it - view.x.begin()) - 1;
    below = above > 0 && z == view.x[above] ? above - 1 : above;
    rate_above = view.rate(above, z);
    rate_below = below == above ? rate_above : view.rate(below, z);
  }
  [[nodiscard]] SlopedPlace turned_over(const SlopedView<Scalar>& view) const {
    SlopedPlace place = *this;
    place.z = -z;
    place.below = view.n_cells() - 1 - above;
    place.above = view.n_cells() - 1 - below;
    std::swap(place.rate_below, place.rate_above);
    return place;
  }
};

}  // namespace shearfront::exact
