// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/riemann/overload.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/riemann/flux_course.hpp"

namespace shearfront {
namespace {

struct Interval {
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();

  void take(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  void take(const Interval& other) {
    take(other.least);
    take(other.most);
  }
};

/// Values that are monotone on the stretch, at its two ends.
template <class Function>
Interval between(const Function& f, double lo, double hi) {
  Interval values;
  values.take(f(lo));
  values.take(f(std::nextafter(hi, lo)));
  return values;
}

/// Part of the bed between two knots.
struct BedStretch {
  double bottom;
  Interval starting;  ///< fluxes of its initial states
  Interval room;      ///< fluxes that its states have at every height
  bool narrows;       ///< what begins in it may come to heights that have less room
};

/// Whether f, monotone on the stretch, falls on the way.
template <class Function>
bool falls(const Function& f, double lo, double hi, bool is_upward) {
  const double below = f(lo), above = f(std::nextafter(hi, lo));
  return is_upward ? above < below : below < above;
}

BedStretch stretch_of(const Scene<double>& scene, double lo, double hi, bool is_upward) {
  const Flux<double>& flux = scene.flux_at(lo);
  const auto rate_at = [&](double z) { return scene.rate_at(z); };
  const auto solid_at = [&](double z) { return scene.solid_fraction_at(z); };
  const Interval rate = between(rate_at, lo, hi), solid = between(solid_at, lo, hi);
  const double least = scene.scale() * rate.least * solid.least,
               most = scene.scale() * rate.most * solid.most;
  BedStretch stretch{lo, {}, {}, falls(rate_at, lo, hi, is_upward) || falls(solid_at, lo, hi, is_upward)};
  const auto start = [&](double share) {
    stretch.starting.take(least * flux.value(share));
    stretch.starting.take(most * flux.value(share));
  };
  start(scene.initial_share(lo));
  for (const double z : scene.initial_knots())
    if (z > lo && z < hi) start(scene.initial_share(z));
  start(scene.initial_share(std::nextafter(hi, lo)));
  const double at_lowest = flux.value(flux.range().lowest), at_highest = flux.value(flux.range().highest);
  const double low = std::min(at_lowest, at_highest), high = std::max(at_lowest, at_highest);
  stretch.room = {std::max(least * low, most * low), std::min(least * high, most * high)};
  if ((low > 0 || high < 0) && least < most) stretch.narrows = true;
  return stretch;
}

}  // namespace

std::string overload(const Scene<double>& scene) {
  std::vector<double> edges = scene.knots();
  edges.insert(edges.begin(), scene.bottom());
  edges.push_back(scene.top());
  const bool is_upward = course_of(scene.fluxes().front()) == FluxCourse::rising;
  std::vector<BedStretch> stretches;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    stretches.push_back(stretch_of(scene, edges[i], edges[i + 1], is_upward));
  if (!is_upward) std::reverse(stretches.begin(), stretches.end());
  Interval coming;
  if (scene.spec().is_periodic)
    for (const BedStretch& stretch : stretches) coming.take(stretch.starting);
  const auto& outside = is_upward ? scene.spec().outside_bottom : scene.spec().outside_top;
  if (outside) {
    const double z = is_upward ? scene.bottom() : std::nextafter(scene.top(), scene.bottom());
    const double k = scene.scale() * scene.rate_at(z) * scene.solid_fraction_at(z);
    for (const double share : outside->values) coming.take(k * scene.flux_at(z).value(share));
  }
  for (const BedStretch& stretch : stretches) {
    constexpr double kRoundings = 8;  // in the products of rates, solid fractions and fluxes
    const double slack = kRoundings * std::numeric_limits<double>::epsilon() *
                         std::max(std::abs(stretch.room.least), std::abs(stretch.room.most));
    if (stretch.narrows) coming.take(stretch.starting);
    if (coming.least < stretch.room.least - slack || coming.most > stretch.room.most + slack) {
      const bool is_much = coming.most > stretch.room.most + slack;
      return "the layer above z = " + number_text(stretch.bottom) + " has no state for the flux " +
             number_text(is_much ? coming.most : coming.least) +
             " that may come to it; its own lie between " + number_text(stretch.room.least) + " and " +
             number_text(stretch.room.most);
    }
    coming.take(stretch.starting);
  }
  return {};
}

}  // namespace shearfront
