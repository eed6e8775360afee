// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/fit/study/study_spec.hpp"

namespace shearfront::fit {

/// The points of a study: a row of values, one per variation, for each run. The same for the same specification.
/// Sobol sequences are those of Boost.Random (Joe & Kuo), without their first point, all 0; their order is that of
/// the variations. Cost: runs x variations numbers. Precondition: no design fit.
[[nodiscard]] std::vector<std::vector<double>> study_points(const StudySpec& spec);

/// How many runs a design has.
[[nodiscard]] std::size_t n_runs(const StudySpec& spec);

}  // namespace shearfront::fit
