// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/information.hpp"

#include <nlopt.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of the p-norm that stands for the largest eigenvalue: high enough to be it, low enough to be smooth.
constexpr double kNorm = 32;
/// Eigenvalues below this part of the largest are rounding.
constexpr double kSingular = 1e-13;
constexpr int kMostDesignSteps = 600;
/// Candidates whose tangent is best are tried in earnest before an exchange.
constexpr std::size_t kTried = 8;
constexpr int kMostDesignPasses = 30;
/// An exchange that gains less is none: rounding would go round in circles.
constexpr double kLeastDesignGain = 1e-9;

double trace_of_product(const MatrixXd& a, const MatrixXd& b) { return a.cwiseProduct(b).sum(); }

struct Spectrum {
  VectorXd values;
  MatrixXd vectors;
  bool is_regular = false;
};
Spectrum spectrum_of(const MatrixXd& information) {
  if (!information.allFinite()) return {};
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information);
  if (solver.info() != Eigen::Success) return {};
  const VectorXd& values = solver.eigenvalues();
  return {values, solver.eigenvectors(),
          values.size() > 0 && values[0] > kSingular * values[values.size() - 1]};
}

/// log (trace C^q)^(1/q) of the eigenvalues of C^-1, safe from overflow.
double log_norm(const VectorXd& values, double q) {
  const double largest = 1 / values.minCoeff();
  return std::log(largest) + std::log((values.cwiseInverse() / largest).array().pow(q).sum()) / q;
}

/// The continuous design as NLopt sees it: the criterion over numbers x of any size, w_g = 1 / (n (1 + exp(l - x_g))) with l
/// such that the weights sum to 1. So none is above 1/n, as in n different units.
class WeightProblem {
 public:
  WeightProblem(const WeightedCriterion& criterion, std::size_t n)
      : criterion_(&criterion), n_(static_cast<double>(n)) {}

  [[nodiscard]] VectorXd weights(const VectorXd& x) const {
    const auto n_units = static_cast<double>(x.size());
    if (n_ >= n_units) return VectorXd::Constant(x.size(), 1 / n_units);
    const auto shares = [&](double l) -> VectorXd { return (1 + (l - x.array()).exp()).inverse(); };
    // All x equal: l = x - log(n / (G - n)), so the root is between that of the least and of the largest.
    const double offset = -std::log(n_ / (n_units - n_)), low = x.minCoeff() + offset,
                 high = x.maxCoeff() + offset;
    double l = (low + high) / 2;
    if (high > low)
      l = boost::math::tools::newton_raphson_iterate(
          [&](double at) {
            const VectorXd s = shares(at);
            return std::pair(s.sum() - n_, -s.cwiseProduct((1 - s.array()).matrix()).sum());
          },
          l, low, high, std::numeric_limits<double>::digits);
    const VectorXd s = shares(l);
    return s / s.sum();
  }
  double value(const VectorXd& w, VectorXd* worth) const { return (*criterion_)(w, worth); }
  /// What NLopt calls.
  static double of_logarithms(unsigned size, const double* x, double* gradient, void* problem) {
    const auto* self = static_cast<const WeightProblem*>(problem);
    const VectorXd w = self->weights(Eigen::Map<const VectorXd>(x, size));
    VectorXd worth;
    const double value = self->value(w, gradient ? &worth : nullptr);
    if (gradient) {
      // dw_g = w_g (1 - n w_g) (dx_g - dl), and the weights sum to 1.
      const VectorXd slopes = w.cwiseProduct((1 - self->n_ * w.array()).max(0).matrix());
      const double mean = slopes.sum() > 0 ? slopes.dot(worth) / slopes.sum() : 0;
      for (Index g = 0; g < w.size(); ++g)
        gradient[g] = std::isfinite(value) ? -slopes[g] * (worth[g] - mean) : 0;
    }
    return value;
  }

 private:
  const WeightedCriterion* criterion_;
  double n_;
};

struct DestroyOptimiser {
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};

}  // namespace

