// SPDX-License-Identifier: BSD-3-Clause
// Gradients of misfits by one pass backwards over a run against the Jacobian, which is carried forwards: of random layered beds of
// every flux, of every kind of residuals, noise, loss and coordinate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/misfit_function.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/posterior.hpp"
#include "shearfront/fit/search/search.hpp"
#include "shearfront/fit/unbounded_coordinates.hpp"
#include "shearfront/solver/method.hpp"
#include "shearfront/track/solver.hpp"
#include "support/fit_scenes.hpp"
#include "support/random_tracked.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using support::SceneMaker;

/// Backwards sums are made in another order.
constexpr double kRounding = 1e-10;
/// What is 0 is so up to this part of the largest.
constexpr double kNothing = 1e-13;
/// More unknowns than are differentiated forwards in any case.
constexpr std::size_t kManyUnknowns = 5;

Method tracking(double resolution = 0.05) {
  return Method::of<FrontTrackingSolver>({.resolution = resolution, .reconstruct = Reconstruction::constant});
}

/// Observations on a grid of times and heights, of numbers that have little to do with the scene: residuals are large.
Observations random_data(SceneMaker& make, const Scene<double>& scene, Quantity quantity, bool with_sigma) {
  const int n_times = make.integer(2, 4), n_heights = make.integer(3, 6);
  const double height = scene.top() - scene.bottom(), part = height / n_heights;
  Observations data;
  data.quantity = quantity;
  for (int i = 0; i < n_times; ++i) {
    const double t = (i + make.uniform(0.1, 1)) * 0.5;
    for (int k = 0; k < n_heights; ++k) {
      Observation o;
      o.t = t;
      o.z = scene.bottom() + (k + 0.5) * part;
      o.width = quantity == Quantity::bin ? part / 2 : 0;
      o.value = make.uniform(-1, 1) * (quantity == Quantity::bin ? 1 : height);
      if (with_sigma) o.sigma = make.uniform(0.3, 0.6) * (quantity == Quantity::bin ? 1 : height);
      data.rows.push_back(o);
    }
  }
  return data;
}

/// A fit of all entries of a random scene that can be differentiated, more than a few.
FitSpec random_fit(SceneMaker& make, const std::string& flux, Quantity quantity, bool with_sigma) {
  for (;;) {
    const Scene<double> scene(support::random_tracked_scene(make, flux));
    const Method method = tracking();
    std::vector<std::string> unknowns;
    for (const Entry& entry : entries(scene.spec()))
      if (method.has_derivative(scene, entry)) unknowns.push_back(entry.name());
    if (unknowns.size() < kManyUnknowns) continue;
    FitSpec spec = support::fit_of(scene.spec(), random_data(make, scene, quantity, with_sigma), unknowns);
    spec.forward.method = method;
    return spec;
  }
}

/// sum_i w_i dr_i/du against `gradient`, beside the sizes of the terms.
void expect_product(const MatrixXd& jacobian, const VectorXd& weights, const VectorXd& gradient,
                    const Parameters& parameters) {
  ASSERT_EQ(gradient.size(), jacobian.cols());
  const VectorXd expected = jacobian.transpose() * weights,
                 size = jacobian.cwiseAbs().transpose() * weights.cwiseAbs();
  for (Index j = 0; j < gradient.size(); ++j)
    EXPECT_NEAR(gradient[j], expected[j], kRounding * size[j] + kNothing * size.maxCoeff())
        << parameters[static_cast<std::size_t>(j)].name();
}

/// The objective of these rows, at its start.
void expect_gradient(const FitSpec& spec, const ResidualRows& rows, const Loss& loss,
                     bool is_tethered = false) {
  const Parameters parameters(spec.scene, spec.unknown);
  const Coordinates coordinates(parameters);
  RunControl control(1000);
  Objective objective(parameters, coordinates, spec.forward, rows, loss, control);
  ASSERT_TRUE(objective.forward().has_gradient());
  const VectorXd u = coordinates.coordinates(parameters.start());
  if (is_tethered) objective.set_tether(u.array() + 0.3, 0.7);

  const Objective::Evaluation backwards = objective.evaluate_misfit(u, true);
  ASSERT_TRUE(backwards.is_valid) << backwards.failure;
  EXPECT_EQ(backwards.jacobian.size(), 0);
  EXPECT_EQ(control.evaluations(), 1U);
  const Objective::Evaluation forwards = objective.evaluate(u, true);
  EXPECT_EQ(control.evaluations(), 2U);
  EXPECT_EQ(objective.evaluate_misfit(u, true).jacobian.size(), forwards.jacobian.size());
  EXPECT_EQ(control.evaluations(), 2U);
  ASSERT_EQ(forwards.residuals, backwards.residuals);
  EXPECT_EQ(forwards.misfit, backwards.misfit);

  VectorXd weights = forwards.residuals;
  for (double& r : weights.head(rows.size())) r *= loss(r * r).first;
  expect_product(forwards.jacobian, weights, objective.gradient(backwards), parameters);
}

