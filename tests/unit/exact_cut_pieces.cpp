// SPDX-License-Identifier: BSD-3-Clause
// A piece cut where nothing changes: by one closed form or along routes through many, it is the same bed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/sloped_medium.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using exact::Cells;
using exact::RateForm;
using exact::SlopedMedium;
using exact::SlopedPieces;
using support::SceneMaker;

struct InitialData {
  std::vector<double> breaks, values;
};

InitialData random_data(SceneMaker& maker) {
  InitialData data{maker.heights(maker.integer(0, 4), 0, 1), {}};
  for (std::size_t i = 0; i <= data.breaks.size(); ++i)
    data.values.push_back(maker.integer(0, 2) == 0   ? maker.integer(0, 1)
                          : maker.integer(0, 6) == 0 ? 0.5
                                                     : maker.uniform(0, 1));
  return data;
}

template <class Rate>
SlopedMedium<double> bed(RateForm form, const Rate& rate, const std::vector<double>& cuts,
                         const InitialData& data) {
  std::vector<double> z{0}, low, high;
  z.insert(z.end(), cuts.begin(), cuts.end());
  z.push_back(1);
  for (std::size_t k = 0; k + 1 < z.size(); ++k) low.push_back(rate(z[k])), high.push_back(rate(z[k + 1]));
  Cells<double> cells(data.breaks, data.values, z);
  const double mass = cells.M.back();
  const std::vector<RateForm> forms(low.size(), form);
  return {SlopedPieces<double>(z, low, high, forms), std::move(cells), mass};
}

/// `contrast`: log of the largest rate over the least.
void check_cuts(RateForm form, double contrast, std::uint64_t stream, double tolerance) {
  SceneMaker maker(support::seed_of(stream));
  constexpr int kBeds = 200, kPoints = 10;
  for (int n = 0; n < kBeds; ++n) {
    const double k = maker.uniform(0.1, 1) * contrast;
    const bool is_rising = maker.integer(0, 1) == 1;
    const auto rate = [&](double z) {
      const double x = is_rising ? 1 - z : z;  // 1 where it is 0
      return form == RateForm::linear ? (1 - x) + x * std::exp(-k) : std::exp(-k * x);
    };
    const InitialData data = random_data(maker);
    const auto whole = bed(form, rate, {}, data),
               cut = bed(form, rate, maker.heights(maker.integer(1, 4), 0, 1), data);
    for (int i = 0; i < kPoints; ++i) {
      // At a jump itself, a fan stands still or almost.
      const bool is_jump = !data.breaks.empty() && maker.integer(0, 4) == 0;
      const double z = is_jump ? data.breaks[0] : maker.uniform(0, 1),
                   t = std::exp(maker.uniform(-3, 3)) / rate(maker.uniform(0, 1));
      ASSERT_NEAR(whole.best_path(z, t).value, cut.best_path(z, t).value, tolerance)
          << "stream " << stream << ", bed " << n << ", log contrast " << k << ", z = " << z << ", t = " << t;
    }
  }
}

TEST(CutPieces, ExponentialOnesAreAsTheWhole) { check_cuts(RateForm::exponential, 5, 5300, 4e-15); }
TEST(CutPieces, LinearOnesAreAsTheWhole) { check_cuts(RateForm::linear, 5, 5301, 4e-15); }
// exp is right to as many units as its argument is large, and so are times.
TEST(CutPieces, SteepExponentialOnesAreAsTheWhole) { check_cuts(RateForm::exponential, 100, 5302, 1e-14); }
// Down to the least numbers: squares of rates and dT/dh are none any more.
TEST(CutPieces, ExponentialOnesOverAllExponentsAreAsTheWhole) {
  check_cuts(RateForm::exponential, 680, 5306, 1e-14);
}
TEST(CutPieces, LinearOnesThatAlmostVanishAreAsTheWhole) { check_cuts(RateForm::linear, 100, 5303, 1e-14); }
TEST(CutPieces, FlatOnesAreAsTheWhole) { check_cuts(RateForm::linear, 0, 5304, 4e-15); }
// Of a slope of some units in the last place.
TEST(CutPieces, NearlyFlatOnesAreAsTheWhole) { check_cuts(RateForm::linear, 4e-15, 5305, 1e-13); }

// Between the jump and the knot r does not change by as much as a unit in the last place: the paths that rest at the knot, where a
// is least, have to pass through all the same.
TEST(CutPieces, ACellOfRoundingsWidthLetsPathsLeaveAKnot) {
  const double knot = 0.3337592797820762, jump = std::nextafter(knot, 0.0);
  SceneSpec<double> spec;
  spec.shear_rate = Table<double>{{0, knot, 1}, {2.84, 2.74, 4.98}};
  spec.initial_breaks = {jump};
  spec.initial_values = {0.04, 1};
  const Scene<double> scene(spec);
  spec.initial_breaks = {knot};
  const Scene<double> plain(spec);
  const ExactSolution<double> thin(scene), none(plain);
  int n_resting = 0;
  for (const double d : {1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3, 0.1})
    for (const double z : {knot - d, jump, knot, knot + d})
      for (const double t : {1e-3, 0.03, 0.09, 0.2}) {
        EXPECT_NEAR(thin.M(z, t), none.M(z, t), 1e-15) << "z = knot + " << z - knot << ", t = " << t;
        n_resting += thin.path(z, t).kind == exact::PathKind::waiting;
      }
  EXPECT_GT(n_resting, 20);
}

}  // namespace
}  // namespace shearfront
