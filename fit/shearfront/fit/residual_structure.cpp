// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/residual_structure.hpp"

namespace shearfront::fit {

std::optional<ResidualStructure> residual_structure(const Observations&, const std::vector<double>&) {
  return {};
}

}  // namespace shearfront::fit
