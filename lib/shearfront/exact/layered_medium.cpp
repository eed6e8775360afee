// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/layered_medium.hpp"

#include <algorithm>

#include "shearfront/exact/curved_cell.hpp"
#include "shearfront/exact/first_wave.hpp"
#include "shearfront/exact/initial_amount.hpp"
#include "shearfront/exact/layered_gradient.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

namespace {

/// Allowance for rounding in lower bounds; any larger value is as correct, only slower.
template <Real Scalar>
Scalar bound_slack(const Geometry<Scalar>& g) {
  return Scalar(1 << 12) * unit_roundoff<Scalar>() * (g.top() - g.bottom());
}

template <Real Scalar, class Law>
std::vector<Scalar> cell_fluxes(const Law& law, const Cells<Scalar>& cells,
                                const std::vector<Scalar>& states) {
  std::vector<Scalar> h;
  h.reserve(cells.n_cells());
  for (std::size_t i = 0; i < cells.n_cells(); ++i) h.push_back(law.h_of(cells.layer[i], states[i]));
  return h;
}

}  // namespace

template <Real Scalar, class Law>
LayeredMedium<Scalar, Law>::LayeredMedium(Law law, Cells<Scalar> cells, Scalar mass)
    : Medium<Scalar>(std::move(cells), std::move(mass)),
      law_(std::move(law)),
      h_{cell_fluxes<Scalar>(law_, cells_, cells_.phi), cell_fluxes<Scalar>(law_, cells_, cells_.phi_high)},
      slack_(bound_slack<Scalar>(law_)),
      waiting_(law_, cells_, h_, slack_) {
  emits_.assign(cells_.x.size(), 0);
  for (std::size_t i = 1; i < cells_.n_cells(); ++i) {
    const bool is_pure = cells_.beside(i, false) == cells_.beside(i, true) && h_.low[i] == 0;
    if (is_pure) continue;
    if (may_emit(i, true)) emits_[i] |= 1U;
    if (may_emit(i, false)) emits_[i] |= 2U;
  }
}

/// Leaving a point needs 4 H of the state ahead <= 4 H <= that of the state behind if it lies beyond the peak, its
/// capacity otherwise (beyond that, resting is better). The slack keeps rounding from dropping a borderline source:
/// next to the peak the flux of a state may come out above the capacity.
template <Real Scalar, class Law>
bool LayeredMedium<Scalar, Law>::may_emit(std::size_t i, bool upward) const {
  const Scalar slack = Scalar(1) / Scalar(1 << 20);
  const std::size_t ahead = upward ? i : i - 1, behind = upward ? i - 1 : i;
  const std::size_t k = cells_.layer[ahead], l = cells_.layer[behind];
  const Scalar over_ahead = law_.excess(k, cells_.beside(i, upward), upward);
  const Scalar over_behind = law_.excess(l, cells_.beside(i, !upward), upward);
  if (over_ahead < -Scalar(Law::kSlack)) return false;
  const Scalar limit = over_behind > 0 ? h_.beside(i, !upward) : law_.rate[l];
  return h_.beside(i, upward) <= limit * (Scalar(1) + slack) &&
         (over_ahead > 0 || over_behind < 0 || Law::kMovesAtCapacity);
}

template <Real Scalar, class Law>
Path<Scalar> LayeredMedium<Scalar, Law>::best_free(const Scalar& z, const Scalar& t,
                                                   const Scalar& upper) const {
  return search({z, t, upper, law_.layer_at(z)});
}

template <Real Scalar, class Law>
Path<Scalar> LayeredMedium<Scalar, Law>::best_moving(const Scalar& z, const Scalar& t) const {
  return search({z, t, infinity<Scalar>(), law_.layer_at(z), true});
}

template <Real Scalar, class Law>
Path<Scalar> LayeredMedium<Scalar, Law>::best_beside(const Path<Scalar>& near, const Scalar& z,
                                                     const Scalar& t, bool is_moving) const {
  const Query query{z, t, infinity<Scalar>(), law_.layer_at(z), is_moving};
  Path<Scalar> best;
  try_start_of(near, query, best);
  return search(query, best);
}

