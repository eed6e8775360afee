// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/sloped_medium.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/exact/arc.hpp"
#include "shearfront/exact/initial_amount.hpp"
#include "shearfront/exact/law_calculus.hpp"
#include "shearfront/exact/law_candidates.hpp"
#include "shearfront/exact/one_piece_search.hpp"
#include "shearfront/exact/sloped_arrival.hpp"
#include "shearfront/exact/sloped_candidates.hpp"
#include "shearfront/exact/sloped_gradient.hpp"
#include "shearfront/exact/sloped_search.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

template <Real Scalar>
SlopedMedium<Scalar>::SlopedMedium(SlopedPieces<Scalar> pieces, Cells<Scalar> cells, Scalar mass,
                                   std::shared_ptr<const PieceFluxes<Scalar>> fluxes)
    : Medium<Scalar>(std::move(cells), std::move(mass)),
      fluxes_(std::move(fluxes)),
      pieces_(std::move(pieces)),
      up_(pieces_, cells_, false, fluxes_),
      down_(pieces_, cells_, true, fluxes_),
      throats_(up_, down_) {
  set_pure_times();
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const {
  return search(z, t, upper, false);
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search(z, t, infinity<Scalar>(), true);
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::search(const Scalar& z, const Scalar& t, const Scalar& upper,
                                          bool moving_only, const Starts& starts) const {
  if (fluxes_) return search_for_law(SlopedPlace<Scalar>(up_, z), t, upper, moving_only);
  if (pieces_.size() == 1 && !cells_.shape)
    return OnePieceSearch<Scalar>(up_, z, pieces_.rate(0, z), t).run(moving_only);
  Path<Scalar> best;
  const SlopedPlace<Scalar> place(up_, z);
  using Search = SlopedSearch<Scalar, SlopedCandidates<Scalar>>;
  Search upwards(up_, place, t, upper, moving_only, best);
  upwards.start_between(starts.least, starts.most);
  upwards.run();
  Search downwards(down_, place.turned_over(up_), t, upper, moving_only, best);
  downwards.start_between(Scalar(-starts.most), Scalar(-starts.least));
  downwards.run();
  throats_.search(up_, place, t, upper, best);
  rest(place, t, best);
  settle(place, t, best);
  return best;
}

/// To rest at z costs its capacity, and is what there is where a path starts within rounding of z: from a jump or a state at the peak
/// between flat pieces, or next to pieces so thin or so flat that a start beside z is none. It counts where none has been found that costs
/// less.
template <Real Scalar>
void SlopedMedium<Scalar>::rest(const SlopedPlace<Scalar>& place, const Scalar& t, Path<Scalar>& best) const {
  const std::size_t node = place.above;
  const Scalar tie = Scalar(64) * unit_roundoff<Scalar>() * (this->top() - this->bottom());
  Path<Scalar> still;
  still.r_reference = std::min(place.rate_below, place.rate_above);
  still.H = still.r_reference / Scalar(4);
  still.value = up_.amount(node, place.z) + still.H * t;
  if (best.kind != PathKind::none && !(best.value > still.value + tie)) return;
  const bool is_jump = place.below != node && up_.p_high[node - 1] != up_.p[node];
  still.kind = is_jump ? PathKind::fan : PathKind::constant;
  still.upward = true;
  still.source = node;
  still.foot = place.z;
  still.x = Scalar(0);
  best = still;
}

template <Real Scalar>
void SlopedMedium<Scalar>::settle(const SlopedPlace<Scalar>& place, const Scalar& t,
                                  Path<Scalar>& best) const {
  using std::sqrt;
  if (best.kind == PathKind::none) return;
  const std::size_t above = place.above;
  // The momentum next to z on its upper side. A path that sets out within rounding of a jump may bring a flux that only
  // the lower side can carry.
  const Scalar& r = place.rate_above;
  const Scalar q2 = ((r - best.r_reference) + best.r_reference * best.x * best.x) / r;
  const Scalar q = q2 > 0 ? Scalar(sqrt(q2)) : Scalar(0);
  const Scalar less = std::min(Scalar(0.5), Scalar(Scalar(2) * best.H / r / (Scalar(1) + q)));
  best.p = best.upward ? Scalar(Scalar(1) - less) : less;
  // A state that has not left its cell knows p itself: after no time it is what it was, to the bit.
  const bool is_inside = best.kind == PathKind::constant && best.source == above &&
                         (!best.turned || best.interface == above) &&
                         !(best.x == 0 && best.foot == place.z);  // at rest
  if (is_inside && up_.is_curved(above)) {
    const auto state = up_.state_at(above, best.foot);
    best.p = arc_from_state(up_.form[above], up_.bend[above], t, state.p, state.missing, r).p;
  } else if (is_inside) {
    best.p = arc_from_state(up_.form[above], up_.bend[above], t, up_.p[above], up_.missing[above], r).p;
  }
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::fan_between(const Known& low, const Known& high, const Scalar& z,
                                               const Scalar& t) const {
  Path<Scalar> best;
  const Path<Scalar>&a = low.path, &b = high.path;
  if (a.kind != PathKind::fan || fluxes_) return best;
  const SlopedPlace<Scalar> place(up_, z);
  // What does not leave its piece has a closed form.
  const std::size_t source = a.source, n = up_.n_cells();
  const bool is_set_up = a.upward != a.turned;
  const std::size_t first = is_set_up ? source : source - 1;
  for (const std::size_t cell : {place.below, place.above})
    if (up_.piece[cell] == up_.piece[first]) return best;
  const SlopedView<Scalar>& side = view(!is_set_up);
  const std::size_t node = is_set_up ? source : n - source, j = is_set_up ? a.interface : n - 1 - a.interface;
  // A path between two that turn in one piece turns there; one between two straight ones may rest or turn on its way from the nearer
  // of their ends to the other, unless r rises all that way.
  const std::size_t cell = place.above;
  if (!a.turned && !(low.z > up_.x[cell] && high.z < up_.x[cell + 1] &&
                     (is_set_up ? up_.bend[cell] >= 0 : up_.bend[cell] <= 0)))
    return best;
  const Scalar h_low = Scalar(4) * a.H, h_high = Scalar(4) * b.H, part = (z - low.z) / (high.z - low.z);
  const Scalar least = std::min(h_low, h_high), most = std::max(h_low, h_high);
  const Scalar margin = (most - least) / Scalar(64) + Scalar(64) * unit_roundoff<Scalar>() * most;
  SlopedSearch<Scalar, SlopedCandidates<Scalar>> search(side, is_set_up ? place : place.turned_over(up_), t,
                                                        infinity<Scalar>(), false, best);
  search.run_between(node, a.turned, j, h_low + (h_high - h_low) * part,
                     std::max(Scalar(0), Scalar(least - margin)), most + margin);
  settle(place, t, best);
  return best;
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::best_between(const Known& low, const Known& high, const Scalar& z,
                                                const Scalar& t) const {
  const Path<Scalar>&a = low.path, &b = high.path;
  const bool is_one = a.kind == b.kind && a.upward == b.upward && a.source == b.source &&
                      a.turned == b.turned && a.interface == b.interface;
  if (is_one && low.z < z && z < high.z) {
    if (a.kind == PathKind::bottom_wall) return this->bottom_path(z);
    if (a.kind == PathKind::top_wall) return this->top_path();
    const Path<Scalar> fan = fan_between(low, high, z, t);
    if (fan.kind != PathKind::none) return fan;
  }
  // Starts are known to rounding, and where time hardly depends on them to less.
  const Scalar margin = (this->top() - this->bottom()) / Scalar(1 << 20);
  Starts starts;
  if (a.kind != PathKind::bottom_wall) starts.least = a.foot - margin;
  if (b.kind != PathKind::top_wall) starts.most = b.foot + margin;
  return this->best_with_walls(z, t, [&](const Scalar& upper) { return search(z, t, upper, false, starts); });
}

template <Real Scalar>
std::vector<Path<Scalar>> SlopedMedium<Scalar>::best_paths(const std::vector<Scalar>& z,
                                                           const Scalar& t) const {
  std::vector<Path<Scalar>> paths(z.size());
  if (z.empty()) return paths;
  const auto fill = [&](const auto& self, std::size_t lo, std::size_t hi) -> void {
    if (hi < lo + 2) return;
    const std::size_t middle = lo + (hi - lo) / 2;
    paths[middle] = best_between({z[lo], paths[lo]}, {z[hi], paths[hi]}, z[middle], t);
    self(self, lo, middle);
    self(self, middle, hi);
  };
  paths.front() = this->best_path(z.front(), t);
  if (z.size() > 1) paths.back() = this->best_path(z.back(), t);
  fill(fill, 0, z.size() - 1);
  return paths;
}

template <Real Scalar>
Path<Scalar> SlopedMedium<Scalar>::search_for_law(const SlopedPlace<Scalar>& place, const Scalar& t,
                                                  const Scalar& upper, bool moving_only) const {
  using Search = SlopedSearch<Scalar, LawCandidates<Scalar>>;
  Path<Scalar> best;
  const Scalar& z = place.z;
  const std::size_t cell = place.above;
  if (z == up_.x[cell] || z == up_.x[cell + 1]) {
    // At the top of a view there is no cell above: nothing comes from there, and all of the last cell comes from below.
    SlopedPlace<Scalar> upright = place, turned = place.turned_over(up_);
    if (z == up_.x.back()) upright.above = up_.n_cells();
    if (z == up_.x.front()) turned.above = up_.n_cells();
    Search(up_, upright, t, upper, moving_only, best).run();
    Search(down_, turned, t, upper, moving_only, best).run();
  } else {
    thread_local SlopedView<Scalar> up = up_, down = down_;
    up_.put_node(cell, z, place.rate_above, up);
    down_.put_node(up_.n_cells() - 1 - cell, Scalar(-z), place.rate_above, down);
    SlopedPlace<Scalar> node = place;
    node.above = cell + 1;
    Search(up, node, t, upper, moving_only, best).run();
    Search(down, node.turned_over(up), t, upper, moving_only, best).run();
    // Back to the cells of the bed.
    if (best.source > cell) --best.source;
    if (best.turned && best.interface > cell) --best.interface;
  }
  throats_.search(up_, place, t, upper, best);
  // In a flat piece a state at the peak stands still.
  for (const std::size_t k : {place.below, place.above}) {
    if (up_.bend[k] != 0 || up_.q0[k] != 0 || up_.is_curved(k)) continue;
    Path<Scalar> still;
    still.H = up_.low[k] / Scalar(4);
    still.value = up_.amount(k, z) + still.H * t;
    still.kind = PathKind::constant;
    still.source = k;
    still.foot = z;
    still.r_reference = up_.low[k];
    still.x = Scalar(0);
    if (still.better_than(best)) best = still;
  }
  rest(place, t, best);
  if (best.kind == PathKind::none) return best;
  // The momentum next to z on its upper side.
  const std::size_t piece = up_.piece[place.above];
  const LawState<Scalar> end = state_on(best, piece, place.rate_above, best.upward);
  const Scalar& peak = fluxes_->flux(piece).peak();
  const bool by_peak = end.from_peak < end.from_pure;
  const Scalar of_up = by_peak ? Scalar(peak + end.from_peak) : Scalar(Scalar(1) - end.from_pure),
               of_down = by_peak ? Scalar(peak - end.from_peak) : end.from_pure;
  best.p = best.upward ? of_up : of_down;
  return best;
}

template <Real Scalar>
LawState<Scalar> SlopedMedium<Scalar>::state_on(const Path<Scalar>& path, std::size_t piece, const Scalar& r,
                                                bool is_up) const {
  const Scalar &least = path.r_reference, lack = path.x * path.x,
               e = r == least ? lack : Scalar(((r - least) + least * lack) / r);
  return fluxes_->side(piece, is_up)
      .at(std::clamp(e, Scalar(0), Scalar(1)), std::min(Scalar(1), Scalar(Scalar(4) * path.H / r)));
}

template <Real Scalar>
Scalar SlopedMedium<Scalar>::speed(std::size_t cell, const Scalar& r) const {
  const Scalar& q0 = up_.q0[cell];
  const Scalar size = q0 < 0 ? Scalar(-q0) : q0;
  if (!fluxes_) return r * size;
  const LawSide<Scalar> side = up_.side(cell, q0 > 0);
  return r * side.slope(side.at(up_.e0[cell], up_.G0[cell])) / Scalar(4);
}

template <Real Scalar>
Scalar SlopedMedium<Scalar>::pure_time_inside(std::size_t k, const Scalar& a, const Scalar& b,
                                              bool is_up) const {
  const Scalar one(1), &bend = pieces_.bend[k];
  if (!(b > a)) return Scalar(0);
  Scalar time;
  if (pieces_.form[k] == RateForm::linear)
    time =
        Crossing<Scalar>(RateForm::linear, b - a, pieces_.rate(k, a), one, pieces_.rate(k, b), one, Scalar(0))
            .T;
  else if (a == pieces_.boundaries[k])
    time = exponential_time(bend, pieces_.low[k], Scalar(b - a));
  else if (b == pieces_.boundaries[k + 1])
    time = exponential_time(Scalar(-bend), pieces_.high[k], Scalar(b - a));
  else
    time = exponential_time(bend, pieces_.rate(k, a), Scalar(b - a));
  if (!fluxes_) return time;
  const LawSide<Scalar> side = fluxes_->side(k, is_up);
  return time * (Scalar(4) / side.slope({side.reach(), Scalar(0)}));
}

template <Real Scalar>
void SlopedMedium<Scalar>::set_pure_times() {
  const std::size_t n = pieces_.size();
  from_bottom_.assign(n + 1, Scalar(0));
  from_top_.assign(n + 1, Scalar(0));
  for (std::size_t k = 0; k < n; ++k)
    from_bottom_[k + 1] =
        from_bottom_[k] + pure_time_inside(k, pieces_.boundaries[k], pieces_.boundaries[k + 1], true);
  for (std::size_t k = n; k-- > 0;)
    from_top_[k] =
        from_top_[k + 1] + pure_time_inside(k, pieces_.boundaries[k], pieces_.boundaries[k + 1], false);
}

template <Real Scalar>
Scalar SlopedMedium<Scalar>::pure_travel_time(const Scalar& from, const Scalar& to) const {
  const Scalar &lo = std::min(from, to), &hi = std::max(from, to);
  const auto& z = pieces_.boundaries;
  const bool is_up = from < to;
  std::size_t k = pieces_.piece_at(lo);
  // From the walls, as every query asks.
  if (is_up && lo == z.front()) {
    const std::size_t last = pieces_.piece_at(hi);
    return from_bottom_[last] + pure_time_inside(last, z[last], hi, true);
  }
  if (!is_up && hi == z.back()) return from_top_[k + 1] + pure_time_inside(k, lo, z[k + 1], false);
  Scalar all(0);
  for (; k < pieces_.size() && z[k] < hi; ++k)
    all += pure_time_inside(k, std::max(lo, z[k]), std::min(hi, z[k + 1]), is_up);
  return all;
}

/// By the ends of the piece of z, where they tell.
template <Real Scalar>
bool SlopedMedium<Scalar>::is_reached_from(bool is_bottom, const Scalar& z, const Scalar& t) const {
  const std::size_t k = pieces_.piece_at(z);
  const Scalar &earliest = is_bottom ? from_bottom_[k] : from_top_[k + 1],
               &latest = is_bottom ? from_bottom_[k + 1] : from_top_[k];
  if (earliest > t) return false;
  // By more than rounding: at the end itself the time is that of the end.
  if (latest * (Scalar(1) + Scalar(64) * unit_roundoff<Scalar>()) < t) return true;
  return pure_travel_time(is_bottom ? this->bottom() : this->top(), z) <= t;
}

template <Real Scalar>
void SlopedMedium<Scalar>::add_run(const Path<Scalar>& path, const Scalar& from, const Scalar& to,
                                   Costs& costs) const {
  const Scalar &lo = std::min(from, to), &hi = std::max(from, to), h = Scalar(4) * path.H;
  const auto q = [&](const Scalar& rate) { return q_at(rate, path.r_reference, path.lost()); };
  const bool is_up = from < to;
  for (std::size_t k = pieces_.piece_at(lo); k < pieces_.size() && pieces_.boundaries[k] < hi; ++k) {
    const Scalar a = std::max(lo, pieces_.boundaries[k]), b = std::min(hi, pieces_.boundaries[k + 1]);
    if (!(b > a)) continue;
    const Scalar r1 = pieces_.rate(k, a), r2 = pieces_.rate(k, b), d = b - a;
    const auto add = [&](const auto& run) {
      costs.T += run.T;
      costs.X += run.X;
    };
    if (fluxes_)
      add(LawRun<Scalar>(fluxes_->side(k, is_up), pieces_.form[k], pieces_.bend[k], d, r1,
                         state_on(path, k, r1, is_up), r2, state_on(path, k, r2, is_up), h));
    else
      add(Crossing<Scalar>(pieces_.form[k], d, r1, q(r1), r2, q(r2), h));
  }
}

template <Real Scalar>
void SlopedMedium<Scalar>::add_turn(const Path<Scalar>& path, std::size_t piece, const Scalar& r,
                                    bool is_set_up, Costs& costs) const {
  const Scalar h = Scalar(4) * path.H, bend = is_set_up ? Scalar(-pieces_.bend[piece]) : pieces_.bend[piece];
  const auto add = [&](const auto& turn) {
    costs.T += turn.T;
    costs.X += turn.X;
  };
  if (fluxes_)
    add(LawTurn<Scalar>(fluxes_->side(piece, true), fluxes_->side(piece, false), pieces_.form[piece], bend, r,
                        state_on(path, piece, r, true), state_on(path, piece, r, false), h));
  else
    add(Turn<Scalar>(pieces_.form[piece], bend, r, q_at(r, path.r_reference, path.lost()), h));
}

/// The value of a path is (M0 at its start + U) + sum X + H (t - sum T), U the height gained on its ways up, those in a turn
/// counted to the far end of the piece: the bracket holds data only, and the other terms are small where H is. A turn
/// from the rate r to h in a linear piece that ends at r_end has X = (r_end - h / (1 + q)) / |b| then.
template <Real Scalar>
Scalar SlopedMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                       FinalAmount amount) const {
  CompensatedSum<Scalar> sum;
  add_final_less_initial(cells_, path, z, amount, sum);
  const Scalar h = Scalar(4) * path.H;
  const auto rise = [&](const Scalar& from, const Scalar& to) {
    if (!(from < to)) return;
    sum += from;
    sum += -to;
  };
  Costs costs;
  auto& [T, X] = costs;
  if (path.kind == PathKind::waiting) {
    const Scalar& rest = cells_.x[path.interface];
    rise(path.foot, rest);
    rise(rest, z);
    add_run(path, path.foot, rest, costs);
    add_run(path, rest, z, costs);
  } else if (path.turned) {
    const bool is_up = path.upward != path.turned;
    const std::size_t j = cells_.layer[path.interface];
    const Scalar &near = pieces_.boundaries[is_up ? j : j + 1], &far = pieces_.boundaries[is_up ? j + 1 : j];
    const Scalar outer = is_up ? std::max(path.foot, z) : std::min(path.foot, z);
    const Scalar last = is_up ? std::max(outer, near) : std::min(outer, near);
    is_up ? rise(path.foot, far) : rise(far, z);
    add_run(path, path.foot, z, costs);
    add_run(path, outer, last, costs);
    add_run(path, last, outer, costs);
    const Scalar r = pieces_.rate(j, last), &r_end = is_up ? pieces_.high[j] : pieces_.low[j];
    const Scalar bend = is_up ? Scalar(-pieces_.bend[j]) : pieces_.bend[j], X_before = X;
    add_turn(path, j, r, is_up, costs);
    if (!fluxes_ && pieces_.form[j] == RateForm::linear)
      X = X_before + (r_end - h / (Scalar(1) + q_at(r, path.r_reference, path.lost()))) / bend;
    else
      X -= is_up ? Scalar(far - last) : Scalar(last - far);
  } else {
    rise(path.foot, z);
    if (h > 0) add_run(path, path.foot, z, costs);
  }
  if (!is_finite(T)) T = t, X = Scalar(0);
  sum += Scalar(-X);
  sum += Scalar(-path.H * (t - T));
  return sum.value();
}

template <Real Scalar>
std::optional<Scalar> SlopedMedium<Scalar>::first_wave(std::size_t i) const {
  return SlopedArrival<Scalar>(*this, i).find();
}

template <Real Scalar>
PathGradient<Scalar> SlopedMedium<Scalar>::gradient(const Path<Scalar>& path, const Scalar& z,
                                                    const Scalar& t) const {
  PathGradient<Scalar> out;
  const auto differentiate = [&]<class Calculus>(const Calculus& calculus) {
    SlopedGradient<Scalar, Calculus>(calculus, pieces_, cells_, path, z, t, out).run();
  };
  fluxes_ ? differentiate(LawCalculus<Scalar>(*fluxes_, pieces_, path))
          : differentiate(ParabolaCalculus<Scalar>(pieces_, path));
  return out;
}

template class SlopedMedium<Instantiated>;

}  // namespace shearfront::exact
