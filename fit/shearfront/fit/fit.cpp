// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/fit.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/report.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/fit/shock_rows.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::VectorXd;

/// Residuals at rounding level say nothing about noise: no scale is taken from them.
constexpr double kRounding = 1e-11;
constexpr int kMostRenewals = 6;
/// The scale of a robust loss need not be better known than this.
constexpr double kScaleTolerance = 0.05;

double median_noise(const VectorXd& residuals) {
  std::vector<double> sizes(residuals.begin(), residuals.end());
  for (double& r : sizes) r = std::abs(r);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;  // of a Gaussian
}

ResidualRows rows_of(std::string_view quantity, const FitSpec& spec) {
  ResidualRows rows;
  std::string refusal;
  if (!MisfitList::contains(quantity))
    throw InputError("misfit.quantity", quoted_text(quantity), "must be one of: " + MisfitList::names());
  MisfitList::for_each([&]<class M>() {
    if (quantity != M::kName) return;
    refusal = M::refusal(spec.observations);
    if (refusal.empty()) rows = M::rows(spec.observations, spec.scene.bottom(), spec.scene.top());
  });
  if (!refusal.empty()) throw InputError("misfit.quantity", quoted_text(quantity), refusal);
  return rows;
}

/// One fit from start to minimum; the report is made elsewhere.
class Run {
 public:
  Run(const FitSpec& spec, const Progress& progress)
      : spec_(spec),
        parameters_(spec.scene, spec.unknown),
        coordinates_(parameters_),
        control_(spec.search.max_evaluations, progress),
        quantity_(quantity_of(spec)),
        loss_name_(loss_of(spec)),
        loss_(find_loss(loss_name_, spec.misfit.loss_scale.value_or(0))) {
    const auto names = algorithm_names();
    if (std::find(names.begin(), names.end(), spec.search.algorithm) == names.end())
      (void)nearest_algorithm();
  }

  Estimate operator()() {
    const auto begin = std::chrono::steady_clock::now();
    ResidualRows all = rows_of(quantity_, spec_);
    VectorXd u = coordinates_.coordinates(parameters_.start());
    std::unique_ptr<Objective> objective;
    SearchResult result;
    std::size_t iterations = 0, left_out = 0;
    if (is_two_stage()) {
      Objective sums(parameters_, coordinates_, spec_.forward, rows_of(CumulativeMisfit::kName, spec_),
                     find_loss(SquaredLoss::kName, 0), control_);
      SearchSpec near = spec_.search;
      near.tolerance = std::max(near.tolerance, 1e-6);  // sums of points are not exact anyway
      result = search(sums, u, near);
      iterations += result.iterations;
      u = result.u;
      std::vector<bool> keep;
      for (int round = 0; round < kMostRenewals && !control_.must_stop(); ++round) {
        std::vector<bool> now =
            rows_without_jumps(parameters_, spec_.forward, spec_.observations, coordinates_.values(u));
        if (now == keep) break;
        keep = std::move(now);
        objective = make_objective(all.selected(keep));
        result = minimise(*objective, u, round == 0 ? SearchSpec(spec_.search) : local());
        iterations += result.iterations;
        u = result.u;
      }
      left_out = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), false));
    }
    if (!objective) {
      objective = make_objective(std::move(all));
      result = minimise(*objective, u, spec_.search);
      iterations += result.iterations;
    }
    Estimate estimate = report(spec_, parameters_, *objective, result);
    estimate.iterations = iterations;
    estimate.left_out = left_out;
    estimate.quantity = quantity_;
    estimate.loss = loss_name_;
    estimate.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return estimate;
  }

 private:
  [[noreturn]] void nearest_algorithm() const {
    std::string all;
    for (const std::string& name : algorithm_names()) all += (all.empty() ? "" : ", ") + name;
    throw InputError("search.algorithm", quoted_text(spec_.search.algorithm), "must be one of: " + all);
  }
  [[nodiscard]] bool is_two_stage() const {
    return quantity_ == PointMisfit::kName && CumulativeMisfit::refusal(spec_.observations).empty() &&
           spec_.misfit.two_stage.value_or(uses_derivatives(spec_.search.algorithm));
  }
  [[nodiscard]] std::unique_ptr<Objective> make_objective(ResidualRows rows) {
    control_.new_stage();
    return std::make_unique<Objective>(parameters_, coordinates_, spec_.forward, std::move(rows), loss_,
                                       control_);
  }
  [[nodiscard]] SearchSpec local() const {
    SearchSpec local = spec_.search;
    if (local.algorithm == "global") local.algorithm = "ceres";
    local.starts = 1;
    return local;
  }

  /// A robust loss needs the noise to know what is gross: if the data do not give it, it is taken from the
  /// residuals and renewed until it stays.
  [[nodiscard]] SearchResult minimise(Objective& objective, const VectorXd& start, const SearchSpec& how) {
    if (!loss_.is_robust || spec_.observations.has_sigma()) return search(objective, start, how);
    SearchResult result;
    VectorXd u = start;
    double noise = 0;
    std::size_t iterations = 0;
    for (int round = 0; round < kMostRenewals; ++round) {
      const Objective::Evaluation& at = objective.evaluate(u, false);
      const double now = at.is_valid ? std::max(median_noise(at.residuals), kRounding) : 1;
      if (round > 0 && (now <= kRounding || std::abs(now - noise) <= kScaleTolerance * noise)) break;
      noise = now;
      Loss loss = loss_;
      loss.scale *= noise;
      objective.set_loss(loss);
      control_.new_stage();
      result = search(objective, u, round == 0 ? how : local());
      iterations += result.iterations;
      u = result.u;
      if (control_.must_stop()) break;
    }
    result.iterations = iterations;
    return result;
  }

  const FitSpec& spec_;
  Parameters parameters_;
  Coordinates coordinates_;
  RunControl control_;
  std::string quantity_, loss_name_;
  Loss loss_;
};

}  // namespace

std::string_view quantity_of(const FitSpec& spec) {
  if (spec.misfit.quantity.empty()) return name_of(spec.observations.quantity);
  return spec.misfit.quantity;
}

std::string_view loss_of(const FitSpec& spec) {
  if (!spec.misfit.loss.empty()) return spec.misfit.loss;
  return quantity_of(spec) == PointMisfit::kName ? HuberLoss::kName : SquaredLoss::kName;
}

Estimate fit(const FitSpec& spec, const Progress& progress) { return Run(spec, progress)(); }

}  // namespace shearfront::fit
