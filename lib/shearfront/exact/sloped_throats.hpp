// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_curved.hpp"
#include "shearfront/exact/sloped_place.hpp"
#include "shearfront/exact/sloped_route.hpp"

namespace shearfront::exact {

/// Time and gain of a run at a fixed h away from a throat: int p dz = the height gained on ways up + gain, gain <= 0. The
/// time is infinite where it cannot go.
template <Real Scalar>
struct SlopedWay {
  Scalar T{0}, gain{0};
  Scalar excess{
      0};  ///< r - h where it has come to: next to a throat by how r runs, for the rates there may be equal

  /// Over d through cell k, or a part of it, in which r goes from r1 to r2 and has the bend `bend` that way; the path moves up there or
  /// down.
  void add(const SlopedView<Scalar>& view, std::size_t k, bool moves_up, const Scalar& bend, const Scalar& d,
           const Scalar& r1, const Scalar& r2, const Scalar& h, bool is_new_piece) {
    if (is_new_piece) {
      excess = r1 - h;
      if (excess < 0) T = infinity<Scalar>();  // a jump is in its way
    }
    if (!(d > 0) || !is_finite(T)) return;
    const Scalar e1 = std::max(Scalar(0), excess) / r1;
    excess += rise_of(view.form[k], bend, r1, d);
    if (excess < 0)
      T = infinity<Scalar>();
    else
      add_run(view, k, moves_up, bend, d, r1, e1, r2, Scalar(excess / r2), h);
  }
  /// By what the path lacks to the capacities at both ends.
  void add_run(const SlopedView<Scalar>& view, std::size_t k, bool moves_up, const Scalar& bend,
               const Scalar& d, const Scalar& r1, const Scalar& e1, const Scalar& r2, const Scalar& e2,
               const Scalar& h) {
    using std::sqrt;
    if (!view.fluxes) return add_costs(Crossing<Scalar>(view.form[k], d, r1, sqrt(e1), r2, sqrt(e2), h), h);
    const LawSide<Scalar> side = view.side(k, moves_up);
    add_costs(LawRun<Scalar>(side, view.form[k], bend, d, r1, side.at(e1, Scalar(h / r1)), r2,
                             side.at(e2, Scalar(h / r2)), h),
              h);
  }

 private:
  template <class Run>
  void add_costs(const Run& run, const Scalar& h) {
    T += run.T;
    if (is_finite(run.T)) gain += run.X - h / Scalar(4) * run.T;
  }
};

/// Paths that rest at a throat: which starts reach it, when and at which cost. A later start counts only if it costs less.
template <Real Scalar>
class SlopedThroats {
 public:
  struct Start {
    Scalar T;            ///< it arrives
    Scalar A;            ///< M0 at the start + int p dz to the throat
    Scalar foot;         ///< true height
    std::size_t source;  ///< node, or cell, in the true orientation
    bool is_state;
  };
  struct Throat {
    std::size_t node;  ///< in the true orientation
    Scalar h;
    std::vector<Start> starts;    ///< T ascending, A descending
    std::size_t lowest, highest;  ///< nodes that a path at h can reach from it
  };

  SlopedThroats(const SlopedView<Scalar>& up, const SlopedView<Scalar>& down) {
    for (std::size_t i = 1; i < up.n_cells(); ++i) {
      if (!up.is_throat(i)) continue;
      Throat throat{i, up.throat_h(i), {}, i, i};
      throat.starts.push_back({Scalar(0), up.M[i], up.x[i], i, false});
      collect(up, i, throat);
      collect(down, up.n_cells() - i, throat);
      keep_useful(throat.starts);
      all_.push_back(std::move(throat));
    }
  }