template <Real Scalar, class Law>
void LayeredMedium<Scalar, Law>::try_start_of(const Path<Scalar>& near, const Query& query,
                                              Path<Scalar>& best) const {
  const bool is_fan = near.kind == PathKind::fan;
  if (!is_fan && near.kind != PathKind::constant) return;
  const std::size_t cell = is_fan && !near.upward ? near.source - 1 : near.source;
  const std::size_t layer = cells_.layer[cell], k = query.k;
  if (near.upward ? layer > k : layer < k) return;
  Sweep<Scalar> sweep{
      near.upward, k, k,
      near.upward ? Scalar(query.z - law_.boundary(k)) : Scalar(law_.boundary(k + 1) - query.z)};
  if (layer != k) sweep.cross(law_, sweep.d_own);
  while (sweep.start != layer) sweep.cross(law_, law_.height[sweep.start]);
  if (is_fan)
    try_source(query, sweep, near.source, true, best);
  else
    try_cell(query, sweep, cell, best);
}

template <Real Scalar, class Law>
Path<Scalar> LayeredMedium<Scalar, Law>::search(const Query& query, Path<Scalar> best) const {
  const auto& [z, t, upper, k, moving_only] = query;
  for (const bool upward : {true, false}) {
    Sweep<Scalar> sweep{upward, k, k,
                        upward ? Scalar(z - law_.boundary(k)) : Scalar(law_.boundary(k + 1) - z)};
    search_layer(query, sweep, best);
    sweep.cross(law_, sweep.d_own);
    while (sweep.start < law_.n_layers() && sweep.T0 <= t) {
      search_layer(query, sweep, best);
      sweep.cross(law_, law_.height[sweep.start]);
    }
  }
  waiting_.search(law_, z, k, t, upper, best);
  return best;
}

template <Real Scalar, class Law>
void LayeredMedium<Scalar, Law>::search_layer(const Query& query, Sweep<Scalar>& sweep,
                                              Path<Scalar>& best) const {
  std::size_t begin = cells_.first[sweep.start], end = cells_.first[sweep.start + 1];
  if (sweep.start == sweep.own) {
    // The cell that holds z belongs to both directions; only the matching one can have its foot there.
    const auto it = std::upper_bound(cells_.x.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
                                     cells_.x.begin() + static_cast<std::ptrdiff_t>(end), query.z);
    const auto cell = static_cast<std::size_t>(it - cells_.x.begin()) - 1;
    if (sweep.upward) {
      end = cell + 1;
    } else {
      begin = cell;
    }
  }
  search_range(query, sweep, begin, end, best);
}

