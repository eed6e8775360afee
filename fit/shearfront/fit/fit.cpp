// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "shearfront/fit/bootstrap.hpp"
#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/flat.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/noise.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/profile_likelihood.hpp"
#include "shearfront/fit/report.hpp"
#include "shearfront/fit/resolution_shift.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/fit/search/starts.hpp"
#include "shearfront/fit/shock_rows.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::VectorXd;

/// Residuals at rounding level, in the unit of the rows, say nothing about noise: no scale is taken from them.
constexpr double kRounding = 1e-11;
/// Every row agrees, in the unit of the rows: no jump is on the wrong side of an observation.
constexpr double kExact = 1e-9;
constexpr int kMostRenewals = 6;
/// Relative tolerance of the first stages: only a start for the last one.
constexpr double kNear = 1e-2;
/// The same while rows and noise of the last stage are not settled.
constexpr double kRoughTolerance = 1e-4;
/// Bins taken together at first.
constexpr std::size_t kWidestBin = 32;
/// Further starts lie within this factor of the first: bounds are often far wider.
constexpr double kWidestStart = 20;
/// Scale of the loss, in widths of the range of phi, of the stage with means of phi: jumps are larger, noise is mostly smaller.
constexpr double kForgiven = 0.1;
/// The noise is taken from the residuals that often: what it is taken from again and again shrinks, for a
/// robust fit goes through some of the data.
constexpr int kMostScales = 3;
/// The scale of a robust loss need not be better known than this.
constexpr double kScaleTolerance = 0.05;
/// Halvings of the resolution, each four times the work; and none for data that are more exact than the model: half
/// of their residuals, or more, is its error.
constexpr int kMostRefinements = 4;
constexpr double kMostShare = 0.5;

/// The noise of the rows that depend on an unknown; the others (beds at rest, all of one kind) may fit
/// exactly and say nothing.
double median_noise(const Objective::Evaluation& at) {
  const std::vector<bool> depends = dependent_rows(at.jacobian);
  std::vector<double> residuals;
  for (std::size_t i = 0; i < depends.size(); ++i)
    if (depends[i]) residuals.push_back(at.residuals[static_cast<Eigen::Index>(i)]);
  return median_deviation(std::move(residuals));
}

/// Rows in units of sigma, or of the data whatever they are compared as: weights take sigma = 1 of theirs.
ResidualRows with_unit(ResidualRows rows, const FitSpec& spec, const Parameters& parameters) {
  const Quantity measured = spec.observations.quantity;
  const bool is_height = measured == Quantity::bed_height, is_sum = measured == Quantity::cumulative;
  if (!spec.observations.has_sigma())
    rows.unit = (is_height || is_sum ? parameters.height() : 1) * (is_height ? 1 : parameters.states());
  return rows;
}

ResidualRows rows_of(std::string_view quantity, const FitSpec& spec, const Parameters& parameters) {
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
  return with_unit(std::move(rows), spec, parameters);
}

/// Residuals beside `size`, which has their unit.
void set_size(ResidualRows& rows, double size) {
  for (ResidualRows::Row& row : rows.rows) row.weight = 1 / size;
  rows.unit = 1;
}

/// Mean distance of neighbouring heights of one time.
double mean_spacing(const Observations& observations) {
  double sum = 0;
  std::size_t n = 0;
  for (const MeasuredProfile& profile : measured_profiles(observations)) {
    sum += observations.rows[profile.rows.back()].z - observations.rows[profile.rows.front()].z;
    n += profile.rows.size() - 1;
  }
  return n > 0 ? sum / static_cast<double>(n) : 1;
}

/// With a shape the coordinates are steps between the values, whose profiles say nothing about a single value.
void check_uncertainty(const FitSpec& spec) {
  if (spec.uncertainty.profile && spec.unknown.shape != Shape::none)
    throw InputError("uncertainty.profile", "true",
                     "must be false with unknown.shape; use uncertainty.bootstrap");
}

