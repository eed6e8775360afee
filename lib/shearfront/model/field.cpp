// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/model/field.hpp"

#include <cmath>

namespace shearfront {

std::string range_text(const FieldInfo& info) {
  const auto [low, high, are_included] = info.limits;
  std::string text;
  if (are_included && std::isfinite(low) && std::isfinite(high)) {
    text = "between " + number_text(low) + " and " + number_text(high);
  } else {
    if (std::isfinite(info.low())) text = (are_included ? ">= " : "> ") + number_text(info.low());
    if (std::isfinite(high))
      text += (text.empty() ? "" : " and ") + std::string(are_included ? "<= " : "< ") + number_text(high);
  }
  if (!info.also.empty()) text += (text.empty() ? "" : ", ") + std::string(info.also);
  return text;
}

}  // namespace shearfront
