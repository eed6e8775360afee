// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/numeric/sum.hpp"
#include "support/random_diffusion.hpp"

namespace shearfront::diffusion {
namespace {

using shearfront::support::SceneMaker;
using shearfront::support::seed_of;

double mass(std::span<const double> states) {
  CompensatedSum<double> sum;
  for (const double phi : states) sum += phi;
  return sum.value();
}

Options random_options(SceneMaker& maker, Scheme scheme) {
  Options options;
  options.scheme = scheme;
  if (maker.integer(0, 1) == 0) {
    options.dt = std::pow(10, maker.uniform(-4, 0));
  } else {
    options.tolerance = std::pow(10, maker.uniform(-4, -1));
  }
  return options;
}

class Bed : public ::testing::TestWithParam<Ends> {};
class ClosedBed : public Bed {};        // nothing passes its ends
class BedWithoutWalls : public Bed {};  // walls make extrema

TEST_P(ClosedBed, KeepsItsMassAtEveryStep) {
  for (std::uint64_t number = 0; number < 150; ++number) {
    SceneMaker maker(seed_of(7000 + number));
    const Problem problem = support::random_problem(maker, GetParam());
    Options options = random_options(maker, number % 2 == 0 ? Scheme::central : Scheme::fitted);
    const double before = mass(problem.initial);
    CrankNicolson* running = nullptr;
    double largest = 0;
    options.progress = [&](double, std::uint64_t steps) {
      largest = std::max(largest, std::abs(mass(running->states()) - before));
      return steps < 200;
    };
    CrankNicolson run(problem, options);
    running = &run;
    run.advance_to(2);  // the law holds whether or not it gets there
    EXPECT_LE(largest, 1e-13 * std::max(before, 1.0)) << "seed " << seed_of(7000 + number);
  }
}

TEST_P(Bed, StaysInTheRangeOfItsFluxWhenFitted) {
  double beyond = 0;
  for (std::uint64_t number = 0; number < 200; ++number) {
    SceneMaker maker(seed_of(8000 + number));
    // Neumann ends: r constant, else the bounds are not proved.
    const Problem problem = support::random_problem(maker, GetParam(), GetParam() == Ends::neumann);
    Options options = random_options(maker, Scheme::fitted);
    CrankNicolson run(problem, options);
    const auto [lowest, highest] = support::range_of(problem);
    for (const double t : {0.01, 0.1, 0.5, 2.0}) {
      const Status status = run.advance_to(t);
      EXPECT_TRUE(status == Status::ok || status == Status::steady)
          << run.message() << ", seed " << seed_of(8000 + number);
      for (const double phi : run.states()) beyond = std::max({beyond, lowest - phi, phi - highest});
      EXPECT_LE(beyond, 1e-14) << "seed " << seed_of(8000 + number) << ", t = " << t;
    }
  }
  RecordProperty("beyond", std::to_string(beyond));
}

TEST_P(BedWithoutWalls, HasNoNewExtremaWhenFittedWithConstantRate) {
  for (std::uint64_t number = 0; number < 150; ++number) {
    SceneMaker maker(seed_of(9000 + number));
    const Problem problem = support::random_problem(maker, GetParam(), true);
    Options options = random_options(maker, Scheme::fitted);
    CrankNicolson run(problem, options);
    auto [lowest, highest] = std::minmax_element(problem.initial.begin(), problem.initial.end());
    double low = *lowest, high = *highest;
    for (const double t : {0.01, 0.1, 0.5, 2.0}) {
      run.advance_to(t);
      const auto [smallest, largest] = std::minmax_element(run.states().begin(), run.states().end());
      EXPECT_LE(low - *smallest, 1e-14) << "seed " << seed_of(9000 + number);
      EXPECT_LE(*largest - high, 1e-14) << "seed " << seed_of(9000 + number);
      low = *smallest;
      high = *largest;
    }
  }
}

std::string name_of(const ::testing::TestParamInfo<Ends>& ends) {
  return ends.param == Ends::no_flux ? "no_flux" : ends.param == Ends::neumann ? "neumann" : "periodic";
}
INSTANTIATE_TEST_SUITE_P(Ends, Bed, ::testing::Values(Ends::no_flux, Ends::neumann, Ends::periodic), name_of);
INSTANTIATE_TEST_SUITE_P(Ends, ClosedBed, ::testing::Values(Ends::no_flux, Ends::periodic), name_of);
INSTANTIATE_TEST_SUITE_P(Ends, BedWithoutWalls, ::testing::Values(Ends::neumann, Ends::periodic), name_of);

}  // namespace
}  // namespace shearfront::diffusion
