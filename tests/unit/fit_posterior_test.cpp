// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/posterior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/io/method_text.hpp"
#include "support/fit_scenes.hpp"
#include "support/random_scene.hpp"

namespace shearfront::fit {
namespace {

using namespace shearfront::support;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

SceneSpec<double> posterior_bed() { return small_above_large({0.29}, {2.4, 0.31}); }

/// 20 values of M, or the means of as many bins.
FitSpec posterior_fit(bool with_sigma, std::vector<std::string> unknowns, std::vector<Prior> priors = {},
                      Quantity quantity = Quantity::cumulative, std::uint64_t seed = 1) {
  const ObservationPlan plan{
      {0.2, 0.5, 1, 2}, {0.1, 0.3, 0.5, 0.7, 0.9}, quantity, quantity == Quantity::bin ? 0.1 : 0};
  FitSpec spec =
      fit_of(posterior_bed(), observed(posterior_bed(), plan, 0.02, seed, with_sigma), std::move(unknowns));
  spec.priors = std::move(priors);
  return spec;
}

VectorXd unknowns_at(const std::vector<double>& all) {
  return VectorXd::Map(all.data(), static_cast<Index>(all.size()));
}

/// What is predicted less what was seen, by the solver and nothing of the fit.
VectorXd residuals_by_solver(const FitSpec& spec, const VectorXd& p) {
  SceneSpec<double> scene = spec.scene.spec();
  const auto all = entries(scene);
  const auto places = entry_places(scene);
  Index next = 0;
  for (const std::string& name : spec.unknown.parameters)
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].field == name || all[i].name() == name) *places[i] = p[next++];
  const Scene<double> bed(scene);
  VectorXd r(static_cast<Index>(spec.observations.rows.size()));
  for (Index i = 0; i < r.size(); ++i) {
    const Observation& o = spec.observations.rows[static_cast<std::size_t>(i)];
    const bool is_bin = spec.observations.quantity == Quantity::bin;
    const auto field = sample(bed, Method("exact"), {{o.t, o.z - o.width / 2}, {o.t, o.z + o.width / 2}});
    const double low = field.samples[0].M, high = field.samples[1].M;
    r[i] = (is_bin ? (high - low) / o.width : high) - o.value;
  }
  return r;
}

TEST(FitPrior, IsTheDistributionOfBoost) {
  const boost::math::normal_distribution<double> normal(2.4, 0.3), folded(0, 0.7);
  const boost::math::lognormal_distribution<double> lognormal(std::log(1.7), 0.4);
  struct Case {
    Prior prior;
    std::function<double(double)> density;
    double from, to;
  };
  const std::vector<Case> cases{
      {{"", PriorKind::normal, 2.4, 0.3}, [&](double p) { return pdf(normal, p); }, 1, 4},
      {{"", PriorKind::lognormal, 1.7, 0.4}, [&](double p) { return pdf(lognormal, p); }, 0.3, 6},
      {{"", PriorKind::half_normal, 0.7}, [&](double p) { return 2 * pdf(folded, p); }, 0.01, 3},
      {{"", PriorKind::uniform, -1, 3}, [](double) { return 0.25; }, -0.99, 2.99}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.prior.text());
    EXPECT_EQ(c.prior.refusal(), "");
    const double constant = c.prior.log_density(c.to).log - std::log(c.density(c.to));
    for (int k = 0; k <= 30; ++k) {
      const double p = c.from + (c.to - c.from) * k / 30, h = 1e-3 * p;
      const auto log_at = [&](double q) { return std::log(c.density(q)); };
      EXPECT_NEAR(c.prior.log_density(p).log - constant, log_at(p), 1e-12 * (1 + std::abs(log_at(p))));
      const double slope =
          (8 * (log_at(p + h) - log_at(p - h)) - (log_at(p + 2 * h) - log_at(p - 2 * h))) / (12 * h);
      EXPECT_NEAR(c.prior.log_density(p).slope, slope, 1e-8 * (1 + std::abs(slope))) << p;
    }
  }
  EXPECT_EQ(cases[1].prior.log_density(0).log, -kInfinite);
  EXPECT_EQ(cases[1].prior.log_density(-1).log, -kInfinite);
  EXPECT_EQ(cases[2].prior.log_density(-1e-9).log, -kInfinite);
  EXPECT_EQ(cases[3].prior.log_density(3.1).log, -kInfinite);
  EXPECT_EQ(cases[3].prior.low(), -1);
  EXPECT_EQ(cases[1].prior.low(), 0);
  EXPECT_EQ(cases[0].prior.low(), -kInfinite);
}