ResidualRows rows_of_fit(const FitSpec& spec, std::string_view quantity) {
  return rows_of(quantity, spec, Parameters(spec.scene, spec.unknown));
}

std::string test_name(const testing::TestParamInfo<std::string>& flux) {
  std::string name = flux.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
class FitGradient : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Fluxes, FitGradient, testing::ValuesIn(support::flux_names()), test_name);

/// Single numbers, sums of those below, and bins of sums.
TEST_P(FitGradient, IsThatOfTheJacobianWithEveryLoss) {
  for (std::uint64_t n = 0; n < 12; ++n) {
    const std::uint64_t seed = support::seed_of(9100 + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const Quantity measured = n % 2 == 0 ? Quantity::bin : Quantity::cumulative;
    const FitSpec spec = random_fit(make, GetParam(), measured, n % 3 != 0);
    const std::string_view compared = name_of(n % 4 < 2 ? Quantity::bin : Quantity::cumulative);
    const char* const loss = n % 3 == 0 ? "squared" : n % 3 == 1 ? "huber" : "cauchy";
    expect_gradient(spec, rows_of_fit(spec, compared), find_loss(loss, 0.5), n % 5 == 0);
  }
}

/// Of a grid of times and heights, and of some observations of one.
TEST_P(FitGradient, IsThatOfTheJacobianWithCorrelatedNoise) {
  for (std::uint64_t n = 0; n < 8; ++n) {
    const std::uint64_t seed = support::seed_of(9200 + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    FitSpec spec = random_fit(make, GetParam(), n % 2 == 0 ? Quantity::bin : Quantity::cumulative, true);
    const bool is_grid = n % 4 < 2;
    if (!is_grid) spec.observations.rows.pop_back();
    ResidualRows rows = rows_of_fit(spec, name_of(spec.observations.quantity));
    const auto places = noise_places(spec, rows);
    ASSERT_EQ(places->is_grid(), is_grid);
    const double height = spec.scene.top() - spec.scene.bottom();
    rows.noise = std::make_shared<NoiseCovariance>(places, NoiseShape{0.4 * height, 0.7, 0.1, 0.9});
    expect_gradient(spec, rows, find_loss("squared", 0));
  }
}

/// In p and in x, with sigma and without.
TEST_P(FitGradient, OfAPosteriorIsThatOfTheJacobian) {
  for (std::uint64_t n = 0; n < 6; ++n) {
    const std::uint64_t seed = support::seed_of(9300 + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const bool with_sigma = n % 2 == 0;
    FitSpec spec = random_fit(make, GetParam(), Quantity::bin, with_sigma);
    if (n % 3 == 0) {
      spec.noise.model = NoiseModel::exponential;
      spec.noise.length_z = 0.3 * (spec.scene.top() - spec.scene.bottom());
      spec.noise.length_t = 0.5;
    }
    const Posterior posterior(spec);
    const MisfitFunction misfit(spec);
    std::vector<Entry> all;
    for (const Parameter& p : misfit.parameters()) all.push_back(p.entry);
    const UnboundedCoordinates coordinates(all, posterior.lower(), posterior.upper(), Shape::none);
    const VectorXd x = posterior.coordinates(misfit.parameters().start());
    const auto point = coordinates.at(x);
    ASSERT_TRUE(point.has_value());
    const MisfitFunction::Value forwards = misfit.at(point->p, true);
    if (!forwards.is_valid()) continue;  // what is inside the bounds by a millionth may be no scene
    const VectorXd& r = forwards.residuals;
    const VectorXd weights = -(with_sigma ? 1 : static_cast<double>(r.size()) / r.squaredNorm()) * r;
    expect_product(forwards.jacobian, weights, posterior.at(point->p).gradient, misfit.parameters());
    expect_product(forwards.jacobian * point->derivative, weights,
                   posterior.at_coordinates(x).gradient - point->slope, misfit.parameters());
  }
}

/// Twelve layers whose rates fall upwards, in coordinates that keep the shape.
FitSpec shaped_fit(Shape shape) {
  Piecewise<double> rates{{}, {3}};
  for (int k = 1; k < 12; ++k) {
    rates.breaks.push_back(k / 12.0);
    rates.values.push_back(3 * std::exp(-0.15 * k));
  }
  SceneSpec<double> truth;
  truth.initial_breaks = {0.5};
  truth.initial_values = {0.1, 0.9};
  truth.shear_rate = rates;
  ObservationPlan plan{{0.1, 0.2, 0.3, 0.5, 0.7, 1}, {}, Quantity::bin, 0.05};
  for (int k = 0; k < 20; ++k) plan.depths.push_back((k + 0.5) / 20);
  FitSpec spec =
      support::fit_of(truth, support::observed(truth, plan, 0.005, 1, false), {"shear_rate.values"});
  spec.unknown.shape = shape;
  spec.forward.method = tracking(0.02);
  return spec;
}

TEST(FitGradientOfAShape, IsThatOfTheJacobian) {
  for (const Shape shape : {Shape::none, Shape::decreasing, Shape::convex}) {
    const FitSpec spec = shaped_fit(shape);
    expect_gradient(spec, rows_of_fit(spec, "bin"), find_loss("squared", 0));
  }
}

/// dp/du = 1 turned.
TEST(FitGradientOfAShape, TurnsDerivativesAsTheCoordinatesMove) {
  for (const Shape shape : {Shape::none, Shape::decreasing, Shape::convex}) {
    const FitSpec spec = shaped_fit(shape);
    const Parameters parameters(spec.scene, spec.unknown);
    const Coordinates coordinates(parameters);
    const VectorXd u = coordinates.coordinates(parameters.start());
    const MatrixXd derivative = coordinates.derivative(u);
    for (Index j = 0; j < u.size(); ++j) {
      VectorXd above = u, below = u;
      above[j] += 1e-6, below[j] -= 1e-6;
      const VectorXd numeric = (coordinates.values(above) - coordinates.values(below)) / 2e-6;
      EXPECT_LT((derivative.col(j) - numeric).cwiseAbs().maxCoeff(), 1e-8) << j;
    }
  }
}

/// Searches that follow gradients end where least squares do.
TEST(FitGradientOfAShape, LeadsSearchesToTheMinimum) {
  const FitSpec spec = shaped_fit(Shape::none);
  const Parameters parameters(spec.scene, spec.unknown);
  const Coordinates coordinates(parameters);
  const ResidualRows rows = rows_of("bin", spec, parameters);
  const auto least = [&](const std::string& algorithm) {
    RunControl control(3000);
    Objective objective(parameters, coordinates, spec.forward, rows, find_loss("squared", 0), control);
    SearchSpec how = spec.search;
    how.algorithm = algorithm;
    how.max_evaluations = 1000;
    return search(objective, coordinates.coordinates(parameters.start()), how).misfit;
  };
  const double by_squares = least("ceres");
  for (const char* const algorithm : {"nlopt:lbfgs", "nlopt:slsqp", "nlopt:ccsa"})
    EXPECT_LT(least(algorithm), 1.01 * by_squares) << algorithm;
}

/// Sixty steps of the start, all unknown: nobody waits for refits of each.
TEST(FitGradientOfManyUnknowns, EndsWithoutProfilesThatNobodyAskedFor) {
  constexpr int kSteps = 60;
  ObservationPlan plan{{0.02, 0.05}, {}, Quantity::bin, 1.0 / kSteps};
  SceneSpec<double> truth;
  truth.shear_rate = Piecewise<double>{{}, {1}};
  truth.initial_values = {};
  for (int k = 0; k < kSteps; ++k) {
    if (k > 0) truth.initial_breaks.push_back(static_cast<double>(k) / kSteps);
    truth.initial_values.push_back(0.5 + 0.3 * std::sin(0.3 * k));
    plan.depths.push_back((k + 0.5) / kSteps);
  }
  FitSpec spec = support::fit_of(truth, support::observed(truth, plan, 0.01, 1, true), {"initial.values"});
  spec.forward.method = tracking();
  spec.search.algorithm = "nlopt:lbfgs";
  const Estimate found = fit(spec);
  ASSERT_TRUE(found.usable()) << found.message;
  for (const ParameterEstimate& p : found.parameters) {
    EXPECT_FALSE(p.check.has_value()) << p.name;
    EXPECT_FALSE(p.profile95.has_value()) << p.name;
  }
  const auto says = [](const std::string& w) { return w.find("are not checked") != std::string::npos; };
  EXPECT_EQ(std::count_if(found.warnings.begin(), found.warnings.end(), says), 1);
}

/// Nothing but front tracking with constant states goes backwards, and of few unknowns nothing does.
TEST(FitGradientIsOffered, WhereItCostsLessThanAJacobian) {
  EXPECT_TRUE(tracking().has_linear_sum());
  EXPECT_FALSE(Method::of<FrontTrackingSolver>({.reconstruct = Reconstruction::linear}).has_linear_sum());
  EXPECT_FALSE(Method("exact").has_linear_sum());
  FitSpec spec = shaped_fit(Shape::none);
  const auto has_gradient = [&](const std::vector<std::string>& unknowns, const Method& method) {
    spec.unknown.parameters = unknowns;
    spec.forward.method = method;
    const Parameters parameters(spec.scene, spec.unknown);
    const ResidualRows rows = rows_of("bin", spec, parameters);
    return Forward(parameters, spec.forward, rows.field, rows.points).has_gradient();
  };
  EXPECT_TRUE(has_gradient({"shear_rate.values"}, tracking()));
  EXPECT_FALSE(has_gradient({"shear_rate.values[0]", "initial.breaks"}, tracking()));
  EXPECT_FALSE(has_gradient({"shear_rate.values"}, Method("exact")));
}

}  // namespace
}  // namespace shearfront::fit
