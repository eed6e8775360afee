// SPDX-License-Identifier: BSD-3-Clause
// Derivatives that fronts carry, of every flux, against differences of the same tracker in 110 digits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/track/gradient.hpp"
#include "shearfront/track/linearise.hpp"
#include "shearfront/track/one_layer_grid.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/solver.hpp"
#include "shearfront/track/tracker.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/random_tracked.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

/// What a run in 110 digits says: phi and M at the places, and how it went.
struct PreciseRun {
  std::vector<Profile<Real110>::Value> values;
  std::uint64_t n_collisions = 0;
  std::size_t n_levels = 0;
};

template <class Grid>
PreciseRun precise_run_on(const Scene<Real110>& scene, const TrackOptions& options,
                          const std::vector<Place>& places) {
  const TrackingSetup<Real110, Grid> setup(scene, Real110(options.resolution));
  Tracker<Grid> tracker(setup);
  PreciseRun run;
  for (const Place& place : places) {  // by time
    tracker.advance_to(Real110(place.t));
    const Profile<Real110> profile =
        options.reconstruct == Reconstruction::linear ? linear_profile(tracker) : tracker.profile();
    run.values.push_back(profile.at(Real110(place.z)));
  }
  run.n_collisions = tracker.n_collisions();
  run.n_levels = setup.grid.n_levels();
  return run;
}

PreciseRun precise_run(const Scene<Real110>& scene, const TrackOptions& options,
                       const std::vector<Place>& places) {
  if (LevelGrid<Real110>::refusal(exact_layers(scene)).empty())
    return precise_run_on<LevelGrid<Real110>>(scene, options, places);
  if (course_of(scene.fluxes().front()) == FluxCourse::several_extrema)
    return precise_run_on<OneLayerGrid<Real110>>(scene, options, places);
  return precise_run_on<UnimodalGrid<Real110>>(scene, options, places);
}

struct Count {
  int scenes = 0, compared = 0, other_order = 0, kinks = 0;
};

void compare(const Scene<double>& scene, const TrackOptions& options, const std::vector<Place>& places,
             const std::vector<std::size_t>& wanted, const std::string& label, Count& count) {
  std::any memory;
  const Linearisation mine = FrontTrackingSolver::linearise(scene, options, places, wanted, memory);
  SCOPED_TRACE(label);
  ASSERT_TRUE(mine.summary.usable()) << label << mine.summary.message;
  ASSERT_EQ(mine.derivatives.size(), places.size() * wanted.size());
  ASSERT_EQ(mine.summary.remark, "") << label;
  const SceneSpec<Real110> spec = scene_cast<Real110>(scene).spec();
  const std::vector<Entry> all = entries(spec);
  const double floor = 1e-13 * (1 + scene.top() - scene.bottom());
  const PreciseRun here = precise_run(Scene<Real110>(spec), options, places);
  ++count.scenes;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const Real110 h("1e-30");
    PreciseRun runs[2];
    bool exist = true;
    for (const int side : {0, 1}) {
      SceneSpec<Real110> moved = spec;
      *entry_places(moved)[wanted[k]] += side == 0 ? Real110(-h) : h;
      exist = exist && find_complaints(moved).empty();
      if (exist) runs[side] = precise_run(Scene<Real110>(moved), options, places);
    }
    if (!exist) continue;  // at a bound
    if (runs[0].n_collisions != runs[1].n_collisions || runs[0].n_levels != runs[1].n_levels ||
        runs[0].n_levels != mine.summary.levels || runs[0].n_collisions != mine.summary.collisions) {
      ++count.other_order;
      continue;
    }
    std::vector<Sample> numeric;
    double largest_phi = 0, largest_M = 0;
    bool is_kink = false;  // of the flux, as a function of its numbers
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto &below = runs[0].values[i], &above = runs[1].values[i];
      const auto slope = [&](const Real110& rise) { return to_double(Real110(rise / (2 * h))); };
      numeric.push_back({slope(above.phi - below.phi), slope(above.M - below.M)});
      largest_phi = std::max(largest_phi, std::abs(numeric.back().phi));
      largest_M = std::max(largest_M, std::abs(numeric.back().M));
      const double bend = slope(above.M + below.M - 2 * here.values[i].M),
                   turn = slope(above.phi + below.phi - 2 * here.values[i].phi);
      is_kink = is_kink || std::abs(bend) > 1e-9 * std::abs(numeric.back().M) + floor ||
                std::abs(turn) > 1e-9 * std::abs(numeric.back().phi) + floor;
    }
    if (is_kink) {
      ++count.kinks;
      continue;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Sample& by = mine.derivatives[i * wanted.size() + k];
      const std::string where = label + " d " + all[wanted[k]].name() + " t " + std::to_string(places[i].t) +
                                " z " + std::to_string(places[i].z);
      EXPECT_NEAR(by.phi, numeric[i].phi, 1e-8 * (largest_phi + std::abs(numeric[i].phi)) + floor) << where;
      EXPECT_NEAR(by.M, numeric[i].M, 1e-8 * (largest_M + std::abs(numeric[i].M)) + floor) << where;
      ++count.compared;
    }
  }
}

