// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/digits/exact_digits.hpp"

#include <utility>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"

namespace shearfront {

TimelineText exact_digits(std::string text, const std::string& file, int digits,
                          const SceneChanges& changes) {
  return text_of(exact_timeline<Real110>(parse_scene<Real110>(std::move(text), file, changes)), digits);
}

}  // namespace shearfront
