// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/wanted_motion.hpp"

#include <algorithm>

namespace shearfront {
namespace {

std::size_t state_place(State i) { return static_cast<std::size_t>(i); }

/// d(rate secant(x_l, x_r)) / d(phi) of both states, which are x times the solid fraction.
void add_secant(const Flux<double>& flux, double rate, double solid_fraction, double x_l, double x_r,
                std::size_t row_l, std::size_t row_r, std::vector<StateShift>& all) {
  const auto moving = *flux_tangent(flux);
  const double factor = rate / solid_fraction;
  all.push_back({row_l, factor * moving.secant(Dual<1>(x_l, 1.0), Dual<1>(x_r, 0.0)).d[0], 0});
  all.push_back({row_r, factor * moving.secant(Dual<1>(x_l, 0.0), Dual<1>(x_r, 1.0)).d[0], 0});
}

/// The same of a chord between two states of the polygon.
template <class Grid>
void add_chord(const Grid& grid, const StateRows& rows, std::size_t layer, State lo, State hi,
               std::vector<StateShift>& all) {
  const double run = grid.phi(layer, hi) - grid.phi(layer, lo),
               speed = (grid.flux(layer, hi) - grid.flux(layer, lo)) / run;
  all.push_back({rows(layer, hi), -speed / run, 1 / run});
  all.push_back({rows(layer, lo), speed / run, -1 / run});
}

}  // namespace

WantedMotion<LevelGrid<double>>::WantedMotion(const GridOfScene<Grid>& of, const StateRows& rows)
    : of_(of), rows_(rows), n_wanted_(of.grid.levels_.size()) {
  for (std::size_t n = 0; n < of.wanted.size(); ++n) ++n_wanted_[state_place(level(n))];
}

bool WantedMotion<LevelGrid<double>>::is_torn(const std::vector<std::size_t>& group) const {
  const Grid& grid = of_.grid;
  return std::any_of(group.begin(), group.end(), [&](std::size_t n) {
    const State i = level(n);
    const Grid::Level& at = grid.levels_[state_place(i)];
    const auto n_own = std::count_if(group.begin(), group.end(), [&](std::size_t m) {
      return level(m) == i && of_.wanted[m].phi == of_.wanted[n].phi;
    });
    return at.value == 0 || (at.home >= 0 && at.p + at.p == 1) ||
           (at.home >= 0 &&
            at.home != static_cast<std::int32_t>(grid.layer_capacity_[of_.wanted[n].layer])) ||
           n_wanted_[state_place(i)] != static_cast<std::uint32_t>(n_own);
  });
}

bool WantedMotion<LevelGrid<double>>::is_same(std::size_t m, std::size_t n) const {
  return level(m) == level(n);
}

void WantedMotion<LevelGrid<double>>::shifts(std::size_t n, std::vector<StateShift>& all) const {
  const Grid& grid = of_.grid;
  const std::size_t layer = of_.wanted[n].layer, home = grid.layer_capacity_[layer];
  const State i = level(n);
  const Grid::Level& at = grid.levels_[state_place(i)];
  const StateRange<double> range = of_.stack.flux(layer).range();
  const double width = range.highest - range.lowest;
  // Of p, the smaller of u and 1 - u.
  const double p_by = (grid.is_reversed_ ? -1 : 1) * (of_.states[n] == i ? 1 : -1) / width;
  const auto chord = [&](std::size_t k) {
    return grid.falling_phi(k, at.vertex_above) - grid.falling_phi(k, at.vertex_below);
  };
  const bool is_on_chord = at.home == Grid::kOnChord;
  const double along = is_on_chord ? p_by / chord(layer) : 0;
  const double level_by = is_on_chord ? along * (grid.levels_[state_place(at.vertex_above)].value -
                                                 grid.levels_[state_place(at.vertex_below)].value)
                                      : 4 * grid.classes_[home].capacity * (1 - 2 * at.p) * p_by;
  for (std::size_t k = 0; k < grid.n_layers(); ++k) {
    const std::size_t id = grid.layer_capacity_[k];
    if (i > grid.classes_[id].top) continue;
    double p = p_by;
    if (is_on_chord)
      p = along * chord(k);
    else if (id != home)
      p = level_by / (4 * grid.classes_[id].capacity * (1 - 2 * grid.falling_phi(k, i)));
    const auto& ranges = grid.ranges_;
    const double phi =
        (ranges.empty() ? 1 : ranges[k].highest - ranges[k].lowest) * (grid.is_reversed_ ? -p : p);
    const double flux = grid.is_reversed_ ? level_by : -level_by;
    all.push_back({rows_(k, i), phi, flux});
    if (i < grid.classes_[id].top) all.push_back({rows_(k, 2 * grid.classes_[id].top - i), -phi, flux});
  }
}

void WantedMotion<LevelGrid<double>>::speed(std::size_t layer, State l, State r,
                                            std::vector<StateShift>& all) const {
  const Grid& grid = of_.grid;
  const auto [l_lo, l_hi] = grid.chord(layer, l);
  const auto [r_lo, r_hi] = grid.chord(layer, r);
  if (l_lo != l_hi || r_lo != r_hi)
    return add_chord(grid, rows_, layer, std::min(l_lo, r_lo), std::max(l_hi, r_hi), all);
  const double c = of_.stack.solid_fraction(layer);
  add_secant(of_.stack.flux(layer), of_.stack.rate(layer), c, grid.phi(layer, l) / c, grid.phi(layer, r) / c,
             rows_(layer, l), rows_(layer, r), all);
}

/// By how much the state of a class at the last level moves, on both branches.
struct WantedMotion<UnimodalGrid<double>>::Step {
  double falling = 0, rising = 0;
};

WantedMotion<UnimodalGrid<double>>::WantedMotion(const GridOfScene<Grid>& of, const StateRows& rows)
    : of_(of),
      rows_(rows),
      n_special_(of.grid.levels_.size()),
      special_of_(of.wanted.size()),
      first_falling_(of.grid.classes_.size()),
      first_rising_(of.grid.classes_.size()) {
  using Role = Grid::Special::Role;
  for (std::size_t s = 0; s < of.grid.specials_.size(); ++s) {
    const Grid::Special& special = of.grid.specials_[s];
    ++n_special_[state_place(special.level)];
    if (special.role == Role::wanted) special_of_[special.number] = s;
    if (special.role == Role::first_end) first_falling_[special.id] = special.level;
    if (special.role == Role::last_end) first_rising_[special.id] = special.level;
  }
}

bool WantedMotion<UnimodalGrid<double>>::is_torn(const std::vector<std::size_t>& group) const {
  const auto special = [&](std::size_t n) -> const Grid::Special& {
    return of_.grid.specials_[special_of_[n]];
  };
  return std::any_of(group.begin(), group.end(), [&](std::size_t n) {
    const auto n_own = std::count_if(group.begin(), group.end(), [&](std::size_t m) {
      return special(m).level == special(n).level && special(m).id == special(n).id;
    });
    return n_special_[state_place(special(n).level)] != static_cast<std::uint32_t>(n_own);
  });
}

/// All states of a level that moves; those of `last` that are set to go with it have their own motion.
void WantedMotion<UnimodalGrid<double>>::add_level(State n, double level_by, std::vector<Step>& last,
                                                   std::vector<StateShift>& all) const {
  const Grid& grid = of_.grid;
  const double flux = grid.is_reversed_ ? level_by : -level_by;
  for (std::size_t id = 0; id < grid.classes_.size(); ++id) {
    const auto& c = grid.classes_[id];
    if (n > c.top) continue;
    for (const bool is_falling : {true, false}) {
      if (n < (is_falling ? first_falling_[id] : first_rising_[id])) continue;
      const State i = is_falling ? n : 2 * c.top - n;
      if (!is_falling && i == n) continue;  // the extremum
      const double slope = c.strength * grid.fluxes_[c.flux].derivative(c.polygon.share(i));
      (is_falling ? last[id].falling : last[id].rising) = flux / slope;
    }
  }
  for (std::size_t k = 0; k < grid.n_layers(); ++k) {
    const std::size_t id = grid.layers_[k].id;
    const State top = grid.classes_[id].top;
    if (n > top) continue;
    const double c = grid.layers_[k].solid_fraction;
    if (n >= first_falling_[id]) all.push_back({rows_(k, n), c * last[id].falling, flux});
    if (n >= first_rising_[id] && n < top) all.push_back({rows_(k, 2 * top - n), c * last[id].rising, flux});
  }
}

bool WantedMotion<UnimodalGrid<double>>::is_same(std::size_t m, std::size_t n) const {
  const Grid::Special &a = of_.grid.specials_[special_of_[m]], &b = of_.grid.specials_[special_of_[n]];
  return a.level == b.level && a.id == b.id;
}

void WantedMotion<UnimodalGrid<double>>::shifts(std::size_t n, std::vector<StateShift>& all) const {
  const Grid& grid = of_.grid;
  const Grid::Special& special = grid.specials_[special_of_[n]];
  const double sign = grid.is_reversed_ ? 1 : -1;
  const auto level_by = [&](std::size_t id, State i, double x_by) {
    const auto& c = grid.classes_[id];
    return sign * c.strength * grid.fluxes_[c.flux].derivative(c.polygon.share(i)) * x_by;
  };
  const auto state = [&](std::size_t id, State level, bool is_falling) {
    return is_falling ? level : 2 * grid.classes_[id].top - level;
  };
  std::vector<Step> last(grid.classes_.size());
  add_level(special.level, level_by(special.id, state(special.id, special.level, special.is_falling), 1),
            last, all);
  // And the levels that were made by steps from this one, up to the next that was given.
  const auto n_levels = static_cast<State>(grid.levels_.size());
  for (State i = special.level + 1; i < n_levels && grid.makers_[state_place(i)].id != Grid::Maker::kNone;
       ++i) {
    const Grid::Maker& maker = grid.makers_[state_place(i)];
    const double by = maker.is_falling ? last[maker.id].falling : last[maker.id].rising;
    add_level(i, level_by(maker.id, state(maker.id, i, maker.is_falling), by), last, all);
  }
}

void WantedMotion<UnimodalGrid<double>>::speed(std::size_t layer, State l, State r,
                                               std::vector<StateShift>& all) const {
  const auto& polygon = of_.grid.class_of(layer).polygon;
  add_secant(of_.stack.flux(layer), of_.stack.rate(layer), of_.stack.solid_fraction(layer), polygon.share(l),
             polygon.share(r), rows_(layer, l), rows_(layer, r), all);
}

WantedMotion<OneLayerGrid<double>>::WantedMotion(const GridOfScene<Grid>& of, const StateRows& rows)
    : of_(of), rows_(rows), n_roles_(rows.n()) {
  ++n_roles_.front(), ++n_roles_.back();
  for (const auto* all : {&of.grid.extrema_, &of.grid.zeros_, &of.states})
    for (const State i : *all) ++n_roles_[state_place(i)];
}

bool WantedMotion<OneLayerGrid<double>>::is_torn(const std::vector<std::size_t>& group) const {
  return std::any_of(group.begin(), group.end(), [&](std::size_t n) {
    const auto n_own = std::count_if(group.begin(), group.end(),
                                     [&](std::size_t m) { return of_.states[m] == of_.states[n]; });
    return n_roles_[state_place(of_.states[n])] != static_cast<std::uint32_t>(n_own);
  });
}

bool WantedMotion<OneLayerGrid<double>>::is_same(std::size_t m, std::size_t n) const {
  return of_.states[m] == of_.states[n];
}

void WantedMotion<OneLayerGrid<double>>::shifts(std::size_t n, std::vector<StateShift>& all) const {
  const Grid& grid = of_.grid;
  const State own = of_.states[n];
  const double c = grid.solid_fraction_, strength = grid.rate_ * c;
  const auto add = [&](State i, double by) {
    all.push_back({rows_(0, i), c * by, strength * grid.flux_.derivative(grid.polygon_.share(i)) * by});
  };
  add(own, 1);
  // Between it and the next special states those in the way go along in proportion.
  for (const State step : {-1, 1}) {
    State end = own + step;
    if (end < 0 || end >= grid.n_states(0)) continue;
    while (n_roles_[state_place(end)] == 0) end += step;
    const double x = grid.polygon_.share(own), x_end = grid.polygon_.share(end);
    for (State i = own + step; i != end; i += step) add(i, (grid.polygon_.share(i) - x_end) / (x - x_end));
  }
}

void WantedMotion<OneLayerGrid<double>>::speed(std::size_t layer, State l, State r,
                                               std::vector<StateShift>& all) const {
  const Grid& grid = of_.grid;
  add_secant(grid.flux_, grid.rate_, grid.solid_fraction_, grid.polygon_.share(l), grid.polygon_.share(r),
             rows_(layer, l), rows_(layer, r), all);
}

}  // namespace shearfront
