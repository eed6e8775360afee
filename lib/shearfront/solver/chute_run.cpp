// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solver/chute_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/solver/chute_volume.hpp"

namespace shearfront {
namespace {

/// Pieces of a front that crosses the whole bed: what bends by a quarter is then off by less than 1e-4 of the height.
constexpr double kPiecesOfFront = 64;

class ChuteField final : public Field {
 public:
  ChuteField(const SteadyChute<double>& chute, const Field& bed) : chute_(chute), bed_(bed) {}

  [[nodiscard]] Sample at(double z) const override { return passing(bed_.at(chute_.bed_height(z))); }
  [[nodiscard]] std::vector<Sample> at(const std::vector<double>& heights) const override {
    std::vector<Sample> samples = bed_.at(chute_.bed_heights(heights));
    for (Sample& sample : samples) sample = passing(sample);
    return samples;
  }
  [[nodiscard]] std::vector<double> volumes(const std::vector<double>& heights) const override {
    return chute_volumes(chute_, bed_, heights);
  }
  [[nodiscard]] double integral(const ShareFunction& g) const override {
    return chute_.mean_velocity() * bed_.integral(g);
  }
  [[nodiscard]] std::optional<Profile<double>> profile() const override {
    const std::optional<Profile<double>> inner = bed_.profile();
    if (!inner) return inner;
    std::vector<double> z;
    z.reserve(inner->z().size());
    for (const double zeta : inner->z()) z.push_back(chute_.height(zeta));
    return Profile<double>(std::move(z), inner->below(), inner->above());
  }

 private:
  [[nodiscard]] Sample passing(const Sample& sample) const {
    return {sample.phi, chute_.mean_velocity() * sample.M};
  }
  const SteadyChute<double>& chute_;
  const Field& bed_;
};

class ChuteRun final : public Run {
 public:
  ChuteRun(const Scene<double>& scene, const std::function<std::unique_ptr<Run>(const Scene<double>&)>& start)
      : chute_(scene), run_(start(chute_.bed())) {}

  Status advance(double x) override {
    field_.reset();
    return run_->advance(x);
  }
  [[nodiscard]] const Field& field() override {
    if (!field_) field_.emplace(chute_, run_->field());
    return *field_;
  }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override {
    std::optional<Timeline<double>> all = run_->timeline();
    if (!all) return all;
    all->mass *= chute_.mean_velocity();
    all->steady_height = chute_.height(all->steady_height);
    for (auto& at : all->interfaces) at.z = chute_.height(at.z);
    return all;
  }
  [[nodiscard]] std::vector<FrontSegment<double>> fronts() override {
    const double height = chute_.bed().top() - chute_.bed().bottom();
    std::vector<FrontSegment<double>> bent;
    for (const FrontSegment<double>& front : run_->fronts()) {
      const double rise = front.z_end - front.z_begin, span = front.t_end - front.t_begin;
      const double n = std::isfinite(span) ? std::ceil(kPiecesOfFront * std::abs(rise) / height) : 1;
      FrontSegment<double> piece = front;
      piece.z_begin = chute_.height(front.z_begin);
      for (double k = 1; k < n; ++k) {
        piece.t_end = front.t_begin + span * (k / n);
        piece.z_end = chute_.height(front.z_begin + rise * (k / n));
        bent.push_back(piece);
        piece.t_begin = piece.t_end, piece.z_begin = piece.z_end;
      }
      piece.t_end = front.t_end, piece.z_end = chute_.height(front.z_end);
      bent.push_back(piece);
    }
    return bent;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary = run_->summary();
    if (chute_.is_sampled() && summary.remark.empty())
      summary.remark =
          "what varies with height stands as a table over the stream function: off by about 1e-6 of its "
          "curvature";
    return summary;
  }

 private:
  SteadyChute<double> chute_;
  std::unique_ptr<Run> run_;
  std::optional<ChuteField> field_;
};

}  // namespace

std::unique_ptr<Run> start_chute(const Scene<double>& scene,
                                 const std::function<std::unique_ptr<Run>(const Scene<double>& bed)>& start) {
  return std::make_unique<ChuteRun>(scene, start);
}

}  // namespace shearfront
