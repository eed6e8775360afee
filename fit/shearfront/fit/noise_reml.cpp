// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/noise_reml.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Lengths beyond these are no correlation, and one that the data cannot tell from a common shift.
constexpr double kShortestLength = 0.05, kLongestLength = 100;
/// Of tau over sigma, and of the part of the variance that is independent.
constexpr double kLeastRatio = 1e-3, kMostRatio = 1e3, kMostIndependent = 0.99;
/// How well the search ends, in logarithms: far within the standard error of any length.
constexpr double kNoiseTolerance = 1e-4;
constexpr int kMostCovariances = 300;
/// Of the differences that second derivatives are taken from: 1/50 of a length, so that their error is some 1e-4.
constexpr double kNoiseStep = 0.02;
constexpr double kTwoSided = 1.959963984540054;
/// Columns of J smaller than this part of the largest, once they are orthogonal, are none.
constexpr double kNoiseRank = 1e-7;

enum class NoiseNumber { length_z, length_t, independent, tau };

/// One that is estimated: a logarithm, or the part that is independent as it is.
struct Sought {
  NoiseNumber number;
  double lower, upper;
  std::vector<double> starts;
};

double reach_of(const std::vector<double>& places) { return places.back() - places.front(); }

Sought sought_length(NoiseNumber number, const std::vector<double>& places) {
  double least = reach_of(places);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) least = std::min(least, places[i + 1] - places[i]);
  const double longest = std::log(kLongestLength * reach_of(places)),
               shortest = std::log(kShortestLength * least);
  const double step = reach_of(places) / static_cast<double>(places.size() - 1);
  Sought sought{number, shortest, longest, {}};
  for (const double x : {step, std::sqrt(step * reach_of(places)), 2 * reach_of(places)})
    sought.starts.push_back(std::log(x));
  return sought;
}

/// What [noise] leaves to be estimated, of what the places let see.
std::vector<Sought> sought_in(const NoiseSpec& spec, const NoisePlaces& places) {
  std::vector<Sought> all;
  if (!spec.length_z && places.heights().size() > 1)
    all.push_back(sought_length(NoiseNumber::length_z, places.heights()));
  if (!spec.length_t && places.times().size() > 1)
    all.push_back(sought_length(NoiseNumber::length_t, places.times()));
  if (spec.model == NoiseModel::exponential && !spec.independent)
    all.push_back({NoiseNumber::independent, 0, kMostIndependent, {0.05, 0.5}});
  if (spec.model == NoiseModel::discrepancy && !spec.tau)
    all.push_back({NoiseNumber::tau, std::log(kLeastRatio), std::log(kMostRatio), {-1, 1}});
  return all;
}

class RestrictedLikelihood {
 public:
  RestrictedLikelihood(const NoiseSpec& spec, const NoiseData& data)
      : spec_(spec), data_(data), sought_(sought_in(spec, *data.places)) {
    // Any basis of what the unknowns move: another adds a constant.
    moved_.resize(data.residuals.size(), 0);
    if (data.jacobian.cols() > 0) {
      Eigen::ColPivHouseholderQR<MatrixXd> qr(data.jacobian.colwise().normalized());
      qr.setThreshold(kNoiseRank);
      moved_ = qr.householderQ() * MatrixXd::Identity(data.jacobian.rows(), qr.rank());
    }
    freedom_ = static_cast<double>(data.residuals.size() - moved_.cols());
  }

  [[nodiscard]] const std::vector<Sought>& sought() const { return sought_; }
  [[nodiscard]] bool is_possible() const {
    return freedom_ > static_cast<double>(sought_.size()) && data_.residuals.squaredNorm() > 0;
  }

  [[nodiscard]] NoiseShape shape(const VectorXd& place) const {
    NoiseShape s;
    if (data_.places->heights().size() > 1)
      s.length_z = value(NoiseNumber::length_z, place, spec_.length_z.value_or(0));
    if (data_.places->times().size() > 1)
      s.length_t = value(NoiseNumber::length_t, place, spec_.length_t.value_or(0));
    if (spec_.model == NoiseModel::discrepancy) {
      // In the unit of the data where they have sigma, otherwise beside the sigma that is found.
      const double tau = spec_.tau ? *spec_.tau : data_.mean_sigma * value(NoiseNumber::tau, place, 0);
      s.independent = 1;
      s.correlated = tau * tau;
    } else {
      s.independent = value(NoiseNumber::independent, place, spec_.independent.value_or(0));
      s.correlated = 1 - s.independent;
    }
    return s;
  }

