// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront {

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
  TimelineText all{time(timeline.t0), time(timeline.t1), time(timeline.t_star), {}, text(timeline.mass),
                   text(timeline.steady_height)};
  for (const auto& at : timeline.interfaces) all.interfaces.push_back({text(at.z), time(at.first), time(at.last)});
  return all;
}

}  // namespace shearfront
