// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "shearfront/model/close_packing/all.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/model/start/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/scene/scene.hpp"

/// What `shearfront list` says an entry must be (range_text) is what is enforced: every entry of every model is driven to just
/// inside and just outside of it.
namespace shearfront {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// An entry of a scene; of an array its first element.
struct Listed {
  std::string name;
  FieldInfo info;
  double value = 0;
  std::size_t size = 1;
};

std::vector<Listed> listed(SceneSpec<double> spec) {
  std::vector<Listed> all;
  visit_fields(spec, [&](const std::string& name, const FieldInfo& info, auto& member) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
      all.push_back({name, info, member, 1});
    else if (!member.empty())
      all.push_back({name, info, member[0], member.size()});
  });
  return all;
}

/// Whether a scene with another number in place of element `i` of an entry is refused because of it.
bool is_refused(SceneSpec<double> spec, const std::string& entry, double value, std::size_t i = 0) {
  visit_fields(spec, [&](const std::string& name, const FieldInfo&, auto& member) {
    if (name != entry) return;
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
      member = value;
    else
      member[i] = value;
  });
  // The states of a start are checked together, and the ends of the domain.
  const bool is_start = spec.initial_state && entry.starts_with("initial.");
  for (const Complaint& complaint : find_complaints(spec))
    if (complaint.key == entry || complaint.key.starts_with(entry + "[") ||
        (is_start && complaint.key == "initial.model") ||
        (entry.starts_with("domain.") && complaint.key.starts_with("domain.")))
      return true;
  return false;
}

bool says(const FieldInfo& info, std::string_view words) {
  return info.also.find(words) != std::string::npos;
}

/// What depends on other numbers: a value on the wrong side of it.
void check_words(const SceneSpec<double>& spec, const Listed& entry, int& n_words) {
  const auto refuses = [&](double value, std::size_t i = 0) {
    EXPECT_TRUE(is_refused(spec, entry.name, value, i)) << entry.name << " = " << value;
    ++n_words;
  };
  const double height = spec.top - spec.bottom;
  const std::size_t before = static_cast<std::size_t>(n_words);
  if (says(entry.info, "inside the domain")) refuses(spec.bottom), refuses(spec.top);
  if (says(entry.info, "ascending") && entry.size > 2) refuses(entry.value, 2);
  if (says(entry.info, "ascending") && entry.size == 2) refuses(entry.value, 1);
  if (says(entry.info, "from bottom to top")) refuses(spec.bottom + 0.01 * height);
  if (says(entry.info, "from 0 to 1")) refuses(0.01);
  if (says(entry.info, "of the flux")) refuses(1e6), refuses(-1e6);
  if (says(entry.info, "less than jam")) refuses(1);
  if (says(entry.info, "s a(z) a positive")) ++n_words;  // whatever s is, it depends on a: see below
  if (says(entry.info, "a positive number") && !says(entry.info, "s a(z)")) refuses(1e-4 * height);
  if (says(entry.info, "1e5 waves")) {
    refuses(0.99e-5 * height);
    EXPECT_FALSE(is_refused(spec, entry.name, 1.01e-5 * height));
  }
  if (says(entry.info, "bottom below top")) refuses(entry.name == "domain.bottom" ? spec.top : spec.bottom);
  EXPECT_TRUE(entry.info.also.empty() || static_cast<std::size_t>(n_words) > before || entry.size == 1)
      << entry.name << ": nobody looks at \"" << entry.info.also << '"';
}

/// Just inside and just outside of the limits that are numbers. Where words stand beside them, inside may not be enough.
void check_limits(const SceneSpec<double>& spec, const Listed& entry, int& n_limits) {
  const Limits& limits = entry.info.limits;
  const auto check = [&](double limit, double outwards) {
    if (!std::isfinite(limit)) return;
    const double inside = limits.are_included ? limit : std::nextafter(limit, -outwards);
    const double outside = limits.are_included ? std::nextafter(limit, outwards) : limit;
    EXPECT_TRUE(is_refused(spec, entry.name, outside)) << entry.name << " = " << outside;
    if (entry.info.also.empty() && inside != 0) {
      EXPECT_FALSE(is_refused(spec, entry.name, inside)) << entry.name << " = " << inside;
    }
    ++n_limits;
  };
  check(entry.info.low(), -kInfinite);
  check(limits.high, kInfinite);
  EXPECT_TRUE(is_refused(spec, entry.name, std::nan(""))) << entry.name;
  const bool is_free = range_text(entry.info).empty();
  for (const double x : {-1e3, 1e3})
    if (is_free && entry.size == 1) {
      EXPECT_FALSE(is_refused(spec, entry.name, x)) << entry.name << " = " << x;
    }
}

struct Counts {
  int entries = 0, limits = 0, words = 0;
};
void check_all(const SceneSpec<double>& spec, std::string_view prefix, Counts& counts) {
  ASSERT_TRUE(find_complaints(spec).empty()) << prefix << ": " << find_complaints(spec).front().text();
  for (const Listed& entry : listed(spec)) {
    // Of D, 0 stands for none, and is as good.
    if (!entry.name.starts_with(prefix) || (entry.name == "diffusion.D" && prefix != entry.name)) continue;
    ++counts.entries;
    check_limits(spec, entry, counts.limits);
    check_words(spec, entry, counts.words);
  }
}

