// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/prior.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/observation.hpp"
#include "shearfront/solver/method.hpp"

/// What a fit file says, one struct per table of the file.
namespace shearfront::fit {

/// Order among the values of a(z), bottom to top.
enum class Shape {
  none,
  decreasing,  ///< v_0 >= v_1 >= ... >= v_n
  convex       ///< decreasing with shrinking steps: v_0 - v_1 >= v_1 - v_2 >= ... >= 0
};

/// [unknown]: the entries of the scene to be found. start, lower and upper have one number per unknown in the
/// order of `parameters`, arrays expanded; empty: the values of the scene, and defaults (parameters.hpp).
struct UnknownSpec {
  std::vector<std::string> parameters;
  std::vector<double> start, lower, upper;
  Shape shape = Shape::none;
};

/// [forward]: the solver that predicts the observations, by name and options as on the command line.
struct ForwardSpec {
  Method method;
};

/// [misfit]: what is compared, and how residuals count.
struct MisfitSpec {
  std::string quantity;  ///< name of MisfitList; empty: that of the data
  std::string loss;      ///< name of LossList; empty: squared, for point data huber
  std::optional<double>
      loss_scale;  ///< residual (in units of sigma) where a robust loss bends; default per loss
  /// Points and bins are first fitted through sums over z, which vary smoothly with the parameters; points
  /// then through means with a forgiving loss, and at last as points without those a jump is near. false: at
  /// once as asked. Empty: true if the search uses derivatives.
  std::optional<bool> two_stage;
};

/// [search]: how the minimum is looked for.
struct SearchSpec {
  std::string algorithm = "ceres";  ///< ceres | global | pattern | nlopt:NAME
  std::size_t starts = 1;           ///< > 1: from so many points of a low-discrepancy set as well
  std::uint64_t seed = 1;
  std::size_t max_evaluations = 2000;
  double tolerance = 1e-10;  ///< relative, of parameters and misfit
};

/// [uncertainty]: what is computed besides the standard errors.
struct UncertaintySpec {
  bool profile = false;       ///< profile-likelihood intervals
  std::size_t bootstrap = 0;  ///< replicates of the parametric bootstrap, 0: none
  std::uint64_t seed = 1;
  std::size_t threads = 0;  ///< 0: all cores
};

/// How the noise of different observations goes together; the order of kNoiseModelNames.
enum class NoiseModel {
  independent,
  exponential,  ///< correlation exp(-|dz| / length_z - |dt| / length_t): AR(1) over equal distances
  discrepancy  ///< independent noise, and what the model is wrong by: a Gaussian process with that correlation
};
inline constexpr std::array<std::string_view, 3> kNoiseModelNames{"independent", "exponential",
                                                                  "discrepancy"};

/// [noise]; what is empty is estimated from the data (noise_reml.hpp).
struct NoiseSpec {
  NoiseModel model = NoiseModel::independent;
  std::optional<double> length_z = {}, length_t = {};  ///< > 0
  /// exponential: the part of the variance that belongs to one observation alone, 0 <= s < 1.
  std::optional<double> independent = 0;
  std::optional<double> tau = {};  ///< discrepancy: its standard deviation in the unit of the data, > 0
  /// discrepancy: standard deviations of half-normal priors of what is estimated; empty: how far the data reach in z and
  /// in t, and the range of their values.
  std::optional<double> length_z_prior = {}, length_t_prior = {}, tau_prior = {};
};

/// A whole fit, checked entry by entry by the reader; fit() checks what holds between them.
struct FitSpec {
  std::string name;
  Scene<double> scene;
  Observations observations;
  UnknownSpec unknown;
  ForwardSpec forward;
  MisfitSpec misfit;
  SearchSpec search;
  UncertaintySpec uncertainty;
  std::vector<Prior> priors = {};
  NoiseSpec noise = {};
};

}  // namespace shearfront::fit
