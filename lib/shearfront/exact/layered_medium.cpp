// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/layered_medium.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <algorithm>

namespace shearfront::exact {

template <Real Scalar>
struct LayeredMedium<Scalar>::Query {
  Scalar z, t, upper;
  std::size_t k;             ///< layer of z
  bool moving_only = false;  ///< leave out H = 0
};

namespace {

/// Height at which paths leave the start layer (or the query height itself, in the own layer).
template <Real Scalar>
Scalar exit_height(const Geometry<Scalar>& g, const Sweep<Scalar>& sweep, const Scalar& z) {
  if (sweep.start == sweep.own) return z;
  return g.layers.boundary(sweep.upward ? sweep.start + 1 : sweep.start);
}

/// Allowance for rounding in lower bounds; any larger value is as correct, only slower.
template <Real Scalar>
Scalar bound_slack(const Geometry<Scalar>& g) {
  return Scalar(1 << 12) * unit_roundoff<Scalar>() * (g.layers.top() - g.layers.bottom());
}

/// Makes the H of a path the H' of later lower bounds in the same sweep.
template <Real Scalar>
void set_dual(const Geometry<Scalar>& g, Sweep<Scalar>& sweep, const FanState<Scalar>& fan) {
  sweep.h_dual = Scalar(4) * fan.H;
  sweep.Q_dual = Scalar(0);
  sweep.for_each_crossed(g, [&](const Scalar& d, std::size_t k) {
    sweep.Q_dual += d * momentum_root<Scalar>(g.rate[k] - sweep.h_dual, g.inverse_rate[k]);
  });
}

}  // namespace

template <Real Scalar>
LayeredMedium<Scalar>::LayeredMedium(const Scene<Scalar>& scene, LayerStack<Scalar> layers)
    : geometry_(std::move(layers)),
      cells_(scene, geometry_.layers.boundaries()),
      slack_(bound_slack(geometry_)),
      waiting_(geometry_, cells_, slack_) {
  for (std::size_t i = 0; i < cells_.n_cells(); ++i)
    h_cell_.push_back(Scalar(4) * geometry_.rate[cells_.layer[i]] * cells_.phi[i] *
                      (Scalar(1) - cells_.phi[i]));
  // Going up from a point needs 4 s a phi (1 - phi) of the cell above <= 4 H <= the same of the cell below
  // when phi_b > 1/2, its capacity otherwise (beyond that, resting is better); going down mirrored. The slack
  // keeps rounding from dropping a borderline source: next to 1/2, 4 phi (1 - phi) may come out above 1.
  const Scalar slack = Scalar(1) + Scalar(1) / Scalar(1 << 20);
  emits_.assign(cells_.x.size(), 0);
  const Scalar half(0.5);
  for (std::size_t i = 1; i < cells_.n_cells(); ++i) {
    const Scalar& below = cells_.phi[i - 1];
    const Scalar& above = cells_.phi[i];
    const Scalar up_limit = below > half ? h_cell_[i - 1] : geometry_.rate[cells_.layer[i - 1]];
    const Scalar down_limit = above < half ? h_cell_[i] : geometry_.rate[cells_.layer[i]];
    if (above >= half && h_cell_[i] <= up_limit * slack && (above > half || below < half)) emits_[i] |= 1U;
    if (below <= half && h_cell_[i - 1] <= down_limit * slack && (below < half || above > half))
      emits_[i] |= 2U;
    if (below == above && h_cell_[i] == 0) emits_[i] = 0;
  }
}

template <Real Scalar>
Path<Scalar> LayeredMedium<Scalar>::best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const {
  return search({z, t, upper, geometry_.layers.layer_at(z)});
}

template <Real Scalar>
Path<Scalar> LayeredMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search({z, t, infinity<Scalar>(), geometry_.layers.layer_at(z), true});
}

template <Real Scalar>
Path<Scalar> LayeredMedium<Scalar>::search(const Query& query) const {
  const auto& [z, t, upper, k, moving_only] = query;
  Path<Scalar> best;
  for (const bool upward : {true, false}) {
    Sweep<Scalar> sweep{
        upward, k, k,
        upward ? Scalar(z - geometry_.layers.boundary(k)) : Scalar(geometry_.layers.boundary(k + 1) - z)};
    search_layer(query, sweep, best);
    sweep.cross(geometry_, sweep.d_own);
    while (sweep.start < geometry_.layers.n_layers() && sweep.T0 <= t) {
      search_layer(query, sweep, best);
      sweep.cross(geometry_, geometry_.height[sweep.start]);
    }
  }
  waiting_.search(geometry_, cells_, z, k, t, upper, best);
  return best;
}

