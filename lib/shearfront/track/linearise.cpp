// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/linearise.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/track/curved_tracking.hpp"
#include "shearfront/track/front_tangents.hpp"
#include "shearfront/track/grid_choice.hpp"
#include "shearfront/track/moving_bed.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/state_motion.hpp"
#include "shearfront/track/tangent_profile.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kColumnsAtOnce = 8;  // fill vector registers

template <class Grid>
class TangentRun {
 public:
  using Bed = track_detail::MovingBed<Grid>;
  using Tracking = Tracker<Grid, FrontTangents>;

  TangentRun(const Bed& bed, const TrackOptions& options, const std::vector<Place>& places,
             const Progress& progress)
      : bed_(bed),
        options_(options),
        places_(places),
        order_(track_detail::by_time(places)),
        progress_(progress) {
    result_.samples.resize(places.size());
    result_.derivatives.resize(places.size() * bed.n_columns());
    result_.order_holds.resize(bed.n_columns());
  }

  /// All columns, as many at once as memory should hold.
  [[nodiscard]] Linearisation run() {
    const std::size_t most = bed_.most_columns();
    for (std::size_t from = 0; from < bed_.n_columns(); from += most) {
      run_columns(from, std::min(from + most, bed_.n_columns()));
      if (!result_.summary.usable()) break;
    }
    return std::move(result_);
  }

 private:
  void run_columns(std::size_t from, std::size_t to) {
    TangentTable table(bed_.motion().rows(), to - from);
    std::vector<track_detail::MotionColumn> columns;
    columns.reserve(to - from);
    for (std::size_t j = from; j < to; ++j) columns.push_back(bed_.column(j));
    for (std::size_t first = 0; first < columns.size(); first += kColumnsAtOnce) {
      std::vector<TangentTable::Column> some;
      for (std::size_t j = first; j < std::min(first + kColumnsAtOnce, columns.size()); ++j)
        some.push_back({&columns[j].scene, &columns[j].states});
      table.set(first, some);
    }
    Tracking tracker(bed_.setup().grid, bed_.setup().pieces, bed_.setup().ends,
                     FrontTangents(
                         table, bed_.setup().initial.tops,
                         [&](std::size_t column, std::size_t layer, State l, State r) {
                           return bed_.motion().speed(columns[column].scene, columns[column].states, layer, l,
                                                      r);
                         },
                         bed_.setup().grid.n_layers(), bed_.setup().ends.is_periodic),
                     static_cast<std::size_t>(options_.max_fronts));
    Status status = Status::ok;
    for (std::size_t i = 0, end = 0; i < order_.size(); i = end) {
      const double t = places_[order_[i]].t;
      while (end < order_.size() && places_[order_[end]].t == t) ++end;
      status = tracker.advance_to(t, {options_.max_collisions, progress_});
      if (status != Status::ok && status != Status::steady) break;
      take_samples(tracker, i, end);
      if (options_.reconstruct == Reconstruction::constant)
        take_constant(tracker, i, end, from);
      else
        for (std::size_t first = 0; first < to - from; first += kColumnsAtOnce)
          take_linear(tracker, columns, first, i, end, from);
    }
    take_order(tracker, columns, from);
    summarise(tracker, status);
  }
  void take_order(const Tracking& tracker, const std::vector<track_detail::MotionColumn>& columns,
                  std::size_t from) {
    const auto& setup = bed_.setup();
    const StateRows& rows = bed_.motion().rows();
    const FrontTangents& tangents = tracker.observer();
    OrderSteps steps = tangents.steps();
    const bool is_decided = tangents.order().n_undecided() == 0;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      steps.keep_states(setup.grid, rows, tangents.has_front(), j, columns[j].states);
      result_.order_holds[from + j] = is_decided ? steps.range(j) : StepRange{0, 0};
    }
    std::vector<State> states;
    for (std::size_t i = 0; i < setup.wanted.size(); ++i) {
      const State state = setup.wanted_states[i];
      states.push_back(tangents.has_front()[rows(setup.wanted[i].layer, state)] ? state + 1 : 0);
    }
    result_.order = tangents.signature().value(setup.grid.n_levels(), states);
  }
  void take_samples(const Tracking& tracker, std::size_t begin, std::size_t end) {
    const Profile<double> profile =
        options_.reconstruct == Reconstruction::linear ? linear_profile(tracker) : tracker.profile();
    for (std::size_t i = begin; i < end; ++i) {
      const auto at = profile.at(places_[order_[i]].z);
      result_.samples[order_[i]] = {at.phi, at.M};
    }
  }
  void take_constant(const Tracking& tracker, std::size_t begin, std::size_t end, std::size_t from) {
    std::vector<double> heights;
    for (std::size_t i = begin; i < end; ++i) heights.push_back(places_[order_[i]].z);
    const std::size_t n = bed_.n_columns(), n_columns = tracker.observer().table().n_columns();
    for_each_constant_tangent(tracker, heights, [&](std::size_t i, const double* phi, const double* M) {
      Sample* to = &result_.derivatives[order_[begin + i] * n + from];
      for (std::size_t j = 0; j < n_columns; ++j) to[j] = {phi[j], M[j]};
    });
  }
  /// Of a few columns, with numbers no longer than it takes.
  void take_linear(const Tracking& tracker, const std::vector<track_detail::MotionColumn>& columns,
                   std::size_t first, std::size_t begin, std::size_t end, std::size_t from) {
    const std::size_t n = bed_.n_columns(), n_columns = std::min(kColumnsAtOnce, columns.size() - first);
    const auto take = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
      const TangentProfile<N, Tracking> tangents(tracker, bed_.motion(), columns, first);
      const Profile<Dual<N>> profile = tangents.linear();
      for (std::size_t i = begin; i < end; ++i) {
        const auto at = profile.at(Dual<N>(places_[order_[i]].z));
        for (std::size_t j = 0; j < n_columns; ++j)
          result_.derivatives[order_[i] * n + from + first + j] = {at.phi.d[j], at.M.d[j]};
      }
    };
    if (n_columns <= 2) return take(std::integral_constant<std::size_t, 2>{});
    if (n_columns <= 4) return take(std::integral_constant<std::size_t, 4>{});
    take(std::integral_constant<std::size_t, kColumnsAtOnce>{});
  }
  void summarise(const Tracking& tracker, Status status) {
    Summary& summary = result_.summary;
    summary.status = status;
    summary.message = track_detail::message_of(status, tracker.n_collisions(), tracker.n_unreachable());
    if (tracker.has_too_many_fronts()) summary.message = "stopped at more fronts than allowed";
    summary.collisions = tracker.n_collisions();
    summary.fronts_max = tracker.n_fronts_max();
    summary.levels = bed_.setup().grid.n_levels();
    summary.layers = bed_.setup().stack.n_layers();
    summary.remark = tracker.observer().order().remark();
  }

  const Bed& bed_;
  const TrackOptions& options_;
  const std::vector<Place>& places_;
  std::vector<std::size_t> order_;
  const Progress& progress_;
  Linearisation result_;
};