double InformationCriterion::value(const MatrixXd& information) const {
  const Spectrum of = spectrum_of(information);
  if (!of.is_regular) return std::numeric_limits<double>::infinity();
  switch (criterion_) {
    case Criterion::D:
      return -of.values.array().log().mean();
    case Criterion::A:
      return log_norm(of.values, 1);
    case Criterion::E:
      return log_norm(of.values, kNorm);
    case Criterion::target:
      break;
  }
  return std::log(of.vectors.row(target_).cwiseAbs2().dot(of.values.cwiseInverse().transpose()));
}

std::optional<InformationCriterion::Tangent> InformationCriterion::tangent(
    const MatrixXd& information) const {
  const Spectrum of = spectrum_of(information);
  if (!of.is_regular) return std::nullopt;
  const VectorXd variances = of.values.cwiseInverse();
  const auto from_eigenvalues = [&](const VectorXd& slopes) -> MatrixXd {
    return of.vectors * slopes.asDiagonal() * of.vectors.transpose();
  };
  const auto of_norm = [&](double q) {
    // d log (sum l^-q)^(1/q) = - sum l^-(q+1) dl / sum l^-q, with everything beside the largest variance
    const double largest = variances.maxCoeff();
    const VectorXd powers = (variances / largest).array().pow(q);
    return from_eigenvalues(-powers.cwiseProduct(variances) / powers.sum());
  };
  switch (criterion_) {
    case Criterion::D:
      return Tangent{value(information),
                     from_eigenvalues(-variances / static_cast<double>(variances.size()))};
    case Criterion::A:
      return Tangent{value(information), of_norm(1)};
    case Criterion::E:
      return Tangent{value(information), of_norm(kNorm)};
    case Criterion::target:
      break;
  }
  const VectorXd column = of.vectors * variances.cwiseProduct(of.vectors.row(target_).transpose());
  return Tangent{std::log(column[target_]), -column * column.transpose() / column[target_]};
}

std::optional<ContinuousDesign> continuous_design(const WeightedCriterion& criterion, std::size_t n_all,
                                                  std::size_t n, int most_steps) {
  const WeightProblem problem(criterion, n);
  const auto n_units = static_cast<unsigned>(n_all);
  std::vector<double> x(n_units, 0.0);
  if (!std::isfinite(problem.value(problem.weights(VectorXd::Zero(n_units)), nullptr))) return std::nullopt;
  const std::unique_ptr<nlopt_opt_s, DestroyOptimiser> optimiser(nlopt_create(NLOPT_LD_LBFGS, n_units));
  nlopt_set_min_objective(optimiser.get(), WeightProblem::of_logarithms,
                          const_cast<WeightProblem*>(&problem));  // NOLINT: read only
  nlopt_set_maxeval(optimiser.get(), most_steps);
  nlopt_set_ftol_rel(optimiser.get(), 1e-12);
  double least = 0;
  // Wherever it ends, and why: how good that is says the bound.
  nlopt_optimize(optimiser.get(), x.data(), &least);
  ContinuousDesign found;
  found.weights = problem.weights(Eigen::Map<const VectorXd>(x.data(), n_units));
  found.value = problem.value(found.weights, &found.worth);
  if (!std::isfinite(found.value)) {
    found.weights = VectorXd::Constant(n_units, 1.0 / n_units);
    found.value = problem.value(found.weights, &found.worth);
  }
  // Convex: f(v) >= f(w) - worth . (v - w), least where v are the n units of largest worth.
  VectorXd sorted = found.worth;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const double best = sorted.head(static_cast<Index>(std::min<std::size_t>(n, n_units))).mean();
  found.bound = found.value - (best - found.worth.dot(found.weights));
  return found;
}