  /// The best path to a place that rests.
  void search(const SlopedView<Scalar>& up, const SlopedPlace<Scalar>& place, const Scalar& t,
              const Scalar& upper, Path<Scalar>& best) const {
    const Scalar &z = place.z, &rate_below = place.rate_below, &rate_above = place.rate_above;
    const std::size_t cell_below = place.below, cell_above = place.above;
    for (const Throat& throat : all_) {
      const Scalar& z_i = up.x[throat.node];
      const bool is_above = z > z_i;
      // The way leads to the cell of z over nodes that are no narrower.
      if (is_above ? throat.highest < cell_below : z < z_i && throat.lowest > cell_above + 1) continue;
      if (is_above ? rate_below < throat.h : z < z_i && rate_above < throat.h) continue;
      const Scalar H = throat.h / Scalar(4), gained = is_above ? Scalar(z - z_i) : Scalar(0);
      const Scalar limit = std::min(upper, best.value);
      const Scalar shift = up.least_lean(z - z_i) + H * t;  // at the peak all the way
      if (throat.starts.back().A + shift > limit) continue;
      SlopedWay<Scalar> way;
      if (is_above) {
        std::size_t k = throat.node;
        for (; k < cell_below && way.T <= t; ++k) cross(up, k, true, true, throat.node, throat.h, way);
        if (!(way.T <= t)) continue;  // not in the cell of z
        way.add(up, k, true, up.bend[k], z - up.x[k], up.low[k], rate_below, throat.h,
                is_new_piece(up, k, true, throat.node));
      } else if (z < z_i) {
        std::size_t k = throat.node - 1;
        for (; k > cell_above && way.T <= t; --k) cross(up, k, false, false, throat.node, throat.h, way);
        if (!(way.T <= t)) continue;
        way.add(up, k, false, Scalar(-up.bend[k]), up.x[k + 1] - z, up.high[k], rate_above, throat.h,
                is_new_piece(up, k, false, throat.node));
      }
      if (!(way.T <= t)) continue;
      const Scalar left = t - way.T;
      const auto late = std::upper_bound(throat.starts.begin(), throat.starts.end(), left,
                                         [](const Scalar& time, const Start& s) { return time < s.T; });
      if (late == throat.starts.begin()) continue;
      const Start& start = *(late - 1);
      Path<Scalar> path;
      path.value = start.A + gained + way.gain + H * t;
      if (path.value > best.value) continue;
      path.H = H;
      path.r_reference = throat.h;
      path.x = Scalar(0);
      path.kind = PathKind::waiting;
      path.upward = !(z < z_i);
      path.is_state = start.is_state;
      path.source = start.source;
      path.interface = throat.node;
      path.foot = start.foot;
      if (path.better_than(best)) best = path;
    }
  }

  [[nodiscard]] const std::vector<Throat>& all() const { return all_; }

 private:
  /// Whether the way from a throat enters cell k at the throat or from another piece.
  [[nodiscard]] static bool is_new_piece(const SlopedView<Scalar>& view, std::size_t k, bool is_upward,
                                         std::size_t node) {
    return is_upward ? k == node || view.piece[k - 1] != view.piece[k]
                     : k + 1 == node || view.piece[k + 1] != view.piece[k];
  }
  static void cross(const SlopedView<Scalar>& view, std::size_t k, bool is_upward, bool moves_up,
                    std::size_t node, const Scalar& h, SlopedWay<Scalar>& way) {
    way.add(view, k, moves_up, is_upward ? view.bend[k] : Scalar(-view.bend[k]), view.x[k + 1] - view.x[k],
            is_upward ? view.low[k] : view.high[k], is_upward ? view.high[k] : view.low[k], h,
            is_new_piece(view, k, is_upward, node));
  }

