// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"

namespace shearfront::fit {

/// How much of the variance of an output an entry explains: alone (first), and with all its interactions (total).
struct SobolIndex {
  std::string output, entry;
  double first = 0, total = 0;
  Interval first95, total95;  ///< percentiles of 1000 bootstrap samples of the n base points
};

/// From the outputs of a design of Sobol indices, by run: f(A), f(B), then f(A with column j from B) for every entry.
///
///     first  V_j = mean f(B) (f(AB_j) - f(A)) / var f        (Saltelli et al. 2010)
///     total  T_j = mean (f(A) - f(AB_j))^2 / (2 var f)       (Jansen 1999)
///
/// Base points of which a run failed or an event never comes are left out. Errors of the indices go like 1 / sqrt(n). An
/// output that does not vary gives no index. `outputs[run][k]`; the size is n (d + 2). Cost: 1000 n d per output.
[[nodiscard]] std::vector<SobolIndex> sobol_indices(const std::vector<std::vector<double>>& outputs,
                                                    const std::vector<std::string>& output_names,
                                                    const std::vector<std::string>& entries,
                                                    std::uint64_t seed);

}  // namespace shearfront::fit