std::optional<ContinuousDesign> continuous_design(const UnitInformation& information,
                                                  const InformationCriterion& criterion, std::size_t n) {
  const auto count = static_cast<double>(n), n_draws = static_cast<double>(information.before.size());
  const auto value = [&](const VectorXd& w, VectorXd* worth) {
    double sum = 0;
    if (worth) worth->setZero(w.size());
    for (std::size_t k = 0; k < information.before.size(); ++k) {
      MatrixXd all = information.before[k];
      const auto& units = information.units[k];
      for (std::size_t g = 0; g < units.size(); ++g)
        if (w[static_cast<Index>(g)] > 0) all += count * w[static_cast<Index>(g)] * units[g];
      const auto at = criterion.tangent(all);
      if (!at) return std::numeric_limits<double>::infinity();
      sum += at->value / n_draws;
      for (std::size_t g = 0; worth && g < units.size(); ++g)
        (*worth)[static_cast<Index>(g)] -= count * trace_of_product(at->slope, units[g]) / n_draws;
    }
    return sum;
  };
  return continuous_design(value, information.units.front().size(), n, kMostDesignSteps);
}

MatrixXd information_of(const UnitInformation& information, std::size_t draw,
                        const std::vector<std::size_t>& units) {
  MatrixXd all = information.before[draw];
  for (const std::size_t g : units) all += information.units[draw][g];
  return all;
}

std::vector<std::size_t> weightiest(const ContinuousDesign& design, std::size_t n) {
  std::vector<std::size_t> order(static_cast<std::size_t>(design.weights.size()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  const double largest = design.worth.cwiseAbs().maxCoeff();
  const auto rank = [&](std::size_t g) {
    const auto i = static_cast<Index>(g);
    return design.weights[i] + 1e-6 * design.worth[i] / largest;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
  order.resize(n);
  return order;
}

std::vector<std::size_t> exchanged_design(const UnitInformation& information,
                                          const InformationCriterion& criterion, std::size_t n,
                                          const ContinuousDesign& start) {
  const std::size_t n_units = information.units.front().size(), n_draws = information.before.size();
  std::vector<std::size_t> chosen = weightiest(start, n);
  std::vector<bool> is_chosen(n_units, false);
  std::vector<MatrixXd> sums = information.before;
  const auto add = [&](std::vector<MatrixXd>& to, std::size_t g, double sign) {
    for (std::size_t k = 0; k < n_draws; ++k) to[k] += sign * information.units[k][g];
  };
  for (const std::size_t g : chosen) {
    is_chosen[g] = true;
    add(sums, g, 1);
  }
  const auto mean_of = [&](const std::vector<MatrixXd>& of) {
    double sum = 0;
    for (const MatrixXd& matrix : of) sum += criterion.value(matrix);
    return sum / static_cast<double>(n_draws);
  };
  double value = mean_of(sums);
  bool has_changed = true;
  for (int pass = 0; has_changed && pass < kMostDesignPasses; ++pass) {
    has_changed = false;
    for (std::size_t& out : chosen) {
      std::vector<MatrixXd> without = sums;
      add(without, out, -1);
      // What each would bring, by the tangent at what is there now.
      VectorXd worth = VectorXd::Zero(static_cast<Index>(n_units));
      for (std::size_t k = 0; k < n_draws; ++k) {
        const auto at = criterion.tangent(sums[k]);
        for (std::size_t g = 0; at && g < n_units; ++g)
          worth[static_cast<Index>(g)] -= trace_of_product(at->slope, information.units[k][g]);
      }
      std::vector<std::size_t> tried;
      for (std::size_t g = 0; g < n_units; ++g)
        if (!is_chosen[g]) tried.push_back(g);
      const std::size_t most = std::min(kTried, tried.size());
      std::partial_sort(tried.begin(), tried.begin() + static_cast<std::ptrdiff_t>(most), tried.end(),
                        [&](std::size_t a, std::size_t b) {
                          return worth[static_cast<Index>(a)] > worth[static_cast<Index>(b)];
                        });
      std::size_t best = out;
      double least = value;
      for (std::size_t i = 0; i < most; ++i) {
        std::vector<MatrixXd> with = without;
        add(with, tried[i], 1);
        const double now = mean_of(with);
        if (now < least - kLeastDesignGain) least = now, best = tried[i];
      }
      if (best == out) continue;
      is_chosen[out] = false;
      is_chosen[best] = true;
      sums = std::move(without);
      add(sums, best, 1);
      out = best;
      value = least;
      has_changed = true;
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace shearfront::fit
