// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/bootstrap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <exception>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "shearfront/fit/noise_reml.hpp"
#include "shearfront/fit/quantile.hpp"
#include "shearfront/fit/search/nlopt_algorithm.hpp"
#include "shearfront/solution/observe.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTail = 0.025;

/// The same search if it is a local one.
std::string local_algorithm(const std::string& algorithm) {
  constexpr std::string_view kNlopt = "nlopt:";
  if (algorithm == "pattern") return algorithm;
  if (!algorithm.starts_with(kNlopt)) return "ceres";
  const NloptAlgorithm* of_nlopt = find_nlopt_algorithm(std::string_view(algorithm).substr(kNlopt.size()));
  if (!of_nlopt || !of_nlopt->is_global) return algorithm;
  return of_nlopt->uses_derivatives ? "ceres" : "nlopt:sbplx";
}

/// Fits of all replicates, in their order; nothing where a fit failed or was not made.
class Replicates {
 public:
  Replicates(const FitSpec& spec, const FitSpec& one, const Estimate& estimate, const Refit& refit,
             const Progress& progress)
      : spec_(spec),
        one_(one),
        estimate_(estimate),
        refit_(refit),
        progress_(progress),
        noise_(noise_of_draws(spec.observations, estimate)),
        found_(spec.uncertainty.bootstrap) {}

  std::vector<std::optional<VectorXd>> operator()() {
    std::size_t n_threads = spec_.uncertainty.threads;
    if (n_threads == 0) n_threads = std::max(1U, std::thread::hardware_concurrency());
    n_threads = std::min(n_threads, found_.size());
    std::vector<std::thread> others;
    for (std::size_t i = 1; i < n_threads; ++i) others.emplace_back([this] { work(); });
    work();
    for (std::thread& other : others) other.join();
    return std::move(found_);
  }
  [[nodiscard]] bool is_interrupted() const { return stop_; }

 private:
  void work() {
    FitSpec mine = one_;
    for (std::size_t b = next_++; b < found_.size() && !stop_; b = next_++) {
      draw_observations(mine.observations, estimate_, noise_.get(), stream_seed(spec_.uncertainty.seed, b));
      try {
        found_[b] = refit_(mine, [this](std::size_t, double) { return goes_on(); });
      } catch (const std::exception&) {
        found_[b].reset();  // counted as failed, like a fit without result
      }
      (void)goes_on();
    }
  }
  /// Also asked within the fits.
  bool goes_on() {
    if (!progress_ || stop_) return !stop_;
    const std::lock_guard lock(reporting_);
    if (!progress_(estimate_.evaluations, estimate_.misfit)) stop_ = true;
    return !stop_;
  }

  const FitSpec& spec_;
  const FitSpec& one_;
  const Estimate& estimate_;
  const Refit& refit_;
  const Progress& progress_;
  std::shared_ptr<const NoiseCovariance> noise_;
  std::vector<std::optional<VectorXd>> found_;  // one element per replicate, each written by one thread
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stop_ = false;
  std::mutex reporting_;
};

void set_intervals(const Parameters& parameters, const Estimate& estimate, Bootstrap& result) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ParameterEstimate& p = estimate.parameters[i];
    if (!p.std_error && !p.is_held()) continue;
    const auto column = result.estimates.col(static_cast<Index>(i));
    std::vector<double> sorted(column.begin(), column.end());
    std::sort(sorted.begin(), sorted.end());
    const Interval interval{quantile(sorted, kTail), quantile(sorted, 1 - kTail)};
    if (interval.low < interval.high) result.intervals[i] = interval;
  }
}

}  // namespace

FitSpec replicate_of(const FitSpec& spec, const Parameters& parameters, const Estimate& estimate) {
  FitSpec replicate = spec;
  replicate.unknown = {};
  replicate.unknown.shape = spec.unknown.shape;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& p = parameters[i];
    replicate.unknown.parameters.push_back(p.name());
    replicate.unknown.start.push_back(std::clamp(estimate.parameters[i].estimate, p.lower, p.upper));
    replicate.unknown.lower.push_back(p.lower);
    replicate.unknown.upper.push_back(p.upper);
  }
  replicate.search.algorithm = local_algorithm(spec.search.algorithm);
  replicate.search.starts = 1;
  replicate.uncertainty = {};
  return replicate;
}

std::shared_ptr<const NoiseCovariance> noise_of_draws(const Observations& observations,
                                                      const Estimate& estimate) {
  if (!estimate.noise) return nullptr;
  const bool has_tau = std::isfinite(estimate.noise->tau);
  return std::make_shared<NoiseCovariance>(std::make_shared<NoisePlaces>(observations.rows, has_tau),
                                           shape_of(*estimate.noise, estimate.sigma));
}

void draw_observations(Observations& observations, const Estimate& estimate, const NoiseCovariance* noise,
                       std::uint64_t seed) {
  boost::random::mt19937_64 engine(seed);
  boost::random::normal_distribution<double> normal;
  VectorXd drawn(static_cast<Index>(observations.rows.size()));
  for (double& x : drawn) x = normal(engine);
  if (noise) drawn = noise->coloured(drawn);
  for (std::size_t k = 0; k < observations.rows.size(); ++k) {
    Observation& o = observations.rows[k];
    o.value = estimate.predicted[k] + (o.sigma > 0 ? o.sigma : estimate.sigma) * drawn[static_cast<Index>(k)];
  }
}

Bootstrap bootstrap(const FitSpec& spec, const Parameters& parameters, const Estimate& estimate,
                    const Refit& refit, const Progress& progress) {
  Bootstrap result;
  result.intervals.resize(parameters.size());
  const bool is_predicted = std::all_of(estimate.predicted.begin(), estimate.predicted.end(),
                                        [](double x) { return std::isfinite(x); });
  if (std::isnan(estimate.sigma)) return result;  // too few data: said already
  if (!(estimate.sigma > 0) || !is_predicted) {
    result.warnings.emplace_back("no bootstrap: the noise of the data is not known");
    return result;
  }
  const FitSpec one = replicate_of(spec, parameters, estimate);
  Replicates replicates(spec, one, estimate, refit, progress);
  const std::vector<std::optional<VectorXd>> found = replicates();
  std::vector<VectorXd> good;
  for (const auto& values : found)
    if (values) good.push_back(*values);
  result.failed = found.size() - good.size();
  result.estimates.resize(static_cast<Index>(good.size()), static_cast<Index>(parameters.size()));
  for (std::size_t b = 0; b < good.size(); ++b) result.estimates.row(static_cast<Index>(b)) = good[b];
  if (replicates.is_interrupted())
    result.warnings.emplace_back("the bootstrap was interrupted: its intervals are from the replicates done");
  else if (result.failed > 0)
    result.warnings.push_back(fmt::format(
        "{} of {} bootstrap replicates could not be fitted and are left out", result.failed, found.size()));
  if (good.size() < kFewestReplicates) {
    result.warnings.push_back(
        fmt::format("{} bootstrap replicates are too few for 95 % intervals; at least {} "
                    "are needed",
                    good.size(), kFewestReplicates));
    return result;
  }
  const MatrixXd centred = result.estimates.rowwise() - result.estimates.colwise().mean();
  result.covariance = centred.transpose() * centred / static_cast<double>(good.size() - 1);
  set_intervals(parameters, estimate, result);
  return result;
}

}  // namespace shearfront::fit