template <Real Scalar>
void LayeredMedium<Scalar>::search_layer(const Query& query, Sweep<Scalar>& sweep, Path<Scalar>& best) const {
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
template <Real Scalar>
void LayeredMedium<Scalar>::search_range(const Query& query, Sweep<Scalar>& sweep, std::size_t begin,
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
  const Scalar exit = exit_height(geometry_, sweep, query.z);
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
    const Scalar q = fan.q(geometry_.rate[j], geometry_.inverse_rate[j]);
    const Scalar p = sweep.upward ? (Scalar(1) + q) / Scalar(2) : (Scalar(1) - q) / Scalar(2);
    const Scalar& x_middle = cells_.x[middle];
    const Scalar from_middle = fan.H * query.t + ((query.z - x_middle) + fan.Q) / Scalar(2);
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
template <Real Scalar>
FanState<Scalar> LayeredMedium<Scalar>::try_source(const Query& query, Sweep<Scalar>& sweep, std::size_t i,
                                                   bool prune, Path<Scalar>& best) const {
  FanState<Scalar> fan;
  if (i == 0 || i + 1 == cells_.x.size()) return fan;  // walls
  if (prune && !emits(i, sweep.upward)) return fan;
  const Scalar& x = cells_.x[i];
  const Scalar exit = exit_height(geometry_, sweep, query.z);
  const Scalar d = sweep.upward ? exit - x : x - exit;
  if (d < 0) return fan;
  const Scalar base = cells_.M[i] + (query.z - x) / Scalar(2);
  const Scalar limit = prune ? Scalar(std::min(query.upper, best.value) + slack_) : infinity<Scalar>();
  const bool own = sweep.start == sweep.own;
  if (own && d == 0) {
    // A jump at the query height itself: rest there. On an interface this is a waiting path.
    if (cells_.first[sweep.own] == i) return fan;
    fan.reachable = true;
    fan.r_min = geometry_.rate[sweep.own];
    fan.H = fan.r_min / Scalar(4);
  } else {
    if (prune && !own && cells_.M[i] + dual_bound(geometry_, sweep, d, Scalar(query.z - x), query.t) > limit)
      return fan;
    fan = solve_fan(geometry_, sweep, d, query.t, base, limit);
    if (prune && !own && fan.reachable) set_dual(geometry_, sweep, fan);
  }
  if (!fan.reachable || fan.pruned) return fan;
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
  const Scalar q = fan.q(geometry_.rate[query.k], geometry_.inverse_rate[query.k]);
  path.p = sweep.upward ? (Scalar(1) + q) / Scalar(2)
                        : Scalar(2) * fan.H * geometry_.inverse_rate[query.k] / (Scalar(1) + q);
  if (path.better_than(best)) best = path;
  return fan;
}

/// The characteristic of the constant initial state of cell i.
template <Real Scalar>
void LayeredMedium<Scalar>::try_cell(const Query& query, const Sweep<Scalar>& sweep, std::size_t i,
                                     Path<Scalar>& best) const {
  const Scalar& phi = cells_.phi[i];
  const Scalar half(0.5);
  const bool own = sweep.start == sweep.own;
  if (sweep.upward ? phi < half : phi > half) return;
  if (!own && phi == half) return;  // at rest, never leaves its cell
  const Scalar& h = h_cell_[i];
  if (query.moving_only && h == 0) return;
  if (!own && !(h < sweep.r_min)) return;
  const Scalar& r = geometry_.rate[sweep.start];
  const Scalar speed = r * (sweep.upward ? phi + (phi - Scalar(1)) : (Scalar(1) - phi) - phi);
  const Scalar exit = exit_height(geometry_, sweep, query.z);
  const Scalar nearest = sweep.upward ? exit - cells_.x[i + 1] : cells_.x[i] - exit;
  const Scalar farthest = sweep.upward ? exit - cells_.x[i] : cells_.x[i + 1] - exit;
  if ((query.t - sweep.T0) * speed < nearest) return;  // the crossing takes at least T0
  if (!own) {                                          // the bound is linear in the foot point
    const Scalar limit = std::min(query.upper, best.value) + slack_;
    const auto bound = [&](std::size_t end, const Scalar& d) {
      return Scalar(cells_.M[end] +
                    dual_bound(geometry_, sweep, d, Scalar(query.z - cells_.x[end]), query.t));
    };
    const Scalar bottom = bound(i, sweep.upward ? farthest : nearest);
    const Scalar top = bound(i + 1, sweep.upward ? nearest : farthest);
    if (std::min(bottom, top) > limit) return;
  }
  Scalar time = sweep.T0, Q(0);
  if (h > 0) {
    time = Scalar(0);
    sweep.for_each_crossed(geometry_, [&](const Scalar& d, std::size_t k) {
      const Scalar q = momentum_root<Scalar>(geometry_.rate[k] - h, geometry_.inverse_rate[k]);
      time += d * geometry_.inverse_rate[k] / q;
      Q += d * q;
    });
  }
  const Scalar d = (query.t - time) * speed;
  if (!(d >= nearest && d <= farthest) || d < 0) return;
  Path<Scalar> path;
  path.foot = sweep.upward ? exit - d : exit + d;
  path.H = h / Scalar(4);
  path.r_reference = r;
  path.x = speed / r;
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
    Q += d * (speed / r);
    path.value = start + ((query.z - path.foot) + Q) / Scalar(2) + path.H * query.t;
    const Scalar& ir = geometry_.inverse_rate[query.k];
    const Scalar q = momentum_root<Scalar>(geometry_.rate[query.k] - h, ir);
    path.p = sweep.upward ? (Scalar(1) + q) / Scalar(2) : Scalar(2) * path.H * ir / (Scalar(1) + q);
  }
  if (path.better_than(best)) best = path;
}

/// sum d (1 - q) / 2 between two heights on the path: what going up gains less than d, or going down more
/// than 0.
template <Real Scalar>
Scalar LayeredMedium<Scalar>::loss(const Path<Scalar>& path, const Scalar& z1, const Scalar& z2) const {
  const Geometry<Scalar>& g = geometry_;
  const Scalar& lo = std::min(z1, z2);
  const Scalar& hi = std::max(z1, z2);
  Scalar sum(0);
  for (std::size_t k = g.layers.layer_at(lo); k < g.layers.n_layers() && g.layers.boundary(k) < hi; ++k) {
    const Scalar d = std::min(hi, g.layers.boundary(k + 1)) - std::max(lo, g.layers.boundary(k));
    if (!(d > 0)) continue;
    const Scalar q = momentum_root<Scalar>(
        (g.rate[k] - path.r_reference) + path.r_reference * path.x * path.x, g.inverse_rate[k]);
    sum += d * (path.H * g.inverse_rate[k] / (Scalar(1) + q));
  }
  return Scalar(2) * sum;
}

/// With U the height gained by the legs of the path that go up, its cost is U + H t - sum d (1 - q) / 2, so
/// the shortfall is (final amount - initial amount at the start - U) - H t + sum d (1 - q) / 2: the bracket
/// holds data only, and the other two terms are small when the bracket is.
template <Real Scalar>
Scalar LayeredMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                        FinalAmount amount) const {
  CompensatedSum<Scalar> sum;
  if (amount == FinalAmount::full_below || (amount == FinalAmount::both && path.upward)) {
    sum += z;
    sum += -cells_.x.front();
  } else {
    sum += cells_.M.back();
    sum += cells_.M_low.back();
  }
  sum += -cells_.M[path.source];
  sum += -cells_.M_low[path.source];
  if (path.kind == PathKind::constant) {
    const TwoSum<Scalar> inside(path.foot, Scalar(-cells_.x[path.source]));
    const TwoProduct<Scalar> initial(inside.high, cells_.phi[path.source]);
    sum += -initial.high;
    sum += -(initial.low + inside.low * cells_.phi[path.source]);
  }
  Scalar lost(0);
  const auto leg = [&](const Scalar& from, const Scalar& to) {
    if (from < to) {
      sum += from;
      sum += -to;
    }
    lost += loss(path, from, to);
  };
  if (path.kind == PathKind::waiting) {
    const Scalar& rest = geometry_.layers.boundary(path.interface);
    leg(path.foot, rest);
    leg(rest, z);
  } else {
    leg(path.foot, z);
  }
  sum += Scalar(-path.H * t);
  sum += lost;
  return sum.value();
}

template class LayeredMedium<Instantiated>;

}  // namespace shearfront::exact
