// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/model/flux/flux.hpp"

namespace shearfront {

/// How a flux goes over its range: down to one minimum and up again, the other way round, up all the way, down all the
/// way, or up and down several times.
enum class FluxCourse { minimum, maximum, rising, falling, several_extrema };

template <Real Scalar>
[[nodiscard]] FluxCourse course_of(const Flux<Scalar>& flux) {
  const StateRange<Scalar> range = flux.range();
  const std::vector<Scalar> extrema = flux.extrema();
  if (extrema.size() > 1) return FluxCourse::several_extrema;
  const Scalar lowest = flux.value(range.lowest);
  if (extrema.empty()) return flux.value(range.highest) < lowest ? FluxCourse::falling : FluxCourse::rising;
  return flux.value(extrema.front()) > lowest ? FluxCourse::maximum : FluxCourse::minimum;
}

/// No extremum inside its range: all waves go one way.
[[nodiscard]] constexpr bool is_monotone(FluxCourse course) {
  return course == FluxCourse::rising || course == FluxCourse::falling;
}

/// The state between the falling and the rising branch of a flux that has two branches at most: its extremum, or the end
/// of its range where a monotone one is least. Precondition: no several extrema.
template <Real Scalar>
[[nodiscard]] Scalar turning_state(const Flux<Scalar>& flux) {
  switch (course_of(flux)) {
    case FluxCourse::rising:
      return flux.range().lowest;
    case FluxCourse::falling:
      return flux.range().highest;
    default:
      return flux.extrema().front();
  }
}

}  // namespace shearfront
