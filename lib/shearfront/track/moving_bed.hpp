// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/scene/entries.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/state_motion.hpp"
#include "shearfront/track/track.hpp"

namespace shearfront::track_detail {

/// Numbers of the places in the order of their times and heights.
[[nodiscard]] inline std::vector<std::size_t> by_time(const std::vector<Place>& places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  return order;
}

/// Derivatives with respect to one entry of all that a run is made of.
struct MotionColumn {
  SceneTangent scene;
  StateTangent states;
};

/// A scene with its grid and how its states move with some entries.
template <class Grid>
class MovingBed {
 public:
  MovingBed(const Scene<double>& scene, const TrackOptions& options)
      : scene_(scene),
        setup_(scene_, tracking_layers(scene_, options.resolution), options.resolution, options.grid),
        motion_(of()) {}
  MovingBed(const MovingBed&) = delete;  // the motion refers to the grid
  MovingBed& operator=(const MovingBed&) = delete;

  void move(const std::vector<std::size_t>& entries) {
    entries_ = entries;
    std::size_t bytes = 0;
    for (const std::size_t entry : entries_) {
      MotionColumn made = make(entry);
      if (made.states.is_torn) torn_.push_back(entry);
      bytes += bytes_per_column();
      if (bytes <= kMostBytes) kept_.push_back(std::move(made));
    }
  }
  [[nodiscard]] std::size_t n_columns() const { return entries_.size(); }
  /// With respect to the entry of number j among those given.
  [[nodiscard]] MotionColumn column(std::size_t j) const {
    return j < kept_.size() ? kept_[j] : make(entries_[j]);
  }
  /// How many columns a table of them should have at most.
  [[nodiscard]] std::size_t most_columns() const {
    constexpr std::size_t kLeast = 8;
    return std::max(kLeast, kMostBytes / bytes_per_column());
  }
  /// Entries that move states apart which are one in the grid.
  [[nodiscard]] const std::vector<std::size_t>& torn() const { return torn_; }
  [[nodiscard]] const TrackingSetup<double, Grid>& setup() const { return setup_; }
  [[nodiscard]] const StateMotion<Grid>& motion() const { return motion_; }
  [[nodiscard]] GridOfScene<Grid> of() const {
    return {setup_.grid, setup_.stack, setup_.wanted, setup_.wanted_states};
  }

 private:
  static constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  [[nodiscard]] std::size_t bytes_per_column() const { return 2 * sizeof(double) * (motion_.rows().n() + 1); }
  [[nodiscard]] MotionColumn make(std::size_t entry) const {
    SceneTangent by = scene_tangent(scene_, setup_.stack, setup_.initial, entry);
    StateTangent states = motion_.tangent(by);
    return {std::move(by), std::move(states)};
  }

  Scene<double> scene_;
  TrackingSetup<double, Grid> setup_;
  StateMotion<Grid> motion_;
  std::vector<std::size_t> entries_, torn_;
  std::vector<MotionColumn> kept_;  ///< the first ones, as far as memory should go
};

/// The entries given moved by some 1e-9 of their size, each by another part of it, so that what is equal is so no more.
[[nodiscard]] inline Scene<double> moved_apart(const Scene<double>& scene, const TrackOptions& options,
                                               const std::vector<std::size_t>& torn) {
  constexpr double kPart = 1e-9, kGolden = 0.6180339887498949;
  const std::vector<Entry> all = entries(scene.spec());
  SceneSpec<double> spec = scene.spec();
  const std::vector<double*> places = entry_places(spec);
  const StateRange<double> range = scene.fluxes().front().range();
  const auto is_tracked = [&] {
    return find_complaints(spec).empty() && Tracking::refusal(Scene<double>(spec), options).empty();
  };
  for (std::size_t n = 0; n < torn.size(); ++n) {
    double& number = *places[torn[n]];
    const double here = number, turn = kGolden * static_cast<double>(n + 1);
    const double size = all[torn[n]].range == Range::positive    ? here
                        : all[torn[n]].measure == Measure::state ? range.highest - range.lowest
                                                                 : std::max(1.0, std::abs(here));
    const double step = kPart * size * (1 + (turn - std::floor(turn)));
    number = here + step;
    if (is_tracked()) continue;
    number = here - step;
    if (!is_tracked()) number = here;
  }
  return Scene<double>(std::move(spec));
}

/// What was done to a scene whose numbers were moved apart.
[[nodiscard]] inline std::string apart_remark(std::size_t n_moved, bool are_apart) {
  if (!are_apart)
    return "two states that are one move apart: derivatives hold to one side of the numbers at most";
  return std::to_string(n_moved) + " of the numbers moved by some 1e-9, as equal states have no derivative";
}

/// The bed of a scene whose numbers move, or if that tears states which are one in its grid, of one that is moved apart by so little.
template <class Grid>
class BedApart {
 public:
  BedApart(const Scene<double>& scene, const TrackOptions& options, const std::vector<std::size_t>& wanted)
      : bed_(std::make_unique<MovingBed<Grid>>(scene, options)) {
    bed_->move(wanted);
    if (bed_->torn().empty()) return;
    const std::vector<std::size_t> torn = bed_->torn();
    bed_ = std::make_unique<MovingBed<Grid>>(moved_apart(scene, options, torn), options);
    bed_->move(wanted);
    remark_ = apart_remark(torn.size(), bed_->torn().empty());
  }
  [[nodiscard]] const MovingBed<Grid>& bed() const { return *bed_; }
  /// What was done, or could not be; empty if nothing had to be.
  [[nodiscard]] const std::string& remark() const { return remark_; }

 private:
  std::unique_ptr<MovingBed<Grid>> bed_;
  std::string remark_;
};

inline void add_remark(Summary& summary, const std::string& text) {
  if (text.empty()) return;
  summary.remark += (summary.remark.empty() ? "" : "; ") + text;
}

}  // namespace shearfront::track_detail