/// Differences of log densities: each is known up to a constant.
TEST(FitPosterior, IsThatOfTheFormulaWithKnownAndUnknownSigma) {
  for (const Quantity quantity : {Quantity::cumulative, Quantity::bin})
    for (const bool with_sigma : {true, false}) {
      const FitSpec spec = posterior_fit(with_sigma, {"shear_rate.values"},
                                         {{"shear_rate.values", PriorKind::lognormal, 1, 2}}, quantity);
      const Posterior posterior(spec);
      EXPECT_EQ(posterior.sigma_is_given(), with_sigma);
      EXPECT_EQ(posterior.n_residuals(), 20U);
      EXPECT_FALSE(posterior.has_steps());
      const auto log_density = [&](const VectorXd& p) {
        const double squares = residuals_by_solver(spec, p).squaredNorm();
        double sum = 0;
        for (const double x : p) sum -= std::pow(std::log(x) / 2, 2) / 2 + std::log(x);
        if (with_sigma) return sum - squares / (2 * 0.02 * 0.02);
        // Over sigma with density 1 / sigma, in its logarithm, about where it is likely.
        const double m = 20, likely = std::log(squares / m) / 2;
        const auto over_sigma = [&](double log_sigma) {
          const double scaled = squares * std::exp(-2 * log_sigma) / 2;
          return std::exp(-m * (log_sigma - likely) - scaled + m / 2);
        };
        return sum - m * likely +
               std::log(boost::math::quadrature::gauss_kronrod<double, 61>::integrate(over_sigma, likely - 3,
                                                                                      likely + 6, 10, 1e-12));
      };
      const VectorXd a = unknowns_at({2.4, 0.31}), b = unknowns_at({1.9, 0.36});
      const double expected = log_density(a) - log_density(b);
      EXPECT_NEAR(posterior.log_density(a) - posterior.log_density(b), expected,
                  1e-10 * (1 + std::abs(expected)));
      EXPECT_EQ(posterior.at(a).value, posterior.log_density(a));
    }
}

TEST(FitPosterior, WhitensCorrelatedNoise) {
  FitSpec spec = posterior_fit(false, {"shear_rate.values"}, {}, Quantity::bin);
  spec.noise.model = NoiseModel::exponential;
  EXPECT_THROW(Posterior{spec}, InputError);
  const Estimate found = fit(spec);
  ASSERT_TRUE(found.noise);
  const Posterior of_fit(spec, found);
  spec.noise.length_z = found.noise->length_z;
  spec.noise.length_t = found.noise->length_t;
  const Posterior posterior(spec);
  const auto& rows = spec.observations.rows;
  const auto n = static_cast<Index>(rows.size());
  MatrixXd c(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Observation &a = rows[static_cast<std::size_t>(i)], &b = rows[static_cast<std::size_t>(j)];
      c(i, j) =
          std::exp(-std::abs(a.z - b.z) / *spec.noise.length_z - std::abs(a.t - b.t) / *spec.noise.length_t);
    }
  const auto log_density = [&](const VectorXd& p) {
    const VectorXd r = residuals_by_solver(spec, p);
    return -static_cast<double>(n) / 2 * std::log(r.dot(c.ldlt().solve(r)));
  };
  const VectorXd a = unknowns_at({2.4, 0.31}), b = unknowns_at({1.9, 0.36});
  const double expected = log_density(a) - log_density(b);
  EXPECT_NEAR(posterior.log_density(a) - posterior.log_density(b), expected, 1e-9 * (1 + std::abs(expected)));
  EXPECT_DOUBLE_EQ(of_fit.log_density(a), posterior.log_density(a));
}

