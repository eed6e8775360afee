// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/fit_file.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solver/method.hpp"

/// A study: the same scene many times with other numbers.
namespace shearfront::fit {

/// How an entry of the scene varies. A list has its values; the others have two numbers:
///     range       low, high, in `count` equal steps (ratios for log-range)
///     uniform     low, high;       log-uniform   low, high of a number whose logarithm is uniform
///     normal      mean, standard deviation
///     lognormal   median, standard deviation of the logarithm
enum class VariationKind { list, range, log_range, uniform, log_uniform, normal, lognormal };
inline constexpr std::array<std::string_view, 7> kVariationNames{
    "list", "range", "log-range", "uniform", "log-uniform", "normal", "lognormal"};

struct Variation {
  std::string entry;  ///< "shear_rate.values[0]"
  VariationKind kind = VariationKind::list;
  std::vector<double> values;    ///< of a list; of a range its steps
  double first = 0, second = 0;  ///< the two numbers of the others

  [[nodiscard]] bool is_finite_set() const {
    return static_cast<int>(kind) <= static_cast<int>(VariationKind::log_range);
  }
  /// The value for 0 < u < 1: the quantile of the distribution, or the entry number floor(u n) of a list or range.
  [[nodiscard]] double at(double u) const;
};

/// Which points of the variations are run.
enum class DesignKind {
  grid,             ///< all combinations of lists and ranges, the last varies fastest
  latin_hypercube,  ///< one point in each of n equal slices of every entry
  sobol,            ///< a low-discrepancy sequence
  random,           ///< independent
  indices,          ///< what Sobol indices need: two random designs and their mixtures, n (d + 2) runs
  fit,              ///< draws from the estimates of a fit with their covariance
  replicates        ///< fits of synthetic data: what the estimate predicts, with fresh noise
};
inline constexpr std::array<std::string_view, 7> kDesignNames{
    "grid", "latin-hypercube", "sobol", "random", "sobol-indices", "fit", "replicates"};

/// A number of the scene's solution.
struct StudyOutput {
  enum class Kind { t0, t1, t_star, first, last, phi, M, height, mixing, estimate, std_error, misfit };
  Kind kind = Kind::t_star;
  std::size_t interface = 0;  ///< of first and last; the number of the unknown of estimate and std_error
  double t = 0, z = 0;
  std::string name;  ///< of its column: "t_star", "t_c(1)", "phi(0.5;0.3)"
};

struct StudySpec {
  std::string name;
  std::optional<Scene<double>> scene;  ///< with the numbers that do not vary; of a fit its estimate
  std::string scene_text;              ///< for the record in the result
  Method method;
  std::vector<Variation> variations;
  DesignKind design = DesignKind::grid;
  std::size_t runs = 0;  ///< n; of a grid the product of its steps
  std::uint64_t seed = 1;
  std::vector<StudyOutput> outputs;
  std::optional<FitFile> fit_file;  ///< of design fit and replicates
};

/// Reads a study file (docs/reference/formats). Errors: FileError with every complaint.
[[nodiscard]] StudySpec read_study(const std::string& path, const SceneChanges& changes = {});

}  // namespace shearfront::fit
