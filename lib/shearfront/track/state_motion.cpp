// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/state_motion.hpp"

#include <optional>

namespace shearfront {
namespace {

/// d(strength f(x)) where the share moves by dx; for a state at an extremum, where f has no slope or a kink, with its model.
struct FluxMotion {
  const Flux<double>& flux;
  const Flux<Dual<1>>* moving;  ///< none: its numbers stay
  double strength, strength_by;

  [[nodiscard]] double operator()(double x, double dx) const {
    if (moving) {
      const Dual<1> value = moving->value(Dual<1>(x, dx));
      return strength_by * value.v + strength * value.d[0];
    }
    const double slope = dx != 0 ? strength * flux.derivative(x) * dx : 0;
    return strength_by != 0 ? strength_by * flux.value(x) + slope : slope;
  }
  /// dx at which strength f(x) moves by `df`.
  [[nodiscard]] double inverse(double x, double df) const {
    const double rest = df - (*this)(x, 0);
    return rest != 0 ? rest / (strength * flux.derivative(x)) : 0;
  }
};

/// Derivatives of range and extrema of a flux, with the values.
struct FluxPlaces {
  StateRange<Dual<1>> range;
  std::vector<Dual<1>> extrema;
  explicit FluxPlaces(const Flux<Dual<1>>& flux) : range(flux.range()), extrema(flux.extrema()) {}
};

const Flux<Dual<1>>* moving_flux_of(const SceneTangent& by, std::size_t flux) {
  return by.moving_flux == flux ? &by.fluxes[flux] : nullptr;
}

/// Rate and solid fraction of a layer, and the share of a state, with their derivatives.
struct LayerTangent {
  const Flux<Dual<1>>& flux;
  Dual<1> rate, solid_fraction;

  LayerTangent(const LayerStack<double>& stack, const SceneTangent& by, std::size_t k)
      : flux(by.fluxes[stack.flux_index(k)]),
        rate(stack.rate(k), by.rate[k]),
        solid_fraction(stack.solid_fraction(k), by.solid_fraction[k]) {}