/// Adds the intervals that [uncertainty] asks for, and their warnings.
void add_uncertainty(const FitSpec& spec, const Parameters& parameters, const Objective& objective,
                     const Refit& refit, const Progress& progress, Estimate& estimate) {
  if (!estimate.usable() || estimate.status == Status::interrupted) return;
  const auto warn = [&](const std::vector<std::string>& texts) {
    estimate.warnings.insert(estimate.warnings.end(), texts.begin(), texts.end());
  };
  if (spec.uncertainty.profile) {
    const Profiles profiles = profile_intervals(spec, parameters, objective, estimate, progress);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      estimate.parameters[i].profile95 = profiles.intervals[i];
    warn(profiles.warnings);
  }
  if (spec.uncertainty.bootstrap > 0) {
    const Bootstrap replicates = bootstrap(spec, parameters, estimate, refit, progress);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      estimate.parameters[i].bootstrap95 = replicates.intervals[i];
    warn(replicates.warnings);
  }
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
        loss_(find_loss(loss_name_, spec.misfit.loss_scale.value_or(0))),
        rows_(rows_of(quantity_, spec, parameters_)),
        progress_(progress) {
    check_uncertainty(spec);
    const auto names = algorithm_names();
    if (std::find(names.begin(), names.end(), spec.search.algorithm) == names.end())
      throw unknown_algorithm(spec.search.algorithm);
  }

  Estimate operator()() {
    const auto begin = std::chrono::steady_clock::now();
    find();
    Estimate estimate = report(spec_, parameters_, *objective_, result_);
    refine(estimate);
    estimate.iterations = iterations_;
    estimate.left_out = left_out_;
    estimate.quantity = quantity_;
    estimate.loss = loss_name_;
    const Refit refit = [](const FitSpec& spec) { return Run(spec, {}).values(); };
    add_uncertainty(spec_, parameters_, *objective_, refit, progress_, estimate);
    estimate.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return estimate;
  }

 private:
  /// Goes on with a finer model while its resolution shifts the estimates by more than noise makes worth while; says
  /// so, and what shift is left.
  void refine(Estimate& estimate) {
    std::string before;
    double largest = 0;  // at first
    for (int round = 0; estimate.usable() && estimate.status == Status::ok; ++round) {
      const auto fine = finer(spec_.forward.method);
      const auto found =
          fine ? resolution_shift(*objective_, fine->method, result_.u, estimate) : std::nullopt;
      if (!found) break;
      Eigen::Index worst = 0;
      const double shift = found->shift.cwiseAbs().maxCoeff(&worst);
      if (round == 0)
        before = fmt::format("{} = {}", fine->option, number_text(fine->before)), largest = shift;
      const std::string now = fmt::format("{} = {}", fine->option, number_text(fine->before));
      // Of data that are more exact than the model the errors are the model's own, unless they are given.
      const bool has_own_noise = estimate.sigma_is_given || found->share < kMostShare;
      // Half the resolution of fronts is four times the work for a quarter of the error; twice the cells for half of it.
      const bool may_refine = round < kMostRefinements && fine->now < fine->before && has_own_noise;
      if (shift > kMostShift && may_refine && !control_.must_stop()) {
        spec_.forward.method = fine->method;
        settle(has_stages_ && has_jumps());
        estimate = report(spec_, parameters_, *objective_, result_);
        continue;
      }
      if (shift > kMostShift && has_own_noise)
        estimate.warnings.push_back(fmt::format(
            "{} at {} shifts {} by about {} of its standard errors, which they do not contain: choose a "
            "finer one",
            spec_.forward.method.name(), now, estimate.parameters[static_cast<std::size_t>(worst)].name,
            number_text(shift, 2)));
      if (round > 0)
        estimate.warnings.push_back(fmt::format(
            "{} shifts the estimates by up to {} of their standard errors: they are those with {}", before,
            number_text(largest, 2), now));
      return;
    }
  }

  void find() {
    const VectorXd start = coordinates_.coordinates(parameters_.start());
    has_stages_ = spec_.misfit.two_stage.value_or(uses_derivatives(spec_.search.algorithm)) &&
                  quantity_ != CumulativeMisfit::kName && quantity_ != BedHeightMisfit::kName;
    if (has_stages_ && spec_.search.starts > 1 && spec_.search.algorithm != "global")
      find_from_many(start);
    else
      find_from(start);
    // Which points a shock is near depends on the estimate, and so does the misfit of the others.
    for (Eigen::Index round = 0; round < start.size() && result_.status == Status::ok && !has_jumps();
         ++round) {
      const auto beyond = beyond_flat(*objective_, u_);
      if (!beyond) break;
      const SearchResult before = result_;
      find_from(*beyond);
      if (result_.misfit <= before.misfit) continue;
      result_ = before;
      u_ = before.u;
      break;
    }
  }

  void find_from(const VectorXd& start) {
    start_ = u_ = start;
    has_searched_ = false;
    noise_ = 0;
    n_scales_ = 0;
    if (has_stages_) approach();
    settle(has_stages_ && has_jumps());
  }

  /// Every start goes through all stages: what is best in an early one need not be in the last.
  void find_from_many(const VectorXd& start) {
    StartPoints points(coordinates_, start, spec_.search.seed, kWidestStart);
    VectorXd best = start;
    double least = std::numeric_limits<double>::infinity();
    std::size_t best_start = 0;
    const std::size_t n = spec_.search.starts;
    for (std::size_t k = 0; k < n && !control_.must_stop() && least > 0; ++k) {
      share_ = std::max<std::size_t>(1, control_.left() / (n + 1 - k));
      find_from(k == 0 ? start : points.next());
      const double score = forgiving_misfit();
      if (!(score < least)) continue;
      least = score;
      best = u_;
      best_start = k;
    }
    share_ = control_.left();
    u_ = best;
    noise_ = 0;  // of the last start, not of the best
    n_scales_ = 0;
    settle(has_jumps());
    result_.message = "best of " + std::to_string(n) + " starts (number " + std::to_string(best_start) +
                      "): " + result_.message;
  }

  [[nodiscard]] bool has_diffusion() const { return parameters_.start_scene().has_diffusion(); }
  /// Whether a jump of phi can be near an observation: with diffusion phi is continuous.
  [[nodiscard]] bool has_jumps() const { return quantity_ == PointMisfit::kName && !has_diffusion(); }

  /// Compares estimates whose last stages left out other rows or took another noise: all rows, with a loss of
  /// fixed scale.
  [[nodiscard]] double forgiving_misfit() {
    if (!loss_.is_robust && !left_out_) return objective_->evaluate(u_, false).misfit;
    ResidualRows rows = rows_;
    set_size(rows, parameters_.states());
    return make_objective(std::move(rows), find_loss(CauchyLoss::kName, kForgiven))
        ->evaluate(u_, false)
        .misfit;
  }

  /// Nothing but the values found; nothing if the search did not end at a minimum.
  [[nodiscard]] std::optional<VectorXd> values() {
    find();
    if (result_.status != Status::ok || !std::isfinite(result_.misfit)) return {};
    return coordinates_.values(result_.u);
  }

  [[nodiscard]] std::unique_ptr<Objective> make_objective(ResidualRows rows, const Loss& loss) {
    control_.new_stage();
    return std::make_unique<Objective>(parameters_, coordinates_, spec_.forward, std::move(rows), loss,
                                       control_);
  }

  /// The search asked for the first time, afterwards only its local part from where it ended.
  void search_from_here(Objective& objective, double tolerance) {
    SearchSpec how = spec_.search;
    how.tolerance = std::max(how.tolerance, tolerance);
    if (has_searched_ && how.algorithm == "global") how.algorithm = "ceres";
    if (has_searched_ || has_stages_) how.starts = how.algorithm == "global" ? how.starts : 1;
    has_searched_ = true;
    how.max_evaluations = std::min(share_, control_.left());
    if (tolerance > 0) how.max_evaluations /= 3;  // the last stage needs the most
    result_ = search(objective, u_, how);
    iterations_ += result_.iterations;
    u_ = result_.u;
  }

  /// Comes near the minimum through misfits that vary more smoothly with the parameters than the one asked
  /// for.
  void approach() {
    if (!CumulativeMisfit::refusal(spec_.observations).empty()) return;
    const bool is_point = spec_.observations.quantity == Quantity::point;
    {
      ResidualRows sums = rows_of(CumulativeMisfit::kName, spec_, parameters_);
      // Sums of points are wrong by about the spacing at every shock, whatever the noise.
      if (is_point) set_size(sums, mean_spacing(spec_.observations) * parameters_.states());
      const auto first = make_objective(std::move(sums), find_loss(SquaredLoss::kName, 0));
      if (is_point) first->set_tether(u_, 1);
      search_from_here(*first, kNear);
    }
    if (spec_.observations.quantity == Quantity::bin) narrow_bins();
    if (!is_point || control_.must_stop()) return;
    // Wrong in the cells of a shock only, where the loss forgives it.
    ResidualRows means = rows_of(BinMisfit::kName, spec_, parameters_);
    set_size(means, parameters_.states());
    // The bias of the sums may have put their smallest minimum into another valley.
    if (spec_.search.algorithm == "global") has_searched_ = false;
    search_from_here(*make_objective(std::move(means), find_loss(CauchyLoss::kName, kForgiven)), kNear);
  }

  /// Means over fewer and fewer bins at once. The misfit has a kink wherever a shock enters a bin, and so
  /// many local minima; each width locates the shocks within the valley of the next.
  void narrow_bins() {
    std::size_t most = 0;
    for (const MeasuredProfile& profile : measured_profiles(spec_.observations))
      most = std::max(most, profile.rows.size());
    for (std::size_t n = std::min<std::size_t>(kWidestBin, most / 2); n > 1 && !control_.must_stop(); n /= 2)
      search_from_here(
          *make_objective(
              with_unit(BinMisfit::wide_rows(spec_.observations, spec_.scene.bottom(), spec_.scene.top(), n),
                        spec_, parameters_),
              find_loss(SquaredLoss::kName, 0)),
          kNear);
  }

  /// The misfit asked for. What it depends on besides the parameters, the rows without a jump and the noise
  /// that tells a robust loss what is gross, is taken from the estimate and renewed, with searches as rough
  /// as that, until it stays; the last search is fine.
  void settle(bool leaves_out_jumps) {
    std::vector<bool> keep(leaves_out_jumps ? 0 : rows_.rows.size(), true);
    if (!leaves_out_jumps) objective_ = make_objective(rows_, loss_);
    // Noise of sums may lead the stages to rates that no grid resolves; with diffusion there is often but one
    // valley, and the start in it.
    if (has_stages_ && has_diffusion() &&
        objective_->inspect(start_, false).misfit < objective_->evaluate(u_, false).misfit)
      u_ = start_;
    for (int round = 0; round <= kMostRenewals; ++round) {
      bool is_settled = !(leaves_out_jumps && renew_rows(keep));
      is_settled = !renew_scale() && is_settled;
      const Objective::Evaluation& at = objective_->evaluate(u_, false);
      const bool is_exact = at.is_valid && at.residuals.cwiseAbs().maxCoeff() <= kExact * rows_.unit;
      is_settled = is_settled || is_exact || round == kMostRenewals;
      search_from_here(*objective_, is_settled ? 0 : kRoughTolerance);
      if (is_settled || control_.must_stop()) break;
    }
    left_out_ = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), false));
  }

  /// Whether other rows than before have no jump near them.
  bool renew_rows(std::vector<bool>& keep) {
    std::vector<bool> now =
        rows_without_jumps(parameters_, spec_.forward, spec_.observations, coordinates_.values(u_));
    if (now == keep) return false;
    keep = std::move(now);
    objective_ = make_objective(rows_.selected(keep), loss_);
    if (noise_ > 0) objective_->set_loss(scaled_loss());
    return true;
  }

  /// Whether the noise is another than before; never for data that come with theirs.
  bool renew_scale() {
    if (!loss_.is_robust || spec_.observations.has_sigma() || n_scales_ == kMostScales) return false;
    const Objective::Evaluation& at = objective_->evaluate(u_, true);
    const double now = at.is_valid ? std::max(median_noise(at), kRounding * rows_.unit) : rows_.unit;
    if (n_scales_ > 0 && std::abs(now - noise_) <= kScaleTolerance * noise_) return false;
    noise_ = now;
    ++n_scales_;
    objective_->set_loss(scaled_loss());
    control_.new_stage();
    return true;
  }
  [[nodiscard]] Loss scaled_loss() const {
    Loss loss = loss_;
    loss.scale *= noise_;
    return loss;
  }

  FitSpec spec_;  ///< its forward model may become finer
  Parameters parameters_;
  Coordinates coordinates_;
  RunControl control_;
  std::string quantity_, loss_name_;
  Loss loss_;
  ResidualRows rows_;  ///< of the misfit asked for, made once
  Progress progress_;
  std::unique_ptr<Objective> objective_;
  Eigen::VectorXd u_, start_;
  SearchResult result_;
  bool has_stages_ = false, has_searched_ = false;
  std::size_t share_ = std::numeric_limits<std::size_t>::max();  ///< of the evaluations left, for one start
  std::size_t iterations_ = 0, left_out_ = 0;
  double noise_ = 0;  ///< of the residuals, for a robust loss
  int n_scales_ = 0;
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
