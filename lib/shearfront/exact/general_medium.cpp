// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/general_medium.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace shearfront::exact {

template <Real Scalar>
GeneralMedium<Scalar>::GeneralMedium(const CanonicalForm<Scalar>& form)
    : layers_(exact_layers(form.image())), cells_(form.image(), layers_.boundaries()) {
  for (const Flux<Scalar>& flux : form.layers().fluxes()) laws_.emplace_back(flux);
  for (std::size_t k = 0; k < layers_.n_layers(); ++k) {
    law_of_.push_back(form.layers().flux_index(k));
    capacity_.push_back(layers_.rate(k) / Scalar(4));
  }
  for (std::size_t i = 0; i < cells_.n_cells(); ++i)
    H_cell_.push_back(flux_of(cells_.layer[i], cells_.phi[i]));
  emits_up_.assign(cells_.x.size(), false);
  emits_down_ = emits_up_;
  for (std::size_t i = 1; i < cells_.n_cells(); ++i) {
    emits_up_[i] = emits(i, true);
    emits_down_[i] = emits(i, false);
  }
  rests_.resize(layers_.n_layers() + 1);
  for (std::size_t i = 1; i < layers_.n_layers(); ++i) rests_[i] = rest_at(i);
}

template <Real Scalar>
Scalar GeneralMedium<Scalar>::flux_of(std::size_t k, const Scalar& phi) const {
  if (phi == 0 || phi == 1) return Scalar(0);
  const bool up = phi > law(k).peak();
  const Scalar d = up ? Scalar(phi - law(k).peak()) : Scalar(law(k).peak() - phi);
  return capacity_[k] * std::max(Scalar(0), Scalar(Scalar(1) - law(k).lack(d, up)));
}

template <Real Scalar>
Scalar GeneralMedium<Scalar>::flux_at(const Scalar& z, const Scalar& phi) const {
  return flux_of(layers_.layer_at(z), phi);
}

template <Real Scalar>
Scalar GeneralMedium<Scalar>::momentum(std::size_t k, bool upward, const Scalar& reference,
                                       const Scalar& x) const {
  return law(k).state(law(k).inverse(lack(k, reference, x), upward), upward);
}

template <Real Scalar>
void GeneralMedium<Scalar>::add_layer(std::size_t k, const Scalar& d, bool upward, const Scalar& reference,
                                      const Scalar& x, Leg& leg) const {
  if (!(d > 0)) return;
  const Scalar distance = law(k).inverse(lack(k, reference, x), upward);
  const Scalar speed = capacity_[k] * law(k).slope(distance, upward);
  const Scalar p = law(k).state(distance, upward);
  leg.time += speed > 0 ? Scalar(d / speed) : infinity<Scalar>();
  leg.cost += upward ? Scalar(p * d) : Scalar(-p * d);
}

template <Real Scalar>
auto GeneralMedium<Scalar>::leg(const Scalar& from, const Scalar& to, const Scalar& reference,
                                const Scalar& x) const -> Leg {
  const Scalar& lo = std::min(from, to);
  const Scalar& hi = std::max(from, to);
  Leg sum;
  for (std::size_t k = layers_.layer_at(lo); k < layers_.n_layers() && layers_.boundary(k) < hi; ++k)
    add_layer(k, std::min(hi, layers_.boundary(k + 1)) - std::max(lo, layers_.boundary(k)), from < to,
              reference, x, sum);
  return sum;
}

template <Real Scalar>
Scalar GeneralMedium<Scalar>::pure_travel_time(const Scalar& from, const Scalar& to) const {
  return leg(from, to, capacity_.front(), Scalar(1)).time;
}

/// Whether some H satisfies phi_below <= p <= phi_above for the momenta p of a path from point i on both
/// sides: otherwise moving the start pays. The slack keeps rounding from dropping a borderline source.
template <Real Scalar>
bool GeneralMedium<Scalar>::emits(std::size_t i, bool upward) const {
  const Scalar slack = Scalar(1) / Scalar(1 << 20);
  const std::size_t ahead = upward ? i : i - 1, behind = upward ? i - 1 : i;
  const std::size_t k = cells_.layer[ahead], l = cells_.layer[behind];
  if (cells_.phi[ahead] == cells_.phi[behind] && H_cell_[ahead] == 0) return false;
  // Into the cell ahead with p on the branch of the direction, at most (at least) its state.
  const auto over = [&](std::size_t cell, std::size_t layer) {
    const Scalar over_peak = cells_.phi[cell] - law(layer).peak();
    return upward ? over_peak : Scalar(-over_peak);
  };
  if (over(ahead, k) < -slack) return false;
  const Scalar limit = over(behind, l) > 0 ? H_cell_[behind] : capacity_[l];
  return H_cell_[ahead] <= limit + slack * capacity_[k];
}