  [[nodiscard]] Dual<1> share(double phi, double phi_by) const {
    return Dual<1>(phi, phi_by) / solid_fraction;
  }
  /// d |rate (f'(r) - f'(l)) / (x_r - x_l)| / c.
  [[nodiscard]] double fan_rate(const Dual<1>& x_l, const Dual<1>& x_r) const {
    return abs(rate * (flux.derivative(x_r) - flux.derivative(x_l)) / (x_r - x_l) / solid_fraction).d[0];
  }
  [[nodiscard]] double speed(const Dual<1>& x_l, const Dual<1>& x_r) const {
    return (rate * flux.secant(x_l, x_r)).d[0];
  }
};

}  // namespace

/// Of one column: per class its capacity, per level its value and, where that is known by itself, the place of its state.
struct StateMotion<LevelGrid<double>>::Moved {
  std::vector<double> capacity, level, chord;
  std::vector<double> lowest, highest;  ///< per layer: of the states
  std::vector<double> place;            ///< per level: of p at home
  std::vector<bool> is_wanted;
  Tears levels, places, capacities;
};

void StateMotion<LevelGrid<double>>::move_classes(const SceneTangent& by, Moved& moved) const {
  const Grid& grid = of_.grid;
  moved.capacity.assign(grid.classes_.size(), 0.0);
  std::vector<bool> is_known(grid.classes_.size());
  for (std::size_t k = 0; k < grid.n_layers(); ++k) {
    const std::size_t f = of_.stack.flux_index(k);
    const Flux<Dual<1>>& flux = by.fluxes[f];
    const Dual<1> rate(of_.stack.rate(k), by.rate[k]),
        fraction(of_.stack.solid_fraction(k), by.solid_fraction[k]);
    const StateRange<Dual<1>> range = flux.range();
    const double capacity = abs(rate * fraction * flux.value(flux.extrema().front())).d[0];
    moved.lowest.push_back((fraction * range.lowest).d[0]);
    moved.highest.push_back((fraction * range.highest).d[0]);
    const std::size_t id = grid.layer_capacity_[k];
    if (is_known[id]) moved.capacities.compare(capacity, moved.capacity[id]);
    moved.capacities.see(capacity);
    moved.capacity[id] = capacity;
    is_known[id] = true;
  }
}

void StateMotion<LevelGrid<double>>::move_wanted(const SceneTangent& by, Moved& moved) const {
  const Grid& grid = of_.grid;
  const std::size_t n = grid.levels_.size();
  moved.level.assign(n, 0.0), moved.place.assign(n, 0.0), moved.chord.assign(n, 0.0);
  moved.is_wanted.assign(n, false);
  for (std::size_t w = 0; w < of_.wanted.size(); ++w) {
    const std::size_t layer = of_.wanted[w].layer;
    const State i = grid.level(layer, of_.states[w]);
    const Grid::Level& level = grid.levels_[Grid::index(i)];
    // u = (share - lowest) / width or (highest - share) / width, p the smaller of u and 1 - u.
    const StateRange<Dual<1>> range = by.fluxes[of_.stack.flux_index(layer)].range();
    const Dual<1> share(of_.wanted[w].phi, by.wanted[w]), width = range.highest - range.lowest;
    const Dual<1> u = (grid.is_reversed_ ? range.highest - share : share - range.lowest) / width;
    const double p_by = u.v + u.v <= 1 ? u.d[0] : -u.d[0];
    if (moved.is_wanted[Grid::index(i)]) moved.places.compare(p_by, moved.place[Grid::index(i)]);
    moved.places.see(p_by);
    const bool is_fixed = level.value == 0 || (level.home >= 0 && level.p + level.p == 1);
    if (is_fixed) {
      moved.places.compare(p_by, 0);
      continue;
    }
    if (level.home >= 0 && level.home != static_cast<std::int32_t>(grid.layer_capacity_[layer]))
      moved.places.compare(p_by, 0);  // one level of two states that are not related
    moved.place[Grid::index(i)] = p_by;
    moved.is_wanted[Grid::index(i)] = true;
    if (level.home == Grid::kOnChord) moved.chord[Grid::index(i)] = static_cast<double>(layer);
  }
}

void StateMotion<LevelGrid<double>>::move_levels(Moved& moved) const {
  const Grid& grid = of_.grid;
  for (std::size_t i = 1; i < grid.levels_.size(); ++i) {
    const Grid::Level& level = grid.levels_[i];
    if (level.home < 0) continue;
    const auto home = static_cast<std::size_t>(level.home);
    const double c = grid.classes_[home].capacity, c_by = moved.capacity[home], p = level.p;
    if (p + p == 1) {
      moved.level[i] = c_by;
      continue;
    }
    double& p_by = moved.place[i];
    if (!moved.is_wanted[i]) {
      // A part of the way from the capacity of the class below to the own one.
      const double below = home > 0 ? grid.classes_[home - 1].capacity : 0,
                   below_by = home > 0 ? moved.capacity[home - 1] : 0;
      const double q = std::sqrt((c - below) / c), first = below / (2 * c * (1 + q)),
                   first_by = below > 0 ? (below_by - 4 * first * (1 - first) * c_by) / (4 * c * q) : 0;
      p_by = first_by * (1 - (p - first) / (0.5 - first));
    }
    moved.level[i] = c_by * 4 * p * (1 - p) + 4 * c * (1 - 2 * p) * p_by;
    moved.levels.see(moved.level[i]);
  }
}

/// Of the state of a level on the falling branch of a class, as a part of the range.
double StateMotion<LevelGrid<double>>::place_tangent(std::size_t id, State i, const Moved& moved) const {
  const Grid& grid = of_.grid;
  const Grid::Level& level = grid.levels_[Grid::index(i)];
  if (level.value == 0) return 0;
  if (level.home == static_cast<std::int32_t>(id)) return moved.place[Grid::index(i)];
  std::size_t layer = 0;
  while (grid.layer_capacity_[layer] != id) ++layer;
  if (level.home == Grid::kOnChord) {
    const double lo = place_tangent(id, level.vertex_below, moved),
                 hi = place_tangent(id, level.vertex_above, moved);
    const double length =
        grid.falling_phi(layer, level.vertex_above) - grid.falling_phi(layer, level.vertex_below);
    return lo + level.p * (hi - lo) + moved.chord[Grid::index(i)] * length;
  }
  const double c = grid.classes_[id].capacity, p = grid.falling_phi(layer, i);
  return (moved.level[Grid::index(i)] - 4 * p * (1 - p) * moved.capacity[id]) / (4 * c * (1 - 2 * p));
}

void StateMotion<LevelGrid<double>>::move_chords(const SceneTangent&, Moved& moved) const {
  const Grid& grid = of_.grid;
  for (std::size_t i = 0; i < grid.levels_.size(); ++i) {
    const Grid::Level& level = grid.levels_[i];
    if (level.home != Grid::kOnChord) continue;
    const auto layer = static_cast<std::size_t>(moved.chord[i]);
    const std::size_t id = grid.layer_capacity_[layer];
    const double lo = place_tangent(id, level.vertex_below, moved),
                 hi = place_tangent(id, level.vertex_above, moved);
    const double length =
        grid.falling_phi(layer, level.vertex_above) - grid.falling_phi(layer, level.vertex_below);
    moved.chord[i] = (moved.place[i] - lo - level.p * (hi - lo)) / length;
    const std::size_t below = Grid::index(level.vertex_below), above = Grid::index(level.vertex_above);
    moved.level[i] = moved.level[below] + level.p * (moved.level[above] - moved.level[below]) +
                     moved.chord[i] * (grid.levels_[above].value - grid.levels_[below].value);
  }
}

double StateMotion<LevelGrid<double>>::width(std::size_t layer) const {
  const auto& ranges = of_.grid.ranges_;
  return ranges.empty() ? 1 : ranges[layer].highest - ranges[layer].lowest;
}

StateTangent StateMotion<LevelGrid<double>>::tangent(const SceneTangent& by) const {
  const Grid& grid = of_.grid;
  Moved moved;
  move_classes(by, moved);
  move_wanted(by, moved);
  move_levels(moved);
  move_chords(by, moved);
  StateTangent all;
  all.is_torn = moved.capacities.are_any() || moved.places.are_any();
  all.phi.resize(rows_.n()), all.flux.resize(rows_.n());
  std::vector<double> place;
  for (std::size_t id = 0; id < grid.classes_.size(); ++id) {
    place.clear();
    for (State i = 0; i <= grid.classes_[id].top; ++i) place.push_back(place_tangent(id, i, moved));
    for (std::size_t k = 0; k < grid.n_layers(); ++k) {
      if (grid.layer_capacity_[k] != id) continue;
      for (State s = 0; s < grid.n_states(k); ++s) {
        const State i = grid.level(k, s);
        const double p_by = place[Grid::index(i)], u_by = s == i ? p_by : -p_by, u = grid.unit_phi(k, s);
        const std::size_t row = rows_(k, s);
        const double range_by = moved.highest[k] - moved.lowest[k];
        all.phi[row] = grid.is_reversed_ ? moved.highest[k] - range_by * u - width(k) * u_by
                                         : moved.lowest[k] + range_by * u + width(k) * u_by;
        all.flux[row] = grid.is_reversed_ ? moved.level[Grid::index(i)] : -moved.level[Grid::index(i)];
      }
    }
  }
  return all;
}

double StateMotion<LevelGrid<double>>::fan_rate(const SceneTangent& by, const StateTangent&,
                                                std::size_t layer, State, State) const {
  Moved moved;
  move_classes(by, moved);
  const std::size_t id = of_.grid.layer_capacity_[layer];
  const Dual<1> capacity(of_.grid.classes_[id].capacity, moved.capacity[id]),
      range(width(layer), moved.highest[layer] - moved.lowest[layer]);
  return (Dual<1>(8) * capacity / (range * range)).d[0];
}

double StateMotion<LevelGrid<double>>::speed(const SceneTangent& by, const StateTangent& states,
                                             std::size_t layer, State l, State r) const {
  const Grid& grid = of_.grid;
  const auto [l_lo, l_hi] = grid.chord(layer, l);
  const auto [r_lo, r_hi] = grid.chord(layer, r);
  if (l_lo == l_hi && r_lo == r_hi) {
    const LayerTangent tangent(of_.stack, by, layer);
    const auto share = [&](State i) {
      return tangent.share(grid.phi(layer, i), states.phi[rows_(layer, i)]);
    };
    return tangent.speed(share(l), share(r));
  }
  // Of the chord, or of the two that meet between the states.
  const State lo = std::min(l_lo, r_lo), hi = std::max(l_hi, r_hi);
  const double run = grid.phi(layer, hi) - grid.phi(layer, lo),
               speed = (grid.flux(layer, hi) - grid.flux(layer, lo)) / run;
  const std::size_t from = rows_(layer, lo), to = rows_(layer, hi);
  return (states.flux[to] - states.flux[from] - speed * (states.phi[to] - states.phi[from])) / run;
}

/// One column, level by level, upwards as the grid was made.
class StateMotion<UnimodalGrid<double>>::Mover {
 public:
  using Special = Grid::Special;
  using Role = Special::Role;

