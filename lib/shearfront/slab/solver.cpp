// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/slab/solver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "shearfront/slab/slab_march.hpp"
#include "shearfront/solution/share_integral.hpp"

namespace shearfront {
namespace {

slab::Settings settings_of(const SlabSolver::Options& options, const Scene<double>& scene) {
  slab::Settings settings;
  settings.cells = static_cast<std::size_t>(options.cells);
  settings.cells_x = static_cast<std::size_t>(options.cells_x);
  settings.threads = static_cast<std::size_t>(options.threads);
  settings.time_step = options.time_step;
  if (options.cells_x > 0) return settings;
  const double wanted =
      static_cast<double>(options.cells) * scene.spec().slab->length / (scene.top() - scene.bottom());
  constexpr double kFewest = 3, kMost = 1e4;
  settings.cells_x = static_cast<std::size_t>(std::clamp(std::round(wanted), kFewest, kMost));
  return settings;
}

class MarchedField final : public Field, public SlabField {
 public:
  MarchedField(const Scene<double>& scene, const slab::SlabMarch& march)
      : scene_(scene), march_(march), mean_(march.mean_profile()) {}

  [[nodiscard]] Sample at(double z) const override {
    const auto value = mean_.at(z);
    return {value.phi, value.M};
  }
  [[nodiscard]] double integral(const ShareFunction& g) const override {
    double sum = 0;
    for (std::size_t i = 0; i < march_.n_x(); ++i) sum += share_integral(scene_, march_.profile(i), g);
    return sum / static_cast<double>(march_.n_x());
  }
  [[nodiscard]] std::optional<Profile<double>> profile() const override { return mean_; }
  [[nodiscard]] const SlabField* slab() const override { return this; }
  [[nodiscard]] std::vector<double> middles() const override {
    std::vector<double> x;
    for (std::size_t i = 0; i < march_.n_x(); ++i)
      x.push_back((static_cast<double>(i) + 0.5) * march_.width_x());
    return x;
  }
  [[nodiscard]] std::vector<double> section(const std::vector<double>& x,
                                            const std::vector<double>& z) const override {
    const auto n = static_cast<double>(march_.n_x());
    std::vector<std::vector<Profile<double>::Value>> columns(march_.n_x());
    const auto column = [&](double i) -> const std::vector<Profile<double>::Value>& {
      const auto index = static_cast<std::size_t>(i < 0 ? i + n : i < n ? i : i - n);
      if (columns[index].empty()) columns[index] = march_.profile(index).at(z);
      return columns[index];
    };
    std::vector<double> phi;
    phi.reserve(x.size() * z.size());
    for (const double place : x) {
      const double cell = place / march_.width_x() - 0.5, i = std::floor(cell), part = cell - i;
      const auto &left = column(i), &right = part > 0 ? column(i + 1) : left;
      for (std::size_t j = 0; j < z.size(); ++j)
        phi.push_back(left[j].phi + part * (right[j].phi - left[j].phi));
    }
    return phi;
  }

 private:
  const Scene<double>& scene_;
  const slab::SlabMarch& march_;
  Profile<double> mean_;
};

class SlabRun final : public Run {
 public:
  SlabRun(const Scene<double>& scene, const SlabSolver::Options& options, const Watch& watch)
      : scene_(scene), progress_(watch.progress), march_(scene, settings_of(options, scene)) {}

  Status advance(double t) override {
    field_.reset();
    if (!std::isfinite(t)) {
      message_ =
          "a slab is solved up to finite times only: at rest it no longer depends on x, and is the bed "
          "without the table slab";
      return status_ = Status::unsupported;
    }
    constexpr double kMostUpdates = 1e13;  // a day
    const double cells = static_cast<double>(march_.n_x() * march_.n_z());
    if (!((t - march_.time()) / march_.longest_step() * cells <= kMostUpdates)) {
      message_ = "more than 1e+13 cell updates are needed; use fewer cells";
      return status_ = Status::budget_reached;
    }
    status_ = march_.advance_to(t, progress_);
    message_ = status_ == Status::ok ? "reached the last time, " + std::to_string(march_.n_steps()) + " steps"
               : status_ == Status::interrupted ? "stopped by the caller"
                                                : "the iteration of a column does not converge";
    return status_;
  }
  [[nodiscard]] const Field& field() override {
    if (!field_) field_.emplace(scene_, march_);
    return *field_;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message = message_;
    summary.cell_updates = march_.n_cell_updates();
    return summary;
  }

 private:
  const Scene<double>& scene_;
  Progress progress_;
  slab::SlabMarch march_;
  std::optional<MarchedField> field_;
  Status status_ = Status::ok;
  std::string message_;
};

}  // namespace

std::string SlabSolver::refusal(const Scene<double>& scene, const Options& options) {
  if (!scene.is_slab()) return "it solves scenes with a table slab only";
  if (scene.spec().solid_fraction) return "a solid fraction in a slab is not covered";
  if (!scene.has_walls()) return "a slab has walls at its bottom and top";
  return slab::column_refusal(scene, static_cast<std::size_t>(options.cells));
}

std::unique_ptr<Run> SlabSolver::start(const Scene<double>& scene, const Options& options,
                                       const Watch& watch) {
  return std::make_unique<SlabRun>(scene, options, watch);
}

}  // namespace shearfront
