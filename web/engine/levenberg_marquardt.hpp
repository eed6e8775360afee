// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>

namespace shearfront::web {

/// Told of every point where the search is: evaluations so far, the misfit and the values of the unknowns there.
using Watcher = void (*)(std::size_t evaluations, double misfit, const Eigen::VectorXd& values);
void set_watcher(Watcher watcher);

}  // namespace shearfront::web
