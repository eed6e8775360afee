// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/law_run.hpp"
#include "shearfront/exact/sloped_crossing.hpp"
#include "shearfront/exact/sloped_stretches.hpp"
#include "shearfront/exact/sloped_turn_times.hpp"
#include "shearfront/numeric/contract.hpp"
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

/// The fluxes of pieces that are no parabolas.
template <Real Scalar>
struct PieceFluxes {
  std::vector<InverseFlux<Scalar>> fluxes;
  std::vector<std::size_t> of_piece;
  std::vector<Scalar> still;  ///< where a smooth start rises through the peak of a flux with a kink

  [[nodiscard]] const InverseFlux<Scalar>& flux(std::size_t piece) const { return fluxes[of_piece[piece]]; }
  [[nodiscard]] LawSide<Scalar> side(std::size_t piece, bool is_up) const { return {flux(piece), is_up}; }
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
  std::vector<Scalar> p_high;     ///< at its upper end
  std::vector<Scalar> crest;      ///< where in each curved cell h is largest; none without a smooth start
  std::vector<Scalar> q0;         ///< 2 p - 1, or twice the distance from the peak
  std::vector<Scalar> G0, e0;     ///< 4 H over r, and what it lacks to 1
  std::vector<Scalar> pure_time;  ///< of a pure state upwards through each cell
  std::vector<Scalar> pure_back;  ///< and downwards
  std::vector<RunEnds<Scalar>> upwards, downwards;  ///< through each cell
  std::vector<bool> emits;                          ///< a fan can leave the node upwards
  std::size_t first_start = 0;  ///< no cell below it has a state that moves upwards, nor its upper node a fan
  std::size_t end_of_starts = 0,
              end_of_falls = 0;  ///< nor this cell and above, but pure ones; no r falls there
  SlopedTurnTimes<Scalar> turn_times;
  std::shared_ptr<const StartShape<Scalar>> shape;    ///< of a smooth start
  std::shared_ptr<const PieceFluxes<Scalar>> fluxes;  ///< none: all are parabolas

  SlopedView(const SlopedPieces<Scalar>& pieces, const Cells<Scalar>& cells, bool mirrored,
             std::shared_ptr<const PieceFluxes<Scalar>> of_pieces = nullptr)
      : is_mirror(mirrored), M(cells.M), shape(cells.shape), fluxes(std::move(of_pieces)) {
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
    set_fluxes();
    set_crests();
    emits.assign(x.size(), false);
    for (std::size_t i = 0; i < n_cells(); ++i) {
      pure_time.push_back(pure_way(i, x[i + 1] - x[i], low[i], high[i], true));
      pure_back.push_back(fluxes ? pure_way(i, x[i + 1] - x[i], low[i], high[i], false) : pure_time.back());
    }
    for (std::size_t i = 1; i < n_cells(); ++i) emits[i] = may_emit(i);
    for (std::size_t i = 0; i < n_cells(); ++i) {
      upwards.emplace_back(form[i], Scalar(x[i + 1] - x[i]), low[i], high[i]);
      downwards.emplace_back(form[i], Scalar(x[i + 1] - x[i]), high[i], low[i]);
    }
    set_extent();
    turn_times.prepare(*this);
  }

  /// Whether the state of a cell moves upwards with H > 0, somewhere in the cell.
  [[nodiscard]] bool has_moving_state(std::size_t cell) const {
    if (is_curved(cell)) return std::max(p[cell], p_high[cell]) > peak(cell);
    return p[cell] > 0 && missing[cell] > 0 && (q0[cell] > 0 || (q0[cell] == 0 && bend[cell] > 0));
  }

  /// The same with a node at a height of a cell, which it makes of `view`: one and the same for many queries needs no memory.
  void put_node(std::size_t cell, const Scalar& z, const Scalar& r, SlopedView& view) const {
    view = *this;
    const auto insert = [&](auto& all, std::size_t at, const auto& value) {
      all.insert(all.begin() + static_cast<std::ptrdiff_t>(at), value);
    };
    const auto twice = [&](auto& all) { insert(all, cell, decltype(all[cell] + Scalar(0))(all[cell])); };
    insert(view.x, cell + 1, z);
    insert(view.M, cell + 1, amount(cell, z));
    insert(view.low, cell + 1, r);
    insert(view.high, cell, r);
    for (auto* all : {&view.bend, &view.p, &view.p_high, &view.missing, &view.q0, &view.G0, &view.e0})
      twice(*all);
    if (is_curved(cell)) {
      const State state = state_at(cell, z);
      view.p_high[cell] = view.p[cell + 1] = state.p;
      view.missing[cell + 1] = state.missing;
      view.q0[cell + 1] = state.q0;
      view.G0[cell + 1] = state.G;
      view.e0[cell + 1] = state.lack;
    }
    if (shape) {
      view.crest[cell] = std::min(crest[cell], z);
      insert(view.crest, cell + 1, std::max(crest[cell], z));
    }
    insert(view.piece, cell, piece[cell]);
    insert(view.form, cell, form[cell]);
    insert(view.bends, cell, bends[cell]);
    view.emits.insert(view.emits.begin() + static_cast<std::ptrdiff_t>(cell) + 1, false);
    const Scalar below = z - x[cell], above = x[cell + 1] - z;
    view.pure_time[cell] = pure_way(cell, below, low[cell], r, true);
    view.pure_back[cell] = pure_way(cell, below, low[cell], r, false);
    insert(view.pure_time, cell + 1, pure_way(cell, above, r, high[cell], true));
    insert(view.pure_back, cell + 1, pure_way(cell, above, r, high[cell], false));
    view.upwards[cell] = {form[cell], below, low[cell], r};
    view.downwards[cell] = {form[cell], below, r, low[cell]};
    insert(view.upwards, cell + 1, RunEnds<Scalar>(form[cell], above, r, high[cell]));
    insert(view.downwards, cell + 1, RunEnds<Scalar>(form[cell], above, high[cell], r));
    view.set_extent();
  }

