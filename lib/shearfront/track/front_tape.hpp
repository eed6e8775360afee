// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "shearfront/solver/solver.hpp"
#include "shearfront/track/front_tangents.hpp"
#include "shearfront/track/observers.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

/// How much a sum changes with each state, boundary, initial piece and change outside moved by 1.
struct Adjoints {
  std::vector<double> phi, flux;  ///< by StateRows
  std::vector<double> boundary, top, change;
  /// The speed of a front between close states (CloseStates).
  struct Speed {
    std::size_t layer;
    State below, above;
    double weight;
  };
  std::vector<Speed> close;

  /// With respect to an entry that moves all of these.
  template <class Grid>
  [[nodiscard]] double along(const StateMotion<Grid>& motion, const SceneTangent& scene,
                             const StateTangent& states) const {
    double sum = 0;
    for (const Speed& s : close) sum += s.weight * motion.speed(scene, states, s.layer, s.below, s.above);
    const auto add = [&](const std::vector<double>& weight, const std::vector<double>& by) {
      for (std::size_t i = 0; i < by.size(); ++i) sum += weight[i] * by[i];
    };
    add(phi, states.phi), add(flux, states.flux);
    add(boundary, scene.boundary), add(top, scene.top), add(change, scene.change);
    return sum;
  }
};

/// An observer that keeps which fronts made which point and left it, so that derivatives can be carried backwards in time: of one
/// weighted sum of samples with respect to everything at once, by the transpose of what FrontTangents does (Griewank & Walther
/// 2008). Cost: about that of the run; memory 48 bytes per front and 40 per event, and 16 per front at each time of a sample.
class FrontTape {
 public:
  static constexpr bool kActive = true;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  /// Where fronts and boundaries are at one time: what a sample at that time depends on.
  struct Node {
    double z;
    std::uint32_t front, layer;  ///< no front: the boundary below the layer
    State above;
  };
  struct Snapshot {
    double t = 0;
    std::vector<Node> nodes;
  };

  /// `initial_tops` must outlive it.
  explicit FrontTape(const std::vector<double>& initial_tops) : tops_(&initial_tops) {}

  template <class Grid>
  void collision(const Grid& grid, const CollisionView<double>& view) {
    Point point{view.t,
                kNone,
                kNone,
                kNone,
                static_cast<std::uint32_t>(fronts_.size()),
                static_cast<std::uint32_t>(view.outgoing.size()),
                Point::begin};
    const bool is_in_layer = view.boundary == CollisionView<double>::kNoBoundary;
    if (!is_in_layer) point.boundary = static_cast<std::uint32_t>(view.boundary);
    if (!view.incoming.empty()) {
      point.kind = is_in_layer ? Point::meeting : Point::boundary_hit;
      point.a = slots_[view.incoming.front().slot];
      point.b = slots_[view.incoming.back().slot];
      if (is_in_layer && view.incoming.size() == 2 && view.outgoing.size() == 1) point.kind = Point::merging;
    } else if (view.t > 0) {
      point.kind = Point::change;
      point.a = n_changes_++;
    } else if (is_in_layer) {
      point.a =
          static_cast<std::uint32_t>(std::lower_bound(tops_->begin(), tops_->end(), view.z) - tops_->begin());
    }
    order_.see(view, is_in_layer ? 2 : 1);
    for (const FrontView<double>& f : view.outgoing) {
      if (slots_.size() <= f.slot) slots_.resize(std::size_t{f.slot} + 1);
      slots_[f.slot] = static_cast<std::uint32_t>(fronts_.size());
      const bool is_from_bottom = f.z == grid.boundary(f.layer);
      fronts_.push_back({f.t, f.speed, static_cast<std::uint32_t>(f.layer), f.below, f.above,
                         static_cast<std::uint32_t>(is_from_bottom ? f.layer : f.layer + 1)});
    }
    points_.push_back(point);
  }

