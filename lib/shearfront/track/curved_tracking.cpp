// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/track/curved_field.hpp"
#include "shearfront/track/curved_reconstruct.hpp"
#include "shearfront/track/curved_record.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront::track_detail {
namespace {

// A level takes a number per piece, and its fronts 128 bytes each.
constexpr double kMostLevelEntries = 2e8;

template <class Observer>
class CurvedTracking final : public AnyTracking {
 public:
  CurvedTracking(const Scene<double>& scene, CurvedScene curved, const TrackOptions& options,
                 Progress progress)
      : bed_(make_bed(std::move(curved), options)),
        scene_(std::make_shared<const Scene<double>>(scene)),
        reconstruct_(options.reconstruct),
        edges_(options.edges),
        limits_{options.max_collisions, std::move(progress)},
        tracker_(CurvedSystem<Observer>(bed_->grid, bed_->scene.problem, Observer{},
                                        static_cast<std::size_t>(options.max_fronts)),
                 changes_of(*bed_)) {}

  [[nodiscard]] std::unique_ptr<AnyTracking> copy() const override {
    return std::make_unique<CurvedTracking>(*this);
  }
  Status advance(double t) override {
    if (tracker_.is_periodic() && !std::isfinite(t)) {
      refused_ = "a periodic bed has no steady state; ask for a finite time";
      return status_ = Status::unsupported;
    }
    return status_ = tracker_.advance_to(t / unit(), limits_);
  }
  [[nodiscard]] double time() const override { return tracker_.time() * unit(); }
  [[nodiscard]] Profile<double> profile() const override {
    return reconstruct_ == Reconstruction::linear ? lines() : *steps().profile();
  }
  [[nodiscard]] std::unique_ptr<Field> field(const Scene<double>& scene) const override {
    if (reconstruct_ == Reconstruction::linear) return std::make_unique<ProfileField>(scene, lines());
    return std::make_unique<CurvedField>(steps());
  }
  [[nodiscard]] std::vector<FrontSegment<double>> fronts() const override {
    std::vector<FrontSegment<double>> segments;
    if constexpr (Observer::kActive) {
      const double tolerance = kPicture * (scene_->top() - scene_->bottom());
      const auto add = [&](FrontSegment<double> segment) {
        const double middle = segment.z_begin + (segment.z_end - segment.z_begin) / 2;
        const FlowCoordinate& heights = bed_->scene.heights;
        for (double* phi : {&segment.phi_below, &segment.phi_above})
          *phi = heights.phi_of(segment.layer, heights.z_of(middle), *phi);
        for (double* z : {&segment.z_begin, &segment.z_end}) *z = heights.z_of(*z);
        for (double* t : {&segment.t_begin, &segment.t_end}) *t *= unit();
        segments.push_back(segment);
      };
      for (const CurvedTrace& trace : tracker_.observer().traces())
        add_segments(bed_->grid, trace, tolerance, add);
      const auto& fronts = tracker_.system().fronts();
      fronts.for_each([&](FrontIndex i, const CurvedNode& node) {
        const double now = tracker_.time();
        if (!fronts.is_boundary(i) && now > node.t)
          add_segments(bed_->grid, {node, now, position_of(bed_->grid, node, now)}, tolerance, add);
      });
      sort_by_begin(segments);
    }
    SHEARFRONT_EXPECTS(Observer::kActive, "a tracking that keeps its fronts");
    return segments;
  }
  [[nodiscard]] std::vector<Collision> collisions() const override {
    if constexpr (Observer::kActive) {
      std::vector<Collision> events = tracker_.observer().events();
      for (Collision& event : events) {
        event.z = bed_->scene.heights.z_of(event.z);
        event.t *= unit();
      }
      return events;
    }
    SHEARFRONT_EXPECTS(Observer::kActive, "a tracking that keeps its history");
    return {};
  }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override {
    if (!scene_->has_walls()) {
      refused_ = "event times are those of a bed between walls";
      status_ = Status::unsupported;
      return std::nullopt;
    }
    status_ = tracker_.run_to_steady(limits_);
    if (status_ != Status::ok && status_ != Status::steady) return std::nullopt;
    static_cast<void>(watched_snapshot());
    if (has_lost()) return std::nullopt;
    Timeline<double> timeline;
    timeline.mass = scene_->mass();
    timeline.steady_height = scene_->steady_height();
    const std::size_t n = bed_->grid.n_layers();
    const auto in_scene = [&](std::optional<double> t) {
      if (t) *t *= unit();
      return t;
    };
    const auto first = [&](std::size_t k) {
      const auto& waves = tracker_.system().waves(k);
      return in_scene(edges_ == FanEdges::characteristic ? waves.first_edge : waves.first);
    };
    timeline.t0 = first(0);
    timeline.t1 = first(n);
    if (tracker_.is_steady()) timeline.t_star = in_scene(tracker_.last_collision());
    const std::vector<double> knots = scene_->knots();
    auto knot = knots.begin();
    for (std::size_t k = 1; k < n && knot != knots.end(); ++k)
      if (bed_->scene.heights.y_of(*knot) == bed_->grid.boundary(k))
        timeline.interfaces.push_back({*knot++, first(k), in_scene(tracker_.last_wave(k))});
    return timeline;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = has_lost() ? Status::not_converged : status_;
    summary.message = !refused_.empty() ? refused_ : message();
    summary.collisions = tracker_.n_collisions();
    summary.fronts_max = tracker_.n_fronts_max();
    summary.levels = bed_->grid.n_levels() + 1;
    summary.layers = bed_->grid.n_layers();
    return summary;
  }

