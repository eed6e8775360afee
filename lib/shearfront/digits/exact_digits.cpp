// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/digits/exact_digits.hpp"

#include <utility>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/scene/chute.hpp"

namespace shearfront {

TimelineText exact_digits(std::string text, const std::string& file, int digits,
                          const SceneChanges& changes) {
  const auto scene = parse_scene<Real110>(std::move(text), file, changes);
  if (!scene.is_chute()) return text_of(exact_timeline<Real110>(scene), digits);
  const SteadyChute<Real110> chute(scene);
  Timeline<Real110> times = exact_timeline<Real110>(chute.bed());
  times.mass *= chute.mean_velocity();
  times.steady_height = chute.height(times.steady_height);
  for (auto& at : times.interfaces) at.z = chute.height(at.z);
  return text_of(times, digits);
}

}  // namespace shearfront