  Mover(const GridOfScene<Grid>& of, const SceneTangent& by) : of_(of), by_(by), grid_(of.grid) {
    const std::size_t n = grid_.classes_.size();
    strength_by_.assign(n, 0.0);
    std::vector<bool> is_known(n);
    for (std::size_t k = 0; k < grid_.n_layers(); ++k) {
      const std::uint32_t id = grid_.layers_[k].id;
      const double strength =
          by.rate[k] * of.stack.solid_fraction(k) + of.stack.rate(k) * by.solid_fraction[k];
      if (is_known[id]) strengths_.compare(strength, strength_by_[id]);
      strengths_.see(strength);
      strength_by_[id] = strength;
      is_known[id] = true;
    }
    for (const Flux<Dual<1>>& flux : by.fluxes) places_.emplace_back(flux);
    for (std::size_t id = 0; id < n; ++id) {
      const auto states = static_cast<std::size_t>(2 * grid_.classes_[id].top + 1);
      share_by_.emplace_back(states, 0.0);
      is_given_.emplace_back(states, false);
    }
    first_.assign(n, {0, 0});
    for (const Special& s : grid_.specials_) {
      if (s.role == Role::first_end) first_[s.id].falling = s.level;
      if (s.role == Role::last_end) first_[s.id].rising = s.level;
    }
    level_by_.assign(grid_.levels_.size(), 0.0);
  }

