// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/linearise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/track/curved_tracking.hpp"
#include "shearfront/track/front_tangents.hpp"
#include "shearfront/track/grid_choice.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/state_motion.hpp"
#include "shearfront/track/tangent_profile.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kColumnsAtOnce = 8;  // fill vector registers

/// Places by time: begin and end of the places of each time.
std::vector<std::size_t> by_time(const std::vector<Place>& places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return places[a].t < places[b].t; });
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

  MovingBed(const Scene<double>& scene, const TrackOptions& options, const std::vector<std::size_t>& wanted)
      : setup(scene, tracking_layers(scene, options.resolution), options.resolution, options.grid),
        motion(GridOfScene<Grid>{setup.grid, setup.stack, setup.wanted, setup.wanted_states}) {
    for (const std::size_t entry : wanted) {
      scenes.push_back(scene_tangent(scene, setup.stack, setup.initial, entry));
      states.push_back(motion.tangent(scenes.back()));
      if (states.back().is_torn) torn.push_back(entry);
    }
  }
};

/// The entries given moved by some 1e-9 of their size, each by another part of it, so that what is equal is so no more.
Scene<double> moved_apart(const Scene<double>& scene, const TrackOptions& options,
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

template <class Grid>
class TangentRun {
 public:
  using Bed = MovingBed<Grid>;
  using Tracking = Tracker<Grid, FrontTangents>;

  TangentRun(const Bed& bed, const TrackOptions& options, const std::vector<Place>& places,
             const Progress& progress)
      : bed_(bed), options_(options), places_(places), order_(by_time(places)), progress_(progress) {
    result_.samples.resize(places.size());
    result_.derivatives.resize(places.size() * bed.scenes.size());
  }

  /// All columns, as many at once as memory should hold.
  [[nodiscard]] Linearisation run() {
    constexpr std::size_t kMostBytes = std::size_t{1} << 28;
    const std::size_t per_column = 2 * sizeof(double) * (bed_.motion.rows().n() + 1);
    const std::size_t most = std::max(kColumnsAtOnce, kMostBytes / per_column);
    for (std::size_t from = 0; from < bed_.scenes.size(); from += most) {
      run_columns(from, std::min(from + most, bed_.scenes.size()));
      if (!result_.summary.usable()) break;
    }
    return std::move(result_);
  }

 private:
  void run_columns(std::size_t from, std::size_t to) {
    TangentTable table(bed_.motion.rows(), to - from);
    for (std::size_t j = from; j < to; ++j) table.set(j - from, bed_.scenes[j], bed_.states[j]);
    const std::vector<SceneTangent> scenes(bed_.scenes.begin() + static_cast<std::ptrdiff_t>(from),
                                           bed_.scenes.begin() + static_cast<std::ptrdiff_t>(to));
    const std::vector<StateTangent> states(bed_.states.begin() + static_cast<std::ptrdiff_t>(from),
                                           bed_.states.begin() + static_cast<std::ptrdiff_t>(to));
    Tracking tracker(bed_.setup.grid, bed_.setup.pieces, bed_.setup.ends,
                     FrontTangents(table, bed_.setup.initial.tops,
                                   [&](std::size_t column, std::size_t layer, State l, State r) {
                                     return bed_.motion.speed(scenes[column], states[column], layer, l, r);
                                   }),
                     static_cast<std::size_t>(options_.max_fronts));
    Status status = Status::ok;
    for (std::size_t i = 0, end = 0; i < order_.size(); i = end) {
      const double t = places_[order_[i]].t;
      while (end < order_.size() && places_[order_[end]].t == t) ++end;
      status = tracker.advance_to(t, {options_.max_collisions, progress_});
      if (status != Status::ok && status != Status::steady) break;
      take_samples(tracker, i, end);
      for (std::size_t first = 0; first < to - from; first += kColumnsAtOnce)
        take_derivatives(TangentProfile(tracker, bed_.motion, scenes, states, first), i, end, from + first,
                         std::min(from + first + kColumnsAtOnce, to));
    }
    summarise(tracker, status);
  }
  void take_samples(const Tracking& tracker, std::size_t begin, std::size_t end) {
    const Profile<double> profile =
        options_.reconstruct == Reconstruction::linear ? linear_profile(tracker) : tracker.profile();
    for (std::size_t i = begin; i < end; ++i) {
      const auto at = profile.at(places_[order_[i]].z);
      result_.samples[order_[i]] = {at.phi, at.M};
    }
  }
  template <class Tangents>
  void take_derivatives(const Tangents& tangents, std::size_t begin, std::size_t end, std::size_t from,
                        std::size_t to) {
    const auto profile =
        options_.reconstruct == Reconstruction::linear ? tangents.linear() : tangents.constant();
    const std::size_t n = bed_.scenes.size();
    for (std::size_t i = begin; i < end; ++i) {
      const auto at = profile.at(typename Tangents::Scalar(places_[order_[i]].z));
      for (std::size_t j = from; j < to; ++j)
        result_.derivatives[order_[i] * n + j] = {at.phi.d[j - from], at.M.d[j - from]};
    }
  }
  void summarise(const Tracking& tracker, Status status) {
    Summary& summary = result_.summary;
    summary.status = status;
    summary.message = track_detail::message_of(status, tracker.n_collisions(), tracker.n_unreachable());
    if (tracker.has_too_many_fronts()) summary.message = "stopped at more fronts than allowed";
    summary.collisions = tracker.n_collisions();
    summary.fronts_max = tracker.n_fronts_max();
    summary.levels = bed_.setup.grid.n_levels();
    summary.layers = bed_.setup.stack.n_layers();
    const OrderCheck& order = tracker.observer().order();
    if (order.n_undecided > 0)
      summary.remark = "the order of events is not decided in " + std::to_string(order.n_undecided) +
                       " points, the first at t = " + number_text(order.first->t) +
                       ", z = " + number_text(order.first->z) +
                       ": derivatives hold to one side of the numbers at most";
  }

  const Bed& bed_;
  const TrackOptions& options_;
  const std::vector<Place>& places_;
  std::vector<std::size_t> order_;
  const Progress& progress_;
  Linearisation result_;
};

void add_remark(Summary& summary, const std::string& text) {
  summary.remark += (summary.remark.empty() ? "" : "; ") + text;
}

template <class Grid>
Linearisation linearised_on(const Scene<double>& scene, const TrackOptions& options,
                            const std::vector<Place>& places, const std::vector<std::size_t>& wanted,
                            const Progress& progress) {
  const MovingBed<Grid> bed(scene, options, wanted);
  if (bed.torn.empty()) return TangentRun<Grid>(bed, options, places, progress).run();
  const MovingBed<Grid> apart(moved_apart(scene, options, bed.torn), options, wanted);
  Linearisation result = TangentRun<Grid>(apart, options, places, progress).run();
  if (apart.torn.empty())
    add_remark(result.summary, "moved by some 1e-9, as equal states have no derivative: " +
                                   std::to_string(bed.torn.size()) + " of the numbers");
  else
    add_remark(result.summary,
               "two states that are one move apart: derivatives hold to one side of the numbers at most");
  return result;
}

/// A run without derivatives.
Linearisation sampled(const Scene<double>& scene, const TrackOptions& options,
                      const std::vector<Place>& places, const Progress& progress) {
  Linearisation result;
  result.samples.resize(places.size());
  Tracking tracking(scene, options, progress);
  const std::vector<std::size_t> order = by_time(places);
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
  return tangent_refusal(scene, entry);
}

Linearisation linearise_tracking(const Scene<double>& scene, const TrackOptions& options,
                                 const std::vector<Place>& places, const std::vector<std::size_t>& wanted,
                                 const Progress& progress) {
  if (wanted.empty()) return sampled(scene, options, places, progress);
  if (scene.spec().is_periodic &&
      std::any_of(places.begin(), places.end(), [](const Place& p) { return !std::isfinite(p.t); })) {
    Linearisation result;
    result.summary.status = Status::unsupported;
    result.summary.message = "a periodic bed has no steady state; ask for a finite time";
    return result;
  }
  return track_detail::with_grid(scene, exact_layers(scene), [&]<class Grid>(std::type_identity<Grid>) {
    return linearised_on<Grid>(scene, options, places, wanted, progress);
  });
}

}  // namespace shearfront
