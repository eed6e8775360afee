// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace shearfront::fit {

/// What is known of an unknown before the data: [prior] of a fit file. The misfit of a fit does not see it; samples of the
/// posterior do (Python: problem.posterior()).
enum class PriorKind {
  uniform,     ///< [low, high]
  normal,      ///< [mean, standard deviation]
  lognormal,   ///< [median, standard deviation of the logarithm]
  half_normal  ///< [standard deviation], of the normal number whose absolute value it is
};
inline constexpr std::array<std::string_view, 4> kPriorNames{"uniform", "normal", "lognormal", "half_normal"};

struct Prior {
  std::string parameter;  ///< an unknown, or a field for all of its entries
  PriorKind kind = PriorKind::uniform;
  double first = 0, second = 0;  ///< the numbers above; second is 0 where there is one only
};

}  // namespace shearfront::fit