  [[nodiscard]] StateTangent run(const StateRows& rows) {
    auto special = grid_.specials_.begin();
    for (State n = 0; n < static_cast<State>(grid_.levels_.size()); ++n) {
      const auto begin = special;
      for (; special != grid_.specials_.end() && special->level == n; ++special)
        give(*special, special == begin);
      if (begin == special) step_to(n);
      for (std::size_t id = 0; id < grid_.classes_.size(); ++id) follow(id, n);
    }
    StateTangent all;
    all.is_torn = strengths_.are_any() || levels_.are_any() || shares_.are_any();
    all.phi.resize(rows.n()), all.flux.resize(rows.n());
    for (std::size_t k = 0; k < grid_.n_layers(); ++k) {
      const std::size_t id = grid_.layers_[k].id;
      for (State i = 0; i < grid_.n_states(k); ++i) {
        const std::size_t row = rows(k, i);
        all.phi[row] = by_.solid_fraction[k] * grid_.classes_[id].polygon.share(i) +
                       of_.stack.solid_fraction(k) * share_by_[id][Grid::index(i)];
        all.flux[row] = sign() * level_by_[Grid::index(grid_.level(k, i))];
      }
    }
    return all;
  }

 private:
  [[nodiscard]] double sign() const { return grid_.is_reversed_ ? 1 : -1; }
  [[nodiscard]] FluxMotion flux_of(std::size_t id) const {
    const auto& c = grid_.classes_[id];
    return {grid_.fluxes_[c.flux], moving_flux_of(by_, c.flux), c.strength, strength_by_[id]};
  }
  [[nodiscard]] State state(std::size_t id, State level, bool is_falling) const {
    return is_falling ? level : 2 * grid_.classes_[id].top - level;
  }
  [[nodiscard]] double share(std::size_t id, State i) const { return grid_.classes_[id].polygon.share(i); }