 private:
  [[nodiscard]] double unit() const { return bed_->scene.time_unit; }
  /// Largest distance in y of the segments of a picture from the curves, as a part of the bed.
  static constexpr double kPicture = 1e-4;
  /// Of what the bed holds, before its numbers are no longer used.
  static constexpr double kMostLost = 1e-9;

  [[nodiscard]] static std::shared_ptr<const CurvedBed> make_bed(CurvedScene curved,
                                                                 const TrackOptions& options) {
    LevelPlan plan = plan_levels(curved.problem, options.resolution);
    return std::make_shared<const CurvedBed>(std::move(curved), std::move(plan), options.resolution);
  }
  [[nodiscard]] static std::vector<Ends<double>::Change> changes_of(const CurvedBed& bed) {
    std::vector<Ends<double>::Change> changes;
    const CurvedEnds& ends = bed.scene.problem.ends;
    for (std::size_t end = 0; end < 2; ++end)
      for (std::size_t i = 0; i < ends.changes[end].size(); ++i)
        changes.push_back({ends.changes[end][i], end, outside_state(bed.grid, end, ends.states[end][i + 1])});
    std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
    return changes;
  }
  [[nodiscard]] CurvedField steps() const { return {bed_, watched_snapshot()}; }
  [[nodiscard]] Profile<double> lines() const {
    const CurvedSnapshot snapshot = watched_snapshot();
    return CurvedReconstruction(*bed_, tracker_.system().fronts(), snapshot).profile();
  }
  /// Nothing is lost but by rounding: where a front was not found or met at the wrong time, it shows here.
  [[nodiscard]] CurvedSnapshot watched_snapshot() const {
    CurvedSnapshot snapshot = snapshot_of(tracker_.system(), tracker_.time());
    if (scene_->has_walls() || tracker_.is_periodic()) {
      const double amount = bed_->scene.heights.amount_of(snapshot.z.back(), snapshot.below.back());
      const double room = bed_->scene.heights.room() * (snapshot.z.back() - snapshot.z.front());
      lost_ = std::max(lost_, std::abs(amount - scene_->mass()) / room);
    }
    return snapshot;
  }
  [[nodiscard]] bool has_lost() const { return lost_ > kMostLost; }
  [[nodiscard]] std::string message() const {
    if (has_lost())
      return "rounding lost " + number_text(lost_, 2) +
             " of what the bed holds: rates or heights differ by too much, or by next to nothing, for "
             "curved fronts; exact and finite volumes take such beds";
    if (tracker_.has_too_many_fronts())
      return "stopped at " + std::to_string(tracker_.n_fronts_max()) +
             " fronts, more than allowed; use a coarser resolution, or allow more, at 128 bytes each and as "
             "much again while their list grows";
    switch (status_) {
      case Status::steady:
        return "steady state reached";
      case Status::budget_reached:
        return "stopped at " + std::to_string(tracker_.n_collisions()) +
               " collisions, the largest number allowed; allow more or use a coarser resolution";
      case Status::interrupted:
        return "interrupted after " + std::to_string(tracker_.n_collisions()) + " collisions";
      default:
        return tracker_.n_unreachable() > 0 ? "some fronts meet only after the largest representable time"
                                            : "reached the last time";
    }
  }

  std::shared_ptr<const CurvedBed> bed_;
  std::shared_ptr<const Scene<double>> scene_;
  Reconstruction reconstruct_;
  FanEdges edges_;
  RunLimits limits_;
  Tracker<LevelCurves, Observer, CurvedSystem<Observer>> tracker_;
  Status status_ = Status::ok;
  std::string refused_;
  mutable double lost_ = 0;  ///< most at a time that was looked at, of what the bed holds
};

}  // namespace

bool wants_curves(const Scene<double>& scene, const TrackOptions& options) {
  return options.grid == GridKind::levels && has_curved_fronts(scene);
}

std::string refusal_of_curves(const Scene<double>& scene, const TrackOptions& options) {
  if (const double n = count_curved_entries(scene, options.resolution); n > kMostLevelEntries)
    return "the grid would need " + number_text(n) +
           " numbers, one for each level and piece of the bed; use a coarser resolution";
  return {};
}

std::unique_ptr<AnyTracking> track_curves(const Scene<double>& scene, const TrackOptions& options,
                                          Progress progress) {
  if (options.fronts || options.history)
    return std::make_unique<CurvedTracking<CurvedRecord>>(scene, curved_scene(scene, options.resolution),
                                                          options, std::move(progress));
  return std::make_unique<CurvedTracking<NoObserver>>(scene, curved_scene(scene, options.resolution), options,
                                                      std::move(progress));
}

}  // namespace shearfront::track_detail
