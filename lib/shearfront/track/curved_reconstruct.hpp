// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/track/curved_field.hpp"
#include "shearfront/track/curved_snapshot.hpp"
#include "shearfront/track/level_lines.hpp"

namespace shearfront {

/// Linear reconstruction of a solution in levels: smooth stretches joined through the characteristics of which their fronts
/// are means.
///
/// A front between neighbouring levels is the mean of the characteristics of the fluxes between, so the one in the middle,
/// H = (H_i + H_j) / 2, passes its place up to the square of their distance, with the u of that H; where the front turned in its
/// piece the middle characteristic is known in closed form from the turning time on. Monotone cubics, cut into lines, join these nodes; towards shocks and
/// interfaces H goes on linearly, as far as half of the next level, at plateaus (levels of the initial state) to the level. What a stretch between
/// shocks and interfaces then holds too much or too little, of second order, is taken from its nodes in proportion to
/// their distance from the levels beside them. Guaranteed: M at walls, interfaces and shocks is that of the steps; u stays between 0
/// and 1. A stretch where this would move a node beyond a level beside it keeps its levels. Cost: O(fronts).
class CurvedReconstruction {
 public:
  template <class Fronts>
  CurvedReconstruction(const CurvedBed& bed, const Fronts& fronts, const CurvedSnapshot& snapshot)
      : bed_(bed), snapshot_(snapshot), lines_(snapshot.z.front()) {
    nodes_.reserve(snapshot.z.size());
    for (std::size_t i = 0; i < snapshot.z.size(); ++i) {
      const FrontIndex k = snapshot.node[i];
      nodes_.push_back(fronts.is_boundary(k) ? boundary(i) : node_of(fronts[k], snapshot.z[i]));
    }
    for (std::size_t low = 0; low + 1 < nodes_.size();) {
      std::size_t high = low + 1;
      while (nodes_[high].is_smooth || nodes_[high].is_nothing) ++high;
      add_stretch(low, high);
      low = high;
    }
    lines_.close(snapshot.z.back());
  }
  [[nodiscard]] Profile<double> profile() const { return bed_.scene.profile_of(lines_); }

 private:
  struct Node {
    bool is_smooth = false;
    bool is_nothing = false;  ///< a boundary with the same on both sides
    double z = 0, u = 0;
    double room = 0;  ///< distance of u from the nearer level
    double h = 0;     ///< 4 H of the characteristic
  };
  [[nodiscard]] std::size_t piece_at(double z, std::size_t p) const;
  template <class Each>
  void in_pieces(double from, double to, const Each& each) const;
  [[nodiscard]] double turn_beyond(const CurvedNode& front) const;
  [[nodiscard]] Node boundary(std::size_t i) const;
  [[nodiscard]] Node node_of(const CurvedNode& front, double z) const;
  [[nodiscard]] std::vector<Node> joined(const std::vector<Node>& nodes) const;
  void add_stretch(std::size_t low, std::size_t high);
  void add_steps(std::size_t low, std::size_t high);
  [[nodiscard]] std::vector<Node> end_of(std::size_t region, double limit, const Node& first,
                                         const Node& second) const;

  const CurvedBed& bed_;
  const CurvedSnapshot& snapshot_;
  Lines lines_;
  std::vector<Node> nodes_;
};

}  // namespace shearfront