/// Cells begin .. end - 1 with the source at the outer end of each (below it for paths going up).
template <Real Scalar, class Law>
void LayeredMedium<Scalar, Law>::search_range(const Query& query, Sweep<Scalar>& sweep, std::size_t begin,
                                              std::size_t end, Path<Scalar>& best) const {
  constexpr std::size_t kLeaf = 6;
  if (end - begin <= kLeaf) {
    for (std::size_t n = 0; n < end - begin; ++n) {
      const std::size_t cell = sweep.upward ? end - 1 - n : begin + n;
      try_cell(query, sweep, cell, best);
      try_source(query, sweep, sweep.upward ? cell : cell + 1, true, best);
    }
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const Scalar& exit = sweep.exit(law_, query.z);
  const FanState<Scalar> fan = try_source(query, sweep, middle, false, best);
  const Scalar d_middle = sweep.upward ? exit - cells_.x[middle] : cells_.x[middle] - exit;
  if (!fan.reachable && d_middle > 0) {  // everything farther out is out of reach, too
    sweep.upward ? search_range(query, sweep, middle, end, best)
                 : search_range(query, sweep, begin, middle, best);
    return;
  }
  // Lower bound over all starts x in [x_a, x_b] at the H of the middle source: constant + M(x) - p x, where
  // M(x) >= max(M_a, M_b - (x_b - x)).
  const std::size_t j = sweep.start;
  const auto bound = [&](std::size_t a, std::size_t b) {
    if (!fan.reachable) return Scalar(-infinity<Scalar>());
    const Scalar q = law_.q_on(j, sweep.upward, fan.r_min, fan.x);
    const Scalar p = law_.momentum(j, sweep.upward, q, fan.H);
    const Scalar& x_middle = cells_.x[middle];
    const Scalar from_middle = fan.H * query.t + (law_.peaks(x_middle, query.z) + fan.Q / Scalar(2));
    const Scalar rise = cells_.M[b] - cells_.M[a];
    return Scalar(from_middle + cells_.M[a] - p * ((cells_.x[b] - rise) - x_middle));
  };
  const Scalar low = bound(begin, middle), high = bound(middle, end);
  const auto worth = [&](const Scalar& b) { return !(b > std::min(query.upper, best.value) + slack_); };
  if (low < high) {
    if (worth(low)) search_range(query, sweep, begin, middle, best);
    if (worth(high)) search_range(query, sweep, middle, end, best);
  } else {
    if (worth(high)) search_range(query, sweep, middle, end, best);
    if (worth(low)) search_range(query, sweep, begin, middle, best);
  }
}

/// The fan from point i. With `prune` false it is solved to the end even when it cannot be the best.
template <Real Scalar, class Law>
FanState<Scalar> LayeredMedium<Scalar, Law>::try_source(const Query& query, Sweep<Scalar>& sweep,
                                                        std::size_t i, bool prune, Path<Scalar>& best) const {
  FanState<Scalar> fan;
  if (i == 0 || i + 1 == cells_.x.size()) return fan;  // walls
  if (prune && !emits(i, sweep.upward)) return fan;
  const Scalar& x = cells_.x[i];
  const Scalar& exit = sweep.exit(law_, query.z);
  const Scalar d = sweep.upward ? exit - x : x - exit;
  if (d < 0) return fan;
  const Scalar lean = law_.peaks(x, query.z);
  const Scalar base = cells_.M[i] + lean;
  const Scalar limit = prune ? Scalar(std::min(query.upper, best.value) + slack_) : infinity<Scalar>();
  const bool own = sweep.start == sweep.own;
  if (own && d == 0) {
    // A jump at the query height itself: rest there. On an interface this is a waiting path.
    if (cells_.first[sweep.own] == i) return fan;
    fan.reachable = true;
    fan.r_min = law_.rate[sweep.own];
    fan.H = fan.r_min / Scalar(4);
  } else {
    if (prune && !own && cells_.M[i] + dual_bound(law_, sweep, d, lean, query.t) > limit) return fan;
    fan = law_.solve_fan(sweep, d, query.t, base, limit);
    if (prune && !own && fan.reachable) sweep.set_dual(law_, Scalar(Scalar(4) * fan.H));
  }
  // Without `prune` only a bound is wanted of those that emit nothing: between pure states their rounded values may be the least.
  if (!fan.reachable || fan.pruned || !emits(i, sweep.upward)) return fan;
  Path<Scalar> path;
  path.value = base + fan.Q / Scalar(2) + fan.H * query.t;
  if (path.value > best.value) return fan;
  path.H = fan.H;
  path.kind = PathKind::fan;
  path.upward = sweep.upward;
  path.source = i;
  path.foot = x;
  path.r_reference = fan.r_min;
  path.x = fan.x;
  path.p = law_.momentum(query.k, sweep.upward, law_.q_on(query.k, sweep.upward, fan.r_min, fan.x), fan.H);
  if (path.better_than(best)) best = path;
  return fan;
}

/// The characteristic of the constant initial state of cell i.
template <Real Scalar, class Law>
void LayeredMedium<Scalar, Law>::try_cell(const Query& query, const Sweep<Scalar>& sweep, std::size_t i,
                                          Path<Scalar>& best) const {
  if (cells_.is_curved(i)) return try_curved_cell(query, sweep, i, best);
  const Scalar& phi = cells_.phi[i];
  const bool own = sweep.start == sweep.own;
  const std::size_t j = sweep.start;
  const Scalar over = law_.excess(j, phi, sweep.upward);
  if (over < 0 || (!own && over == 0)) return;  // at the peak it rests and never leaves its cell
  const Scalar& h = h_.low[i];
  if (query.moving_only && h == 0) return;
  if (!own && !(h < sweep.r_min)) return;  // ends of the cell cover what is equal to a capacity
  const Scalar speed = over > 0 ? Scalar(law_.rate[j] * law_.steepness(j, sweep.upward, over)) : Scalar(0);
  const Scalar& exit = sweep.exit(law_, query.z);
  const Scalar nearest = sweep.upward ? exit - cells_.x[i + 1] : cells_.x[i] - exit;
  const Scalar farthest = sweep.upward ? exit - cells_.x[i] : cells_.x[i + 1] - exit;
  if ((query.t - sweep.T0) * speed < nearest) return;  // the crossing takes at least T0
  if (!own) {                                          // the bound is linear in the foot point
    const Scalar limit = std::min(query.upper, best.value) + slack_;
    const auto bound = [&](std::size_t end, const Scalar& d) {
      return Scalar(cells_.M[end] + dual_bound(law_, sweep, d, law_.peaks(cells_.x[end], query.z), query.t));
    };
    const Scalar bottom = bound(i, sweep.upward ? farthest : nearest);
    const Scalar top = bound(i + 1, sweep.upward ? nearest : farthest);
    if (std::min(bottom, top) > limit) return;
  }
  Leg<Scalar> beyond{sweep.T0};
  if (h > 0) {
    beyond.time = Scalar(0);
    sweep.for_each_crossed(law_, [&](const Scalar& d, std::size_t k) {
      add_layer(law_, d, k, sweep.upward, Scalar(law_.rate[k] - h), beyond);
    });
  }
  const Scalar d = (query.t - beyond.time) * speed;
  if (!(d >= nearest && d <= farthest) || d < 0) return;
  Path<Scalar> path;
  path.foot = sweep.upward ? exit - d : exit + d;
  path.H = h / Scalar(4);
  path.r_reference = law_.rate[j];
  path.x = law_.root_lack(j, sweep.upward, over);
  path.kind = PathKind::constant;
  path.upward = sweep.upward;
  path.source = i;
  const Scalar start = cells_.M[i] + phi * (path.foot - cells_.x[i]);
  if (h == 0) {  // pure states: exact even where the sums below would leave a rounding error
    path.p = phi;
    path.value = sweep.upward ? Scalar(start + (query.z - path.foot)) : start;
  } else if (own) {
    path.p = phi;
    path.value = start + (phi * (query.z - path.foot) + path.H * query.t);
  } else {
    const Scalar Q = beyond.Q + d * over;
    path.value = start + (law_.peaks(path.foot, query.z) + Q / Scalar(2)) + path.H * query.t;
    const Scalar q = law_.q(query.k, sweep.upward, Scalar(law_.rate[query.k] - h));
    path.p = law_.momentum(query.k, sweep.upward, q, path.H);
  }
  if (path.better_than(best)) best = path;
}

/// The characteristics of the states of a curved cell.
template <Real Scalar, class Law>
void LayeredMedium<Scalar, Law>::try_curved_cell(const Query& query, const Sweep<Scalar>& sweep,
                                                 std::size_t i, Path<Scalar>& best) const {
  const bool up = sweep.upward, own = sweep.start == sweep.own;
  const std::size_t j = sweep.start;
  const Scalar reach = (query.t - sweep.T0) / law_.pure_slowness(j, up);  // nothing is faster
  if (!(reach > 0)) return;
  const Scalar& exit = sweep.exit(law_, query.z);
  const Scalar lo = up ? std::max(cells_.x[i], Scalar(exit - reach)) : std::max(cells_.x[i], exit);
  const Scalar hi = up ? std::min(cells_.x[i + 1], exit) : std::min(cells_.x[i + 1], Scalar(exit + reach));
  if (!(lo < hi)) return;
  const Scalar limit = std::min(query.upper, best.value);
  if (!own) {
    const auto bound = [&](const Scalar& y) {
      return dual_bound(law_, sweep, up ? Scalar(exit - y) : Scalar(y - exit), law_.peaks(y, query.z),
                        query.t);
    };
    if (cells_.M[i] + std::min(bound(lo), bound(hi)) > limit + slack_) return;
  }
  using Search = CurvedCell<Scalar, Law>;
  Search(law_, cells_, sweep, i, query.z, query.t, limit)
      .run(lo, hi, reach, [&](const typename Search::Start& s) {
        Path<Scalar> path;
        path.foot = s.y;
        path.value = s.value();
        path.kind = PathKind::constant;
        path.upward = up;
        path.source = i;
        const Scalar over = law_.excess(j, s.phi, up), h = law_.h_of(j, s.phi);
        // The state knows H better than the distance does, but where it is about to rest.
        if (!(over < 0) && (own || h < sweep.r_min)) {
          path.H = h / Scalar(4);
          path.r_reference = law_.rate[j];
          path.x = law_.root_lack(j, up, over);
          path.p =
              own ? s.phi
                  : law_.momentum(query.k, up, law_.q(query.k, up, Scalar(law_.rate[query.k] - h)), path.H);
        } else {
          path.H = s.fan.H;
          path.r_reference = s.fan.r_min;
          path.x = s.fan.x;
          path.p = law_.momentum(query.k, up, law_.q_on(query.k, up, s.fan.r_min, s.fan.x), s.fan.H);
        }
        if (query.moving_only && path.H == 0) return;
        if (path.better_than(best)) best = path;
      });
}

/// With U the height gained by the legs of the path that go up, its cost is U + H t - sum d loss (what going up gains
/// less than d, or going down more than 0), so the shortfall is (final amount - initial amount at the start - U) - H t
/// + sum d loss: the bracket holds data only, and the other two terms are small when the bracket is.
template <Real Scalar, class Law>
Scalar LayeredMedium<Scalar, Law>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                             FinalAmount amount) const {
  CompensatedSum<Scalar> sum;
  add_final_less_initial(cells_, path, z, amount, sum);
  Scalar lost(0);
  const auto leg = [&](const Scalar& from, const Scalar& to) {
    const bool upward = from < to;
    if (upward) {
      sum += from;
      sum += -to;
    }
    law_.for_each_layer(from, to, [&](const Scalar& d, std::size_t k) {
      const Scalar q =
          law_.q(k, upward, Scalar((law_.rate[k] - path.r_reference) + path.r_reference * path.x * path.x));
      lost += d * law_.loss(k, upward, q, path.H);
    });
  };
  if (path.kind == PathKind::waiting) {
    const Scalar& rest = law_.boundary(path.interface);
    leg(path.foot, rest);
    leg(rest, z);
  } else {
    leg(path.foot, z);
  }
  sum += Scalar(-path.H * t);
  sum += lost;
  return sum.value();
}

template <Real Scalar, class Law>
std::optional<Scalar> LayeredMedium<Scalar, Law>::first_wave(std::size_t i) const {
  return exact::first_wave(*this, i);
}

template <Real Scalar, class Law>
PathGradient<Scalar> LayeredMedium<Scalar, Law>::gradient(const Path<Scalar>& path, const Scalar& z,
                                                          const Scalar& t) const {
  return layered_gradient(law_, cells_, path, z, t);
}

template class LayeredMedium<Instantiated, ParabolaLaw<Instantiated>>;
template class LayeredMedium<Instantiated, UnimodalLaw<Instantiated>>;

}  // namespace shearfront::exact
