// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/track.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/riemann/flux_course.hpp"
#include "shearfront/riemann/overload.hpp"
#include "shearfront/track/any_tracking.hpp"
#include "shearfront/track/curved_tracking.hpp"
#include "shearfront/track/grid_choice.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/solid_profile.hpp"

namespace shearfront {

namespace {

// A record of 40 bytes per level: beyond this a grid would need more memory than a workstation has.
constexpr double kMaxLevels = 4e8;

/// Why the grid cannot be built; empty if it can.
std::string refusal_of_levels(const LayerStack<double>& stack, const TrackOptions& options) {
  if (options.grid == GridKind::levels) {
    if (const double n = LevelGrid<double>::exact_level_count(stack, options.resolution); n > kMaxLevels)
      return "the grid would need " + number_text(std::floor(n)) + " levels; use a coarser resolution";
    return {};
  }
  double largest = 0;
  for (std::size_t k = 0; k < stack.n_layers(); ++k) largest = std::max(largest, stack.shear_rate(k));
  if (const double n = largest / options.resolution; n > kMaxLevels)
    return "the singular-mapping grid would need " + number_text(std::floor(n)) +
           " levels; use a coarser resolution or the levels grid";
  return {};
}

/// A flux that does not vanish at the ends of its range may bring more to a layer than that can carry.
std::string refusal_between_layers(const Scene<double>& scene) {
  if (scene.is_uniform()) return {};
  if (is_monotone(course_of(scene.fluxes().front()))) return overload(scene);
  for (const Flux<double>& flux : scene.fluxes())
    if (flux.value(flux.range().lowest) != 0 || flux.value(flux.range().highest) != 0)
      return "flux " + std::string(flux.name()) +
             " must vanish at both ends of its range where a, c or T vary";
  return {};
}

std::string refusal_of(const Scene<double>& scene, const LayerStack<double>& stack,
                       const TrackOptions& options) {
  if (stack.is_plain()) return refusal_of_levels(stack, options);
  if (options.grid != GridKind::levels)
    return "the singular-mapping grid is known for the quadratic flux only";
  if (options.reconstruct != Reconstruction::constant && has_smooth_solid_fraction(scene))
    return "the linear reconstruction is not known where c varies smoothly";
  if (LevelGrid<double>::refusal(stack).empty()) return refusal_of_levels(stack, options);
  if (track_detail::has_several_extrema(scene))
    return OneLayerGrid<double>::refusal(stack, options.resolution);
  if (std::string why = UnimodalGrid<double>::refusal(stack, options.resolution); !why.empty()) return why;
  return refusal_between_layers(scene);
}

/// What needs no layers to be refused.
std::string refusal_at_once(const Scene<double>& scene, const TrackOptions& options) {
  if (options.grid == GridKind::levels && !(options.resolution > 0 && options.resolution <= 1))
    return "resolution = " + number_text(options.resolution) + "; must be > 0 and <= 1";
  if (!(options.resolution > 0)) return "resolution = " + number_text(options.resolution) + "; must be > 0";
  if (scene.has_diffusion()) return "there are no fronts where grains diffuse";
  return {};
}

/// Whether only pure states are at rest.
bool separates(const Flux<double>& flux) {
  bool is_negative = true, is_positive = true;
  for (const double x : flux.extrema()) {
    is_negative = is_negative && flux.value(x) < 0;
    is_positive = is_positive && flux.value(x) > 0;
  }
  return is_negative || is_positive;
}

LayerStack<double> layers_of(const Scene<double>& scene, const TrackOptions& options) {
  return tracking_layers(scene, std::min(options.resolution, 1.0));
}

template <class AnyTracker>
Profile<double> profile_of(const AnyTracker& tracker, const Scene<double>& scene,
                           const LayerStack<double>& stack, Reconstruction reconstruct) {
  if (has_smooth_solid_fraction(scene)) return solid_profile(tracker, scene, stack);
  if (reconstruct == Reconstruction::linear) return linear_profile(tracker);
  return tracker.profile();
}

}  // namespace

namespace {

using track_detail::AnyTracking;

template <class Grid, class Observer>
class TrackingOn final : public AnyTracking {
 public:
  TrackingOn(const Scene<double>& scene, const TrackOptions& options, Progress progress,
             LayerStack<double> stack)
      : bed_(std::make_shared<const Bed>(scene, options, std::move(stack))),
        limits_{options.max_collisions, std::move(progress)},
        tracker_(bed_->setup.grid, bed_->setup.pieces, bed_->setup.ends, {},
                 static_cast<std::size_t>(options.max_fronts)) {}

