// SPDX-License-Identifier: BSD-3-Clause
// How far an entry moves before the order of events of front tracking changes, and whether it did: of every flux, against steps of half
// and of twice that size.
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/scene/entries.hpp"
#include "shearfront/track/solver.hpp"
#include "support/random_tracked.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::size_t entry_of(const SceneSpec<double>& spec, const std::string& name) {
  const std::vector<Entry> all = entries(spec);
  return static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.name() == name; }) - all.begin());
}

Linearisation linearised(const SceneSpec<double>& spec, const TrackOptions& options,
                         const std::vector<Place>& places, const std::vector<std::size_t>& wanted) {
  std::any memory;
  return FrontTrackingSolver::linearise(Scene<double>(spec), options, places, wanted, memory);
}

/// Nothing where the scene is none with the step.
std::optional<Linearisation> after_step(SceneSpec<double> spec, std::size_t entry, double step,
                                        const TrackOptions& options, const std::vector<Place>& places) {
  *entry_places(spec)[entry] += step;
  if (!find_complaints(spec).empty()) return std::nullopt;
  return linearised(spec, options, places, {entry});
}

/// An interface at rest at 1/2 between 5/8 and 3/4, whose fluxes are equal. A shock of speed 5/8 reaches it from below at t = 0.4, one
/// of speed -5/32 from above at t = 0.5.
SceneSpec<double> two_shocks_at_an_interface() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.5}, {1, 1.25}};
  spec.top = 2;
  spec.initial_values = {1, 0.625, 0.75, 0.125};
  spec.initial_breaks = {0.25, 0.5, 0.5 + 5.0 / 64};
  return spec;
}

TEST(EventOrder, OfTwoFrontsAtAnInterface) {
  const SceneSpec<double> spec = two_shocks_at_an_interface();
  const TrackOptions options{.resolution = 0.05};
  const std::vector<Place> places{{0.6, 1}};
  const std::size_t below = entry_of(spec, "initial.breaks[0]"), above = entry_of(spec, "initial.breaks[2]");
  const Linearisation at = linearised(spec, options, places, {below, above});
  ASSERT_EQ(at.summary.remark, "");
  // They come together when the first one is late by 0.1, or the second one early.
  EXPECT_NEAR(at.order_holds[0].down, 0.1 * 5 / 8, 1e-15);
  EXPECT_NEAR(at.order_holds[1].down, 0.1 * 5 / 32, 1e-15);
  for (const auto& [entry, bound] : {std::pair{below, 0.0625}, std::pair{above, 0.015625}}) {
    SCOPED_TRACE(entry);
    const auto inside = after_step(spec, entry, -0.999 * bound, options, places),
               outside = after_step(spec, entry, -1.001 * bound, options, places);
    ASSERT_TRUE(inside && outside);
    EXPECT_EQ(inside->order, at.order);
    EXPECT_NE(outside->order, at.order);
    // In either order one front is left in the end, which is where its mass is: M does not bend.
    const double by = at.derivatives[entry == below ? 0 : 1].M;
    EXPECT_NEAR(by, entry == below ? 0.375 : 0.625, 1e-15);
    EXPECT_NEAR(outside->derivatives[0].M, by, 1e-14);
  }
}

/// A shock of speed -1/4 leaves the bottom at t = 0.4, where at 0.3 the state outside changed, which sends nothing in. The two share the
/// boundary and no front.
TEST(EventOrder, OfAFrontAndAChangeOutside) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.5, 0.25};
  spec.initial_breaks = {0.1};
  spec.outside_bottom = OutsideState<double>{{0.3}, {0.5, 0.25}};
  const TrackOptions options{.resolution = 0.05};
  const std::vector<Place> places{{0.5, 0.5}};
  const std::size_t shock = entry_of(spec, "initial.breaks[0]"),
                    change = entry_of(spec, "boundary.bottom.breaks[0]");
  const Linearisation at = linearised(spec, options, places, {shock, change});
  ASSERT_EQ(at.summary.remark, "");
  EXPECT_NEAR(at.order_holds[0].down, 0.025, 1e-15);
  EXPECT_NEAR(at.order_holds[1].up, 0.1, 1e-15);
  EXPECT_EQ(after_step(spec, change, 0.099, options, places)->order, at.order);
  EXPECT_NE(after_step(spec, change, 0.101, options, places)->order, at.order);
}

