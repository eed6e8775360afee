// SPDX-License-Identifier: BSD-3-Clause
// What every misfit and every loss must satisfy.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/loss/skeleton.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/misfit/skeleton.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/solution/observe.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"
#include "support/identification.hpp"
#include "support/model_types.hpp"

namespace shearfront::fit {
namespace {

template <class M>
class MisfitLaws : public ::testing::Test {};
using MisfitLawsTypes = support::ModelTypes<MisfitList, SkeletonMisfit>::Type;
TYPED_TEST_SUITE(MisfitLaws, MisfitLawsTypes, support::ModelName);

constexpr Quantity kQuantities[] = {Quantity::point, Quantity::bin, Quantity::cumulative,
                                    Quantity::bed_height};

/// Exact data; heights of the bed by another solver than the one that predicts them.
Observations data_of(const support::Identification& problem, Quantity quantity) {
  if (quantity != Quantity::bed_height) return support::exact_data(problem, quantity);
  const Scene<double> scene(problem.truth);
  const ObservationPlan plan{problem.times, {}, quantity, 0};
  const double resolution = scene.is_layered() ? 0.002 : 0.05;
  return observe(plan, scene,
                 solve<FrontTrackingSolver>(scene, request_of(plan, scene), {.resolution = resolution}));
}

/// Calls check(data, quantity) for all kinds of data that the misfit takes: it must take some.
template <class Misfit, class Check>
void for_data(const support::Identification& problem, Check&& check) {
  support::Checked checked;
  for (const Quantity quantity : kQuantities) {
    Observations kind;
    kind.quantity = quantity;
    if (!Misfit::refusal(kind).empty()) continue;
    const Observations data = data_of(problem, quantity);
    SCOPED_TRACE(std::string(name_of(quantity)) + " data");
    check(data, quantity);
    checked.count();
  }
}

/// Bins and integrals need no more than the data say; other data are summed by a rule that is only nearly
/// right.
double expected_residual(Quantity data, std::string_view misfit, double spacing) {
  const bool own = name_of(data) == misfit || misfit == "skeleton";
  const bool from_bins = data == Quantity::bin && misfit == "cumulative";
  const bool from_sums = data == Quantity::cumulative && misfit == "bin";
  if (data == Quantity::bed_height) return 1e-6;  // of the other solver
  if (own || from_bins || from_sums) return 1e-13;
  return misfit == "cumulative" ? 2 * spacing
                                : 1;  // a trapezoid at each of two shocks; a value next to a jump
}

TYPED_TEST(MisfitLaws, ResidualsVanishAtTheTruth) {
  const support::Identification problem = support::example_3();
  for_data<TypeParam>(problem, [&](const Observations& data, Quantity quantity) {
    const ResidualRows rows = TypeParam::rows(data, 0, 1);
    ASSERT_GT(rows.size(), 0);
    const Parameters parameters(Scene<double>(problem.truth),
                                {{"shear_rate.values"}, {}, {}, {}, Shape::none});
    const Forward forward(parameters, {}, rows.field, rows.points);
    const Prediction at = forward.predict(parameters.start(), false);
    ASSERT_TRUE(at.is_valid()) << at.failure;
    const Eigen::VectorXd r = rows.residuals(at.values);
    double most = 0;
    for (Eigen::Index i = 0; i < r.size(); ++i)
      most = std::max(most, std::abs(r[i]) / rows.rows[static_cast<std::size_t>(i)].weight);
    EXPECT_LE(most, expected_residual(quantity, TypeParam::kName, 0.01));
  });
}

TYPED_TEST(MisfitLaws, WeightsAreTheNoiseOfTheRow) {
  for_data<TypeParam>(support::example_5(), [](Observations data, Quantity) {
    for (Observation& o : data.rows) o.sigma = 0.02;
    const ResidualRows rows = TypeParam::rows(data, 0, 1);
    ASSERT_GT(rows.size(), 0);
    std::map<std::size_t, double> coefficients;  // of a row with all before it that it continues
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
      const ResidualRows::Row& row = rows.rows[i];
      if (!row.continues) coefficients.clear();
      for (const Term& term : rows.data(i)) coefficients[term.index] += term.coefficient;
      double variance = 0, target = 0;
      for (const auto& [k, coefficient] : coefficients) {
        variance += std::pow(coefficient * 0.02, 2);
        target += coefficient * data.rows[k].value;
      }
      EXPECT_NEAR(row.weight * std::sqrt(variance), 1, 1e-12);
      EXPECT_NEAR(row.target, target, 1e-14);
    }
  });
}

/// Running sums stored as such took 8 GB for 1000 heights at 1000 times: what is stored grows with the rows.
TYPED_TEST(MisfitLaws, TermsAreAsManyAsTheRows) {
  for_data<TypeParam>(support::example_5(), [](const Observations& data, Quantity) {
    const ResidualRows rows = TypeParam::rows(data, 0, 1);
    EXPECT_LE(rows.model_terms.size() + rows.data_terms.size(), 4 * rows.rows.size());
    EXPECT_LE(rows.points.size(), 2 * data.rows.size());
  });
}

/// Away from jumps of phi: the Jacobian of the objective is the derivative of its residuals.
template <class Misfit>
void check_jacobian(const support::Identification& problem, const Observations& data) {
  const Parameters parameters(Scene<double>(problem.truth),
                              {problem.parameters, problem.start, {}, {}, Shape::none});
  const Coordinates coordinates(parameters);
  RunControl control(1000);
  Objective objective(parameters, coordinates, {}, Misfit::rows(data, 0, 1), find_loss("squared", 0),
                      control);
  const Eigen::VectorXd u = coordinates.coordinates(parameters.start());
  const Objective::Evaluation at = objective.evaluate(u, true);
  ASSERT_TRUE(at.is_valid);
  Eigen::Index compared = 0;
  for (Eigen::Index j = 0; j < u.size(); ++j) {
    Eigen::VectorXd above = u, below = u;
    above[j] += 1e-6;
    below[j] -= 1e-6;
    const Eigen::VectorXd ahead = objective.inspect(above, false).residuals;
    const Eigen::VectorXd behind = objective.inspect(below, false).residuals;
    for (Eigen::Index i = 0; i < ahead.size(); ++i) {
      const double forward = (ahead[i] - at.residuals[i]) / 1e-6,
                   backward = (at.residuals[i] - behind[i]) / 1e-6;
      if (std::abs(forward - backward) > 1e-3 * (1 + std::abs(forward))) continue;  // a jump or a kink
      EXPECT_NEAR(at.jacobian(i, j), (forward + backward) / 2, 1e-5 * (1 + std::abs(forward)))
          << i << " " << j;
      ++compared;
    }
  }
  EXPECT_GT(compared, at.jacobian.size() * 3 / 4);
}

TYPED_TEST(MisfitLaws, JacobianIsTheDerivative) {
  const support::Identification problem = support::example_5();
  for_data<TypeParam>(problem,
                      [&](const Observations& data, Quantity) { check_jacobian<TypeParam>(problem, data); });
}

template <class L>
class LossLaws : public ::testing::Test {};
using LossLawsTypes = support::ModelTypes<LossList, SkeletonLoss>::Type;
TYPED_TEST_SUITE(LossLaws, LossLawsTypes, support::ModelName);

TYPED_TEST(LossLaws, StartsAsSquaresAndRises) {
  for (const double scale : {0.1, 1.0, TypeParam::kDefaultScale, 30.0}) {
    const LossValue origin = TypeParam::value(0, scale);
    EXPECT_EQ(origin.rho, 0);
    EXPECT_EQ(origin.first, 1);
    double last = 0;
    for (double s = 1e-3; s < 1e4; s *= 1.7) {
      const LossValue here = TypeParam::value(s, scale);
      EXPECT_GT(here.rho, last);
      EXPECT_LE(here.rho, s * (1 + 1e-15));
      EXPECT_GT(here.first, 0);
      EXPECT_LE(here.second, 0);
      last = here.rho;
    }
  }
}

TYPED_TEST(LossLaws, DerivativesAgreeWithDifferences) {
  for (const double scale : {0.5, TypeParam::kDefaultScale})
    for (double s = 0.017; s < 100; s *= 1.9) {
      const double h = 1e-5 * s;
      const LossValue above = TypeParam::value(s + h, scale), below = TypeParam::value(s - h, scale);
      const LossValue here = TypeParam::value(s, scale);
      EXPECT_NEAR((above.rho - below.rho) / (2 * h), here.first, 1e-8);
      EXPECT_NEAR((above.first - below.first) / (2 * h), here.second, 1e-8 * (1 + std::abs(here.second)));
    }
}

}  // namespace
}  // namespace shearfront::fit
