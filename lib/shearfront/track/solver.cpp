// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/solver.hpp"

#include <memory>
#include <optional>

#include "shearfront/track/curved_scene.hpp"

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

std::unique_ptr<Run> FrontTrackingSolver::start(const Scene<double>& scene, const Options& options,
                                                const Watch& watch) {
  Options watching = options;
  watching.fronts = watch.fronts;
  return std::make_unique<TrackRun>(scene, watching, watch.progress);
}

}  // namespace shearfront