/// The total in the coordinate is that in the unknown, and so is the part below a value in the middle: no factor is missing.
TEST(FitPosterior, ChangesVariables) {
  struct Case {
    std::string unknown;
    double lower, upper;
    Prior prior;
  };
  const std::vector<Case> cases{
      {"shear_rate.values[1]", 0.25, 0.4, {}},  // two ends
      {"shear_rate.values[1]", 1e-3, 10, {}},   // far apart: of its logarithm
      {"shear_rate.values[1]",
       0.3,
       kInfinite,
       {"", PriorKind::lognormal, 0.3, 0.1}},  // one end, near the middle
      {"initial.breaks[0]", -kInfinite, 0.51, {"", PriorKind::normal, 0.5, 0.01}},
      {"initial.breaks[0]", -kInfinite, kInfinite, {"", PriorKind::normal, 0.5, 0.01}}};
  for (const bool with_sigma : {true, false})
    for (const Case& c : cases) {
      SCOPED_TRACE(c.unknown + " from " + std::to_string(c.lower) + " to " + std::to_string(c.upper));
      FitSpec spec = posterior_fit(with_sigma, {c.unknown});
      spec.unknown.lower = {c.lower};
      spec.unknown.upper = {c.upper};
      if (c.prior.second > 0) {
        spec.priors = {c.prior};
        spec.priors[0].parameter = c.unknown;
      }
      const Posterior posterior(spec);
      const bool is_rate = c.unknown.starts_with("shear_rate");
      const double from = std::max(c.lower, is_rate ? 0.15 : 0.4), to = std::min(c.upper, 0.6);
      const double peak = posterior.log_density(unknowns_at({is_rate ? 0.31 : 0.5}));
      const auto in_p = [&](double p) { return std::exp(posterior.log_density(unknowns_at({p})) - peak); };
      const auto in_x = [&](double x) {
        return std::exp(posterior.at_coordinates(unknowns_at({x}), false).value - peak);
      };
      const auto integral = [](const auto& f, double a, double b) {
        constexpr int kParts = 100;  // the density has kinks where a path changes its kind
        double sum = 0;
        for (int k = 0; k < kParts; ++k)
          sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
              f, a + (b - a) * k / kParts, a + (b - a) * (k + 1) / kParts, 0);
        return sum;
      };
      const auto x_of = [&](double p) { return posterior.coordinates(unknowns_at({p}))[0]; };
      const double middle = is_rate ? 0.315 : 0.498;
      const double low_x = std::max(x_of(from), -12.0), high_x = std::min(x_of(to), 12.0);
      const double low_p = (*posterior.values(unknowns_at({low_x})))[0],
                   high_p = (*posterior.values(unknowns_at({high_x})))[0];
      const double below = integral(in_p, low_p, middle), above = integral(in_p, middle, high_p);
      EXPECT_GT(below, 1e-4);
      EXPECT_GT(above, 1e-4);
      EXPECT_NEAR(std::abs(integral(in_x, low_x, x_of(middle))), below, 1e-6 * below);
      EXPECT_NEAR(std::abs(integral(in_x, x_of(middle), high_x)), above, 1e-6 * above);
    }
}

/// With data that the model meets exactly J^T J is the Hessian, so it is the slope of the gradient.
TEST(FitPosterior, CurvatureIsTheHessianWhereTheDataAreMet) {
  FitSpec spec = posterior_fit(true, {"shear_rate.values", "initial.breaks"});
  const VectorXd truth = unknowns_at({0.5, 2.4, 0.31});
  const ObservationPlan plan{{0.2, 0.5, 1, 2}, {0.1, 0.3, 0.5, 0.7, 0.9}, Quantity::cumulative, 0};
  const Scene<double> bed(posterior_bed());
  const Observations exact = observe(plan, bed, solve<ExactSolver>(bed, request_of(plan, bed)));
  for (std::size_t i = 0; i < exact.rows.size(); ++i) spec.observations.rows[i].value = exact.rows[i].value;
  spec.unknown.parameters = {"initial.breaks", "shear_rate.values"};
  const Posterior posterior(spec);
  const VectorXd x = posterior.coordinates(truth);
  const MatrixXd curvature = *posterior.curvature(x);
  MatrixXd numeric(3, 3), by_x(3, 3);
  for (Index j = 0; j < 3; ++j) {
    const double h = 1e-6;
    const VectorXd step = h * VectorXd::Unit(3, j);
    numeric.col(j) = -(posterior.at(truth + step).gradient - posterior.at(truth - step).gradient) / (2 * h);
    by_x.col(j) = (*posterior.values(x + step) - *posterior.values(x - step)) / (2 * h);
  }
  const MatrixXd expected = by_x.transpose() * numeric * by_x;
  EXPECT_LT((curvature - expected).norm(), 1e-3 * expected.norm());
}