template <Real Scalar>
auto GeneralMedium<Scalar>::rest_at(std::size_t i) const -> Rest {
  Rest rest;
  rest.H = std::min(capacity_[i - 1], capacity_[i]);
  const Scalar x(0);
  std::vector<Entry> all;
  const std::size_t at = cells_.first[i];
  if (!(cells_.phi[at - 1] == cells_.phi[at] && H_cell_[at - 1] == 0 && H_cell_[at] == 0))
    all.push_back({Scalar(0), cells_.M[at], at});
  for (const bool above : {true, false}) {
    std::vector<Leg>& out = above ? rest.up : rest.down;
    out.push_back({});
    Leg in;  // of paths that come from this side
    for (std::size_t k = above ? i : i - 1; k < layers_.n_layers() && !(capacity_[k] < rest.H);
         above ? ++k : --k) {
      const auto d_to = [&](const Scalar& y) {
        return above ? Scalar(y - layers_.boundary(k)) : Scalar(layers_.boundary(k + 1) - y);
      };
      for (std::size_t point = cells_.first[k]; point <= cells_.first[k + 1]; ++point) {
        if (point == 0 || point + 1 == cells_.x.size() || !(d_to(cells_.x[point]) > 0)) continue;
        Leg arrival = in;
        add_layer(k, d_to(cells_.x[point]), !above, rest.H, x, arrival);
        if (is_finite(arrival.time)) all.push_back({arrival.time, cells_.M[point] + arrival.cost, point});
      }
      const Scalar height = layers_.boundary(k + 1) - layers_.boundary(k);
      add_layer(k, height, !above, rest.H, x, in);
      Leg next = out.back();
      add_layer(k, height, above, rest.H, x, next);
      if (!is_finite(in.time) || !is_finite(next.time)) break;
      out.push_back(next);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.tau < b.tau; });
  for (const Entry& entry : all)
    if (rest.entries.empty() || entry.A < rest.entries.back().A) rest.entries.push_back(entry);
  return rest;
}

template <Real Scalar>
Path<Scalar> GeneralMedium<Scalar>::best_free(const Scalar& z, const Scalar& t,
                                              const Scalar& /*upper*/) const {
  return search({z, t, layers_.layer_at(z), false});
}

template <Real Scalar>
Path<Scalar> GeneralMedium<Scalar>::best_moving(const Scalar& z, const Scalar& t) const {
  return search({z, t, layers_.layer_at(z), true});
}

template <Real Scalar>
Path<Scalar> GeneralMedium<Scalar>::search(const Query& query) const {
  Path<Scalar> best;
  for (const bool upward : {true, false}) {
    Scalar slowest = capacity_[query.k];
    for (std::size_t j = query.k; j < layers_.n_layers(); upward ? --j : ++j) {
      const Scalar& exit = j == query.k ? query.z : layers_.boundary(upward ? j + 1 : j);
      if (j != query.k && pure_travel_time(exit, query.z) > query.t) break;
      const Scalar between = slowest;  // of the layers before this one
      slowest = std::min(slowest, capacity_[j]);
      for (std::size_t i = cells_.first[j]; i < cells_.first[j + 1]; ++i) {
        if (j == query.k && (upward ? cells_.x[i] > query.z : cells_.x[i + 1] < query.z)) continue;
        try_cell(query, i, upward, j == query.k ? infinity<Scalar>() : between, best);
        const std::size_t point = upward ? i : i + 1;
        if (upward ? emits_up_[point] : emits_down_[point]) try_source(query, point, upward, slowest, best);
      }
    }
  }
  for (std::size_t i = 1; i < layers_.n_layers(); ++i) try_rest(query, i, best);
  return best;
}

/// The fan from point i; `reference`: least capacity of the layers crossed.
template <Real Scalar>
void GeneralMedium<Scalar>::try_source(const Query& query, std::size_t i, bool upward,
                                       const Scalar& reference, Path<Scalar>& best) const {
  const Scalar& from = cells_.x[i];
  if (from == query.z && cells_.first[query.k] == i) return;  // at an interface: a path that rests there
  Scalar x(1);
  Leg path_leg = leg(from, query.z, reference, x);
  if (path_leg.time > query.t) return;
  const Scalar fastest = path_leg.time;
  path_leg = leg(from, query.z, reference, Scalar(0));
  if (!(path_leg.time > query.t)) {
    x = Scalar(0);
  } else {
    const Scalar u = unit_roundoff<Scalar>();
    std::uintmax_t most = 300;
    // t / T(x) is nearly linear: linear for one layer of a parabola.
    const auto excess = [&](const Scalar& y) {
      return Scalar(query.t / leg(from, query.z, reference, y).time - Scalar(1));
    };
    const Scalar low = is_finite(path_leg.time) ? Scalar(query.t / path_leg.time - Scalar(1)) : Scalar(-1);
    const Scalar high = query.t / fastest - Scalar(1);
    if (high > 0) {
      const auto [a, b] = boost::math::tools::toms748_solve(
          excess, Scalar(0), Scalar(1), low, high,
          [&](const Scalar& y, const Scalar& y2) { return y2 - y <= Scalar(2) * u * y2; }, most);
      x = a + (b - a) / Scalar(2);
    }
    path_leg = leg(from, query.z, reference, x);
  }
  Path<Scalar> path;
  path.H = reference * ((Scalar(1) - x) * (Scalar(1) + x));
  path.value = cells_.M[i] + (path_leg.cost + path.H * query.t);
  if (path.value > best.value) return;
  path.p = momentum(query.k, upward, reference, x);
  path.kind = PathKind::fan;
  path.upward = upward;
  path.source = i;
  path.foot = from;
  path.r_reference = Scalar(4) * reference;
  path.x = x;
  if (path.better_than(best)) best = path;
}