/// Whether there is no derivative, as two states are one: the run then says so.
bool is_torn(const Scene<double>& scene, const TrackOptions& options, std::size_t entry) {
  std::any memory;
  const Place start{0, (scene.bottom() + scene.top()) / 2};
  return !FrontTrackingSolver::linearise(scene, options, {start}, {entry}, memory).summary.remark.empty();
}

class TrackingDerivatives : public testing::TestWithParam<std::string> {
 public:
  static void compare_random_scenes(int n_scenes, int n_entries, std::uint64_t first_seed) {
    Count count;
    for (int n = 0; n < n_scenes; ++n) {
      const std::uint64_t seed = support::seed_of(first_seed + static_cast<std::uint64_t>(n));
      SceneMaker make(seed);
      const Scene<double> scene(support::random_tracked_scene(make, GetParam()));
      TrackOptions options{.resolution = 0.15};
      if (n % 2 == 1) options.reconstruct = Reconstruction::linear;
      const std::string label = GetParam() + " seed " + std::to_string(seed);
      ASSERT_EQ(FrontTrackingSolver::refusal(scene, options), "") << label;
      const std::vector<Entry> all = entries(scene.spec());
      std::vector<std::size_t> wanted;
      for (std::size_t i = 0; i < all.size(); ++i)
        if (FrontTrackingSolver::derivative_refusal(scene, options, all[i]).empty() &&
            !is_torn(scene, options, i))
          wanted.push_back(i);
      while (wanted.size() > static_cast<std::size_t>(n_entries))
        wanted.erase(wanted.begin() + make.integer(0, static_cast<int>(wanted.size()) - 1));
      compare(scene, options, support::random_places(make, scene, 3), wanted, label, count);
    }
    RecordProperty("compared", count.compared);
    RecordProperty("kinks", count.kinks);
    EXPECT_EQ(count.scenes, n_scenes);
    EXPECT_GT(count.compared, n_scenes * n_entries);
    EXPECT_LT(count.other_order, n_scenes);
    EXPECT_LT(count.kinks, 2 * n_scenes);
  }
};
std::string test_name(const testing::TestParamInfo<std::string>& flux) {
  std::string name = flux.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Fluxes, TrackingDerivatives, testing::ValuesIn(support::flux_names()), test_name);
class SlowTrackingDerivatives : public TrackingDerivatives {};
INSTANTIATE_TEST_SUITE_P(Fluxes, SlowTrackingDerivatives, testing::ValuesIn(support::flux_names()),
                         test_name);

