// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/solver.hpp"

#include <memory>
#include <optional>
#include <string>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/track/curved_scene.hpp"
#include "shearfront/track/curved_tracking.hpp"
#include "shearfront/track/gradient.hpp"
#include "shearfront/track/linearise.hpp"

namespace shearfront {
namespace {

class TrackRun final : public Run {
 public:
  TrackRun(const Scene<double>& scene, const TrackOptions& options, const Progress& progress)
      : scene_(scene), tracking_(scene, options, progress) {}

  Status advance(double t) override {
    field_.reset();
    return tracking_.advance(t);
  }
  [[nodiscard]] const Field& field() override {
    if (!field_) field_ = tracking_.field(scene_);
    return *field_;
  }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override { return tracking_.timeline(); }
  [[nodiscard]] std::vector<FrontSegment<double>> fronts() override { return tracking_.fronts(); }
  [[nodiscard]] Summary summary() const override { return tracking_.summary(); }

 private:
  const Scene<double>& scene_;
  Tracking tracking_;
  std::unique_ptr<Field> field_;
};

}  // namespace

double FrontTrackingSolver::order_M(const Scene<double>& scene) {
  return scene.is_layered() || has_curved_fronts(scene) ? guarantees().order_M : guarantees().least_order_M;
}

void FrontTrackingSolver::prefer_smooth(const Scene<double>& scene, Options& options) {
  Options smooth = options;
  smooth.reconstruct = Reconstruction::linear;
  if (refusal(scene, smooth).empty()) options = smooth;
}

std::string FrontTrackingSolver::forewarning(const Scene<double>& scene, const Options& options) {
  constexpr double kMany = 1e8;
  // Few layers need no count: each front crosses each of them in no time.
  constexpr std::size_t kFewLayers = 100;
  const bool has_stairs = !scene.is_layered() && !track_detail::wants_curves(scene, options);
  if (!has_stairs && scene.knots().size() < kFewLayers) return {};
  if (!refusal(scene, options).empty()) return {};
  const Summary at_start = Tracking(scene, options).summary();
  if (at_start.fronts_max > options.max_fronts) return {};  // does not begin
  const double n = static_cast<double>(at_start.fronts_max) * static_cast<double>(at_start.layers);
  if (n < kMany) return {};
  return "up to " + number_text(n, 2) + " collisions, if each of " + std::to_string(at_start.fronts_max) +
         " fronts crosses each of " + std::to_string(at_start.layers) +
         " layers, at a minute or less per 1e8; a coarser resolution has fewer";
}

std::unique_ptr<Run> FrontTrackingSolver::start(const Scene<double>& scene, const Options& options,
                                                const Watch& watch) {
  Options watching = options;
  watching.fronts = watch.fronts;
  return std::make_unique<TrackRun>(scene, watching, watch.progress);
}

std::string FrontTrackingSolver::derivative_refusal(const Scene<double>& scene, const Options& options,
                                                    const Entry& entry) {
  return tracking_derivative_refusal(scene, options, entry);
}

Linearisation FrontTrackingSolver::linearise(const Scene<double>& scene, const Options& options,
                                             const std::vector<Place>& places,
                                             const std::vector<std::size_t>& wanted, std::any& /*memory*/,
                                             const Progress& progress) {
  return linearise_tracking(scene, options, places, wanted, progress);
}

LinearSum FrontTrackingSolver::linearise_sum(const Scene<double>& scene, const Options& options,
                                             const std::vector<Place>& places, const SumWeights& weights,
                                             const std::vector<std::size_t>& wanted,
                                             const Progress& progress) {
  return tracking_gradient(scene, options, places, weights, wanted, progress);
}

}  // namespace shearfront