  /// Starts below the node in this view.
  void collect(const SlopedView<Scalar>& view, std::size_t node, Throat& throat) {
    const Scalar& h = throat.h;
    const std::size_t n = view.n_cells();
    SlopedWay<Scalar> way;
    for (std::size_t k = node; k-- > 0;) {
      if (view.high[k] < h) return;
      const auto add = [&](const Scalar& y, const SlopedWay<Scalar>& to, bool is_state) {
        if (!is_finite(to.T)) return;
        Start start{to.T, view.amount(k, y) + to.gain, view.is_mirror ? Scalar(-y) : y, 0, is_state};
        if (!view.is_mirror) start.A += view.x[node] - y;
        const std::size_t cell = view.is_mirror ? n - 1 - k : k;
        start.source = is_state ? cell : view.is_mirror ? n - k : k;
        throat.starts.push_back(start);
      };
      const Scalar G0 = view.is_curved(k) ? Scalar(0) : view.G0[k];
      const Scalar excess = is_new_piece(view, k, false, node) ? Scalar(view.high[k] - h) : way.excess;
      if (view.is_curved(k)) {
        // The starts whose state has the h of the throat, on both sides of where h is largest.
        const auto over = [&](const Scalar& y) { return view.state_at(k, y).q0; };
        const auto more = [&](const Scalar& y) -> std::optional<Scalar> {
          return Scalar(view.state_at(k, y).G * view.rate(k, y) - h);
        };
        const auto find = [&](Scalar lo, Scalar hi) {
          if (!(lo < hi) || !keep_where<Scalar>(over, lo, hi)) return;
          const std::optional<Scalar> y = sign_change<Scalar>(more, lo, hi);
          if (!y) return;
          SlopedWay<Scalar> to = way;
          to.add_run(view, k, true, Scalar(-view.bend[k]), Scalar(view.x[k + 1] - *y), view.high[k],
                     Scalar(std::max(Scalar(0), excess) / view.high[k]), view.rate(k, *y),
                     view.state_at(k, *y).lack, h);
          add(*y, to, true);
        };
        find(view.x[k], view.crest[k]);
        find(view.crest[k], view.x[k + 1]);
      }
      if (view.q0[k] > 0 && G0 > 0 && view.bend[k] != 0) {
        // Its start, from the end where r is least.
        const Scalar r = h / G0, q2 = view.e0[k], width = view.x[k + 1] - view.x[k];
        const bool is_rising = view.bend[k] > 0;
        const Scalar& least = is_rising ? view.low[k] : view.high[k];
        const Scalar over =
            is_rising ? Scalar(excess + rise_of(view.form[k], Scalar(-view.bend[k]), view.high[k], width))
                      : excess;
        // h / G - r, where G has lost what 1 - G keeps from r - h.
        const Scalar rise = q2 > Scalar(0.5) ? Scalar(r - least) : Scalar((least * q2 - over) / G0);
        const Scalar d =
            distance_of(view.form[k], is_rising ? view.bend[k] : Scalar(-view.bend[k]), least, rise);
        if (d >= 0 && d <= width) {
          SlopedWay<Scalar> to = way;
          const Scalar left = is_rising ? Scalar(width - d) : d;
          to.add_run(view, k, true, Scalar(-view.bend[k]), left, view.high[k],
                     Scalar(std::max(Scalar(0), excess) / view.high[k]), r, view.e0[k], h);
          add(Scalar(view.x[k + 1] - left), to, true);
        }
      }
      if (view.low[k] < h) return;
      cross(view, k, false, true, node, h, way);
      if (!is_finite(way.T)) return;
      const std::size_t reached = view.is_mirror ? n - k : k;
      throat.lowest = std::min(throat.lowest, reached);
      throat.highest = std::max(throat.highest, reached);
      if (k > 0) add(view.x[k], way, false);
    }
  }

  static void keep_useful(std::vector<Start>& starts) {
    std::stable_sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.T < b.T; });
    std::size_t n = 0;
    for (const Start& start : starts)
      if (n == 0 || start.A < starts[n - 1].A) starts[n++] = start;
    starts.resize(n, starts.front());
  }

  std::vector<Throat> all_;
};

}  // namespace shearfront::exact