  /// Of the tracker that it observes, now.
  template <class AnyTracker>
  [[nodiscard]] Snapshot snapshot(const AnyTracker& tracker) const {
    Snapshot now{tracker.time(), {}};
    tracker.for_each_node([&](bool is_boundary, const FrontView<double>& node, double z) {
      if (!is_boundary)
        z = std::max(std::min(z, tracker.grid().boundary(node.layer + 1)), now.nodes.back().z);
      now.nodes.push_back(
          {z, is_boundary ? kNone : slots_[node.slot], static_cast<std::uint32_t>(node.layer), node.above});
    });
    return now;
  }

  /// Of sum_i (weights[i].phi phi + weights[i].M M) at places[i], which are of the time of snapshots[snapshot_of[i]]. Of the solution
  /// that is constant between fronts.
  template <class Grid>
  [[nodiscard]] Adjoints adjoints(const Grid& grid, const StateRows& rows, std::size_t n_pieces,
                                  std::size_t n_changes, const std::vector<Snapshot>& snapshots,
                                  const std::vector<Place>& places,
                                  const std::vector<std::size_t>& snapshot_of,
                                  const std::vector<Sample>& weights) const {
    Adjoints all;
    all.phi.assign(rows.n(), 0.0), all.flux.assign(rows.n(), 0.0);
    all.boundary.assign(grid.n_layers() + 1, 0.0), all.top.assign(n_pieces, 0.0);
    all.change.assign(n_changes, 0.0);
    std::vector<Moved> moved(fronts_.size());
    std::vector<std::vector<std::size_t>> of_snapshot(snapshots.size());
    for (std::size_t i = 0; i < places.size(); ++i) of_snapshot[snapshot_of[i]].push_back(i);
    for (std::size_t s = 0; s < snapshots.size(); ++s)
      seed(grid, rows, snapshots[s], places, of_snapshot[s], weights, moved, all);
    CloseStates close;
    for (auto point = points_.rbegin(); point != points_.rend(); ++point)
      back(grid, rows, *point, close, moved, all);
    unite(all.close);
    return all;
  }
  [[nodiscard]] const OrderCheck& order() const { return order_; }

 private:
  struct Front {
    double t, speed;
    std::uint32_t layer;
    State below, above;
    std::uint32_t boundary;  ///< where it was born, if at one
  };
  struct Point {
    enum Kind : std::uint8_t { begin, change, boundary_hit, meeting, merging };
    double t;
    std::uint32_t a, b;  ///< fronts that met; of a change its number, of the first fronts their piece
    std::uint32_t boundary;
    std::uint32_t first, n;  ///< fronts that left it
    Kind kind;
  };
  /// Weights of g and ds of a front (FrontTangents).
  struct Moved {
    double g = 0, speed = 0;
  };

