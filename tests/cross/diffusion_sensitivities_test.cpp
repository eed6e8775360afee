// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"

namespace shearfront::diffusion {
namespace {

using shearfront::support::SceneMaker;
using shearfront::support::seed_of;
using Numbers = std::vector<double>;

/// Two layers of rates, a diffusivity, and a step of two initial states: five parameters.
Problem problem_of(const Numbers& p, Ends ends, const Flux<double>& flux) {
  Problem problem;
  problem.n_cells = 40;
  problem.ends = ends;
  problem.flux = flux;
  for (std::size_t i = 0; i <= problem.n_cells; ++i) {
    const bool is_low = i < 15 || (ends == Ends::periodic && i == problem.n_cells);
    problem.rate.push_back(is_low ? p[0] : p[1]);
    problem.diffusivity.push_back(p[2] * (is_low ? 1 : 0.5));
  }
  for (std::size_t i = 0; i < problem.n_cells; ++i) problem.initial.push_back(i < 20 ? p[3] : p[4]);
  return problem;
}

/// The problem is linear in its parameters: a column is its value at a unit vector.
std::vector<Tangent> tangents_of(std::size_t n, Ends ends, const Flux<double>& flux) {
  std::vector<Tangent> all;
  for (std::size_t k = 0; k < n; ++k) {
    Numbers unit(n, 0.0);
    unit[k] = 1;
    const Problem problem = problem_of(unit, ends, flux);
    Tangent tangent;
    if (k < 2) tangent.rate = problem.rate;
    if (k == 2) tangent.diffusivity = problem.diffusivity;
    if (k > 2) tangent.initial = problem.initial;
    all.push_back(tangent);
  }
  return all;
}

struct Case {
  Ends ends;
  Flux<double> flux;
  Options options;
};

/// Distance of tangent k to a central difference of fourth order, over the largest tangent; those below 0.1
/// drown in the rounding of the differences.
double disagreement(const Case& c, const Numbers& p, const CrankNicolson& run, std::size_t k, double step) {
  const auto states = [&](double shift) {
    Numbers moved = p;
    moved[k] += shift;
    // With tangents the iteration goes on to rounding.
    CrankNicolson other(problem_of(moved, c.ends, c.flux), c.options, {Tangent{}});
    EXPECT_EQ(other.repeat(run.steps()), Status::ok);
    return Numbers(other.states().begin(), other.states().end());
  };
  const Numbers above = states(step), below = states(-step);
  const Numbers above2 = states(2 * step), below2 = states(-2 * step);
  double largest = 0.1, difference = 0;
  for (std::size_t j = 0; j < above.size(); ++j) {
    const double slope = (8 * (above[j] - below[j]) - (above2[j] - below2[j])) / (12 * step);
    largest = std::max(largest, std::abs(run.tangent(k)[j]));
    difference = std::max(difference, std::abs(run.tangent(k)[j] - slope));
  }
  return difference / largest;
}

/// Of all parameters. A step that suits one (a rate that hardly matters) is too long for another (a steep
/// front): the best of three, as a wrong tangent agrees with none.
double disagreement(const Case& c, const Numbers& p) {
  CrankNicolson run(problem_of(p, c.ends, c.flux), c.options, tangents_of(p.size(), c.ends, c.flux));
  EXPECT_EQ(run.advance_to(0.3), Status::ok) << run.message();
  double worst = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    double best = 1;
    for (const double step : {1e-3, 1e-4, 1e-5})
      best = std::min(best, disagreement(c, p, run, k, step * (k == 2 ? p[2] : 1)));
    worst = std::max(worst, best);
  }
  return worst;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Ends ends : {Ends::no_flux, Ends::neumann, Ends::periodic})
    for (const Scheme scheme : {Scheme::central, Scheme::fitted})
      for (const bool adaptive : {false, true}) {
        Options options;
        (adaptive ? options.tolerance : options.dt) = 1e-2;
        options.scheme = scheme;
        all.push_back({ends, Quadratic<double>{}, options});
        all.push_back({ends, RichardsonZaki<double>{4.7}, options});
      }
  return all;
}

TEST(DiffusionSensitivities, AgreeWithCentralDifferences) {
  SceneMaker maker(seed_of(6600));
  double worst = 0;
  for (const Case& c : cases()) {
    const Numbers p{maker.uniform(-2, 2), maker.uniform(-2, 2), std::pow(10, maker.uniform(-2.5, -0.5)),
                    maker.uniform(0.1, 0.9), maker.uniform(0.1, 0.9)};
    const double difference = disagreement(c, p);
    EXPECT_LE(difference, 1e-8) << static_cast<int>(c.ends) << " scheme "
                                << static_cast<int>(c.options.scheme) << " dt " << c.options.dt;
    worst = std::max(worst, difference);
  }
  std::cout << "largest difference: " << worst << '\n';
}

TEST(DiffusionSensitivities, DoNotSteer) {
  const Numbers p{1.5, 0.5, 0.02, 0.3, 0.7};
  for (const Scheme scheme : {Scheme::central, Scheme::fitted}) {
    Options options;
    options.tolerance = 1e-3;
    options.scheme = scheme;
    const Problem problem = problem_of(p, Ends::no_flux, Quadratic<double>{});
    CrankNicolson one(problem, options, {Tangent{}});
    CrankNicolson all(problem, options, tangents_of(p.size(), Ends::no_flux, Quadratic<double>{}));
    one.advance_to(1);
    all.advance_to(1);
    EXPECT_TRUE(std::equal(one.states().begin(), one.states().end(), all.states().begin()));
  }
}

/// The mass depends on the initial states only.
TEST(DiffusionSensitivities, KeepTheMass) {
  const Numbers p{1.5, -0.5, 0.02, 0.3, 0.7};
  Options options;
  options.dt = 1e-2;
  CrankNicolson run(problem_of(p, Ends::no_flux, Quadratic<double>{}), options,
                    tangents_of(p.size(), Ends::no_flux, Quadratic<double>{}));
  run.advance_to(2);
  const double expected[]{0, 0, 0, 20, 20};
  for (std::size_t k = 0; k < p.size(); ++k) {
    double sum = 0;
    for (const double d : run.tangent(k)) sum += d;
    EXPECT_NEAR(sum, expected[k], 1e-11) << k;
  }
}

}  // namespace
}  // namespace shearfront::diffusion
