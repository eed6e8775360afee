// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// The event times an experimenter looks for (May et al. 2010, Section 3). A time that never comes is empty.
///
///   t0      first wave at the bottom wall: phi next to the wall leaves its initial value. 0 if the wall
///           itself sends out a wave at once (initial phi there is neither 0 nor 1), empty if it never changes.
///   t1      the same at the top wall.
///   first   first wave at an interface: 0 if the initial states there are not at rest.
///   last    last wave at an interface: afterwards phi keeps its final value on both sides. Empty if there is
///           none at all.
///   t_star  steady time: nothing moves any more. 0 if the initial state is steady, empty if the bed never rests: a flux
///           without slope at a pure state lets the last grains settle ever more slowly.
template <Real Scalar>
struct Timeline {
  struct InterfaceTimes {
    Scalar z;
    std::optional<Scalar> first, last;
  };
  std::optional<Scalar> t0, t1, t_star;
  std::vector<InterfaceTimes> interfaces;  ///< breaks of a(z), bottom to top; none for smooth a(z)
  Scalar mass{0};                          ///< int phi dz
  Scalar steady_height{0};                 ///< bottom + mass: phi = 1 below it and 0 above in the end
};

/// Derivatives of the times of a Timeline with respect to some numbers of the scene. Empty where there are none: for a time that
/// never comes, or of which the solver cannot say how it changes.
struct TimelineDerivatives {
  using Numbers = std::vector<double>;
  struct AtInterface {
    Numbers first, last;
  };
  Numbers t0, t1, t_star;
  std::vector<AtInterface> interfaces;
};

/// The numbers of a Timeline as decimal texts, with as many digits as wanted; a time that never comes is empty.
struct TimelineText {
  struct InterfaceTimes {
    std::string z;
    std::optional<std::string> first, last;
  };
  std::optional<std::string> t0, t1, t_star;
  std::vector<InterfaceTimes> interfaces;
  std::string mass, steady_height;
};

/// With so many significant digits, or for 0 with the shortest texts that read back to the same double.
template <Real S>
[[nodiscard]] TimelineText text_of(const Timeline<S>& timeline, int digits) {
  const auto text = [digits](const S& x) -> std::string {
    if (digits == 0) return number_text(to_double(x));
    std::string all = x == 0 ? "0" : number_text(x, digits);
    if (all.ends_with('.')) all.pop_back();
    return all;
  };
  const auto time = [&](const std::optional<S>& t) -> std::optional<std::string> {
    return t && is_finite(*t) ? std::optional(text(*t)) : std::nullopt;
  };
  TimelineText all{time(timeline.t0),   time(timeline.t1),           time(timeline.t_star), {},
                   text(timeline.mass), text(timeline.steady_height)};
  for (const auto& at : timeline.interfaces)
    all.interfaces.push_back({text(at.z), time(at.first), time(at.last)});
  return all;
}

}  // namespace shearfront
