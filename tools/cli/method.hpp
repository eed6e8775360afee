// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/solver/solver.hpp"

namespace CLI {
class App;
}

namespace shearfront::tools {

/// The options that choose and steer a solver, the same for every subcommand.
class MethodArguments {
 public:
  void add_to(CLI::App& app);

  /// Errors: InputError for the first option with a value that is not allowed.
  [[nodiscard]] SolverOptions options() const;
  /// The name of a solver of SolverList.
  [[nodiscard]] std::string_view method() const;
  /// The options that give the same result again, defaults included. Like options() it refuses wrong values.
  [[nodiscard]] std::string settings() const;
  [[nodiscard]] bool has_resolution() const { return !resolution_.empty(); }
  [[nodiscard]] bool has_layers() const { return !layers_.empty(); }

 private:
  void add_diffusion_to(CLI::App& app);
  std::string method_ = "exact", resolution_, grid_, reconstruct_, layers_, max_collisions_, cells_, cfl_,
              limiter_, face_coefficient_, time_step_, tolerance_, cell_tolerance_;
  bool align_cells_ = false, local_steps_ = false, monotone_ = false;
};

/// Says that --layers changes nothing where the shear rate is piecewise constant already.
void note_unused_layers(const MethodArguments& arguments, const Scene<double>& scene);

[[nodiscard]] SolverResult solve_with(std::string_view method, const Scene<double>& scene,
                                      const SolverRequest& request, const SolverOptions& options);
[[nodiscard]] Guarantees guarantees_of(std::string_view method);
/// Names of the solvers that can return front segments.
[[nodiscard]] std::vector<std::string> methods_with_fronts();
/// Names of the solvers that can return event times.
[[nodiscard]] std::vector<std::string> methods_with_timeline();

[[nodiscard]] const std::vector<std::string>& grid_names();            ///< in the order of GridKind
[[nodiscard]] const std::vector<std::string>& reconstruction_names();  ///< in the order of Reconstruction
[[nodiscard]] const std::vector<std::string>& limiter_names();         ///< in the order of Limiter
/// In the order of FaceCoefficient.
[[nodiscard]] const std::vector<std::string>& face_coefficient_names();

}  // namespace shearfront::tools