  [[nodiscard]] std::unique_ptr<AnyTracking> copy() const override {
    return std::make_unique<TrackingOn>(*this);
  }
  Status advance(double t) override {
    if (bed_->scene.spec().is_periodic && !std::isfinite(t)) {
      refused_ = "a periodic bed has no steady state; ask for a finite time";
      return status_ = Status::unsupported;
    }
    return status_ = tracker_.advance_to(t, limits_);
  }
  [[nodiscard]] double time() const override { return tracker_.time(); }
  [[nodiscard]] Profile<double> profile() const override {
    return profile_of(tracker_, bed_->scene, bed_->setup.stack, bed_->reconstruct);
  }
  [[nodiscard]] std::vector<FrontSegment<double>> fronts() const override {
    if constexpr (Observer::kActive) return tracker_.record().segments();
    SHEARFRONT_EXPECTS(Observer::kActive, "a tracking that keeps its fronts");
    return {};
  }
  [[nodiscard]] std::vector<Collision> collisions() const override {
    std::vector<Collision> all;
    if constexpr (requires(const Observer& observer) { observer.collisions(); }) {
      const Observer record = tracker_.record();
      for (const auto& c : record.collisions()) {
        if (c.incoming.empty()) continue;  // where fronts begin at time 0
        all.push_back({c.t, c.z, c.boundary, c.incoming.size(), c.outgoing.size()});
        if (c.boundary == CollisionView<double>::kNoBoundary) all.back().boundary.reset();
      }
      return all;
    }
    SHEARFRONT_EXPECTS(Observer::kActive, "a tracking that keeps its history");
    return all;
  }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override {
    if (!bed_->scene.has_walls()) {
      refused_ = "event times are those of a bed between walls";
      status_ = Status::unsupported;
      return std::nullopt;
    }
    if (!std::all_of(bed_->scene.fluxes().begin(), bed_->scene.fluxes().end(), separates)) {
      refused_ = "event times are those of grains that go one way; this flux is 0 inside its range";
      status_ = Status::unsupported;
      return std::nullopt;
    }
    status_ = tracker_.run_to_steady(limits_);
    if (status_ != Status::ok && status_ != Status::steady) return std::nullopt;
    const Timeline<double> timeline =
        tracked_timeline(tracker_, bed_->scene, bed_->setup.stack, bed_->setup.initial, bed_->edges);
    rests_never_ = tracker_.is_steady() && !timeline.t_star;
    return timeline;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message = !refused_.empty() ? refused_ : message();
    summary.collisions = tracker_.n_collisions();
    summary.fronts_max = tracker_.n_fronts_max();
    summary.levels = bed_->setup.grid.n_levels();
    summary.layers = bed_->setup.stack.n_layers();
    return summary;
  }

 private:
  [[nodiscard]] std::string message() const {
    if (tracker_.has_too_many_fronts())
      return "stopped at " + std::to_string(tracker_.n_fronts_max()) +
             " fronts, more than allowed; use a coarser resolution, or allow more, at 64 "
             "bytes "
             "each and as much again while their list grows";
    if (rests_never_)
      return "the bed never rests, for its flux has no slope at a pure state; the last fronts of the polygon "
             "meet "
             "at t = " +
             number_text(tracker_.last_collision());
    std::string text = track_detail::message_of(status_, tracker_.n_collisions(), tracker_.n_unreachable());
    if (bed_->scene.has_smooth_start())
      text += "; " + std::to_string(bed_->setup.pieces.size()) +
              " steps stand for the smooth start, an L1 distance of " +
              number_text(bed_->setup.start_distance, 2);
    return text;
  }

