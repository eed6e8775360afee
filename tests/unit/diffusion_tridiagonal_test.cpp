// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "shearfront/diffusion/tridiagonal.hpp"
#include "support/random_scene.hpp"

namespace shearfront::diffusion {
namespace {

using Numbers = std::vector<double>;

struct System {
  Numbers lower, upper, right;
  bool is_cyclic;

  System(shearfront::support::SceneMaker& maker, std::size_t n, bool cyclic, double largest)
      : is_cyclic(cyclic) {
    for (std::size_t i = 0; i < n; ++i) {
      lower.push_back(largest * maker.uniform(0, 1));
      upper.push_back(-largest * maker.uniform(0, 1));
      right.push_back(maker.uniform(-1, 1));
    }
  }
  [[nodiscard]] std::size_t size() const { return right.size(); }
  [[nodiscard]] Numbers dense_solution(double factor) const {
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto j = static_cast<std::size_t>(i);
      a(i, i) += 1 + factor * (lower[j] - upper[j]);
      if (i > 0 || is_cyclic) a(i, (i + n - 1) % n) -= factor * lower[j];
      if (i + 1 < n || is_cyclic) a(i, (i + 1) % n) += factor * upper[j];
    }
    const Eigen::VectorXd x = a.fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(right.data(), n));
    return {x.data(), x.data() + n};
  }
};

class TridiagonalSolve : public ::testing::TestWithParam<bool> {};

TEST_P(TridiagonalSolve, AgreesWithDenseElimination) {
  shearfront::support::SceneMaker maker(shearfront::support::seed_of(61));
  for (std::size_t n = GetParam() ? 2 : 1; n < 30; ++n) {
    const System system(maker, n, GetParam(), n % 3 == 0 ? 1e6 : 10.0);
    Tridiagonal matrix(n, GetParam());
    Numbers x = system.right, again = system.right;
    matrix.solve(0.5, system.lower, system.upper, x);
    matrix.solve_again(again);
    const Numbers expected = system.dense_solution(0.5);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(x[i], expected[i], 1e-9) << n << " rows, row " << i;
      EXPECT_EQ(x[i], again[i]) << n << " rows, row " << i;
    }
  }
}

TEST_P(TridiagonalSolve, IsBoundedByTheRightHandSide) {
  shearfront::support::SceneMaker maker(shearfront::support::seed_of(62));
  for (const double largest : {0.0, 1.0, 1e3, 1e9, 1e15}) {
    const System system(maker, 501, GetParam(), largest);
    Tridiagonal matrix(501, GetParam());
    Numbers x = system.right;
    matrix.solve(1, system.lower, system.upper, x);
    for (const double value : x) EXPECT_LE(std::abs(value), 1 + 1e-12) << largest;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, TridiagonalSolve, ::testing::Bool(),
                         [](const auto& kind) { return kind.param ? "cyclic" : "plain"; });

}  // namespace
}  // namespace shearfront::diffusion
