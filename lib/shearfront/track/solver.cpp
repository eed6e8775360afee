// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/solver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/track/packed_profile.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"

namespace shearfront {

namespace {

// A record of 40 bytes per level: beyond this a grid would need more memory than a workstation has.
constexpr double kMaxLevels = 4e8;

template <class Grid>
constexpr bool kIsLevelGrid = std::is_same_v<Grid, LevelGrid<double>>;

/// Why the grid cannot be built; empty if it can.
std::string refusal_of_levels(const LayerStack<double>& stack, const FrontTrackingSolver::Options& options) {
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
  for (const Flux<double>& flux : scene.fluxes())
    if (std::string name = std::visit(
            [](const auto& f) {
              const bool vanishes = f.value(f.range().lowest) == 0 && f.value(f.range().highest) == 0;
              return vanishes ? std::string() : std::string(f.kName);
            },
            flux);
        !name.empty())
      return "flux " + name + " must vanish at both ends of its range where a, c or T vary";
  return {};
}

std::string refusal_of(const Scene<double>& scene, const LayerStack<double>& stack,
                       const FrontTrackingSolver::Options& options) {
  if (stack.is_plain()) return refusal_of_levels(stack, options);
  if (options.grid != GridKind::levels)
    return "the singular-mapping grid is known for the quadratic flux only";
  if (options.reconstruct != Reconstruction::constant)
    return "the linear reconstruction is known for the quadratic flux only";
  if (LevelGrid<double>::refusal(stack).empty()) return refusal_of_levels(stack, options);
  if (std::string why = UnimodalGrid<double>::refusal(stack, options.resolution); !why.empty()) return why;
  return refusal_between_layers(scene);
}

LayerStack<double> layers_of(const Scene<double>& scene, const FrontTrackingSolver::Options& options) {
  return tracking_layers(scene, std::min(options.resolution, 1.0), static_cast<std::size_t>(options.layers));
}

std::string message_of(Status status, std::uint64_t n_collisions, std::size_t n_unreachable) {
  switch (status) {
    case Status::steady:
      return "steady state reached";
    case Status::budget_reached:
      return "stopped at " + std::to_string(n_collisions) +
             " collisions, the largest number allowed; allow more or use a coarser resolution";
    case Status::interrupted:
      return "interrupted after " + std::to_string(n_collisions) + " collisions";
    default:
      return n_unreachable > 0 ? "some fronts meet only after the largest representable time"
                               : "reached the last time";
  }
}

template <class AnyTracker>
Profile<double> profile_of(const AnyTracker& tracker, const Scene<double>& scene,
                           const LayerStack<double>& stack, Reconstruction reconstruct) {
  if (has_smooth_packing(scene)) return packed_profile(tracker, scene, stack);
  if constexpr (kIsLevelGrid<std::decay_t<decltype(tracker.grid())>>)
    if (reconstruct == Reconstruction::linear) return linear_profile(tracker);
  return tracker.profile();
}

template <class Grid, class Observer>
class TrackRun final : public Run {
 public:
  TrackRun(const Scene<double>& scene, const FrontTrackingSolver::Options& options, const Watch& watch,
           LayerStack<double> stack)
      : scene_(scene),
        reconstruct_(options.reconstruct),
        limits_{options.max_collisions, watch.progress},
        setup_(scene, std::move(stack), options.resolution, options.grid),
        tracker_(setup_.grid, setup_.pieces, setup_.ends) {}

  Status advance(double t) override {
    field_.reset();
    if (scene_.spec().is_periodic && !std::isfinite(t)) {
      refused_ = "a periodic bed has no steady state; ask for a finite time";
      return status_ = Status::unsupported;
    }
    return status_ = tracker_.advance_to(t, limits_);
  }
  [[nodiscard]] const Field& field() override {
    if (!field_) field_.emplace(scene_, profile_of(tracker_, scene_, setup_.stack, reconstruct_));
    return *field_;
  }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override {
    if (!scene_.has_walls()) {
      refused_ = "event times are those of a bed between walls";
      status_ = Status::unsupported;
      return std::nullopt;
    }
    status_ = tracker_.run_to_steady(limits_);
    if (status_ != Status::ok && status_ != Status::steady) return std::nullopt;
    return tracked_timeline(tracker_, scene_, setup_.stack);
  }
  [[nodiscard]] std::vector<FrontSegment<double>> fronts() override {
    if constexpr (Observer::kActive) {
      tracker_.close_record();
      return tracker_.observer().segments();
    } else {
      return {};
    }
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message =
        refused_.empty() ? message_of(status_, tracker_.n_collisions(), tracker_.n_unreachable()) : refused_;
    summary.collisions = tracker_.n_collisions();
    summary.fronts_max = tracker_.n_fronts_max();
    summary.levels = setup_.grid.n_levels();
    summary.layers = setup_.stack.n_layers();
    return summary;
  }

 private:
  const Scene<double>& scene_;
  Reconstruction reconstruct_;
  RunLimits limits_;
  TrackingSetup<double, Grid> setup_;
  Tracker<Grid, Observer> tracker_;
  Status status_ = Status::ok;
  std::string refused_;
  std::optional<ProfileField> field_;
};

template <class Grid>
std::unique_ptr<Run> start_on(const Scene<double>& scene, const FrontTrackingSolver::Options& options,
                              const Watch& watch, LayerStack<double> stack) {
  if (watch.fronts)
    return std::make_unique<TrackRun<Grid, SegmentRecord<double>>>(scene, options, watch, std::move(stack));
  return std::make_unique<TrackRun<Grid, NoObserver>>(scene, options, watch, std::move(stack));
}

}  // namespace

std::string FrontTrackingSolver::refusal(const Scene<double>& scene, const Options& options) {
  if (options.grid == GridKind::levels && !(options.resolution > 0 && options.resolution <= 1))
    return "resolution = " + number_text(options.resolution) + "; must be > 0 and <= 1";
  if (!(options.resolution > 0)) return "resolution = " + number_text(options.resolution) + "; must be > 0";
  if (scene.has_diffusion()) return "there are no fronts where grains diffuse";
  return refusal_of(scene, layers_of(scene, options), options);
}

void FrontTrackingSolver::prefer_smooth(const Scene<double>& scene, Options& options) {
  Options smooth = options;
  smooth.reconstruct = Reconstruction::linear;
  if (refusal(scene, smooth).empty()) options = smooth;
}

std::unique_ptr<Run> FrontTrackingSolver::start(const Scene<double>& scene, const Options& options,
                                                const Watch& watch) {
  LayerStack<double> stack = layers_of(scene, options);
  return LevelGrid<double>::refusal(stack).empty()
             ? start_on<LevelGrid<double>>(scene, options, watch, std::move(stack))
             : start_on<UnimodalGrid<double>>(scene, options, watch, std::move(stack));
}

}  // namespace shearfront