  /// A state with a motion of its own; its flux is that of the level.
  void give(const Special& s, bool is_first) {
    const FluxPlaces& places = places_[grid_.classes_[s.id].flux];
    const bool is_lowest = (s.role == Role::first_end) != grid_.is_reversed_;
    const double end_by = (is_lowest ? places.range.lowest : places.range.highest).d[0];
    double by = 0;
    switch (s.role) {
      case Role::wanted:
        by = by_.wanted[s.number];
        break;
      case Role::extremum:
        by = places.extrema.empty() ? 0 : places.extrema.front().d[0];
        break;
      default:
        by = end_by;
    }
    const State i = state(s.id, s.level, s.is_falling);
    // The extremum of a monotone flux is an end of its range.
    if (s.role == Role::extremum && places.extrema.empty()) return;
    const double level = sign() * flux_of(s.id)(share(s.id, i), by);
    if (!is_first) levels_.compare(level, level_by_[Grid::index(s.level)]);
    if (is_given_[s.id][Grid::index(i)]) shares_.compare(by, share_by_[s.id][Grid::index(i)]);
    levels_.see(level), shares_.see(by);
    level_by_[Grid::index(s.level)] = level;
    share_by_[s.id][Grid::index(i)] = by;
    is_given_[s.id][Grid::index(i)] = true;
  }
  /// A level one step of the resolution beyond the one below, on the branch that it was made for.
  void step_to(State n) {
    const Grid::Maker& maker = grid_.makers_[Grid::index(n)];
    const FluxPlaces& places = places_[grid_.classes_[maker.id].flux];
    const double step = grid_.resolution_ * (places.range.highest - places.range.lowest).d[0];
    const bool is_up = maker.is_falling != grid_.is_reversed_;
    const State i = state(maker.id, n, maker.is_falling), before = state(maker.id, n - 1, maker.is_falling);
    const double by = share_by_[maker.id][Grid::index(before)] + (is_up ? step : -step);
    share_by_[maker.id][Grid::index(i)] = by;
    is_given_[maker.id][Grid::index(i)] = true;
    level_by_[Grid::index(n)] = sign() * flux_of(maker.id)(share(maker.id, i), by);
    levels_.see(level_by_[Grid::index(n)]);
  }
  /// All other states of the level.
  void follow(std::size_t id, State n) {
    if (n > grid_.classes_[id].top) return;
    for (const bool is_falling : {true, false}) {
      if (n < (is_falling ? first_[id].falling : first_[id].rising)) continue;
      const State i = state(id, n, is_falling);
      if (is_given_[id][Grid::index(i)]) continue;
      share_by_[id][Grid::index(i)] = flux_of(id).inverse(share(id, i), sign() * level_by_[Grid::index(n)]);
      is_given_[id][Grid::index(i)] = true;
    }
  }