template <class Grid>
Linearisation linearised_tracking_on(const Scene<double>& scene, const TrackOptions& options,
                                     const std::vector<Place>& places, const std::vector<std::size_t>& wanted,
                                     const Progress& progress) {
  const track_detail::BedApart<Grid> bed(scene, options, wanted);
  Linearisation result = TangentRun<Grid>(bed.bed(), options, places, progress).run();
  track_detail::add_remark(result.summary, bed.remark());
  return result;
}

/// A run without derivatives.
Linearisation tracked_samples(const Scene<double>& scene, const TrackOptions& options,
                              const std::vector<Place>& places, const Progress& progress) {
  Linearisation result;
  result.samples.resize(places.size());
  Tracking tracking(scene, options, progress);
  const std::vector<std::size_t> order = track_detail::by_time(places);
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    const double t = places[order[i]].t;
    const Status status = tracking.advance(t);
    if (status != Status::ok && status != Status::steady) break;
    const auto field = tracking.field(scene);
    std::vector<double> heights;
    for (; end < order.size() && places[order[end]].t == t; ++end) heights.push_back(places[order[end]].z);
    const std::vector<Sample> row = field->at(heights);
    for (std::size_t k = 0; k < row.size(); ++k) result.samples[order[i + k]] = row[k];
  }
  result.summary = tracking.summary();
  return result;
}

}  // namespace

std::string tracking_derivative_refusal(const Scene<double>& scene, const TrackOptions& options,
                                        const Entry& entry) {
  if (options.grid != GridKind::levels) return "the states of this grid are rounded";
  if (track_detail::wants_curves(scene, options)) return "fronts are curved";
  // Each entry moves the states of all layers: with so many layers that is more work than two runs.
  constexpr std::size_t kMostLayers = 64;
  if (scene.knots().size() >= kMostLayers)
    return "the bed has more than " + std::to_string(kMostLayers) + " layers";
  return tangent_refusal(scene, entry);
}

Linearisation linearise_tracking(const Scene<double>& scene, const TrackOptions& options,
                                 const std::vector<Place>& places, const std::vector<std::size_t>& wanted,
                                 const Progress& progress) {
  if (wanted.empty()) return tracked_samples(scene, options, places, progress);
  if (scene.spec().is_periodic &&
      std::any_of(places.begin(), places.end(), [](const Place& p) { return !std::isfinite(p.t); })) {
    Linearisation result;
    result.summary.status = Status::unsupported;
    result.summary.message = "a periodic bed has no steady state; ask for a finite time";
    return result;
  }
  return track_detail::with_grid(scene, exact_layers(scene), [&]<class Grid>(std::type_identity<Grid>) {
    return linearised_tracking_on<Grid>(scene, options, places, wanted, progress);
  });
}

}  // namespace shearfront
