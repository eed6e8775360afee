// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/gradient.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "shearfront/track/front_tape.hpp"
#include "shearfront/track/grid_choice.hpp"
#include "shearfront/track/moving_bed.hpp"
#include "shearfront/track/start_entries.hpp"
#include "shearfront/track/tracker.hpp"
#include "shearfront/track/wanted_motion.hpp"

namespace shearfront {
namespace {

/// What a gradient is taken in: entries that are numbers of the start each by itself, all others by how they move all states.
template <class Grid>
class GradientBed {
 public:
  GradientBed(const Scene<double>& scene, const TrackOptions& options, const std::vector<std::size_t>& wanted)
      : wanted_(wanted) {
    make(scene, options);
    const std::vector<std::size_t> torn = this->torn();
    if (torn.empty()) return;
    make(track_detail::moved_apart(scene, options, torn), options);
    remark_ = track_detail::apart_remark(torn.size(), this->torn().empty());
  }
  [[nodiscard]] const track_detail::MovingBed<Grid>& bed() const { return *bed_; }
  [[nodiscard]] const std::string& remark() const { return remark_; }

  [[nodiscard]] std::vector<double> gradient(const Adjoints& adjoints) const {
    // Speeds of fronts between close states change with these.
    std::vector<double> phi = adjoints.phi, flux = adjoints.flux;
    std::vector<StateShift> shifts;
    for (const Adjoints::Speed& close : adjoints.close) {
      shifts.clear();
      motion_->speed(close.layer, close.below, close.above, shifts);
      for (const StateShift& s : shifts)
        phi[s.row] += close.weight * s.phi, flux[s.row] += close.weight * s.flux;
    }
    std::vector<double> all;
    std::size_t n_general = 0;
    for (const std::size_t entry : wanted_) {
      const StartEntries::Entry& start = (*starts_)[entry];
      if (!start.is_any()) {
        const track_detail::MotionColumn column = bed_->column(n_general++);
        all.push_back(adjoints.along(bed_->motion(), column.scene, column.states));
        continue;
      }
      shifts.clear();
      for (auto n = start.wanted.begin(); n != start.wanted.end(); ++n)
        if (std::none_of(start.wanted.begin(), n, [&](std::size_t m) { return motion_->is_same(m, *n); }))
          motion_->shifts(*n, shifts);
      double sum = 0;
      for (const StateShift& s : shifts) sum += phi[s.row] * s.phi + flux[s.row] * s.flux;
      if (start.top != StartEntries::kNone) sum += adjoints.top[start.top];
      if (start.change != StartEntries::kNone) sum += adjoints.change[start.change];
      all.push_back(sum);
    }
    return all;
  }

 private:
  void make(const Scene<double>& scene, const TrackOptions& options) {
    bed_ = std::make_unique<track_detail::MovingBed<Grid>>(scene, options);
    starts_.emplace(scene, bed_->setup().initial);
    std::vector<std::size_t> general;
    for (const std::size_t entry : wanted_)
      if (!(*starts_)[entry].is_any()) general.push_back(entry);
    bed_->move(general);
    motion_.emplace(bed_->of(), bed_->motion().rows());
  }
  [[nodiscard]] std::vector<std::size_t> torn() const {
    std::vector<std::size_t> all = bed_->torn();
    for (const std::size_t entry : wanted_)
      if (const auto& group = (*starts_)[entry].wanted; !group.empty() && motion_->is_torn(group))
        all.push_back(entry);
    return all;
  }

  const std::vector<std::size_t>& wanted_;
  std::unique_ptr<track_detail::MovingBed<Grid>> bed_;
  std::optional<StartEntries> starts_;
  std::optional<WantedMotion<Grid>> motion_;
  std::string remark_;
};

template <class Grid>
LinearSum tracking_gradient_on(const Scene<double>& scene, const TrackOptions& options,
                               const std::vector<Place>& places, const SumWeights& weigh,
                               const std::vector<std::size_t>& wanted, const Progress& progress) {
  const GradientBed<Grid> apart(scene, options, wanted);
  const track_detail::MovingBed<Grid>& bed = apart.bed();
  Tracker<Grid, FrontTape> tracker(bed.setup().grid, bed.setup().pieces, bed.setup().ends,
                                   FrontTape(bed.setup().initial.tops),
                                   static_cast<std::size_t>(options.max_fronts));
  LinearSum result;
  result.samples.resize(places.size());
  std::vector<std::size_t> snapshot_of(places.size());
  const std::vector<std::size_t> order = track_detail::by_time(places);
  std::vector<FrontTape::Snapshot> snapshots;
  Status status = Status::ok;
  for (std::size_t i = 0; i < order.size();) {
    const double t = places[order[i]].t;
    status = tracker.advance_to(t, {options.max_collisions, progress});
    if (status != Status::ok && status != Status::steady) break;
    snapshots.push_back(tracker.observer().snapshot(tracker));
    const Profile<double> profile = tracker.profile();
    for (; i < order.size() && places[order[i]].t == t; ++i) {
      const auto at = profile.at(places[order[i]].z);
      result.samples[order[i]] = {at.phi, at.M};
      snapshot_of[order[i]] = snapshots.size() - 1;
    }
  }
  Summary& summary = result.summary;
  summary.status = status;
  summary.message = track_detail::message_of(status, tracker.n_collisions(), tracker.n_unreachable());
  if (tracker.has_too_many_fronts()) summary.message = "stopped at more fronts than allowed";
  summary.collisions = tracker.n_collisions();
  summary.fronts_max = tracker.n_fronts_max();
  summary.levels = bed.setup().grid.n_levels();
  summary.layers = bed.setup().stack.n_layers();
  if (!summary.usable()) return result;
  summary.remark = tracker.observer().order().remark();
  track_detail::add_remark(summary, apart.remark());
  const Adjoints adjoints = tracker.observer().adjoints(
      bed.setup().grid, bed.motion().rows(), bed.setup().pieces.size(), bed.setup().ends.changes.size(),
      snapshots, places, snapshot_of, weigh(result.samples));
  result.gradient = apart.gradient(adjoints);
  return result;
}

}  // namespace

LinearSum tracking_gradient(const Scene<double>& scene, const TrackOptions& options,
                            const std::vector<Place>& places, const SumWeights& weigh,
                            const std::vector<std::size_t>& wanted, const Progress& progress) {
  return track_detail::with_grid(scene, exact_layers(scene), [&]<class Grid>(std::type_identity<Grid>) {
    return tracking_gradient_on<Grid>(scene, options, places, weigh, wanted, progress);
  });
}

}  // namespace shearfront