/// The characteristic of the constant initial state of cell i; `slowest`: least capacity beyond its layer.
template <Real Scalar>
void GeneralMedium<Scalar>::try_cell(const Query& query, std::size_t i, bool upward, const Scalar& slowest,
                                     Path<Scalar>& best) const {
  using std::sqrt;
  const Scalar &phi = cells_.phi[i], &H = H_cell_[i], &t = query.t;
  const std::size_t j = cells_.layer[i];
  const bool own = j == query.k;
  const Scalar over = upward ? Scalar(phi - law(j).peak()) : Scalar(law(j).peak() - phi);
  if (over < 0 || (!own && over == 0)) return;
  if (query.moving_only && H == 0) return;
  if (!(H < slowest)) return;  // ends of the cell cover what is equal to a capacity
  const Scalar lack = law(j).lack(over, upward), x = sqrt(lack);
  const Scalar speed = over > 0 ? Scalar(capacity_[j] * law(j).slope(over, upward)) : Scalar(0);
  const Scalar& exit = own ? query.z : layers_.boundary(upward ? j + 1 : j);
  const Leg beyond = own ? Leg{} : leg(exit, query.z, capacity_[j], x);
  const Scalar nearest = upward ? exit - cells_.x[i + 1] : cells_.x[i] - exit;
  const Scalar farthest = upward ? exit - cells_.x[i] : cells_.x[i + 1] - exit;
  const Scalar d = (t - beyond.time) * speed;
  if (!(d >= nearest && d <= farthest) || d < 0) return;
  Path<Scalar> path;
  path.foot = upward ? exit - d : exit + d;
  path.H = H;
  path.r_reference = Scalar(4) * capacity_[j];
  path.x = x;
  path.kind = PathKind::constant;
  path.upward = upward;
  path.source = i;
  const Scalar start = cells_.M[i] + phi * (path.foot - cells_.x[i]);
  path.p = own || H == 0 ? phi : momentum(query.k, upward, capacity_[j], x);
  if (H == 0)  // pure states: exact even where the sums below would leave a rounding error
    path.value = upward ? Scalar(start + (query.z - path.foot)) : start;
  else
    path.value = start + ((phi * (exit - path.foot) + beyond.cost) + H * t);
  if (path.better_than(best)) best = path;
}

template <Real Scalar>
void GeneralMedium<Scalar>::try_rest(const Query& query, std::size_t i, Path<Scalar>& best) const {
  const Rest& rest = rests_[i];
  if (rest.entries.empty()) return;
  const Scalar& z_i = layers_.boundary(i);
  const bool upward = !(query.z < z_i);
  const std::vector<Leg>& legs = upward ? rest.up : rest.down;
  const std::size_t n = upward ? query.k - i : i - 1 - query.k;  // layers crossed as a whole
  if (n >= legs.size() || capacity_[query.k] < rest.H) return;
  Leg out = legs[n];
  const Scalar d = upward ? query.z - layers_.boundary(query.k) : layers_.boundary(query.k + 1) - query.z;
  add_layer(query.k, d, upward, rest.H, Scalar(0), out);
  const Scalar left = query.t - out.time;
  const auto late = std::upper_bound(rest.entries.begin(), rest.entries.end(), left,
                                     [](const Scalar& time, const Entry& e) { return time < e.tau; });
  if (late == rest.entries.begin()) return;
  const Entry& entry = *(late - 1);
  Path<Scalar> path;
  path.value = entry.A + (out.cost + rest.H * query.t);
  if (path.value > best.value) return;
  path.H = rest.H;
  path.r_reference = Scalar(4) * rest.H;
  path.x = Scalar(0);
  path.kind = PathKind::waiting;
  path.upward = upward;
  path.source = entry.source;
  path.interface = i;
  path.foot = cells_.x[entry.source];
  path.p = momentum(query.k, upward, rest.H, Scalar(0));
  if (path.better_than(best)) best = path;
}

template <Real Scalar>
Scalar GeneralMedium<Scalar>::shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& /*t*/,
                                        FinalAmount amount) const {
  CompensatedSum<Scalar> sum;
  if (amount == FinalAmount::full_below || (amount == FinalAmount::both && path.upward)) {
    sum += z;
    sum += -cells_.x.front();
  } else {
    sum += cells_.M.back();
    sum += cells_.M_low.back();
  }
  sum += -path.value;
  return sum.value();
}

template class GeneralMedium<Instantiated>;

}  // namespace shearfront::exact
