// SPDX-License-Identifier: BSD-3-Clause
#include "cli/method.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <limits>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

/// Names of the solvers with the property.
template <class Has>
std::vector<std::string> solver_names(Has&& has) {
  std::vector<std::string> names;
  SolverList::for_each([&]<class S>() {
    if (has(S::guarantees())) names.emplace_back(S::kName);
  });
  return names;
}

std::vector<std::string> solver_names() {
  return solver_names([](const Guarantees&) { return true; });
}

std::string join(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, "|")); }

}  // namespace

const std::vector<std::string>& grid_names() {
  static const std::vector<std::string> names(kGridNames.begin(), kGridNames.end());
  return names;
}

const std::vector<std::string>& reconstruction_names() {
  static const std::vector<std::string> names(kReconstructionNames.begin(), kReconstructionNames.end());
  return names;
}

const std::vector<std::string>& limiter_names() {
  static const std::vector<std::string> names(kLimiterNames.begin(), kLimiterNames.end());
  return names;
}

const std::vector<std::string>& face_coefficient_names() {
  static const std::vector<std::string> names(kFaceCoefficientNames.begin(), kFaceCoefficientNames.end());
  return names;
}

void MethodArguments::add_to(CLI::App& app) {
  app.add_option("--method", method_, "solver: " + SolverList::names() + "; default " + method_)
      ->type_name(join(solver_names()));
  app.add_option("--resolution", resolution_,
                 "front tracking: largest step of phi in a fan, or delta of the singular mapping; "
                 "> 0 and <= 1, default 0.01")
      ->type_name("D");
  app.add_option("--grid", grid_, "front tracking: grid of states; default levels")
      ->type_name(join(grid_names()));
  app.add_option("--reconstruct", reconstruct_, "front tracking: phi between fronts; default constant")
      ->type_name(join(reconstruction_names()));
  app.add_option("--layers", layers_, "smooth shear rates: number of layers of the staircase")
      ->type_name("N");
  app.add_option("--max-collisions", max_collisions_, "front tracking: stop after so many collisions")
      ->type_name("N");
  app.add_option("--cells", cells_, "finite volumes, crank-nicolson: number of cells, default 400")
      ->type_name("N");
  app.add_option("--cfl", cfl_,
                 "finite volumes: time step over the largest for which the bounds of phi are proved (Courant "
                 "number 1, muscl 1/2); > 0 and <= 1, default 1")
      ->type_name("C");
  app.add_option("--limiter", limiter_, "muscl: what bounds the slopes; default mc")
      ->type_name(join(limiter_names()));
  app.add_option("--face-coefficient", face_coefficient_,
                 "engquist-osher: harmonic mean of a(z) between the middles of two cells, or its value at "
                 "their face; default harmonic")
      ->type_name(join(face_coefficient_names()));
  app.add_flag("--align-cells", align_cells_,
               "finite volumes: edges of cells on the interfaces, equal cells within each layer");
  app.add_flag("--local-steps", local_steps_,
               "finite volumes: parts of the bed that move slowly take longer time steps");
  add_diffusion_to(app);
}

void MethodArguments::add_diffusion_to(CLI::App& app) {
  app.add_option("--time-step", time_step_, "crank-nicolson: fixed time step; default chosen by --tolerance")
      ->type_name("DT");
  app.add_option("--tolerance", tolerance_,
                 "crank-nicolson: aim for the error that time steps make in phi; > 0 and <= 1, default 1e-5")
      ->type_name("E");
  app.add_option(
         "--cell-tolerance", cell_tolerance_,
         "crank-nicolson: halve cells, beginning with --cells, where phi bends by more than this from "
         "one to the next; >= 1e-6 and <= 0.1, default equal cells")
      ->type_name("E");
  app.add_flag(
      "--monotone", monotone_,
      "crank-nicolson: fitted fluxes, which do not wiggle where cells are coarse (first order there)");
}

std::string_view MethodArguments::method() const {
  (void)choice_option("--method", method_, solver_names());
  return method_;
}