  /// What never changes; the tracker refers to it.
  struct Bed {
    Bed(const Scene<double>& of, const TrackOptions& options, LayerStack<double> stack)
        : scene(of),
          setup(of, std::move(stack), options.resolution, options.grid),
          reconstruct(options.reconstruct),
          edges(options.edges) {}
    Scene<double> scene;
    TrackingSetup<double, Grid> setup;
    Reconstruction reconstruct;
    FanEdges edges;
  };

  std::shared_ptr<const Bed> bed_;
  RunLimits limits_;
  Tracker<Grid, Observer> tracker_;
  Status status_ = Status::ok;
  std::string refused_;
  bool rests_never_ = false;
};

template <class Grid>
std::unique_ptr<AnyTracking> tracking_on(const Scene<double>& scene, const TrackOptions& options,
                                         Progress progress, LayerStack<double> stack) {
  const auto keeping = [&]<class Observer>(Observer) -> std::unique_ptr<AnyTracking> {
    return std::make_unique<TrackingOn<Grid, Observer>>(scene, options, std::move(progress),
                                                        std::move(stack));
  };
  if (options.history) return keeping(History<double>{});
  if (options.fronts) return keeping(SegmentRecord<double>{});
  return keeping(NoObserver{});
}

}  // namespace

std::string Tracking::refusal(const Scene<double>& scene, const TrackOptions& options) {
  if (std::string why = refusal_at_once(scene, options); !why.empty()) return why;
  if (track_detail::wants_curves(scene, options)) return track_detail::refusal_of_curves(scene, options);
  return refusal_of(scene, layers_of(scene, options), options);
}

Tracking::Tracking(const Scene<double>& scene, const TrackOptions& options, Progress progress) {
  std::string why = refusal_at_once(scene, options);
  if (why.empty() && track_detail::wants_curves(scene, options)) {
    why = track_detail::refusal_of_curves(scene, options);
    if (why.empty()) tracking_ = track_detail::track_curves(scene, options, std::move(progress));
  } else if (why.empty()) {
    LayerStack<double> stack = layers_of(scene, options);
    why = refusal_of(scene, stack, options);
    const auto on = [&]<class Grid>(std::type_identity<Grid>) {
      return tracking_on<Grid>(scene, options, std::move(progress), std::move(stack));
    };
    if (why.empty()) tracking_ = track_detail::with_grid(scene, stack, on);
  }
  if (!tracking_) throw InputError("method", "\"front-tracking\"", "must suit the scene: " + why);
}
Tracking::Tracking(const Tracking& other) : tracking_(other.tracking_->copy()) {}
Tracking::Tracking(Tracking&&) noexcept = default;
Tracking& Tracking::operator=(Tracking other) noexcept {
  tracking_ = std::move(other.tracking_);
  return *this;
}
Tracking::~Tracking() = default;

Status Tracking::advance(double t) { return tracking_->advance(t); }
double Tracking::time() const { return tracking_->time(); }
Profile<double> Tracking::profile() const { return tracking_->profile(); }
std::unique_ptr<Field> Tracking::field(const Scene<double>& scene) const { return tracking_->field(scene); }
std::vector<FrontSegment<double>> Tracking::fronts() const { return tracking_->fronts(); }
std::vector<Collision> Tracking::collisions() const { return tracking_->collisions(); }
std::optional<Timeline<double>> Tracking::timeline() { return tracking_->timeline(); }
Summary Tracking::summary() const { return tracking_->summary(); }

}  // namespace shearfront
