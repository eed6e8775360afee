// SPDX-License-Identifier: BSD-3-Clause
// The Jacobian a fit uses (in double) against central differences of the exact solution in 50 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/forward.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront::fit {
namespace {

using support::SceneMaker;

struct Difference {
  double value = 0;
  bool is_smooth = false;  ///< the same kind of path on both sides and in double
};

/// Central difference in 50 digits of phi or M in one entry of the scene file.
Difference difference(const SceneSpec<double>& spec, std::size_t entry, Observable field, const Place& point,
                      int kind_in_double) {
  const Real110 h("1e-16"), z(point.z), t(point.t);
  SceneSpec<Real110> moved = scene_cast<Real110>(Scene<double>(spec)).spec();
  Real110& number = *entry_places(moved)[entry];
  const Real110 here = number;
  Real110 values[2];
  bool same = true;
  for (int side = 0; side < 2; ++side) {
    number = here + (side == 0 ? -h : h);
    const ExactSolution<Real110> solution{Scene<Real110>(moved)};
    const auto at = solution.at(z, t);
    same = same && static_cast<int>(solution.path(z, t).kind) == kind_in_double;
    values[side] = field == Observable::phi ? at.phi : at.M;
  }
  return {to_double(Real110((values[1] - values[0]) / (2 * h))), same};
}

void expect_jacobian(const SceneSpec<double>& spec, SceneMaker& make, const std::string& label,
                     int& compared) {
  UnknownSpec unknown;
  unknown.parameters = {"shear_rate.values", "shear_rate.scale"};
  if (!spec.initial_breaks.empty()) unknown.parameters.push_back("initial.breaks");
  if (std::get<Piecewise<double>>(spec.shear_rate).values.size() > 1)
    unknown.parameters.push_back("shear_rate.breaks");
  const Parameters parameters(Scene<double>(spec), unknown);
  const auto all = entries(spec);
  const ExactSolution<double> solution{Scene<double>(spec)};
  std::vector<Place> points;
  for (int k = 0; k < 3; ++k)
    points.push_back({std::exp(make.uniform(std::log(0.05), std::log(4.0))), make.uniform(0, 1)});
  for (const Observable field : {Observable::phi, Observable::M}) {
    const Forward forward(parameters, {}, field, points);
    ASSERT_TRUE(forward.has_derivatives());
    const Prediction at = forward.predict(parameters.start(), true);
    ASSERT_TRUE(at.is_valid());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const int kind = static_cast<int>(solution.path(points[i].z, points[i].t).kind);
      for (std::size_t j = 0; j < parameters.size(); ++j) {
        const auto entry = static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(),
                         [&](const Entry& e) { return e.name() == parameters[j].name(); }) -
            all.begin());
        const Difference numeric = difference(spec, entry, field, points[i], kind);
        if (!numeric.is_smooth) continue;
        const double exact = at.derivatives(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        EXPECT_NEAR(exact, numeric.value, 1e-10 * std::max(1.0, std::abs(numeric.value)))
            << label << (field == Observable::phi ? " phi" : " M") << " d " << parameters[j].name() << " t "
            << points[i].t << " z " << points[i].z;
        ++compared;
      }
    }
  }
}

void jacobians_of_random_scenes(std::uint64_t first, std::uint64_t count) {
  int compared = 0;
  for (std::uint64_t n = first; n < first + count; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    const int layers = make.integer(1, 5);
    const auto spec = n % 2 == 0 ? make.step(layers, make.order()) : make.data(layers, make.order(), 4);
    expect_jacobian(spec, make, "seed " + std::to_string(seed), compared);
  }
  EXPECT_GT(compared, 20 * static_cast<int>(count));  // the test must not skip its way through
}

TEST(FitJacobian, AgreesWithDifferencesIn50Digits) { jacobians_of_random_scenes(1, 10); }
TEST(SlowFitJacobian, AgreesWithDifferencesIn50DigitsFor200Scenes) { jacobians_of_random_scenes(1000, 200); }

/// p(u) and dp/du of every shape against each other, and u(p(u)) = u.
TEST(FitCoordinates, AreOneToOneAndDifferentiated) {
  const SceneSpec<double> spec = SceneMaker(1).step(5, SceneMaker::Order::falling);
  for (const Shape shape : {Shape::none, Shape::decreasing, Shape::convex}) {
    UnknownSpec unknown;
    unknown.parameters = {"initial.breaks", "shear_rate.values", "shear_rate.scale"};
    unknown.start = {0.4, 5, 3, 2, 1.5, 1.2, 0.7};
    unknown.shape = shape;
    const Parameters parameters(Scene<double>(spec), unknown);
    const Coordinates coordinates(parameters);
    const Eigen::VectorXd u = coordinates.coordinates(parameters.start());
    EXPECT_LT((coordinates.values(u) - parameters.start()).norm(), 1e-14);
    const Eigen::MatrixXd derivative = coordinates.derivative(u);
    for (Eigen::Index j = 0; j < u.size(); ++j) {
      Eigen::VectorXd above = u, below = u;
      above[j] += 1e-5;
      below[j] -= 1e-5;
      const Eigen::VectorXd numeric = (coordinates.values(above) - coordinates.values(below)) / 2e-5;
      EXPECT_LT((numeric - derivative.col(j)).norm(), 1e-8) << static_cast<int>(shape) << " column " << j;
    }
  }
}

}  // namespace
}  // namespace shearfront::fit
