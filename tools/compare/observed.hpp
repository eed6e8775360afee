// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "compare/race.hpp"

namespace shearfront::tools {

/// Event times by every method beside the exact ones. An empty time never comes, or is not seen.
struct ObservedEvents {
  struct Row {
    std::string method;
    double resolution = 0;
    std::vector<std::optional<double>> times;
  };
  std::vector<std::string> names;
  std::vector<std::optional<double>> exact;
  std::vector<Row> rows;
};

/// Methods with a timeline give their own. Of the others, profiles are observed
/// (solution/observed_events.hpp) from 0 to 1.25 t*: at 65 times first, then twice at 16 more in every
/// interval where something is seen to happen. A ladder ends as in race(); exact methods and methods that
/// only differ in how profiles are drawn are left out.
[[nodiscard]] ObservedEvents observe_events(const Scene<double>& scene,
                                            const std::vector<Contestant>& contestants,
                                            const Ladders& ladders, const RaceLimits& limits);

}  // namespace shearfront::tools
