// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/riemann/state.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/track/level_grid.hpp"
#include "shearfront/track/one_layer_grid.hpp"
#include "shearfront/track/pieces.hpp"
#include "shearfront/track/scene_tangents.hpp"
#include "shearfront/track/unimodal_grid.hpp"

/// How the states of a grid move with an entry of the scene while the number of its levels stays: the derivatives of phi(layer, state)
/// and flux(layer, state) as the grid itself is made. States that were asked for, extrema, ends of ranges and zeros go with their
/// entries; all others keep the place that the rule of the grid gives them (between two capacities, a step of the resolution from the
/// level below, a part of the way between two special states), and on the other branch and in other layers that of the same flux.
namespace shearfront {

/// Rows of a table with one for every state of every layer.
class StateRows {
 public:
  StateRows() = default;
  template <StateGrid Grid>
  explicit StateRows(const Grid& grid) {
    for (std::size_t k = 0; k < grid.n_layers(); ++k)
      first_.push_back(first_.back() + static_cast<std::size_t>(grid.n_states(k)));
  }
  [[nodiscard]] std::size_t n() const { return first_.back(); }
  [[nodiscard]] std::size_t operator()(std::size_t layer, State i) const {
    return first_[layer] + static_cast<std::size_t>(i);
  }

 private:
  std::vector<std::size_t> first_{0};
};

/// Derivatives of all states with respect to one entry.
struct StateTangent {
  std::vector<double> phi, flux;  ///< by StateRows
  /// Whether two states that are one in the grid move apart: the derivative then depends on the side.
  bool is_torn = false;
};

/// What a StateMotion is made from: a grid with what it was made for, all of which must outlive it.
template <class Grid>
struct GridOfScene {
  const Grid& grid;
  const LayerStack<double>& stack;
  const std::vector<LayerState<double>>& wanted;  ///< shares
  const std::vector<State>& states;               ///< those wanted, in the grid
};

/// Cost of a tangent: O(layers states), with an evaluation of the flux and its slope for each state of the general grids.
template <class Grid>
class StateMotion;

/// Tells whether numbers that should be equal are, beside the largest of their kind.
class Tears {
 public:
  void see(double size) { size_ = std::max(size_, std::abs(size)); }
  void compare(double a, double b) {
    see(a), see(b);
    gap_ = std::max(gap_, std::abs(a - b));
  }
  [[nodiscard]] bool are_any() const { return gap_ > kRounding * size_; }

 private:
  static constexpr double kRounding = 1e-9;
  double gap_ = 0, size_ = 0;
};

template <>
class StateMotion<LevelGrid<double>> {
 public:
  explicit StateMotion(const GridOfScene<LevelGrid<double>>& of);
  [[nodiscard]] const StateRows& rows() const { return rows_; }
  [[nodiscard]] StateTangent tangent(const SceneTangent& by) const;
  /// Derivatives of fan_rate(), and of speed() also for states so close that those of phi and flux cancel.
  [[nodiscard]] double fan_rate(const SceneTangent& by, const StateTangent& states, std::size_t layer,
                                State l, State r) const;
  [[nodiscard]] double speed(const SceneTangent& by, const StateTangent& states, std::size_t layer, State l,
                             State r) const;

 private:
  using Grid = LevelGrid<double>;
  struct Moved;
  void move_classes(const SceneTangent& by, Moved& moved) const;
  void move_wanted(const SceneTangent& by, Moved& moved) const;
  void move_levels(Moved& moved) const;
  void move_chords(Moved& moved) const;
  [[nodiscard]] double place_tangent(std::size_t id, State level, const Moved& moved) const;
  [[nodiscard]] double width(std::size_t layer) const;
  [[nodiscard]] double place_of(std::size_t id, State level) const {
    return places_[first_[id] + static_cast<std::size_t>(level)];
  }

  GridOfScene<Grid> of_;
  StateRows rows_;
  std::vector<double> places_;      // p of every level in every class
  std::vector<std::size_t> first_;  // of them, per class
};

template <>
class StateMotion<UnimodalGrid<double>> {
 public:
  explicit StateMotion(const GridOfScene<UnimodalGrid<double>>& of) : of_(of), rows_(of.grid) {}
  [[nodiscard]] const StateRows& rows() const { return rows_; }
  [[nodiscard]] StateTangent tangent(const SceneTangent& by) const;
  [[nodiscard]] double fan_rate(const SceneTangent& by, const StateTangent& states, std::size_t layer,
                                State l, State r) const;
  [[nodiscard]] double speed(const SceneTangent& by, const StateTangent& states, std::size_t layer, State l,
                             State r) const;

 private:
  using Grid = UnimodalGrid<double>;
  class Mover;

  GridOfScene<Grid> of_;
  StateRows rows_;
};

template <>
class StateMotion<OneLayerGrid<double>> {
 public:
  explicit StateMotion(const GridOfScene<OneLayerGrid<double>>& of) : of_(of), rows_(of.grid) {}
  [[nodiscard]] const StateRows& rows() const { return rows_; }
  [[nodiscard]] StateTangent tangent(const SceneTangent& by) const;
  [[nodiscard]] double fan_rate(const SceneTangent& by, const StateTangent& states, std::size_t layer,
                                State l, State r) const;
  [[nodiscard]] double speed(const SceneTangent& by, const StateTangent& states, std::size_t layer, State l,
                             State r) const;

 private:
  using Grid = OneLayerGrid<double>;

  GridOfScene<Grid> of_;
  StateRows rows_;
};

}  // namespace shearfront
