// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/warnings.hpp"

namespace shearfront::fit {

std::vector<std::string> warnings(const FitSpec&, const Parameters&, const Objective&, const Covariance&,
                                  const Objective::Evaluation&, const Estimate&) {
  return {};
}

}  // namespace shearfront::fit