  struct Value {
    double criterion = 0, sigma = 1;
  };
  /// -2 log likelihood up to a constant.
  [[nodiscard]] Value operator()(const VectorXd& place) const {
    const NoiseShape s = shape(place);
    const NoiseCovariance covariance(data_.places, s);
    VectorXd residuals = covariance.whitened(data_.residuals);
    const Index p = moved_.cols();
    double sum = covariance.log_determinant();
    if (p > 0) {
      const Eigen::HouseholderQR<MatrixXd> qr(covariance.whitened(moved_));
      residuals.applyOnTheLeft(qr.householderQ().adjoint());
      for (Index i = 0; i < p; ++i) sum += 2 * std::log(std::abs(qr.matrixQR()(i, i)));
    }
    const double squares = residuals.tail(residuals.size() - p).squaredNorm();
    sum += data_.sigma_is_given ? squares : freedom_ * std::log(squares / freedom_);
    const double sigma = data_.sigma_is_given ? 1 : std::sqrt(squares / freedom_);
    if (spec_.model == NoiseModel::discrepancy) sum += minus_2_log_prior(s, sigma);
    return {sum, sigma};
  }

  [[nodiscard]] VectorXd found(const VectorXd& place) const;
  /// Of the logarithms (the independent part as it is), 0 for those at a bound and NaN where there are none.
  [[nodiscard]] VectorXd standard_errors(const VectorXd& place) const;

 private:
  [[nodiscard]] double value(NoiseNumber number, const VectorXd& place, double given) const {
    for (std::size_t i = 0; i < sought_.size(); ++i)
      if (sought_[i].number == number) {
        const double x = place[static_cast<Index>(i)];
        return number == NoiseNumber::independent ? x : std::exp(x);
      }
    return given;
  }
  [[nodiscard]] double minus_2_log_prior(const NoiseShape& s, double sigma) const {
    const auto term = [](bool is_given, double x, const std::optional<double>& asked, double otherwise) {
      return is_given ? 0 : std::pow(x / asked.value_or(otherwise), 2);
    };
    double sum = term(spec_.tau.has_value(), std::sqrt(s.correlated) * sigma, spec_.tau_prior, data_.range);
    if (std::isfinite(s.length_z))
      sum += term(spec_.length_z.has_value(), s.length_z, spec_.length_z_prior,
                  reach_of(data_.places->heights()));
    if (std::isfinite(s.length_t))
      sum +=
          term(spec_.length_t.has_value(), s.length_t, spec_.length_t_prior, reach_of(data_.places->times()));
    return sum;
  }

  const NoiseSpec& spec_;
  const NoiseData& data_;
  std::vector<Sought> sought_;
  MatrixXd moved_;
  double freedom_ = 0;
};

VectorXd RestrictedLikelihood::found(const VectorXd& from) const {
  VectorXd lower(from.size()), upper(from.size());
  for (Index i = 0; i < from.size(); ++i) {
    lower[i] = sought_[static_cast<std::size_t>(i)].lower;
    upper[i] = sought_[static_cast<std::size_t>(i)].upper;
  }
  constexpr double kFirstNoiseStep = 0.3;
  return least_in_box([this](const VectorXd& x) { return (*this)(x).criterion; }, from, lower, upper,
                      kFirstNoiseStep, kNoiseTolerance, kMostCovariances);
}

/// The best of a lattice.
VectorXd best_on_lattice(const RestrictedLikelihood& likelihood) {
  const std::vector<Sought>& sought = likelihood.sought();
  const auto n = static_cast<Index>(sought.size());
  VectorXd best(n);
  double least = HUGE_VAL;
  std::vector<std::size_t> at(sought.size(), 0);
  for (bool goes_on = true; goes_on;) {
    VectorXd place(n);
    for (Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      place[i] = std::clamp(sought[k].starts[at[k]], sought[k].lower, sought[k].upper);
    }
    if (const double value = likelihood(place).criterion; value < least || least == HUGE_VAL)
      least = value, best = place;
    goes_on = false;
    for (std::size_t k = 0; k < sought.size() && !goes_on; ++k) {
      goes_on = ++at[k] < sought[k].starts.size();
      if (!goes_on) at[k] = 0;
    }
  }
  return best;
}

VectorXd RestrictedLikelihood::standard_errors(const VectorXd& place) const {
  std::vector<Index> free;
  for (Index i = 0; i < place.size(); ++i) {
    const Sought& s = sought_[static_cast<std::size_t>(i)];
    if (place[i] - s.lower > kNoiseStep && s.upper - place[i] > kNoiseStep) free.push_back(i);
  }
  const auto n = static_cast<Index>(free.size());
  const auto criterion = [&](Index a, double da, Index b, double db) {
    VectorXd at = place;
    at[free[static_cast<std::size_t>(a)]] += da * kNoiseStep;
    at[free[static_cast<std::size_t>(b)]] += db * kNoiseStep;
    return (*this)(at).criterion;
  };
  MatrixXd second(n, n);
  const double middle = (*this)(place).criterion;
  for (Index a = 0; a < n; ++a) {
    second(a, a) = criterion(a, 1, a, 0) + criterion(a, -1, a, 0) - 2 * middle;
    for (Index b = 0; b < a; ++b)
      second(a, b) = second(b, a) = (criterion(a, 1, b, 1) + criterion(a, -1, b, -1) -
                                     criterion(a, 1, b, -1) - criterion(a, -1, b, 1)) /
                                    4;
  }
  VectorXd errors = VectorXd::Zero(place.size());
  const Eigen::LLT<MatrixXd> llt(second / (2 * kNoiseStep * kNoiseStep));
  const bool is_minimum = n > 0 && llt.info() == Eigen::Success;
  const MatrixXd covariance = is_minimum ? MatrixXd(llt.solve(MatrixXd::Identity(n, n))) : MatrixXd(n, n);
  for (Index a = 0; a < n; ++a)
    errors[free[static_cast<std::size_t>(a)]] = is_minimum ? std::sqrt(covariance(a, a)) : kUnknown;
  return errors;
}

