// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/staged_search.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/flat.hpp"
#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/noise.hpp"
#include "shearfront/fit/search/starts.hpp"
#include "shearfront/fit/shock_rows.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::VectorXd;

/// Residuals at rounding level, in the unit of the rows, say nothing about noise: no scale is taken from them.
constexpr double kRounding = 1e-11;
/// Every row agrees, in the unit of the rows: no jump is on the wrong side of an observation.
constexpr double kExact = 1e-9;
constexpr int kMostRenewals = 6;
/// So far from the start, a factor of 20 for a rate, an end may be a level place and no minimum.
constexpr double kFar = 3;
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

/// Refits with the correlation of the noise estimated anew; a few do, for most are nearly linear.
constexpr int kMostNoiseRounds = 20;
/// Further searches by the misfit of correlated noise.
constexpr int kNoiseStarts = 20;
/// It stands still when no length changes by more than this part.
constexpr double kNoiseStands = 1e-3;

/// The noise of the rows that depend on an unknown; the others (beds at rest, all of one kind) may fit
/// exactly and say nothing.
double median_noise(const Objective::Evaluation& at) {
  const std::vector<bool> depends = dependent_rows(at.jacobian);
  std::vector<double> residuals;
  for (std::size_t i = 0; i < depends.size(); ++i)
    if (depends[i]) residuals.push_back(at.residuals[static_cast<Eigen::Index>(i)]);
  return median_deviation(std::move(residuals));
}

}  // namespace

StagedSearch::StagedSearch(const FitSpec& spec, const Progress& progress)
    : spec_(spec),
      parameters_(spec.scene, spec.unknown),
      coordinates_(parameters_),
      control_(spec.search.max_evaluations, progress),
      quantity_(quantity_of(spec)),
      loss_name_(loss_of(spec)),
      loss_(find_loss(loss_name_, spec.misfit.loss_scale.value_or(0))),
      rows_(rows_of(quantity_, spec, parameters_)) {
  const auto names = algorithm_names();
  if (std::find(names.begin(), names.end(), spec.search.algorithm) == names.end())
    throw unknown_algorithm(spec.search.algorithm);
  if (spec.noise.model == NoiseModel::independent) return;
  if (const std::string refusal = noise_refusal(spec, rows_); !refusal.empty())
    throw InputError("noise.model", quoted_text(kNoiseModelNames[static_cast<std::size_t>(spec.noise.model)]),
                     refusal);
  places_ = noise_places(spec, rows_);
  if (auto given = given_noise(spec.noise, *places_)) whiten(std::move(*given));
}

void StagedSearch::go_on_with(const Method& method) {
  spec_.forward.method = method;
  settle(has_stages_ && has_jumps());
  settle_noise();
}

void StagedSearch::find() {
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
  leave_bounds(start);
  settle_noise();
}

std::optional<NoiseEstimate> StagedSearch::noise() const {
  if (!correlation_) return std::nullopt;
  return correlation_->estimate;
}

void StagedSearch::whiten(NoiseNumbers numbers) {
  rows_.noise = std::make_shared<NoiseCovariance>(places_, numbers.shape);
  correlation_ = std::move(numbers);
}

NoiseData StagedSearch::noise_data() const {
  const Objective::Evaluation at = objective_->inspect(u_, true);
  NoiseData data;
  if (!at.is_valid || !(at.residuals.norm() > at.rounding)) return data;
  data.places = places_;
  const Observations& observations = spec_.observations;
  data.sigma_is_given = observations.has_sigma();
  double low = observations.rows.front().value, high = low, sum = 0;
  for (const Observation& o : observations.rows) {
    low = std::min(low, o.value);
    high = std::max(high, o.value);
    sum += o.sigma;
  }
  if (data.sigma_is_given) data.mean_sigma = sum / static_cast<double>(observations.rows.size());
  if (high > low) data.range = high - low;
  std::vector<Eigen::Index> free;
  const std::vector<bool> held = coordinates_.at_bound(u_);
  for (Eigen::Index j = 0; j < u_.size(); ++j)
    if (!held[static_cast<std::size_t>(j)]) free.push_back(j);
  data.residuals = objective_->rows().coloured(at.residuals);
  const Eigen::MatrixXd jacobian = objective_->rows().coloured(at.jacobian);
  data.jacobian = jacobian(Eigen::seqN(0, jacobian.rows()), free);
  return data;
}

void StagedSearch::search_other_valleys(const NoiseData& data) {
  const std::vector<bool> held = coordinates_.at_bound(u_);  // not among the columns of the data's Jacobian
  search_from_here(*objective_, 0);
  if (!data.places || has_diffusion() || !uses_derivatives(spec_.search.algorithm)) return;
  const VectorXd from = u_;
  SearchResult best = result_;
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> jacobian(data.jacobian);
  const double sigma = data.residuals.norm() / std::sqrt(static_cast<double>(data.residuals.size()));
  boost::random::mt19937_64 engine(spec_.search.seed);
  boost::random::normal_distribution<double> normal;
  if (result_.status != Status::ok) return;
  for (int k = 0; k < kNoiseStarts && !control_.must_stop(); ++k) {
    VectorXd noise(data.residuals.size());
    for (double& x : noise) x = sigma * normal(engine);
    const VectorXd by = jacobian.solve(VectorXd(rows_.noise->coloured(noise)));
    u_ = from;
    for (Eigen::Index j = 0, i = 0; j < u_.size(); ++j)
      if (!held[static_cast<std::size_t>(j)]) u_[j] += by[i++];
    u_ = u_.cwiseMax(coordinates_.lower()).cwiseMin(coordinates_.upper());
    search_from_here(*objective_, 0);
    if (result_.status == Status::ok && result_.misfit < best.misfit) best = result_;
  }
  if (result_.status == Status::interrupted) return;
  result_ = best;
  u_ = best.u;
}

