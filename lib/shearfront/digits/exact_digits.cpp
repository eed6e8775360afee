// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/digits/exact_digits.hpp"

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/io/scene_file.hpp"

namespace shearfront {

TimelineText exact_digits(const std::string& path, int digits) {
  return text_of(exact_timeline<Real110>(read_scene<Real110>(path)), digits);
}

}  // namespace shearfront