TEST_P(TrackingDerivatives, AgreeWithDifferencesIn110Digits) { compare_random_scenes(3, 2, 8100); }
/// More than 200 in all. A power of the settling flux takes a tenth of a millisecond in so many digits.
TEST_P(SlowTrackingDerivatives, AgreeWithDifferencesIn110Digits) {
  compare_random_scenes(23, GetParam() == "richardson-zaki" ? 3 : 8, 8200);
}

/// One pass backwards gives what as many columns forwards do.
TEST_P(TrackingDerivatives, BackwardsAreThoseForwards) {
  int compared = 0;
  for (std::uint64_t n = 0; n < 20; ++n) {
    const std::uint64_t seed = support::seed_of(8300 + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const Scene<double> scene(support::random_tracked_scene(make, GetParam()));
    const TrackOptions options{.resolution = 0.05};
    const std::vector<Entry> all = entries(scene.spec());
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (FrontTrackingSolver::derivative_refusal(scene, options, all[i]).empty()) wanted.push_back(i);
    std::vector<Place> places = support::random_places(make, scene, 4);
    places.push_back({places[1].t, scene.top()});
    places.push_back({places[1].t, places[0].z});
    std::vector<Sample> weights;
    for (std::size_t i = 0; i < places.size(); ++i)
      weights.push_back({make.uniform(-1, 1), make.uniform(-1, 1)});
    std::any memory;
    const Linearisation forward = FrontTrackingSolver::linearise(scene, options, places, wanted, memory);
    const LinearSum backward = tracking_gradient(
        scene, options, places, [&](const std::vector<Sample>&) { return weights; }, wanted);
    EXPECT_EQ(backward.summary.remark, forward.summary.remark);
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(backward.samples[i].M, forward.samples[i].M);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      double sum = 0, size = 0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        const Sample& by = forward.derivatives[i * wanted.size() + k];
        sum += weights[i].phi * by.phi + weights[i].M * by.M;
        size += std::abs(weights[i].phi * by.phi) + std::abs(weights[i].M * by.M);
      }
      EXPECT_NEAR(backward.gradient[k], sum, 1e-9 * size + 1e-11 * (1 + scene.top() - scene.bottom()))
          << all[wanted[k]].name();
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

/// Between walls M at the top moves as the mass does, whatever happens below.
TEST(TrackingDerivativesOfMass, AreThoseOfTheScene) {
  int compared = 0;
  for (const std::string& flux : support::flux_names())
    for (std::uint64_t n = 0; n < 30; ++n) {
      const std::uint64_t seed = support::seed_of(8500 + n);
      SceneMaker make(seed);
      const Scene<double> scene(support::random_tracked_scene(make, flux));
      if (!scene.has_walls()) continue;
      const std::vector<Entry> all = entries(scene.spec());
      for (std::size_t j = 0; j < all.size(); ++j) {
        const bool is_value = all[j].field == "initial.values";
        if (!is_value && all[j].field != "initial.breaks") continue;
        for (const Reconstruction how : {Reconstruction::constant, Reconstruction::linear}) {
          const TrackOptions options{.resolution = 0.05, .reconstruct = how};
          if (!FrontTrackingSolver::derivative_refusal(scene, options, all[j]).empty() ||
              is_torn(scene, options, j))
            continue;
          const auto& breaks = scene.initial_breaks();
          const std::size_t i = all[j].index;
          const double lo = i == 0 ? scene.bottom() : breaks[i - 1],
                       hi = i == breaks.size() ? scene.top() : breaks[i];
          const auto& values = scene.initial_values();
          const double expected = is_value ? scene.solid(lo, hi)
                                           : scene.solid_fraction_at(breaks[i]) * (values[i] - values[i + 1]);
          std::any memory;
          const Linearisation at =
              FrontTrackingSolver::linearise(scene, options, {{1.5, scene.top()}}, {j}, memory);
          EXPECT_NEAR(at.derivatives[0].M, expected, 1e-11 * (1 + scene.top() - scene.bottom()))
              << flux << " seed " << seed << " d " << all[j].name();
          ++compared;
        }
      }
    }
  EXPECT_GT(compared, 200);
}

SceneSpec<double> three_shocks(double third) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  // States u_0 > u_1 > u_2 > u_3 with shocks of speed 1 - u_i - u_(i+1) that meet in one point at t = 0.5.
  spec.initial_values = {0.9, 0.6, 0.4, 0.2};
  spec.initial_breaks = {0.5 - 0.5 * 0.5, 0.5, third};
  return spec;
}

/// Three shocks meet in one point: which two of them meet first depends on the side to which a number moves.
TEST(TrackingDerivativesWhereThereAreNone, AreReported) {
  const auto remark = [](const SceneSpec<double>& spec, const std::string& name) {
    const Scene<double> scene(spec);
    const std::vector<Entry> all = entries(spec);
    const auto entry = static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.name() == name; }) - all.begin());
    std::any memory;
    return FrontTrackingSolver::linearise(scene, {}, {{0.8, 0.5}}, {entry}, memory).summary.remark;
  };
  EXPECT_THAT(remark(three_shocks(0.7), "initial.breaks[1]"), testing::StartsWith("the order of events"));
  EXPECT_EQ(remark(three_shocks(0.72), "initial.breaks[1]"), "");

  // One of two equal states, an extremum, an end of the range: moved apart, and said.
  SceneSpec<double> equal = three_shocks(0.72);
  equal.initial_values = {0.3, 0.9, 0.3, 0.7};
  EXPECT_THAT(remark(equal, "initial.values[0]"), testing::HasSubstr("moved by some 1e-9"));
  EXPECT_EQ(remark(equal, "initial.values[1]"), "");
  equal.initial_values = {0, 0.9, 0.5, 0.7};
  EXPECT_THAT(remark(equal, "initial.values[0]"), testing::HasSubstr("moved by some 1e-9"));
  EXPECT_THAT(remark(equal, "initial.values[2]"), testing::HasSubstr("moved by some 1e-9"));
  equal.shear_rate = Piecewise<double>{{0.4}, {1, 1}};
  EXPECT_THAT(remark(equal, "shear_rate.values[1]"), testing::HasSubstr("moved by some 1e-9"));
  EXPECT_EQ(remark(equal, "shear_rate.scale"), "");
}