TEST(FitPosterior, PriorsNarrowBoundsAndTheLastHolds) {
  const Posterior posterior(posterior_fit(true, {"shear_rate.values", "shear_rate.breaks"},
                                          {{"shear_rate.values", PriorKind::lognormal, 1, 2},
                                           {"shear_rate.values[1]", PriorKind::uniform, 0.2, 0.4}}));
  ASSERT_EQ(posterior.size(), 3U);
  const auto place = [&](const std::string& name) {
    return std::find(posterior.names().begin(), posterior.names().end(), name) - posterior.names().begin();
  };
  const auto first = place("shear_rate.values[0]"), second = place("shear_rate.values[1]"),
             height = place("shear_rate.breaks[0]");
  EXPECT_EQ(posterior.priors()[static_cast<std::size_t>(first)].kind, PriorKind::lognormal);
  EXPECT_EQ(posterior.priors()[static_cast<std::size_t>(second)].text(), "uniform [0.2, 0.4]");
  EXPECT_EQ(posterior.priors()[static_cast<std::size_t>(height)].text(), "uniform [-inf, inf]");
  EXPECT_EQ(posterior.lower()[second], 0.2);
  EXPECT_EQ(posterior.upper()[second], 0.4);
  EXPECT_EQ(posterior.lower()[height], 0);
  VectorXd p(3);
  p[first] = 2.4, p[second] = 0.3, p[height] = 0.29;
  EXPECT_EQ(posterior.at(p).failure, "");
  p[second] = 0.5;
  const LogDensity outside = posterior.at(p);
  EXPECT_EQ(outside.value, -kInfinite);
  EXPECT_EQ(outside.failure, "outside the bounds");
  EXPECT_EQ(outside.gradient, VectorXd::Zero(3));
  EXPECT_EQ(posterior.at_coordinates(VectorXd::Constant(3, -1e4)).value, -kInfinite);
  EXPECT_FALSE(posterior.values(VectorXd::Constant(3, 1e4)));
}

TEST(FitPosterior, TakesDensitiesOfOnesOwn) {
  Prior own{"shear_rate.values[0]", PriorKind::uniform, 2.2, kInfinite};
  own.own = [](double p) { return PriorDensity{-std::pow((p - 2.4) / 0.2, 2) / 2, -(p - 2.4) / 0.04}; };
  const Posterior mine(posterior_fit(true, {"shear_rate.values"}, {own}));
  const Posterior known(
      posterior_fit(true, {"shear_rate.values"}, {{"shear_rate.values[0]", PriorKind::normal, 2.4, 0.2}}));
  const VectorXd p = unknowns_at({2.3, 0.32});
  EXPECT_NEAR(mine.log_density(p), known.log_density(p), 1e-12);
  EXPECT_LT((mine.at(p).gradient - known.at(p).gradient).norm(), 1e-10);
  EXPECT_EQ(mine.log_density(unknowns_at({2.1, 0.32})), -kInfinite);
}

