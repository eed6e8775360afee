// SPDX-License-Identifier: BSD-3-Clause
// Fluxes that are neither convex nor concave: the distance of the finite volumes from front tracking falls
// with the first power of the cell size, in L1 times a logarithm. docs/evidence/fluxes.md quotes the slow tests.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

/// A bed of one layer or of those of May et al. (2010).
Scene<double> bed(const Cubic<double>& flux, bool is_layered) {
  SceneSpec<double> spec;
  spec.fluxes = {flux};
  spec.shear_rate = is_layered ? Piecewise<double>{{0.29}, {2.4, 0.31}} : Piecewise<double>{{}, {1}};
  spec.initial_breaks = {0.5};
  spec.initial_values = {0, 1};
  return Scene<double>(spec);
}

struct OrderCase {
  const char* name;
  Cubic<double> flux;
  bool is_layered;
  double t;
  friend std::ostream& operator<<(std::ostream& out, const OrderCase& p) { return out << p.name; }
};
const Cubic<double> kScaled{0.9, CubicScaling::quadratic_extremum};
const std::vector<OrderCase> kProblems{{"quadratic for comparison, one layer, t = 0.3", {0}, false, 0.3},
                                       {"one layer, t = 0.3", {0.9}, false, 0.3},
                                       {"one layer, t = 1", {0.9}, false, 1},
                                       {"two layers, t = 1", {0.9}, true, 1},
                                       {"two layers, scaled, t = 0.5", kScaled, true, 0.5}};

/// L1 distances between front tracking and the finite volumes on 250, 500, ... up to `most` cells.
template <class Solver>
std::vector<double> distances(const OrderCase& problem, std::size_t most) {
  const Scene<double> scene = bed(problem.flux, problem.is_layered);
  const SolverRequest request{{problem.t}, {}, false, false, true};
  // Its own distance from the truth: below 1e-5.
  const auto tracked = solve<FrontTrackingSolver>(scene, request, {.resolution = 2e-5});
  EXPECT_EQ(tracked.profiles.size(), 1u) << tracked.summary.message;
  std::vector<double> all;
  typename Solver::Options options;
  for (options.cells = 250; options.cells <= most; options.cells *= 2) {
    const auto cells = solve<Solver>(scene, request, options);
    EXPECT_EQ(cells.profiles.size(), 1u) << cells.summary.message;
    all.push_back(l1_distance(tracked.profiles.at(0), cells.profiles.at(0)));
  }
  return all;
}

// At the corners of a fan, and where a fan ends in a shock of its own speed, a monotone scheme loses a
// logarithm (Harabetian 1988 for fans): N e(N) grows by about the same amount from each N to 2 N.
template <class Solver>
void check_order(const OrderCase& problem, std::size_t most) {
  SCOPED_TRACE(std::string(Solver::kName) + ", " + problem.name);
  const std::vector<double> error = distances<Solver>(problem, most);
  constexpr double kPerDoubling = 0.3;
  std::printf("| %s | %s |", problem.name, std::string(Solver::kName).c_str());
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double doublings = static_cast<double>(i);
    EXPECT_LE(error[i] * std::exp2(doublings), error[0] * (1 + kPerDoubling * doublings)) << i;
    std::printf(" %.2e |", error[i]);
  }
  std::printf(" %.2f |\n", std::log2(error.front() / error.back()) / static_cast<double>(error.size() - 1));
}

TEST(NonConvexOrder, OneUpTo2000Cells) {
  for (const std::size_t i : {1u, 4u}) {
    check_order<EngquistOsherSolver>(kProblems[i], 2000);
    check_order<GodunovSolver>(kProblems[i], 2000);
  }
}

class NonConvexOrderTo16000 : public testing::TestWithParam<OrderCase> {};
TEST_P(NonConvexOrderTo16000, EngquistOsher) { check_order<EngquistOsherSolver>(GetParam(), 16000); }
TEST_P(NonConvexOrderTo16000, Godunov) { check_order<GodunovSolver>(GetParam(), 16000); }
INSTANTIATE_TEST_SUITE_P(Slow, NonConvexOrderTo16000, testing::ValuesIn(kProblems));

}  // namespace
}  // namespace shearfront
