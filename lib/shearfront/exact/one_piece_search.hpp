// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/path.hpp"
#include "shearfront/exact/sloped_bed.hpp"

namespace shearfront::exact {

/// The best path to (z, t) in a bed that is one piece: a closed form for each initial jump and each state within reach, no
/// routes, no bounds. Heights of the upright view. Finite speed: the starts within reach are those of pure states.
template <Real Scalar>
class OnePieceSearch {
 public:
  OnePieceSearch(const SlopedView<Scalar>& view, const Scalar& z, const Scalar& rate, const Scalar& t)
      : view_(view), z_(z), rate_(rate), t_(t), form_(view.form.front()), bend_(view.bend.front()) {
    slack_ = Scalar(64) * unit_roundoff<Scalar>() * (view.x.back() - view.x.front());
  }

  [[nodiscard]] Path<Scalar> run(bool moving_only) {
    const Scalar lowest = z_ - reach(bend_) - slack_, highest = z_ + reach(Scalar(-bend_)) + slack_;
    const auto first = std::upper_bound(view_.x.begin() + 1, view_.x.end() - 1, lowest);
    for (auto k = static_cast<std::size_t>(first - view_.x.begin()) - 1;
         k < view_.n_cells() && !(view_.x[k] > highest); ++k) {
      const bool is_pure = view_.p[k] == 0 || view_.missing[k] == 0;
      if (!(moving_only && is_pure)) state(k);
      if (k > 0) fan(k);
    }
    return best_;
  }

 private:
  /// How far a pure state comes in the time t from where r falls off as exp(-bend d), or by the slope bend, with the distance d.
  [[nodiscard]] Scalar reach(const Scalar& bend) const {
    using std::expm1;
    using std::log1p;
    const Scalar way = rate_ * t_;
    if (form_ == RateForm::linear) {
      const Scalar x = bend * t_;
      return x == 0 ? way : Scalar(way * (-expm1(Scalar(-x)) / x));
    }
    const Scalar x = bend * way;
    return x > Scalar(-1) ? Scalar(log1p(x) / bend) : infinity<Scalar>();
  }

  void state(std::size_t k) {
    // In terms of the cell: where r is steep, heights that differ by rounding have other H.
    const Scalar &lo = view_.x[k], &hi = view_.x[k + 1];
    const Scalar rounding = std::min(slack_, Scalar((hi - lo) / Scalar(1 << 20)));
    const Arc<Scalar> arc = arc_from_state(form_, bend_, t_, view_.p[k], view_.missing[k], rate_, Ways::up,
                                           {(z_ - hi) - rounding, (z_ - lo) + rounding});
    if (!arc.exists) return;
    const Scalar y = z_ - arc.rise;
    offer(arc, std::clamp(y, lo, hi), PathKind::constant, k, view_.M[k] + view_.p[k] * (y - lo));
  }
  /// Moving the start must not pay: state below <= p0 <= state above.
  void fan(std::size_t k) {
    if (!(view_.p[k - 1] < view_.p[k])) return;
    const Arc<Scalar> arc = arc_from_point(form_, bend_, t_, Scalar(z_ - view_.x[k]), view_.low[k], rate_);
    const Scalar slack = Scalar(1) / Scalar(1 << 20), &odds = arc.start_odds;
    if (!arc.exists || odds * (view_.missing[k - 1] + slack) < view_.p[k - 1] - slack ||
        odds * (view_.missing[k] - slack) > view_.p[k] + slack)
      return;
    offer(arc, view_.x[k], PathKind::fan, k, view_.M[k]);
  }
  void offer(const Arc<Scalar>& arc, const Scalar& y, PathKind kind, std::size_t source, const Scalar& M0) {
    Path<Scalar> path;
    path.value = M0 + arc.gain;
    if (!(path.value <= best_.value)) return;
    path.H = rate_ * arc.p * arc.missing;
    // What p and the odds round to 1/2 and 1 is what the slope makes of it; a fan stands still at its own source in a flat piece.
    const bool is_fan = kind == PathKind::fan, is_flat = bend_ == 0, is_rising = bend_ > 0;
    path.upward = arc.p > Scalar(0.5) || (is_fan && arc.p == Scalar(0.5) && (is_flat || is_rising));
    const bool starts_up =
                   arc.start_odds > Scalar(1) || (is_fan && arc.start_odds == Scalar(1) && !is_rising),
               starts_down =
                   arc.start_odds < Scalar(1) || (is_fan && arc.start_odds == Scalar(1) && is_rising);
    const Scalar h = Scalar(4) * path.H,
                 q = path.upward ? Scalar(arc.p - arc.missing) : Scalar(arc.missing - arc.p);
    const auto turns_beyond = [&](const Scalar& end, const Scalar& end_rate) {
      return stays_above<Scalar>(form_, bend_, rate_, q, h, end - z_, end_rate);
    };
    if (starts_up && !path.upward && turns_beyond(view_.x.back(), view_.high.back())) return;
    if (starts_down && path.upward && turns_beyond(view_.x.front(), view_.low.front())) return;
    path.turned = h > 0 && !is_flat && (path.upward ? starts_down : starts_up);
    path.kind = kind;
    path.source = source;
    path.foot = y;
    path.interface = 0;
    path.r_reference = rate_;
    path.x = q;
    path.p = std::clamp(arc.p, Scalar(0), Scalar(1));
    if (path.better_than(best_)) best_ = path;
  }

  const SlopedView<Scalar>& view_;
  Scalar z_, rate_, t_;
  RateForm form_;
  Scalar bend_, slack_{0};
  Path<Scalar> best_;
};

}  // namespace shearfront::exact
