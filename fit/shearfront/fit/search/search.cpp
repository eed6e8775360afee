// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

std::vector<std::string> algorithm_names() { return {"ceres"}; }

bool uses_derivatives(std::string_view algorithm) { return algorithm == "ceres" || algorithm == "global"; }

SearchResult search(Objective& objective, const Eigen::VectorXd& start, const SearchSpec& spec) {
  return search_ceres(objective, start, spec);
}

}  // namespace shearfront::fit
