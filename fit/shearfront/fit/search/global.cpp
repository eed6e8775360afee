// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

SearchResult search_global(Objective& objective, const Eigen::VectorXd& start, const SearchSpec& spec) {
  return search_ceres(objective, start, spec);
}

}  // namespace shearfront::fit