/// A shock of speed 1/8 would leave the top at 0.7, but a faster front catches it 0.025 before, and what they become rests there: the
/// event that did not happen is none of a front that ends.
TEST(EventOrder, OfAFrontThatIsStoppedBeforeTheTop) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.top = 0.7;
  spec.initial_values = {0.875, 1, 0.125};
  spec.initial_breaks = {0.5, 0.65};
  spec.outside_bottom = OutsideState<double>{{}, {0.875}};
  spec.outside_top = OutsideState<double>{{}, {0.125}};
  const TrackOptions options{.resolution = 0.15};
  const std::vector<Place> places{{1, 0.6}};
  const std::size_t faster = entry_of(spec, "initial.breaks[0]"), shock = entry_of(spec, "initial.breaks[1]");
  const Linearisation at = linearised(spec, options, places, {faster, shock});
  ASSERT_EQ(at.summary.remark, "");
  // They rest at (7 z1 - z0) / 6.
  EXPECT_NEAR(at.order_holds[0].down, 6 * 0.025, 1e-14);
  EXPECT_NEAR(at.order_holds[1].up, 6.0 / 7 * 0.025, 1e-14);
  EXPECT_EQ(after_step(spec, faster, -0.149, options, places)->order, at.order);
  EXPECT_NE(after_step(spec, faster, -0.151, options, places)->order, at.order);
}

/// Two jumps of the start that come to be one.
TEST(EventOrder, OfThePiecesOfTheStart) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.25, 0.375, 0.5};  // fans, which part
  spec.initial_breaks = {0.5, 0.53125};
  spec.outside_bottom = OutsideState<double>{{}, {0.25}};
  spec.outside_top = OutsideState<double>{{}, {0.5}};
  const std::size_t entry = entry_of(spec, "initial.breaks[0]");
  const Linearisation at = linearised(spec, {.resolution = 0.15}, {{0.1, 0.5}}, {entry});
  ASSERT_EQ(at.summary.remark, "");
  EXPECT_EQ(at.order_holds[0].up, 0.03125);
}

/// What a run is told with one entry it is told with all.
TEST(EventOrder, IsThatOfTheRunWhateverEntriesAreAskedFor) {
  const SceneSpec<double> spec = two_shocks_at_an_interface();
  const TrackOptions options{.resolution = 0.05};
  const Linearisation one = linearised(spec, options, {{0.6, 1}}, {entry_of(spec, "initial.breaks[0]")}),
                      two = linearised(
                          spec, options, {{0.3, 1}, {0.6, 0.2}},
                          {entry_of(spec, "shear_rate.scale"), entry_of(spec, "initial.breaks[0]")}),
                      none = linearised(spec, options, {{0.6, 1}}, {});
  EXPECT_EQ(one.order, two.order);
  EXPECT_EQ(one.order_holds[0].down, two.order_holds[1].down);
  EXPECT_EQ(one.order_holds[0].up, two.order_holds[1].up);
  EXPECT_TRUE(none.order_holds.empty());
  EXPECT_EQ(none.order, 0u);
}

/// Steps of half the bound and of twice the bound; places where M does not follow its derivative over the first, and has another one
/// after the second.
struct Steps {
  int n = 0, changed_within = 0, kept_beyond = 0, other_levels = 0;
  int places = 0, bent_within = 0, bent_beyond = 0;
};

