// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/prediction.hpp"
#include "shearfront/scene/scene.hpp"

/// What a scene file says about errors of its numbers ([uncertain]), and what follows from them.
namespace shearfront::fit {

/// Numbers of a scene that are known up to an error: normal, those that must be positive in their logarithm.
struct SceneUncertainty {
  std::vector<std::string> entries;  ///< "shear_rate.values[0]"
  Eigen::MatrixXd covariance;        ///< in the units of the entries
};

/// Reads
///
///     [uncertain]
///     shear_rate.values = 0.05            # relative standard deviation of each; or one for each: [0.05, 0.1]
///     initial.breaks    = [0.02]
///     covariance        = "covariance.csv" # instead: names of entries as header, then the matrix, a row a line
///
/// of a scene file that was read without a complaint; nothing if it has no such table. `path` is the name of the file.
/// Errors: FileError for names that are no numbers of the scene, deviations that are not > 0 or relative to 0, a file with
/// no symmetric matrix that has no negative eigenvalue.
[[nodiscard]] std::optional<SceneUncertainty> read_uncertainty(const std::string& text,
                                                               const std::string& path,
                                                               const Scene<double>& scene);

/// Scenes drawn from it, as draw_scenes() does for a fit.
[[nodiscard]] DrawnScenes draw_scenes(const Scene<double>& scene, const SceneUncertainty& uncertainty,
                                      std::size_t n, std::uint64_t seed);

}  // namespace shearfront::fit