/// One state everywhere, periodic: any flux is possible.
SceneSpec<double> uniform() {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0};
  spec.is_periodic = true;
  return spec;
}

TEST(ListRanges, OfEveryModelAreEnforced) {
  Counts counts;
  FluxList<double>::for_each([&]<class F>() {
    for (const F& sample : F::samples()) {
      SceneSpec<double> spec = uniform();
      spec.fluxes = {sample};
      spec.initial_values = {sample.range().lowest};
      check_all(spec, "flux.", counts);
    }
  });
  DepthFunctionList<double>::for_each([&]<class A>() {
    for (const A& sample : A::samples()) {
      SceneSpec<double> spec = uniform();
      const std::vector<double> knots = sample.knots();
      spec.top = knots.empty() ? 1 : 2 * knots.back();
      sample.fields(sample, [&](const FieldInfo& info, const auto& member) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, double>)
          if (info.key == "z") spec.bottom = member.front(), spec.top = member.back();
      });
      spec.shear_rate = sample;
      if (!find_complaints(spec).empty()) continue;  // of another domain
      check_all(spec, "shear_rate.", counts);
      spec.temperature = sample;
      spec.solid_fraction = sample;
      spec.diffusion.emplace().D = 0.1;
      spec.diffusion->variation = sample;
      if (!find_complaints(spec).empty()) continue;  // only a(z) may jump in a table
      for (const char* prefix : {"solid_fraction.", "temperature.", "diffusion."})
        check_all(spec, prefix, counts);
    }
  });
  InitialStateList<double>::for_each([&]<class P>() {
    for (const P& sample : P::samples()) {
      SceneSpec<double> spec = uniform();
      spec.initial_state = sample;
      spec.initial_values.clear();
      sample.fields(sample, [&](const FieldInfo& info, const auto& member) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, double>)
          if (info.key == "z") spec.bottom = member.front(), spec.top = member.back();
      });
      spec.is_periodic = false;
      if (!find_complaints(spec).empty()) continue;  // of another flux
      check_all(spec, "initial.", counts);
    }
  });
  ClosePackingList<double>::for_each([&]<class C>() {
    for (const C& sample : C::samples()) {
      SceneSpec<double> spec = uniform();
      spec.close_packing = sample;
      check_all(spec, "close_packing.", counts);
    }
  });
  EXPECT_GE(counts.entries, 60);
  EXPECT_GE(counts.limits, 50);
  EXPECT_GE(counts.words, 30);
}

TEST(ListRanges, OfTheRestOfASceneAreEnforced) {
  Counts counts;
  SceneSpec<double> spec = uniform();
  spec.is_periodic = false;
  spec.initial_breaks = {0.25, 0.5, 0.75};
  spec.initial_values = {0, 1, 0.5, 0.25};
  spec.outside_bottom = OutsideState<double>{{1, 2, 3}, {0, 1, 0.5, 1}};
  spec.outside_top = OutsideState<double>{{1, 2, 3}, {0, 1, 0.5, 1}};
  spec.fluxes.push_back(spec.fluxes.front());
  spec.flux_breaks = {0.5};
  for (const char* prefix : {"shear_rate.scale", "initial.", "domain.", "boundary.", "flux[1].above"})
    check_all(spec, prefix, counts);
  SceneSpec<double> none = uniform();
  none.diffusion.emplace().D = 0;
  none.is_periodic = false;
  check_all(none, "diffusion.D", counts);
  EXPECT_EQ(counts.entries, 11);
}

TEST(ListRanges, TheScaleKeepsTheRateANumber) {
  SceneSpec<double> spec = uniform();
  spec.shear_rate = Piecewise<double>{{}, {1e-200}};
  EXPECT_TRUE(is_refused(spec, "shear_rate.scale", 1e-200));
  EXPECT_FALSE(is_refused(spec, "shear_rate.scale", 1e-100));
}

// As it is printed.
TEST(ListRanges, AreWords) {
  EXPECT_EQ(range_text({.key = "x"}), "");
  EXPECT_EQ(range_text({.key = "x", .range = Range::positive}), "> 0");
  EXPECT_EQ(range_text({.key = "x", .range = Range::positive, .limits = {.low = 1}}), "> 1");
  EXPECT_EQ(range_text({.key = "x", .range = Range::positive, .limits = {.high = 0.95}}), "> 0 and < 0.95");
  EXPECT_EQ(range_text({.key = "x", .limits = {.high = 0}}), "< 0");
  EXPECT_EQ(range_text({.key = "x", .limits = {0, 1, true}}), "between 0 and 1");
  EXPECT_EQ(range_text({.key = "x", .limits = {.low = 0, .are_included = true}}), ">= 0");
  EXPECT_EQ(range_text({.key = "x", .range = Range::positive, .also = "less than jam"}),
            "> 0, less than jam");
}

}  // namespace
}  // namespace shearfront
