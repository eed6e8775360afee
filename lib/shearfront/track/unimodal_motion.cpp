// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/flux_motion.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

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
  [[nodiscard]] track_detail::FluxMotion flux_of(std::size_t id) const {
    const auto& c = grid_.classes_[id];
    return {grid_.fluxes_[c.flux], track_detail::moving_flux_of(by_, c.flux), c.strength, strength_by_[id]};
  }
  [[nodiscard]] State state(std::size_t id, State level, bool is_falling) const {
    return is_falling ? level : 2 * grid_.classes_[id].top - level;
  }
  [[nodiscard]] double share(std::size_t id, State i) const { return grid_.classes_[id].polygon.share(i); }

  /// A state with a motion of its own; its flux is that of the level.
  void give(const Special& s, bool is_first) {
    const track_detail::FluxPlaces& places = places_[grid_.classes_[s.id].flux];
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
    const track_detail::FluxPlaces& places = places_[grid_.classes_[maker.id].flux];
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
  std::vector<track_detail::FluxPlaces> places_;
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
  return track_detail::SharesTangent(of_, rows_, by, states.phi, layer, l, r).fan_rate();
}

double StateMotion<UnimodalGrid<double>>::speed(const SceneTangent& by, const StateTangent& states,
                                                std::size_t layer, State l, State r) const {
  return track_detail::SharesTangent(of_, rows_, by, states.phi, layer, l, r).speed();
}

}  // namespace shearfront