void StagedSearch::settle_noise() {
  if (!places_) return;
  if (given_noise(spec_.noise, *places_)) {
    if (result_.status == Status::ok) search_other_valleys(noise_data());
    return;
  }
  noise_warning_.clear();
  for (int round = 0; round < kMostNoiseRounds && result_.status == Status::ok && !control_.must_stop();
       ++round) {
    const NoiseData data = noise_data();
    auto now = data.places
                   ? estimated_noise(spec_.noise, data, correlation_ ? correlation_->place : VectorXd())
                   : std::nullopt;
    if (!now) {
      noise_warning_ = data.places ? "too few observations to estimate how their noise is correlated: error "
                                     "bars take it as independent"
                                   : "the residuals are rounding and say nothing about how noise is "
                                     "correlated: error bars take it as independent";
      return;
    }
    const bool is_first = !correlation_;
    const bool stands =
        correlation_ && (now->place - correlation_->place).cwiseAbs().maxCoeff() <= kNoiseStands;
    whiten(std::move(*now));
    objective_ = make_objective(rows_, loss_);
    is_first ? search_other_valleys(data) : search_from_here(*objective_, 0);
    if (stands) return;
  }
  if (result_.status == Status::ok)
    noise_warning_ =
        "the correlation of the noise does not stand still: give noise.length_z or noise.length_t";
}

void StagedSearch::leave_bounds(const VectorXd& start) {
  if (!uses_derivatives(spec_.search.algorithm) || spec_.unknown.shape != Shape::none || has_jumps()) return;
  const std::vector<bool> at_bound = coordinates_.at_bound(u_), starts_there = coordinates_.at_bound(start);
  const VectorXd end = u_;
  for (Eigen::Index j = 0; j < start.size() && result_.status == Status::ok && !control_.must_stop(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    if (starts_there[k] || !(at_bound[k] || std::abs(end[j] - start[j]) > kFar)) continue;
    const SearchResult before = result_;
    u_[j] = start[j];
    search_from_here(*objective_, 0);
    if (result_.status == Status::ok && result_.misfit < before.misfit) continue;
    result_ = before;
    u_ = before.u;
  }
}

void StagedSearch::find_from(const VectorXd& start) {
  start_ = u_ = start;
  has_searched_ = false;
  noise_ = 0;
  n_scales_ = 0;
  if (has_stages_) approach();
  settle(has_stages_ && has_jumps());
}

void StagedSearch::find_from_many(const VectorXd& start) {
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

bool StagedSearch::has_jumps() const { return quantity_ == PointMisfit::kName && !has_diffusion(); }

double StagedSearch::forgiving_misfit() {
  if (!loss_.is_robust && !left_out_) return objective_->evaluate(u_, false).misfit;
  ResidualRows rows = rows_;
  set_size(rows, parameters_.states());
  return make_objective(std::move(rows), find_loss(CauchyLoss::kName, kForgiven))->evaluate(u_, false).misfit;
}

std::optional<VectorXd> StagedSearch::values() const {
  if (result_.status != Status::ok || !std::isfinite(result_.misfit)) return {};
  return coordinates_.values(result_.u);
}

std::unique_ptr<Objective> StagedSearch::make_objective(ResidualRows rows, const Loss& loss) {
  control_.new_stage();
  return std::make_unique<Objective>(parameters_, coordinates_, spec_.forward, std::move(rows), loss,
                                     control_);
}

void StagedSearch::search_from_here(Objective& objective, double tolerance) {
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

void StagedSearch::approach() {
  if (!CumulativeMisfit::refusal(spec_.observations).empty()) return;
  // Sums of points are no M of a steady chute; those of bins are volumes.
  if (spec_.scene.is_chute() && spec_.observations.quantity != Quantity::bin) return;
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

void StagedSearch::narrow_bins() {
  std::size_t most = 0;
  for (const MeasuredProfile& profile : measured_profiles(spec_.observations))
    most = std::max(most, profile.rows.size());
  for (std::size_t n = std::min<std::size_t>(kWidestBin, most / 2); n > 1 && !control_.must_stop(); n /= 2)
    search_from_here(*make_objective(with_unit(BinMisfit::wide_rows(spec_.observations, spec_.scene.bottom(),
                                                                    spec_.scene.top(), n),
                                               spec_, parameters_),
                                     find_loss(SquaredLoss::kName, 0)),
                     kNear);
}

void StagedSearch::settle(bool leaves_out_jumps) {
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

bool StagedSearch::renew_rows(std::vector<bool>& keep) {
  std::vector<bool> now =
      rows_without_jumps(parameters_, spec_.forward, spec_.observations, coordinates_.values(u_),
                         [this](double, std::uint64_t) { return control_.may_run(); });
  if (now == keep) return false;
  keep = std::move(now);
  objective_ = make_objective(rows_.selected(keep), loss_);
  if (noise_ > 0) objective_->set_loss(scaled_loss());
  return true;
}

bool StagedSearch::renew_scale() {
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

Loss StagedSearch::scaled_loss() const {
  Loss loss = loss_;
  loss.scale *= noise_;
  return loss;
}

}  // namespace shearfront::fit
