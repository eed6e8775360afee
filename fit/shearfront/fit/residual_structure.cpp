// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/residual_structure.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {
namespace {

/// Of the range of the data: exact solutions agree to rounding, those of implicit schemes to what their
/// iteration leaves.
constexpr double kLeastSpread = 1e-7;
/// Heights of different times that are one height up to rounding, relative to the largest.
constexpr double kSameHeight = 1e-12;

/// Standardised residuals of all observations; those at rounding level are 0. Empty if all are.
std::vector<double> standardised(const Observations& observations, const std::vector<double>& predicted) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Observation& o : observations.rows) {
    low = std::min(low, o.value);
    high = std::max(high, o.value);
  }
  const double floor = kLeastSpread * (high > low ? high - low : std::max(std::abs(high), 1e-300));
  std::vector<double> residuals;
  double squares = 0;
  std::size_t n = 0;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    const Observation& o = observations.rows[k];
    const double difference = predicted[k] - o.value;
    const double sigma = o.sigma > 0 ? o.sigma : 1;
    residuals.push_back(std::abs(difference) <= floor ? 0 : difference / sigma);
    if (std::isnan(difference)) continue;
    squares += difference * difference;
    ++n;
  }
  if (n == 0 || std::sqrt(squares / static_cast<double>(n)) <= floor) residuals.clear();
  return residuals;
}

/// Normal scores with the signs of the residuals; 0 stays 0, NaN stays NaN.
std::vector<double> signed_scores(const std::vector<double>& residuals) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (std::abs(residuals[k]) > 0) order.push_back(k);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(std::abs(residuals[a]), a) < std::pair(std::abs(residuals[b]), b);
  });
  std::vector<double> scores = residuals;
  const boost::math::normal law;
  const auto n = static_cast<double>(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double score = boost::math::quantile(law, (1 + static_cast<double>(i + 1) / (n + 1)) / 2);
    scores[order[i]] = std::copysign(score, residuals[order[i]]);
  }
  return scores;
}

/// Sums over pairs of neighbours, for their correlation and its test.
class Lag1 {
 public:
  Lag1(const std::vector<double>& residuals, const std::vector<double>& scores)
      : residuals_(&residuals), scores_(&scores) {}

  void add(std::size_t first, std::size_t second) {
    const double a = (*residuals_)[first], b = (*residuals_)[second];
    const double product = (*scores_)[first] * (*scores_)[second];
    if (std::isnan(product)) return;
    ++n_;
    products_ += a * b;
    first2_ += a * a;
    second2_ += b * b;
    score_ += product;
    variance_ += product * product;
  }
  [[nodiscard]] bool is_tested() const { return n_ >= kFewestPairs && variance_ > 0; }
  [[nodiscard]] double correlation() const { return products_ / std::sqrt(first2_ * second2_); }
  [[nodiscard]] double z_score() const { return score_ / std::sqrt(variance_); }

 private:
  const std::vector<double>*residuals_, *scores_;
  std::size_t n_ = 0;
  double products_ = 0, first2_ = 0, second2_ = 0, score_ = 0, variance_ = 0;
};

/// Runs of equal sign in several sequences; given the numbers of both signs in each.
class Runs {
 public:
  void add(const std::vector<double>& residuals) {
    double n_positive = 0, n_negative = 0, runs = 0, last = 0;
    for (const double r : residuals) {
      if (std::isnan(r) || r == 0) continue;
      (r > 0 ? n_positive : n_negative) += 1;
      if (last == 0 || (r > 0) != (last > 0)) runs += 1;
      last = r;
    }
    const double n = n_positive + n_negative;
    if (n < 2) return;
    const double twice = 2 * n_positive * n_negative;
    n_ += n;
    excess_ += runs - (twice / n + 1);
    variance_ += twice * (twice - n) / (n * n * (n - 1));
  }
  [[nodiscard]] bool is_tested() const { return n_ >= static_cast<double>(kFewestPairs) && variance_ > 0; }
  [[nodiscard]] double z_score() const { return excess_ / std::sqrt(variance_); }

 private:
  double n_ = 0, excess_ = 0, variance_ = 0;
};

/// Pairs of successive times at one height.
void add_times(const Observations& observations, Lag1& pairs) {
  std::vector<std::size_t> order;
  double highest = 0;
  for (const MeasuredProfile& profile : measured_profiles(observations))
    for (const std::size_t k : profile.rows) {
      order.push_back(k);
      highest = std::max(highest, std::abs(observations.rows[k].z));
    }
  const auto height = [&](std::size_t k) { return observations.rows[k].z; };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && height(order[end]) - height(order[i]) <= kSameHeight * highest) ++end;
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(i);
    const auto to = order.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(from, to,
              [&](std::size_t a, std::size_t b) { return observations.rows[a].t < observations.rows[b].t; });
    for (auto k = from; k + 1 != to; ++k) pairs.add(*k, *(k + 1));
  }
}

}  // namespace

std::optional<ResidualStructure> residual_structure(const Observations& observations,
                                                    const std::vector<double>& predicted) {
  const std::vector<double> residuals = standardised(observations, predicted);
  if (residuals.empty()) return {};
  const std::vector<double> scores = signed_scores(residuals);
  Lag1 height(residuals, scores), time(residuals, scores);
  Runs runs;
  for (const MeasuredProfile& profile : measured_profiles(observations)) {
    std::vector<double> along;
    for (const std::size_t k : profile.rows) along.push_back(residuals[k]);
    for (std::size_t j = 0; j + 1 < along.size(); ++j) height.add(profile.rows[j], profile.rows[j + 1]);
    runs.add(along);
  }
  add_times(observations, time);
  double worst = 0;
  int n_tests = 0;
  const auto take = [&](bool is_tested, double z) {
    if (!is_tested) return;
    ++n_tests;
    worst = std::max(worst, std::abs(z));
  };
  take(height.is_tested(), height.z_score());
  take(time.is_tested(), time.z_score());
  take(runs.is_tested(), runs.z_score());
  if (n_tests == 0) return {};
  ResidualStructure structure;
  structure.lag1_height = height.is_tested() ? height.correlation() : kUnknown;
  structure.lag1_time = time.is_tested() ? time.correlation() : kUnknown;
  structure.runs_z_score = runs.is_tested() ? runs.z_score() : kUnknown;
  structure.is_structured = worst > boost::math::quantile(boost::math::complement(
                                        boost::math::normal(), kStructureLevel / (2 * n_tests)));
  return structure;
}

}  // namespace shearfront::fit
