// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_curved.hpp"
#include "shearfront/exact/sloped_route.hpp"

namespace shearfront::exact {

/// Time and gain of a run at a fixed h between two heights of a view, over cells whose rate is h at least: int p dz = the
/// height gained on ways up + gain, gain <= 0. The time is infinite where it cannot go.
template <Real Scalar>
struct SlopedWay {
  Scalar T{0}, gain{0};

  void add(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& r2, const Scalar& h) {
    if (!(d > 0)) return;
    add(form, d, r1, q_at(r1, h, Scalar(0)), r2, q_at(r2, h, Scalar(0)), h);
  }
  /// To the end of a query: r rises by `rise`, which next to r1 = h knows more than r2 - r1.
  void add_last(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& rise, const Scalar& r2,
                const Scalar& h) {
    using std::sqrt;
    if (!(d > 0)) return;
    const Scalar q2 = ((r1 - h) + rise) / r2;
    add(form, d, r1, q_at(r1, h, Scalar(0)), r2, q2 > 0 ? Scalar(sqrt(q2)) : Scalar(0), h);
  }

 private:
  void add(RateForm form, const Scalar& d, const Scalar& r1, const Scalar& q1, const Scalar& r2,
           const Scalar& q2, const Scalar& h) {
    const Crossing<Scalar> c(form, d, r1, q1, r2, q2, h);
    T += c.T;
    if (is_finite(c.T)) gain += c.X - h / Scalar(4) * c.T;
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
    const auto& [z, cell_below, cell_above, rate_below, rate_above] = place;
    for (const Throat& throat : all_) {
      const Scalar& z_i = up.x[throat.node];
      const bool is_above = z > z_i;
      // The way leads to the cell of z over nodes that are no narrower.
      if (is_above ? throat.highest < cell_below : z < z_i && throat.lowest > cell_above + 1) continue;
      if (is_above ? rate_below < throat.h : z < z_i && rate_above < throat.h) continue;
      const Scalar H = throat.h / Scalar(4), gained = is_above ? Scalar(z - z_i) : Scalar(0);
      const Scalar limit = std::min(upper, best.value);
      const Scalar shift = (z - z_i) / Scalar(2) + H * t;  // q = 0 all the way
      if (throat.starts.back().A + shift > limit) continue;
      SlopedWay<Scalar> way;
      if (is_above) {
        for (std::size_t k = throat.node; k < cell_below && way.T <= t; ++k)
          way.add(up.form[k], up.x[k + 1] - up.x[k], up.low[k], up.high[k], throat.h);
        const Scalar d = z - up.x[cell_below];
        way.add_last(up.form[cell_below], d, up.low[cell_below],
                     rise_of(up.form[cell_below], up.bend[cell_below], up.low[cell_below], d), rate_below,
                     throat.h);
      } else if (z < z_i) {
        for (std::size_t k = throat.node - 1; k > cell_above && way.T <= t; --k)
          way.add(up.form[k], up.x[k + 1] - up.x[k], up.high[k], up.low[k], throat.h);
        const Scalar d = up.x[cell_above + 1] - z;
        way.add_last(up.form[cell_above], d, up.high[cell_above],
                     rise_of(up.form[cell_above], up.bend[cell_above], up.high[cell_above], Scalar(-d)),
                     rate_above, throat.h);
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
      if (view.is_curved(k)) {
        // The start whose state has the h of the throat.
        Scalar lo = view.x[k], hi = view.x[k + 1];
        const auto over = [&](const Scalar& y) { return CurvedState<Scalar>(view, k, y).q0; };
        const auto more = [&](const Scalar& y) -> std::optional<Scalar> {
          const CurvedState<Scalar> state(view, k, y);
          return Scalar(Scalar(4) * state.p * state.missing * view.rate(k, y) - h);
        };
        if (keep_where<Scalar>(over, lo, hi))
          if (const std::optional<Scalar> y = sign_change<Scalar>(more, lo, hi)) {
            SlopedWay<Scalar> to = way;
            to.add(view.form[k], view.x[k + 1] - *y, view.rate(k, *y), view.high[k], h);
            add(*y, to, true);
          }
      }
      const Scalar four_g = view.is_curved(k) ? Scalar(0) : Scalar(Scalar(4) * view.p[k] * view.missing[k]);
      if (view.q0[k] > 0 && four_g > 0 && view.bend[k] != 0) {
        const Scalar r = h / four_g;
        const bool is_rising = view.bend[k] > 0;
        const Scalar& near = is_rising ? view.low[k] : view.high[k];
        const Scalar y = (is_rising ? view.x[k] : view.x[k + 1]) +
                         distance_of(view.form[k], view.bend[k], near, Scalar(r - near));
        if (y >= view.x[k] && y <= view.x[k + 1]) {
          SlopedWay<Scalar> to = way;
          to.add(view.form[k], view.x[k + 1] - y, r, view.high[k], h);
          add(y, to, true);
        }
      }
      if (view.low[k] < h) return;
      way.add(view.form[k], view.x[k + 1] - view.x[k], view.high[k], view.low[k], h);
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
