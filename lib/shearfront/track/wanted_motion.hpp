// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/track/state_motion.hpp"

namespace shearfront {

/// By how much a state, of a row of StateRows, moves, or what its moving by 1 does.
struct StateShift {
  std::size_t row;
  double phi, flux;
};

/// The few states that move with one share that a grid was asked for, all else as it is: what a StateMotion says of an entry that is an
/// initial or an outside state, without a pass over all states. So the gradient in hundreds of them costs no more than one such pass.
///
///   is_torn(group)   whether shares of these numbers, moved together, tear what is one state or level in the grid apart
///   is_same(m, n)    whether they are one state of a grid that is not torn by them
///   shifts(n, all)   adds the states that the share of number n moves by 1
///   speed(k, l, r, all)  adds how the speed of a front l | r changes with its states, which stay on the polygon
template <class Grid>
class WantedMotion;

template <>
class WantedMotion<LevelGrid<double>> {
 public:
  using Grid = LevelGrid<double>;
  WantedMotion(const GridOfScene<Grid>& of, const StateRows& rows);
  [[nodiscard]] bool is_torn(const std::vector<std::size_t>& group) const;
  [[nodiscard]] bool is_same(std::size_t m, std::size_t n) const;
  void shifts(std::size_t n, std::vector<StateShift>& all) const;
  void speed(std::size_t layer, State l, State r, std::vector<StateShift>& all) const;

 private:
  [[nodiscard]] State level(std::size_t n) const {
    return of_.grid.level(of_.wanted[n].layer, of_.states[n]);
  }

  GridOfScene<Grid> of_;
  const StateRows& rows_;
  std::vector<std::uint32_t> n_wanted_;  // per level
};

template <>
class WantedMotion<UnimodalGrid<double>> {
 public:
  using Grid = UnimodalGrid<double>;
  WantedMotion(const GridOfScene<Grid>& of, const StateRows& rows);
  [[nodiscard]] bool is_torn(const std::vector<std::size_t>& group) const;
  [[nodiscard]] bool is_same(std::size_t m, std::size_t n) const;
  void shifts(std::size_t n, std::vector<StateShift>& all) const;
  void speed(std::size_t layer, State l, State r, std::vector<StateShift>& all) const;

 private:
  struct Step;
  void add_level(State n, double level_by, std::vector<Step>& last, std::vector<StateShift>& all) const;

  GridOfScene<Grid> of_;
  const StateRows& rows_;
  std::vector<std::uint32_t> n_special_;             // per level
  std::vector<std::size_t> special_of_;              // per state wanted
  std::vector<State> first_falling_, first_rising_;  // per class: the first level with a state
};

template <>
class WantedMotion<OneLayerGrid<double>> {
 public:
  using Grid = OneLayerGrid<double>;
  WantedMotion(const GridOfScene<Grid>& of, const StateRows& rows);
  [[nodiscard]] bool is_torn(const std::vector<std::size_t>& group) const;
  [[nodiscard]] bool is_same(std::size_t m, std::size_t n) const;
  void shifts(std::size_t n, std::vector<StateShift>& all) const;
  void speed(std::size_t layer, State l, State r, std::vector<StateShift>& all) const;

 private:
  GridOfScene<Grid> of_;
  const StateRows& rows_;
  std::vector<std::uint32_t> n_roles_;  // per state
};

}  // namespace shearfront