/// A grid method: the gradient is by differences in the coordinates of a search, which are logarithms of rates.
TEST(FitPosterior, HasGradientsOfMethodsWithoutDerivatives) {
  FitSpec spec = posterior_fit(true, {"shear_rate.values", "initial.breaks"},
                               {{"shear_rate.values", PriorKind::lognormal, 1, 2}});
  const LogDensity exact =
      Posterior(spec).at_coordinates(Posterior(spec).coordinates(unknowns_at({2.3, 0.33, 0.5})));
  spec.forward.method = Method("muscl");
  set_option(spec.forward.method, "cells", "200", "cells");
  const Posterior posterior(spec);
  const VectorXd x = posterior.coordinates(unknowns_at({2.3, 0.33, 0.5}));
  const LogDensity at = posterior.at_coordinates(x);
  for (Index j = 0; j < 3; ++j) {
    const VectorXd step = 1e-3 * VectorXd::Unit(3, j);
    const double slope =
        (posterior.at_coordinates(x + step, false).value - posterior.at_coordinates(x - step, false).value) /
        2e-3;
    EXPECT_NEAR(at.gradient[j], slope, 0.03 * (1 + std::abs(slope))) << j;
    EXPECT_NEAR(at.gradient[j], exact.gradient[j], 0.1 * (1 + std::abs(slope))) << j;
  }
}

TEST(FitPosterior, PointsNextToShocksMakeSteps) {
  FitSpec points = posterior_fit(true, {"shear_rate.values"}, {}, Quantity::point);
  EXPECT_TRUE(Posterior(points).has_steps());
  points.misfit.quantity = "cumulative";
  EXPECT_FALSE(Posterior(points).has_steps());
}

/// The density of an unknown sigma has a pole where every residual is 0.
TEST(FitPosterior, IsInfiniteWhereUnknownNoiseIsNone) {
  FitSpec spec = posterior_fit(false, {"shear_rate.values"});
  for (Observation& o : spec.observations.rows) o.z = o.value = 0;
  const LogDensity at = Posterior(spec).at(unknowns_at({2.4, 0.31}));
  EXPECT_EQ(at.value, kInfinite);
  EXPECT_EQ(at.gradient, VectorXd::Zero(2));
}

std::string posterior_complaint(const FitSpec& spec) {
  try {
    const Posterior posterior(spec);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FitPosterior, SaysWhatIsWrongWithPriorsAndVectors) {
  const auto with = [](std::vector<Prior> priors) {
    return posterior_complaint(posterior_fit(true, {"shear_rate.values"}, std::move(priors)));
  };
  EXPECT_EQ(
      with({{"shear_rate.scale", PriorKind::normal, 1, 1}}),
      "prior = shear_rate.scale; must be an unknown of the fit: shear_rate.values[0], shear_rate.values[1]");
  EXPECT_EQ(with({{"shear_rate.values[0]", PriorKind::normal, 1, -1}}),
            "prior.shear_rate.values[0] = normal [1, -1]; must have a standard deviation > 0");
  EXPECT_EQ(with({{"shear_rate.values[0]", PriorKind::half_normal, 0}}),
            "prior.shear_rate.values[0] = half_normal [0]; must have a standard deviation > 0");
  EXPECT_EQ(with({{"shear_rate.values[0]", PriorKind::lognormal, -1, 1}}),
            "prior.shear_rate.values[0] = lognormal [-1, 1]; must have a median > 0");
  EXPECT_EQ(with({{"shear_rate.values[0]", PriorKind::normal, std::nan(""), 1}}),
            "prior.shear_rate.values[0] = normal [nan, 1]; must have finite numbers");
  EXPECT_EQ(with({{"shear_rate.values[0]", PriorKind::uniform, 1, 1}}),
            "prior.shear_rate.values[0] = uniform [1, 1]; must ascend");
  EXPECT_EQ(with({{"shear_rate.values[1]", PriorKind::uniform, 1e9, 2e9}}),
            "prior = shear_rate.values[1]; must leave room between the bounds of the unknown");
  const Posterior posterior(posterior_fit(true, {"shear_rate.values"}));
  EXPECT_THROW((void)posterior.log_density(VectorXd::Ones(3)), InputError);
  EXPECT_THROW((void)posterior.at_coordinates(VectorXd::Ones(1)), InputError);
  EXPECT_THROW((void)posterior.values(VectorXd::Ones(1)), InputError);
  EXPECT_THROW((void)posterior.coordinates(VectorXd::Ones(1)), InputError);
}

}  // namespace
}  // namespace shearfront::fit
