// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/gradient.hpp"

#include <type_traits>
#include <utility>

#include "shearfront/track/front_tape.hpp"
#include "shearfront/track/grid_choice.hpp"
#include "shearfront/track/moving_bed.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront {
namespace {

template <class Grid>
TrackingGradient gradient_on(const Scene<double>& scene, const TrackOptions& options,
                             const std::vector<Place>& places,
                             const std::function<std::vector<Sample>(const std::vector<Sample>&)>& weigh,
                             const std::vector<std::size_t>& wanted, const Progress& progress) {
  const track_detail::BedApart<Grid> apart(scene, options, wanted);
  const track_detail::MovingBed<Grid>& bed = apart.bed();
  Tracker<Grid, FrontTape> tracker(bed.setup.grid, bed.setup.pieces, bed.setup.ends,
                                   FrontTape(bed.setup.initial.tops),
                                   static_cast<std::size_t>(options.max_fronts));
  TrackingGradient result;
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
  summary.collisions = tracker.n_collisions();
  summary.fronts_max = tracker.n_fronts_max();
  summary.levels = bed.setup.grid.n_levels();
  summary.layers = bed.setup.stack.n_layers();
  if (!summary.usable()) return result;
  summary.remark = tracker.observer().order().remark();
  track_detail::add_remark(summary, apart.remark());
  const Adjoints adjoints = tracker.observer().adjoints(
      bed.setup.grid, bed.motion.rows(), bed.setup.pieces.size(), bed.setup.ends.changes.size(), snapshots,
      places, snapshot_of, weigh(result.samples));
  for (std::size_t k = 0; k < wanted.size(); ++k)
    result.gradient.push_back(adjoints.along(bed.motion, bed.scenes[k], bed.states[k]));
  return result;
}

}  // namespace

TrackingGradient tracking_gradient(
    const Scene<double>& scene, const TrackOptions& options, const std::vector<Place>& places,
    const std::function<std::vector<Sample>(const std::vector<Sample>&)>& weigh,
    const std::vector<std::size_t>& wanted, const Progress& progress) {
  return track_detail::with_grid(scene, exact_layers(scene), [&]<class Grid>(std::type_identity<Grid>) {
    return gradient_on<Grid>(scene, options, places, weigh, wanted, progress);
  });
}

}  // namespace shearfront