SolverOptions MethodArguments::options() const {
  SolverOptions options;
  (void)method();
  if (!resolution_.empty())
    options.resolution = number_option("--resolution", resolution_, {0, 1, true}, "> 0 and <= 1");
  if (!grid_.empty()) options.grid = static_cast<GridKind>(choice_option("--grid", grid_, grid_names()));
  if (!reconstruct_.empty())
    options.reconstruct =
        static_cast<Reconstruction>(choice_option("--reconstruct", reconstruct_, reconstruction_names()));
  constexpr unsigned long long kMostLayers = 1'000'000, kMostCollisions = 1'000'000'000'000'000;
  if (!layers_.empty())
    options.layers = static_cast<std::size_t>(count_option("--layers", layers_, 1, kMostLayers));
  if (!max_collisions_.empty())
    options.max_collisions = count_option("--max-collisions", max_collisions_, 1, kMostCollisions);
  constexpr unsigned long long kMostCells = 100'000'000;
  if (!cells_.empty())
    options.cells = static_cast<std::size_t>(count_option("--cells", cells_, 1, kMostCells));
  if (!cfl_.empty()) options.cfl = number_option("--cfl", cfl_, {0, 1, true}, "> 0 and <= 1");
  if (!limiter_.empty())
    options.limiter = static_cast<Limiter>(choice_option("--limiter", limiter_, limiter_names()));
  if (!face_coefficient_.empty())
    options.face_coefficient = static_cast<FaceCoefficient>(
        choice_option("--face-coefficient", face_coefficient_, face_coefficient_names()));
  if (!time_step_.empty())
    options.time_step =
        number_option("--time-step", time_step_, {0, std::numeric_limits<double>::max(), true}, "> 0");
  if (!tolerance_.empty())
    options.tolerance = number_option("--tolerance", tolerance_, {0, 1, true}, "> 0 and <= 1");
  if (!cell_tolerance_.empty())
    options.cell_tolerance =
        number_option("--cell-tolerance", cell_tolerance_, {1e-6, 0.1}, ">= 1e-6 and <= 0.1");
  options.monotone = monotone_;
  options.align_cells = align_cells_;
  options.local_steps = local_steps_;
  return options;
}

std::string MethodArguments::settings() const {
  const SolverOptions chosen = options();
  const Guarantees guarantees = guarantees_of(method());
  std::string text = fmt::format("--method {}", method());
  if (guarantees.has_fronts)
    text += fmt::format(" --resolution {} --grid {} --reconstruct {}", number_text(chosen.resolution),
                        grid_names()[static_cast<std::size_t>(chosen.grid)],
                        reconstruction_names()[static_cast<std::size_t>(chosen.reconstruct)]);
  else if (guarantees.scope.diffusion && !guarantees.exact)
    text += fmt::format(
        " --cells {} {}{}{}", chosen.cells,
        chosen.time_step > 0 ? "--time-step " + number_text(chosen.time_step)
                             : "--tolerance " + number_text(chosen.tolerance),
        chosen.cell_tolerance > 0 ? " --cell-tolerance " + number_text(chosen.cell_tolerance) : "",
        chosen.monotone ? " --monotone" : "");
  else if (!guarantees.exact)
    text += fmt::format(" --cells {} --cfl {}", chosen.cells, number_text(chosen.cfl));
  if (method() == MusclSolver::kName)
    text += fmt::format(" --limiter {}", limiter_names()[static_cast<std::size_t>(chosen.limiter)]);
  if (method() == EngquistOsherSolver::kName && chosen.face_coefficient != FaceCoefficient::harmonic)
    text += " --face-coefficient value";
  if (guarantees.order_phi > 0 && !guarantees.has_fronts && !guarantees.scope.diffusion)
    text += fmt::format("{}{}", chosen.align_cells ? " --align-cells" : "",
                        chosen.local_steps ? " --local-steps" : "");
  if (chosen.layers > 0) text += fmt::format(" --layers {}", chosen.layers);
  return text;
}

void note_unused_layers(const MethodArguments& arguments, const Scene<double>& scene) {
  if (arguments.has_layers() && scene.is_layered())
    note("--layers changes nothing: the shear rate is piecewise constant");
}

SolverResult solve_with(std::string_view method, const Scene<double>& scene, const SolverRequest& request,
                        const SolverOptions& options) {
  SolverResult result;
  SolverList::for_each([&]<class S>() {
    if (method == S::kName) result = S::solve(scene, request, options);
  });
  return result;
}

Guarantees guarantees_of(std::string_view method) {
  Guarantees guarantees;
  SolverList::for_each([&]<class S>() {
    if (method == S::kName) guarantees = S::guarantees();
  });
  return guarantees;
}

std::vector<std::string> methods_with_fronts() {
  return solver_names([](const Guarantees& g) { return g.has_fronts; });
}

std::vector<std::string> methods_with_timeline() {
  return solver_names([](const Guarantees& g) { return g.has_timeline; });
}

}  // namespace shearfront::tools
