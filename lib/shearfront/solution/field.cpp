// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/field.hpp"

#include "shearfront/solution/share_integral.hpp"

namespace shearfront {

std::vector<Sample> ProfileField::at(const std::vector<double>& heights) const {
  std::vector<Sample> samples;
  samples.reserve(heights.size());
  for (const auto& value : profile_.at(heights)) samples.push_back({value.phi, value.M});
  return samples;
}

double ProfileField::integral(const ShareFunction& g) const { return share_integral(*scene_, profile_, g); }

}  // namespace shearfront