  /// A state as the view sees it: what it lacks to 1, twice its distance from the peak, 4 H over r, and what that lacks to 1.
  struct State {
    Scalar p, missing, q0, G, lack;
  };
  [[nodiscard]] State state_of(std::size_t cell, const Scalar& p_of, const Scalar& missing_of) const {
    const Scalar half(0.5), one(1);
    State state{p_of, missing_of, p_of - missing_of, Scalar(0), one};
    if (!fluxes) {
      state.G = Scalar(4) * p_of * missing_of;
      state.lack = state.q0 * state.q0;
      return state;
    }
    const InverseFlux<Scalar>& flux = fluxes->flux(piece[cell]);
    const Scalar u = is_mirror ? missing_of : p_of;
    const bool is_up = u > flux.peak();
    const Scalar over = u - flux.peak(), d = is_up ? over : Scalar(-over);
    state.q0 = Scalar(2) * (is_mirror ? Scalar(-over) : over);
    if (u == 0 || u == 1) return state;
    state.lack = flux.lack(d, is_up);
    state.G =
        state.lack > half ? flux.flux_beside(is_up ? Scalar(one - u) : u, is_up) : Scalar(one - state.lack);
    return state;
  }
  /// The state of a curved cell at a height.
  [[nodiscard]] State state_at(std::size_t cell, const Scalar& y) const {
    const Scalar phi = shape->state(piece[cell], is_mirror ? Scalar(-y) : y), other = Scalar(1) - phi;
    return is_mirror ? state_of(cell, other, phi) : state_of(cell, phi, other);
  }
  /// Where the flux of a cell is largest.
  [[nodiscard]] Scalar peak(std::size_t cell) const {
    if (!fluxes) return Scalar(0.5);
    const Scalar& of = fluxes->flux(piece[cell]).peak();
    return is_mirror ? Scalar(Scalar(1) - of) : of;
  }

  /// At least int p dz of paths that rise by `rise` from a throat, or fall.
  [[nodiscard]] Scalar least_lean(const Scalar& rise) const {
    if (!fluxes) return rise / Scalar(2);
    Scalar least(1), most(0);
    for (const auto& flux : fluxes->fluxes) {
      least = std::min(least, flux.peak());
      most = std::max(most, flux.peak());
    }
    return rise * (rise > 0 ? least : most);
  }
  /// One side of the flux in a cell, as paths upwards in the view see it, or downwards.
  [[nodiscard]] LawSide<Scalar> side(std::size_t cell, bool is_up) const {
    return fluxes->side(piece[cell], is_up != is_mirror);
  }
  /// Time of a pure state over d in a cell.
  [[nodiscard]] Scalar pure_way(std::size_t cell, const Scalar& d, const Scalar& r1, const Scalar& r2,
                                bool is_up) const {
    const Scalar one(1);
    if (!fluxes) return Crossing<Scalar>(form[cell], d, r1, one, r2, one, Scalar(0)).T;
    const LawSide<Scalar> of = side(cell, is_up);
    const LawState<Scalar> pure{of.reach(), Scalar(0)};
    return LawRun<Scalar>(of, form[cell], bend[cell], d, r1, pure, r2, pure, Scalar(0)).T;
  }

  [[nodiscard]] std::size_t n_cells() const { return low.size(); }
  /// Of what H depends on besides the state.
  [[nodiscard]] bool is_jump(std::size_t node) const {
    return high[node - 1] != low[node] ||
           (fluxes && fluxes->of_piece[piece[node - 1]] != fluxes->of_piece[piece[node]]);
  }
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
  [[nodiscard]] Scalar h(std::size_t cell, const Scalar& r) const { return G0[cell] * r; }