/// Steps that make another layer, and what front tracking does not differentiate.
TEST(TrackingDerivativesWhereThereAreNone, AreRefused) {
  const auto refusal = [](const SceneSpec<double>& spec, const std::string& name, TrackOptions options = {}) {
    const Scene<double> scene(spec);
    for (const Entry& entry : entries(spec))
      if (entry.name() == name) return FrontTrackingSolver::derivative_refusal(scene, options, entry);
    return std::string("no such entry");
  };
  SceneSpec<double> spec = three_shocks(0.72);
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 2}};
  EXPECT_EQ(refusal(spec, "initial.breaks[1]"), "initial.breaks[1] lies on another height of the scene");
  EXPECT_EQ(refusal(spec, "shear_rate.breaks[0]"),
            "shear_rate.breaks[0] lies on another height of the scene");
  EXPECT_EQ(refusal(spec, "initial.breaks[0]"), "");
  EXPECT_EQ(refusal(spec, "shear_rate.values[0]", {.grid = GridKind::singular_mapping}),
            "the states of this grid are rounded");
  SceneMaker make(1);
  spec.shear_rate = make.layers(65, SceneMaker::Order::random);
  EXPECT_EQ(refusal(spec, "shear_rate.scale"), "the bed has more than 64 layers");
  spec.shear_rate = make.layers(64, SceneMaker::Order::random);
  EXPECT_EQ(refusal(spec, "shear_rate.scale"), "");
  spec.shear_rate = Exponential<double>{};
  EXPECT_EQ(refusal(spec, "shear_rate.amplitude"), "fronts are curved");
}

}  // namespace
}  // namespace shearfront
