// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/events.hpp"

#include <algorithm>
#include <variant>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/final_time.hpp"
#include "shearfront/exact/first_wave.hpp"
#include "shearfront/exact/general_first_wave.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

namespace {

using exact::Medium;

/// Heights of the lowest and highest initial jump where phi really changes.
template <Real Scalar>
struct RealJumps {
  std::optional<Scalar> lowest, highest;
  explicit RealJumps(const Scene<Scalar>& scene) {
    const auto& values = scene.initial_values();
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      if (values[i] == values[i + 1]) continue;
      if (!lowest) lowest = scene.initial_breaks()[i];
      highest = scene.initial_breaks()[i];
    }
  }
};

/// Whether the initial phi equals `pure` on the whole of (from, to); decided from the data, not from sums.
template <Real Scalar>
bool is_pure(const Scene<Scalar>& scene, const Scalar& from, const Scalar& to, int pure) {
  const auto& jumps = scene.initial_breaks();
  for (std::size_t i = 0; i <= jumps.size(); ++i) {
    const Scalar& lo = i == 0 ? scene.bottom() : jumps[i - 1];
    const Scalar& hi = i == jumps.size() ? scene.top() : jumps[i];
    if (lo < to && hi > from && scene.initial_values()[i] != Scalar(pure)) return false;
  }
  return true;
}

/// 1s below, 0s above, or only one of them.
template <Real Scalar>
bool is_steady(const Scene<Scalar>& scene) {
  bool seen_zero = false;
  for (const Scalar& phi : scene.initial_values()) {
    if (phi == Scalar(0)) {
      seen_zero = true;
    } else if (phi != Scalar(1) || seen_zero) {
      return false;
    }
  }
  return true;
}

template <Real Scalar>
Scalar last_time(const Scene<Scalar>& scene, const Medium<Scalar>& medium, const Scalar& z,
                 const Scalar& mass, bool is_straight) {
  const Scalar steady_height = std::min(Scalar(scene.bottom() + mass), scene.top());
  const auto amount = z < steady_height   ? exact::FinalAmount::full_below
                      : z > steady_height ? exact::FinalAmount::all_mass
                                          : exact::FinalAmount::both;
  const Scalar start =
      std::max(medium.pure_travel_time(scene.bottom(), z), medium.pure_travel_time(scene.top(), z));
  const Scalar height = scene.top() - scene.bottom();
  const Scalar t = exact::final_time(medium, z, amount, start, height);
  return is_straight ? exact::final_time_of_contacts(medium, z, amount, t, height) : t;
}

/// The times of a scene of the quadratic flux, or of the canonical form of another one, in the medium given;
/// `is_straight`: that one has straight branches.
template <Real Scalar>
Timeline<Scalar> plain_timeline(const Scene<Scalar>& scene, const Medium<Scalar>* medium,
                                bool is_straight = false) {
  Timeline<Scalar> events;
  events.mass = scene.mass();
  events.steady_height = std::min(Scalar(scene.bottom() + events.mass), scene.top());

  const RealJumps<Scalar> jumps(scene);
  const Scalar& at_bottom = scene.initial_values().front();
  const Scalar& at_top = scene.initial_values().back();
  if (at_bottom == Scalar(0)) {
    if (jumps.lowest) events.t0 = medium->pure_travel_time(*jumps.lowest, scene.bottom());
  } else if (at_bottom != Scalar(1)) {
    events.t0 = Scalar(0);
  }
  if (at_top == Scalar(1)) {
    if (jumps.highest) events.t1 = medium->pure_travel_time(*jumps.highest, scene.top());
  } else if (at_top != Scalar(0)) {
    events.t1 = Scalar(0);
  }
  events.t_star = is_steady(scene)
                      ? Scalar(0)
                      : last_time(scene, *medium, events.steady_height, events.mass, is_straight);

  if (!scene.is_layered()) return events;
  const auto add = [&](const Scalar& z, std::optional<Scalar> first) {
    typename Timeline<Scalar>::InterfaceTimes times{z, std::move(first), {}};
    // Only 1 below or only 0 above: no flux ever passes z, which acts as a wall; the first wave there is the
    // last.
    if (is_pure(scene, scene.bottom(), z, 1) || is_pure(scene, z, scene.top(), 0)) {
      times.last = times.first;
    } else {
      times.last = last_time(scene, *medium, z, events.mass, is_straight);
      // The same wave can be the first and the last: rounding must not order them.
      if (times.first && *times.last < *times.first) times.last = times.first;
    }
    events.interfaces.push_back(std::move(times));
  };
  if (const auto* layered = dynamic_cast<const exact::LayeredMedium<Scalar>*>(medium))
    for (std::size_t i = 1; i < layered->layers().n_layers(); ++i)
      add(layered->layers().boundary(i), exact::first_wave(*layered, i, events.mass));
  if (const auto* general = dynamic_cast<const exact::GeneralMedium<Scalar>*>(medium))
    for (std::size_t i = 1; i < general->layers().n_layers(); ++i)
      add(general->layers().boundary(i), exact::first_wave(*general, i, events.mass, *events.t_star));
  return events;
}

}  // namespace

template <Real Scalar>
Timeline<Scalar> exact_timeline(const Scene<Scalar>& scene, TimelineOptions options) {
  if (scene.is_plain()) {
    const std::size_t n = options.layers > 0 ? options.layers : ExactSolution<Scalar>::kDefaultLayers;
    return plain_timeline(scene, exact::make_medium(scene, n).get());
  }
  const ExactSolution<Scalar> solution(scene, {options.layers});
  const exact::CanonicalForm<Scalar>& form = *solution.canonical_form();
  const bool is_straight =
      std::any_of(scene.fluxes().begin(), scene.fluxes().end(),
                  [](const Flux<Scalar>& flux) { return std::holds_alternative<Triangular<Scalar>>(flux); });
  Timeline<Scalar> events = plain_timeline(form.image(), &solution.medium(), is_straight);
  events.mass = solution.mass();
  events.steady_height = solution.steady_height();
  if (!scene.is_layered()) {
    events.interfaces.clear();
    events.steady_height = scene.steady_height();  // of the smooth c, not of its staircase
  }
  for (std::size_t i = 0; i < events.interfaces.size(); ++i)
    events.interfaces[i].z = form.layers().boundary(i + 1);
  return events;
}

template Timeline<Instantiated> exact_timeline<Instantiated>(const Scene<Instantiated>&, TimelineOptions);

}  // namespace shearfront