  struct FirstLevels {
    State falling, rising;
  };
  const GridOfScene<Grid>& of_;
  const SceneTangent& by_;
  const Grid& grid_;
  std::vector<double> strength_by_, level_by_;
  std::vector<FluxPlaces> places_;
  std::vector<std::vector<double>> share_by_;  // per class and state
  std::vector<std::vector<bool>> is_given_;
  std::vector<FirstLevels> first_;
  Tears strengths_, levels_, shares_;
};

StateTangent StateMotion<UnimodalGrid<double>>::tangent(const SceneTangent& by) const {
  return Mover(of_, by).run(rows_);
}

double StateMotion<UnimodalGrid<double>>::fan_rate(const SceneTangent& by, const StateTangent& states,
                                                   std::size_t layer, State l, State r) const {
  const LayerTangent tangent(of_.stack, by, layer);
  const auto share = [&](State i) {
    return tangent.share(of_.grid.phi(layer, i), states.phi[rows_(layer, i)]);
  };
  return tangent.fan_rate(share(l), share(r));
}

double StateMotion<UnimodalGrid<double>>::speed(const SceneTangent& by, const StateTangent& states,
                                                std::size_t layer, State l, State r) const {
  const LayerTangent tangent(of_.stack, by, layer);
  const auto share = [&](State i) {
    return tangent.share(of_.grid.phi(layer, i), states.phi[rows_(layer, i)]);
  };
  return tangent.speed(share(l), share(r));
}

StateTangent StateMotion<OneLayerGrid<double>>::tangent(const SceneTangent& by) const {
  const Grid& grid = of_.grid;
  const std::size_t n = rows_.n();
  const Flux<Dual<1>>& flux = by.fluxes[of_.stack.flux_index(0)];
  const FluxPlaces places(flux);
  const Dual<1> rate(of_.stack.rate(0), by.rate[0]),
      fraction(of_.stack.solid_fraction(0), by.solid_fraction[0]);
  const FluxMotion motion{grid.flux_, moving_flux_of(by, of_.stack.flux_index(0)), (rate * fraction).v,
                          (rate * fraction).d[0]};
  std::vector<double> share(n, 0.0);
  std::vector<bool> is_special(n);
  Tears tears;
  const auto give = [&](State i, double dx) {
    const auto at = static_cast<std::size_t>(i);
    if (is_special[at]) tears.compare(dx, share[at]);
    tears.see(dx);
    share[at] = dx;
    is_special[at] = true;
  };
  give(0, places.range.lowest.d[0]);
  give(static_cast<State>(n) - 1, places.range.highest.d[0]);
  for (std::size_t i = 0; i < grid.extrema_.size(); ++i) give(grid.extrema_[i], places.extrema[i].d[0]);
  for (const State i : grid.zeros_) {
    // Where f is 0: it moves by -df / f', at an end or an extremum with that, or not at all.
    const double x = grid.polygon_.share(i), slope = grid.flux_.derivative(x),
                 df = flux.value(Dual<1>(x, 0.0)).d[0];
    if (is_special[static_cast<std::size_t>(i)]) {
      const double total = motion(x, share[static_cast<std::size_t>(i)]) / motion.strength;
      if (slope != 0) give(i, share[static_cast<std::size_t>(i)] - total / slope);
    } else {
      give(i, df != 0 ? -df / slope : 0);
    }
  }
  for (std::size_t w = 0; w < of_.wanted.size(); ++w) give(of_.states[w], by.wanted[w]);
  for (std::size_t lo = 0, hi = 0; lo + 1 < n; lo = hi) {
    for (hi = lo + 1; !is_special[hi]; ++hi) continue;
    const auto place = [&](std::size_t i) { return grid.polygon_.share(static_cast<State>(i)); };
    for (std::size_t i = lo + 1; i < hi; ++i)
      share[i] = share[lo] + (share[hi] - share[lo]) * ((place(i) - place(lo)) / (place(hi) - place(lo)));
  }
  StateTangent all;
  all.is_torn = tears.are_any();
  for (std::size_t i = 0; i < n; ++i) {
    const double x = grid.polygon_.share(static_cast<State>(i));
    all.phi.push_back(fraction.d[0] * x + fraction.v * share[i]);
    all.flux.push_back(motion(x, share[i]));
  }
  for (const State i : grid.zeros_) all.flux[static_cast<std::size_t>(i)] = 0;
  return all;
}

double StateMotion<OneLayerGrid<double>>::fan_rate(const SceneTangent& by, const StateTangent& states,
                                                   std::size_t layer, State l, State r) const {
  const LayerTangent tangent(of_.stack, by, layer);
  const auto share = [&](State i) {
    return tangent.share(of_.grid.phi(layer, i), states.phi[rows_(layer, i)]);
  };
  return tangent.fan_rate(share(l), share(r));
}

double StateMotion<OneLayerGrid<double>>::speed(const SceneTangent& by, const StateTangent& states,
                                                std::size_t layer, State l, State r) const {
  const LayerTangent tangent(of_.stack, by, layer);
  const auto share = [&](State i) {
    return tangent.share(of_.grid.phi(layer, i), states.phi[rows_(layer, i)]);
  };
  return tangent.speed(share(l), share(r));
}

}  // namespace shearfront
