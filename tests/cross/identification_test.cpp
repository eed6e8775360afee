// SPDX-License-Identifier: BSD-3-Clause
// Known coefficients found again: Examples 3 to 6 of Buerger, Martinez, Villada (2023), exact data and data
// of another solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fv/engquist_osher_solver.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/identification.hpp"
#include "support/table_bed.hpp"

namespace shearfront::fit {
namespace {

using namespace support;

constexpr Quantity kQuantities[] = {Quantity::point, Quantity::bin, Quantity::cumulative};

std::vector<Identification> examples() { return {example_3(), example_4(), example_5(), example_6()}; }

std::string label(const Identification& problem, Quantity quantity) {
  return "Example " + problem.name + ", " + std::string(name_of(quantity));
}

TEST(Identification, FindsTheCoefficientsFromExactData) {
  for (const Identification& problem : examples())
    for (const Quantity quantity : kQuantities) {
      const Estimate estimate = fit(fit_of(problem, exact_data(problem, quantity)));
      EXPECT_EQ(estimate.status, Status::ok) << label(problem, quantity) << ": " << estimate.message;
      EXPECT_LE(problem.error(estimate), 1e-10) << label(problem, quantity);
      EXPECT_LE(estimate.evaluations, 25U) << label(problem, quantity);
    }
}

TEST(Identification, PredictsTheObservationsInTheirOwnOrder) {
  const Identification problem = example_3();
  for (const Quantity quantity : {Quantity::bin, Quantity::cumulative}) {
    Observations data = exact_data(problem, quantity);
    std::reverse(data.rows.begin(), data.rows.end());
    const Estimate estimate = fit(fit_of(problem, data));
    ASSERT_EQ(estimate.predicted.size(), data.rows.size());
    for (std::size_t k = 0; k < data.rows.size(); ++k)
      EXPECT_NEAR(estimate.predicted[k], data.rows[k].value, 1e-8) << label(problem, quantity);
  }
}

TEST(Identification, FindsTheConvexShapeOfExample4) {
  for (const Shape shape : {Shape::decreasing, Shape::convex}) {
    const Identification problem = example_4();
    FitSpec spec = fit_of(problem, exact_data(problem, Quantity::cumulative));
    spec.unknown.shape = shape;
    const Estimate estimate = fit(spec);
    EXPECT_LE(problem.error(estimate), 1e-10);
    EXPECT_LE(estimate.evaluations, 25U);
  }
}

TEST(Identification, FindsTheInterfaceAndTheInitialJumpToo) {
  Identification problem = example_3();
  problem.parameters = {"shear_rate.values", "shear_rate.breaks", "initial.breaks"};
  for (const double off : {0.05, -0.05})
    for (const Quantity quantity : kQuantities) {
      FitSpec spec = fit_of(problem, exact_data(problem, quantity));
      spec.unknown.start = {2.5, 0.7, 0.29 + off, 0.5 - off};
      const Estimate estimate = fit(spec);
      EXPECT_LE(problem.error(estimate), 1e-8) << label(problem, quantity) << ", off by " << off;
      ASSERT_TRUE(estimate.usable());
      EXPECT_NEAR(estimate.parameters[2].estimate, 0.29, 1e-8) << label(problem, quantity);
      EXPECT_NEAR(estimate.parameters[3].estimate, 0.5, 1e-8) << label(problem, quantity);
    }
}

/// The smallest coefficients of a layer the data hardly see may be off by their noise; here all are seen.
double root_mean_square_error(const Identification& problem, const std::string& loss, double outliers) {
  constexpr int kReplicates = 10;
  double sum = 0;
  for (int n = 1; n <= kReplicates; ++n) {
    boost::random::mt19937_64 engine(static_cast<std::uint64_t>(n));
    boost::random::normal_distribution<double> noise(0, 0.01);
    boost::random::uniform_01<double> uniform;
    Observations data = exact_data(problem, Quantity::bin);
    for (Observation& o : data.rows) {
      o.value += noise(engine);
      const double lot = uniform(engine), gross = uniform(engine);
      if (lot < outliers) o.value = 3 * gross - 1;
    }
    FitSpec spec = fit_of(problem, data);
    spec.misfit.loss = loss;
    sum += std::pow(problem.error(fit(spec)), 2);
  }
  return std::sqrt(sum / kReplicates);
}

TEST(Identification, GrossErrorsDoNotDoubleTheErrorOfRobustLosses) {
  for (const Identification& problem : {example_3(), example_5()})
    for (const std::string loss : {"huber", "cauchy"}) {
      const double clean = root_mean_square_error(problem, loss, 0);
      EXPECT_LT(root_mean_square_error(problem, loss, 0.1), 2 * clean)
          << "Example " << problem.name << " " << loss;
    }
}

/// Point values of the Engquist-Osher scheme with 10000 cells, as in the paper.
Observations engquist_osher_data(const Identification& problem) {
  SolverRequest request;
  request.times = problem.times;
  request.heights = problem.heights;
  EngquistOsherSolver::Options options;
  options.cells = 10'000;
  const SolverResult result = solve<EngquistOsherSolver>(Scene<double>(problem.truth), request, options);
  Observations data = exact_data(problem, Quantity::point);
  for (std::size_t i = 0; i < data.rows.size(); ++i) data.rows[i].value = result.samples[i].phi;
  return data;
}

TEST(SlowIdentification, FindsTheCoefficientsFromDataOfAnotherSolver) {
  const double bounds[] = {2e-2, 5e-3, 1e-3, 1e-2};
  std::size_t i = 0;
  for (const Identification& problem : examples()) {
    const Estimate estimate = fit(fit_of(problem, engquist_osher_data(problem)));
    EXPECT_LE(problem.error(estimate), bounds[i++]) << "Example " << problem.name;
  }
}

/// All values of a table at once from exact data: one derivative that is wrong in one kind of path would stop the search short.
TEST(Identification, FindsTheTwelveValuesOfATable) {
  Identification problem;
  problem.name = "42 mm";
  problem.truth = bed_of_42_mm();
  const auto& table = std::get<Table<double>>(problem.truth.shear_rate);
  for (const double z : table.z) problem.start.push_back(0.4 * std::exp(-z / 16));
  for (int i = 0; i < 40; ++i) problem.times.push_back(20 * std::pow(1.12, i));
  for (int i = 0; i < 42; ++i) problem.heights.push_back(0.5 + i);
  const Estimate estimate = fit(fit_of(problem, exact_data(problem, Quantity::cumulative)));
  ASSERT_EQ(estimate.status, Status::ok) << estimate.message;
  ASSERT_EQ(estimate.parameters.size(), table.values.size());
  for (std::size_t i = 0; i < table.values.size(); ++i)
    EXPECT_NEAR(estimate.parameters[i].estimate, table.values[i], 1e-8 * table.values[i])
        << "z " << table.z[i];
  EXPECT_LE(estimate.evaluations, 40U);
}

}  // namespace
}  // namespace shearfront::fit