class EventOrders : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Fluxes, EventOrders, testing::ValuesIn(support::flux_names()),
                         [](const testing::TestParamInfo<std::string>& flux) {
                           std::string name = flux.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EventOrders, ChangeBeyondTheStepAndNotWithin) {
  // Of the number that moves: what is linear is known to some part of that. Heights and times move fronts by what is all but linear.
  constexpr double kSmall = 1e-3, kSmallPlace = 1e-2;
  Steps count;
  for (std::uint64_t n = 0; n < 200; ++n) {
    const std::uint64_t seed = support::seed_of(9000 + n);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const SceneSpec<double> spec = support::random_tracked_scene(make, GetParam());
    if (spec.is_periodic) continue;  // never at rest
    const TrackOptions options{.resolution = 0.15};
    const Scene<double> scene(spec);
    std::vector<Place> places = support::random_places(make, scene, 6);
    places.push_back({kInfinity, scene.bottom()});
    const std::vector<Entry> all = entries(spec);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!FrontTrackingSolver::derivative_refusal(scene, options, all[i]).empty()) continue;
      if (GetParam() == "table" && all[i].field.starts_with("flux.")) continue;  // M bends with its knots
      const Linearisation at = linearised(spec, options, places, {i});
      ASSERT_TRUE(at.summary.usable()) << at.summary.message;
      if (!at.summary.remark.empty()) continue;
      SceneSpec<double> numbers = spec;
      const double number = std::abs(*entry_places(numbers)[i]),
                   most =
                       (all[i].field.ends_with(".breaks") ? kSmallPlace : kSmall) * (number > 0 ? number : 1);
      for (const double side : {-1.0, 1.0}) {
        const double bound = side < 0 ? at.order_holds[0].down : at.order_holds[0].up;
        if (!(bound < most)) continue;
        const auto inside = after_step(spec, i, side * bound / 2, options, places),
                   outside = after_step(spec, i, side * bound * 2, options, places);
        if (!inside || !outside) continue;  // at a bound
        if (inside->summary.levels != at.summary.levels) {
          ++count.other_levels;
          continue;
        }
        ++count.n;
        count.changed_within += inside->order != at.order;
        count.kept_beyond += outside->order == at.order;
        double largest = 1e-9 * (scene.top() - scene.bottom());
        for (const Sample& by : at.derivatives) largest = std::max(largest, std::abs(by.M));
        for (std::size_t p = 0; p + 1 < places.size(); ++p) {
          const Sample& by = at.derivatives[p];
          // M bends as well where a front passes the place, and takes another state there.
          const auto has_other_state = [&](const Linearisation& there, double step) {
            const double moved = step * by.phi;
            return std::abs(there.samples[p].phi - at.samples[p].phi - moved) >
                   0.01 * std::abs(moved) + 1e-13;
          };
          if (has_other_state(*inside, side * bound / 2) || has_other_state(*outside, side * bound * 2))
            continue;
          const double step = side * bound / 2, quotient = (inside->samples[p].M - at.samples[p].M) / step,
                       rounding = 1e-14 * (scene.top() - scene.bottom()) / std::abs(step);
          ++count.places;
          count.bent_within += std::abs(quotient - by.M) > 0.01 * largest + rounding;
          count.bent_beyond += std::abs(outside->derivatives[p].M - by.M) > 0.01 * largest;
        }
      }
    }
  }
  RecordProperty("steps", count.n);
  RecordProperty("kept_beyond", count.kept_beyond);
  RecordProperty("bent_beyond", count.bent_beyond);
  EXPECT_GT(count.n, 20);
  EXPECT_EQ(count.changed_within, 0) << count.n;
  // Not told by the bound.
  EXPECT_LE(count.other_levels, count.n / 20) << count.n;
  // Told too soon, to first order: of a level beside an extremum by a factor of 2, and of levels that pass each other in a layer where
  // none of them has a front.
  EXPECT_LE(count.kept_beyond, count.n / 30) << count.n;
  EXPECT_LE(200 * count.bent_within, count.places) << count.bent_within;
  EXPECT_GT(count.bent_beyond, count.bent_within) << count.places;
}

}  // namespace
}  // namespace shearfront