NoiseEstimate estimate_of(const NoiseSpec& spec, const NoiseShape& shape, double sigma) {
  NoiseEstimate e;
  e.model = kNoiseModelNames[static_cast<std::size_t>(spec.model)];
  if (std::isfinite(shape.length_z)) e.length_z = shape.length_z;
  if (std::isfinite(shape.length_t)) e.length_t = shape.length_t;
  const bool has_tau = spec.model == NoiseModel::discrepancy;
  e.independent = has_tau ? kUnknown : shape.independent;
  if (has_tau) e.tau = sigma * std::sqrt(shape.correlated);
  return e;
}

}  // namespace

std::optional<NoiseNumbers> given_noise(const NoiseSpec& spec, const NoisePlaces& places) {
  if (!sought_in(spec, places).empty()) return std::nullopt;
  NoiseShape shape;
  if (places.heights().size() > 1) shape.length_z = *spec.length_z;
  if (places.times().size() > 1) shape.length_t = *spec.length_t;
  const bool has_tau = spec.model == NoiseModel::discrepancy;
  shape.independent = has_tau ? 1 : *spec.independent;
  shape.correlated = has_tau ? *spec.tau * *spec.tau : 1 - shape.independent;
  return NoiseNumbers{shape, estimate_of(spec, shape, 1), {}};
}

std::optional<NoiseNumbers> estimated_noise(const NoiseSpec& spec, const NoiseData& data,
                                            const VectorXd& place) {
  if (auto given = given_noise(spec, *data.places)) return given;
  const RestrictedLikelihood likelihood(spec, data);
  if (!likelihood.is_possible()) return std::nullopt;
  NoiseNumbers numbers;
  numbers.place = likelihood.found(place.size() > 0 ? place : best_on_lattice(likelihood));
  numbers.shape = likelihood.shape(numbers.place);
  const double sigma = likelihood(numbers.place).sigma;
  NoiseEstimate& e = numbers.estimate = estimate_of(spec, numbers.shape, sigma);
  e.estimated = likelihood.sought().size();
  const VectorXd errors = likelihood.standard_errors(numbers.place);
  for (std::size_t i = 0; i < e.estimated; ++i) {
    const double error = errors[static_cast<Index>(i)], factor = std::exp(kTwoSided * error);
    if (!(error > 0)) continue;
    const auto around = [&](double x) { return Interval{x / factor, x * factor}; };
    switch (likelihood.sought()[i].number) {
      case NoiseNumber::length_z:
        e.length_z95 = around(e.length_z);
        break;
      case NoiseNumber::length_t:
        e.length_t95 = around(e.length_t);
        break;
      case NoiseNumber::tau:
        e.tau95 = around(e.tau);
        break;
      case NoiseNumber::independent:
        e.independent95 = {std::max(0.0, e.independent - kTwoSided * error),
                           std::min(1.0, e.independent + kTwoSided * error)};
        break;
    }
  }
  return numbers;
}

NoiseSpec known_noise(const FitSpec& spec, const Estimate& estimate) {
  if (!estimate.noise) return {};
  const NoiseEstimate& found = *estimate.noise;
  NoiseSpec known = spec.noise;
  if (std::isfinite(found.length_z)) known.length_z = found.length_z;
  if (std::isfinite(found.length_t)) known.length_t = found.length_t;
  if (known.model == NoiseModel::exponential) {
    known.independent = found.independent;
  } else if (estimate.sigma_is_given) {
    known.tau = found.tau;
  } else {
    known.model = NoiseModel::exponential;
    known.independent = 1 / (1 + std::pow(found.tau / estimate.sigma, 2));
  }
  return known;
}

NoiseShape shape_of(const NoiseEstimate& estimate, double sigma) {
  NoiseShape shape;
  if (std::isfinite(estimate.length_z)) shape.length_z = estimate.length_z;
  if (std::isfinite(estimate.length_t)) shape.length_t = estimate.length_t;
  const bool has_tau = std::isfinite(estimate.tau);
  shape.independent = has_tau ? 1 : estimate.independent;
  shape.correlated = has_tau ? std::pow(estimate.tau / sigma, 2) : 1 - shape.independent;
  return shape;
}

}  // namespace shearfront::fit
