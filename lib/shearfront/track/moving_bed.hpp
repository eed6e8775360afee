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

/// A scene with a grid and how its states move.
template <class Grid>
struct MovingBed {
  TrackingSetup<double, Grid> setup;
  StateMotion<Grid> motion;
  std::vector<SceneTangent> scenes;  ///< per entry
  std::vector<StateTangent> states;
  std::vector<std::size_t> torn;  ///< entries

  MovingBed(const Scene<double>& scene, const TrackOptions& options)
      : setup(scene, tracking_layers(scene, options.resolution), options.resolution, options.grid),
        motion(of()) {}
  /// By these entries.
  void move(const Scene<double>& scene, const std::vector<std::size_t>& wanted) {
    for (const std::size_t entry : wanted) {
      scenes.push_back(scene_tangent(scene, setup.stack, setup.initial, entry));
      states.push_back(motion.tangent(scenes.back()));
      if (states.back().is_torn) torn.push_back(entry);
    }
  }
  [[nodiscard]] GridOfScene<Grid> of() const {
    return {setup.grid, setup.stack, setup.wanted, setup.wanted_states};
  }
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
    bed_->move(scene, wanted);
    if (bed_->torn.empty()) return;
    const std::vector<std::size_t> torn = bed_->torn;
    const Scene<double> apart = moved_apart(scene, options, torn);
    bed_ = std::make_unique<MovingBed<Grid>>(apart, options);
    bed_->move(apart, wanted);
    remark_ = apart_remark(torn.size(), bed_->torn.empty());
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
