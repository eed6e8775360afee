// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/flux_motion.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

/// Of one column: per class its capacity, per level its value and, where that is known by itself, the place of its state.
struct StateMotion<LevelGrid<double>>::Moved {
  std::vector<double> capacity, level, chord;
  std::vector<double> lowest, highest;  ///< per layer: of the states
  std::vector<double> place;            ///< per level: of p at home
  std::vector<bool> is_wanted;
  Tears levels, places, capacities;
};

StateMotion<LevelGrid<double>>::StateMotion(const GridOfScene<Grid>& of) : of_(of), rows_(of.grid) {
  const Grid& grid = of.grid;
  std::vector<std::size_t> layer_of(grid.classes_.size());
  for (std::size_t k = 0; k < grid.n_layers(); ++k) layer_of[grid.layer_capacity_[k]] = k;
  for (std::size_t id = 0; id < grid.classes_.size(); ++id) {
    first_.push_back(places_.size());
    for (State i = 0; i <= grid.classes_[id].top; ++i) places_.push_back(grid.falling_phi(layer_of[id], i));
  }
}

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
  if (level.home == Grid::kOnChord) {
    const double lo = place_tangent(id, level.vertex_below, moved),
                 hi = place_tangent(id, level.vertex_above, moved);
    const double length = place_of(id, level.vertex_above) - place_of(id, level.vertex_below);
    return lo + level.p * (hi - lo) + moved.chord[Grid::index(i)] * length;
  }
  const double rise = moved.level[Grid::index(i)], capacity = moved.capacity[id];
  if (rise == 0 && capacity == 0) return 0;
  const double c = grid.classes_[id].capacity, p = place_of(id, i);
  return (rise - 4 * p * (1 - p) * capacity) / (4 * c * (1 - 2 * p));
}

void StateMotion<LevelGrid<double>>::move_chords(Moved& moved) const {
  const Grid& grid = of_.grid;
  for (std::size_t i = 0; i < grid.levels_.size(); ++i) {
    const Grid::Level& level = grid.levels_[i];
    if (level.home != Grid::kOnChord) continue;
    const auto layer = static_cast<std::size_t>(moved.chord[i]);
    const std::size_t id = grid.layer_capacity_[layer];
    const double lo = place_tangent(id, level.vertex_below, moved),
                 hi = place_tangent(id, level.vertex_above, moved);
    const double length = place_of(id, level.vertex_above) - place_of(id, level.vertex_below);
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
  move_chords(moved);
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
        const double p_by = place[Grid::index(i)], u_by = s == i ? p_by : -p_by;
        const double range_by = moved.highest[k] - moved.lowest[k],
                     u = range_by != 0 ? grid.unit_phi(k, s) : 0;
        const std::size_t row = rows_(k, s);
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
    const track_detail::LayerTangent tangent(of_.stack, by, layer);
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

}  // namespace shearfront