  void add_place(std::uint32_t front, double t, double weight, std::vector<Moved>& moved) const {
    moved[front].g += weight;
    moved[front].speed += (t - fronts_[front].t) * weight;
  }
  /// From the top down: what lies below a height counts for all samples of M above it.
  template <class Grid>
  void seed(const Grid& grid, const StateRows& rows, const Snapshot& snapshot,
            const std::vector<Place>& places, std::vector<std::size_t> samples,
            const std::vector<Sample>& weights, std::vector<Moved>& moved, Adjoints& all) const {
    const auto& nodes = snapshot.nodes;
    std::sort(samples.begin(), samples.end(),
              [&](std::size_t a, std::size_t b) { return places[a].z < places[b].z; });
    double above = 0,
           carried = 0;  // weights of M above the cell, and what a node gets from the cell above it
    const auto give = [&](const Node& node, double weight) {
      if (node.front == kNone)
        all.boundary[node.layer] += weight;
      else
        add_place(node.front, snapshot.t, weight, moved);
    };
    for (std::size_t i = nodes.size() - 1; i-- > 0;) {
      const Node &low = nodes[i], &high = nodes[i + 1];
      const double phi = grid.phi(low.layer, low.above);
      double& by_phi = all.phi[rows(low.layer, low.above)];
      give(high, above * phi - carried);
      by_phi += above * (high.z - low.z);
      double here = 0;
      // The cell of a place is the topmost one that begins at or below it, as Profile has it.
      while (!samples.empty() && (i == 0 || !(places[samples.back()].z < low.z))) {
        const Sample& weight = weights[samples.back()];
        by_phi += weight.phi + weight.M * (places[samples.back()].z - low.z);
        here += weight.M;
        samples.pop_back();
      }
      above += here;
      carried = above * phi;
    }
    give(nodes.front(), -carried);
  }
  /// One weight for all fronts between the same states.
  static void unite(std::vector<Adjoints::Speed>& all) {
    const auto states = [](const Adjoints::Speed& s) { return std::tuple(s.layer, s.below, s.above); };
    std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return states(a) < states(b); });
    std::size_t n = 0;
    for (const Adjoints::Speed& s : all)
      if (n > 0 && states(all[n - 1]) == states(s))
        all[n - 1].weight += s.weight;
      else
        all[n++] = s;
    all.resize(n);
  }
  template <class Grid>
  void back(const Grid& grid, const StateRows& rows, const Point& point, CloseStates& close,
            std::vector<Moved>& moved, Adjoints& all) const {
    double dz = 0, dt = 0, merged = 0;
    for (std::uint32_t i = point.first; i < point.first + point.n; ++i) {
      const Front& f = fronts_[i];
      const Moved& by = moved[i];
      spread_speed(grid, rows, f, by.speed, close, all);
      if (point.kind == Point::merging) {
        merged = by.g;
        continue;
      }
      dt -= f.speed * by.g;
      (point.boundary != kNone ? all.boundary[f.boundary] : dz) += by.g;
    }
    switch (point.kind) {
      case Point::begin:
        if (point.boundary == kNone) all.top[point.a] += dz;
        break;
      case Point::change:
        all.change[point.a] += dt;
        break;
      case Point::boundary_hit: {
        const double by_place = dt / fronts_[point.a].speed;
        all.boundary[point.boundary] += by_place;
        add_place(point.a, point.t, -by_place, moved);
        break;
      }
      case Point::meeting: {
        const double closing = fronts_[point.a].speed - fronts_[point.b].speed;
        const double late = closing != 0 ? (dt + fronts_[point.a].speed * dz) / closing : 0;
        add_place(point.a, point.t, dz - late, moved);
        add_place(point.b, point.t, late, moved);
        break;
      }
      case Point::merging: {
        const Front& f = fronts_[point.first];
        const double phi_l = grid.phi(f.layer, f.below), phi_r = grid.phi(f.layer, f.above),
                     phi_m = grid.phi(f.layer, fronts_[point.a].above),
                     share = phi_r != phi_l ? (phi_r - phi_m) / (phi_r - phi_l) : 0.5;
        add_place(point.a, point.t, (1 - share) * merged, moved);
        add_place(point.b, point.t, share * merged, moved);
        break;
      }
    }
  }
  template <class Grid>
  static void spread_speed(const Grid& grid, const StateRows& rows, const Front& f, double weight,
                           CloseStates& close, Adjoints& all) {
    const double rise = grid.phi(f.layer, f.above) - grid.phi(f.layer, f.below);
    if (weight == 0) return;
    if (close.are(grid, f.layer, rise)) {
      all.close.push_back({f.layer, f.below, f.above, weight});
      return;
    }
    const double w = weight / rise;
    const std::size_t l = rows(f.layer, f.below), r = rows(f.layer, f.above);
    all.flux[r] += w, all.flux[l] -= w;
    all.phi[r] -= f.speed * w, all.phi[l] += f.speed * w;
  }

  const std::vector<double>* tops_;
  std::uint32_t n_changes_ = 0;
  std::vector<std::uint32_t> slots_;  // which front a slot holds
  std::vector<Front> fronts_;
  std::vector<Point> points_;
  OrderCheck order_;
};

}  // namespace shearfront