  /// A path rests at a node at its capacity if leaving it to either side only gains capacity: at jumps next to whose
  /// lower side the rate does not fall, at kinks with a minimum, at the ends of flat minima; and so it may where a piece is flat but for
  /// rounding of the heights from which it would have to come instead.
  [[nodiscard]] bool is_throat(std::size_t node) const {
    const Scalar &below = high[node - 1], &above = low[node];
    const bool rises = bend[node - 1] > 0 && !is_nearly_flat(node - 1),
               falls = bend[node] < 0 && !is_nearly_flat(node);
    if (below < above) return !rises;
    if (below > above) return !falls;
    return !rises && !falls && (bend[node - 1] != 0 || bend[node] != 0) && piece[node - 1] != piece[node];
  }
  [[nodiscard]] bool is_nearly_flat(std::size_t cell) const {
    return bends[cell].most * (x.back() - x.front()) < Scalar(0x1p-20);
  }
  [[nodiscard]] Scalar throat_h(std::size_t node) const { return std::min(high[node - 1], low[node]); }

 private:
  void set_extent() {
    first_start = n_cells();
    end_of_starts = end_of_falls = 0;
    for (std::size_t i = 0; i < n_cells(); ++i) {
      const bool is_start = has_moving_state(i) || (i + 1 < n_cells() && emits[i + 1]);
      if (is_start) end_of_starts = i + 1;
      if (bend[i] < 0) end_of_falls = i + 1;
      if (first_start == n_cells() && (is_start || missing[i] == 0)) first_start = i;
    }
  }
  /// What a curved cell can send upwards through its upper end.
  [[nodiscard]] Scalar most_at_top(std::size_t cell) const {
    const Scalar& u = p_high[cell];
    return u > peak(cell) ? Scalar(state_of(cell, u, Scalar(Scalar(1) - u)).G * high[cell]) : high[cell];
  }
  void set_fluxes() {
    for (std::size_t i = 0; i < n_cells(); ++i) {
      const State state = state_of(i, p[i], missing[i]);
      if (fluxes) q0[i] = state.q0;
      G0.push_back(state.G);
      e0.push_back(fluxes ? state.lack : Scalar(q0[i] * q0[i]));
    }
  }

  /// Parts of a smooth start are so short that h has one maximum there, if any.
  void set_crests() {
    if (!shape) return;
    for (std::size_t i = 0; i < n_cells(); ++i) {
      if (!is_curved(i)) {
        crest.push_back(x[i]);
        continue;
      }
      const auto height = [&](const Scalar& part) { return Scalar(x[i] + (x[i + 1] - x[i]) * part); };
      const auto less = [&](const Scalar& part) {
        const Scalar y = height(part);
        return Scalar(-state_at(i, y).G * rate(i, y));
      };
      constexpr int kBits = 26;
      const auto [part, least] = boost::math::tools::brent_find_minima(less, Scalar(0), Scalar(1), kBits);
      const bool is_monotone = !(less(Scalar(0)) > least) || !(less(Scalar(1)) > least);
      crest.push_back(is_monotone ? x[i] : height(part));
    }
  }

  /// A part of a smooth start so narrow that its heights hardly tell its states apart: from its end a fan sets out as from a jump.
  [[nodiscard]] bool is_thin(std::size_t cell) const {
    return is_curved(cell) && x[cell + 1] - x[cell] < Scalar(0x1p-26) * (x.back() - x.front());
  }
  /// A state at the peak of a flux with a kink moves at any speed between those of both sides, for as long as the rate beside it is the
  /// same.
  [[nodiscard]] bool is_still(std::size_t node) const {
    return fluxes && std::binary_search(fluxes->still.begin(), fluxes->still.end(),
                                        is_mirror ? Scalar(-x[node]) : x[node]);
  }

  /// Moving the start must not pay: state below <= p on its lower side, p on its upper side <= state above; upwards p >=
  /// 1/2. The slack keeps rounding from dropping a borderline source.
  [[nodiscard]] bool may_emit(std::size_t node) const {
    const Scalar slack = Scalar(1) / Scalar(1 << 20), one(1);
    const std::size_t b = node - 1, a = node;
    const bool is_steep = is_thin(b) && p[b] < p_high[b];
    if (!(p_high[b] < p[a]) && !is_jump(node) && !is_steep) return is_still(node);
    if (q0[a] < -slack) return false;
    const Scalar least = q0[a] > 0 ? h(a, low[a]) : low[a];
    const Scalar most = std::min(low[a], is_curved(b) && !is_steep ? most_at_top(b)
                                         : q0[b] > 0               ? h(b, high[b])
                                                                   : high[b]);
    // Between pure states a fan is no more than the path of the state, which is no moving one.
    return most > 0 && least <= most * (one + slack);
  }
};

}  // namespace shearfront::exact
