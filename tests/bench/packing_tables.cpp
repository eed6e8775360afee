// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of docs/evidence/packing.md: the one-dimensional examples of a thesis on segregation in a granular
// flow model (its Tables 5.1 to 5.5) by the schemes it compares, and by front tracking.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "shearfront/fv/march.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/solid_scene.hpp"

namespace {

using namespace shearfront;
using support::Grains;

SceneSpec<double> example(int number, Grains grains) {
  SceneSpec<double> spec;  // as datasets/packing-example-<number>
  spec.fluxes = {support::flux_of(grains)};
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.5};
  const Table<double> sloping{{0, 0.05, 0.95, 1}, {0.7, 0.7, 0.2, 0.2}};
  if (number == 1) {
    spec.solid_fraction = Piecewise<double>{{}, {0.64}};
  } else if (number == 4) {
    spec.solid_fraction = Piecewise<double>{{0.56}, {0.68, 0.3}};
  } else {
    spec.solid_fraction = sloping;
  }
  if (number == 3) {
    Table<double> temperature;
    for (int i = 0; i <= 20; ++i) {
      temperature.z.push_back(0.05 * i);
      temperature.values.push_back(0.2 / sloping.value(std::min(0.05 * i, 1.0)));
    }
    temperature.z.back() = 1;
    spec.temperature = temperature;
  }
  return spec;
}

/// Largest phi - c in a cell at any step up to t = 1.5, at Courant number 1/2.
double overshoot(fv::Rule rule, const Scene<double>& scene, std::size_t cells) {
  const fv::Grid grid = fv::equal_cells(scene, cells);
  fv::March march({rule}, scene, grid);
  const std::vector<double> capacity = fv::capacities(scene, grid);
  const double dt = fv::March({}, scene, grid).largest_step() / 2;
  double most = 0;
  for (double t = 0; t < 1.5; t += dt) {
    march.step(dt);
    const std::vector<double> x = march.shares().x;
    for (std::size_t j = 0; j < cells; ++j) most = std::max(most, capacity[j] / grid.widths[j] * (x[j] - 1));
  }
  return most;
}

/// Largest phi - c(z) of front tracking over a sample of times, at the ends of the pieces of its profiles.
double tracked_overshoot(const Scene<double>& scene, double resolution) {
  SolverRequest request{{}, {}};
  for (int i = 1; i <= 30; ++i) request.times.push_back(0.05 * i);
  request.profiles = true;
  FrontTrackingSolver::Options options;
  options.resolution = resolution;
  const SolverResult result = solve<FrontTrackingSolver>(scene, request, options);
  if (!result.summary.usable()) return std::nan("");
  double most = 0;
  for (const auto& profile : result.profiles) most = std::max(most, support::overshoot(scene, profile));
  return most;
}

void print_overshoot() {
  constexpr std::array<std::array<double, 9>, 3> kThesis{
      {{0.06702, 0.03041, 0.01690, 0.00969, 0.00484, 0.00260, 0.00137, 0.00068, 0.00035},
       {0.06741, 0.02478, 0.01427, 0.00731, 0.00382, 0.00196, 0.00100, 0.00051, 0.00026},
       {0.34160, 0.32870, 0.28748, 0.30736, 0.30397, 0.30226, 0.30141, 0.30099, 0.30078}}};
  constexpr std::array<std::size_t, 9> kCells{13, 25, 50, 100, 200, 400, 800, 1600, 3200};
  std::printf("Overshoot max(phi - c), large grains\n\n");
  std::printf("| example | cells | thesis | classical | upwind | modified | classical, small grains |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (std::size_t e = 0; e < 3; ++e) {
    const Scene<double> large(example(static_cast<int>(e) + 2, Grains::large));
    const Scene<double> small(example(static_cast<int>(e) + 2, Grains::small));
    for (std::size_t i = 0; i < kCells.size(); ++i)
      std::printf("| %zu | %zu | %.5f | %.5f | %.5f | %g | %g |\n", e + 2, kCells[i], kThesis[e][i],
                  overshoot(fv::Rule::classical_godunov, large, kCells[i]),
                  overshoot(fv::Rule::upwind, large, kCells[i]),
                  overshoot(fv::Rule::godunov, large, kCells[i]),
                  overshoot(fv::Rule::classical_godunov, small, kCells[i]));
  }
  std::printf("\nOvershoot at the jump (example 4, large grains, 200 cells) by the values of c\n\n");
  std::printf("| c below, above | classical |\n|---|---|\n");
  for (const auto& [below, above] : std::vector<std::array<double, 2>>{
           {0.55, 0.35}, {0.6, 0.3}, {0.64, 0.3}, {0.68, 0.3}, {0.7, 0.3}, {0.7, 0.2}, {0.8, 0.1}}) {
    SceneSpec<double> spec = example(4, Grains::large);
    spec.solid_fraction = Piecewise<double>{{0.56}, {below, above}};
    std::printf("| %g, %g | %.5f |\n", below, above,
                overshoot(fv::Rule::classical_godunov, Scene<double>(spec), 200));
  }
}

constexpr double kThesisCourant = 0.5;  // with it the errors of example 1 are those of the thesis

template <class Solver>
Profile<double> solved(Solver, const Scene<double>& scene, double t,
                       const typename Solver::Options& options) {
  SolverRequest request{{t}, {}};
  request.profiles = true;
  const SolverResult result = solve<Solver>(scene, request, options);
  return result.profiles.empty() ? Profile<double>() : result.profiles[0];
}
Profile<double> on_cells(auto solver, const Scene<double>& scene, double t, std::size_t cells,
                         double cfl = 1) {
  typename decltype(solver)::Options options;
  options.cells = cells;
  options.cfl = cfl;
  return solved(solver, scene, t, options);
}
Profile<double> tracked(const Scene<double>& scene, double t, double resolution) {
  FrontTrackingSolver::Options options;
  options.resolution = resolution;
  return solved(FrontTrackingSolver{}, scene, t, options);
}

constexpr std::array<std::size_t, 7> kGrids{10, 20, 40, 80, 160, 320, 640};
constexpr std::size_t kThesisGrid = 1280, kFineGrid = 20480;

double rate(double coarse, double fine) { return std::log2(coarse / fine); }

void print_convergence() {
  constexpr std::array<std::array<double, 7>, 3> kThesis{
      {{0.12756, 0.04854, 0.02402, 0.01162, 0.00542, 0.00232, 0.00077},
       {0.13094, 0.08152, 0.03680, 0.02024, 0.00996, 0.00470, 0.00163},
       {0.13664, 0.08367, 0.04279, 0.02295, 0.01068, 0.00480, 0.00198}}};
  std::printf(
      "\nRelative L1 error of phi at t = 0.5, small grains\n\n| example | cells | thesis | modified, C = "
      "1/2, "
      "reference 1280 cells | modified, C = 1, exact or 20480 cells | rate | muscl |\n"
      "|---|---|---|---|---|---|---|\n");
  for (std::size_t e = 0; e < 3; ++e) {
    const Scene<double> scene(example(static_cast<int>(e) + 1, Grains::small));
    const Profile<double> coarse = on_cells(GodunovSolver{}, scene, 0.5, kThesisGrid, kThesisCourant);
    const Profile<double> fine = e == 0
                                     ? Profile<double>({0, 0.25, 0.75, 1}, {0.64, 0.32, 0}, {0.64, 0.32, 0})
                                     : on_cells(GodunovSolver{}, scene, 0.5, kFineGrid);
    double last = std::nan("");
    for (std::size_t i = 0; i < kGrids.size(); ++i) {
      const Profile<double> profile = on_cells(GodunovSolver{}, scene, 0.5, kGrids[i]);
      const Profile<double> theirs = on_cells(GodunovSolver{}, scene, 0.5, kGrids[i], kThesisCourant);
      const double error = l1_distance(profile, fine) / fine.mass();
      std::printf("| %zu | %zu | %.5f | %.5f | %.5f | %.2f | %.5f |\n", e + 1, kGrids[i], kThesis[e][i],
                  l1_distance(theirs, coarse) / coarse.mass(), error, rate(last, error),
                  l1_distance(on_cells(MusclSolver{}, scene, 0.5, kGrids[i]), fine) / fine.mass());
      last = error;
    }
  }
}

/// Psi at 151 times up to the last one.
std::vector<double> mixing_curve(const Scene<double>& scene, double last, std::size_t cells) {
  SolverRequest request{{}, {}};
  for (int i = 0; i <= 150; ++i) request.times.push_back(last * i / 150);
  request.profiles = true;
  GodunovSolver::Options options;
  options.cells = cells;
  options.cfl = kThesisCourant;
  const SolverResult result = solve<GodunovSolver>(scene, request, options);
  std::vector<double> curve;
  for (const auto& profile : result.profiles) curve.push_back(mixing(scene, profile).parameter);
  return curve;
}

struct Errors {
  double most, l1, l2;
};
Errors relative_errors(const std::vector<double>& a, const std::vector<double>& reference) {
  Errors error{0, 0, 0}, size{0, 0, 0};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::abs(a[i] - reference[i]), r = std::abs(reference[i]);
    error = {std::max(error.most, d), error.l1 + d, error.l2 + d * d};
    size = {std::max(size.most, r), size.l1 + r, size.l2 + r * r};
  }
  return {error.most / size.most, error.l1 / size.l1, std::sqrt(error.l2 / size.l2)};
}

constexpr std::array<double, 3> kLastTimes{1, 1, 1.5};

void print_mixing() {
  using Row = std::array<double, 3>;
  constexpr std::array<std::array<Row, 7>, 3> kThesis{{{{{0.11619, 0.16532, 0.13665},
                                                         {0.05817, 0.08301, 0.07084},
                                                         {0.02863, 0.04110, 0.03563},
                                                         {0.01385, 0.01995, 0.01744},
                                                         {0.00647, 0.00932, 0.00820},
                                                         {0.00277, 0.00400, 0.00354},
                                                         {0.00092, 0.00133, 0.00120}}},
                                                       {{{0.09442, 0.09411, 0.11481},
                                                         {0.04282, 0.04174, 0.04701},
                                                         {0.03134, 0.02974, 0.03458},
                                                         {0.01323, 0.01223, 0.01362},
                                                         {0.00563, 0.00517, 0.00546},
                                                         {0.00247, 0.00192, 0.00185},
                                                         {0.00119, 0.00106, 0.00116}}},
                                                       {{{0.11645, 0.18139, 0.14262},
                                                         {0.05547, 0.08852, 0.07311},
                                                         {0.03265, 0.05315, 0.04522},
                                                         {0.01516, 0.02332, 0.02027},
                                                         {0.00713, 0.00995, 0.00888},
                                                         {0.00308, 0.00362, 0.00343},
                                                         {0.00110, 0.00177, 0.00155}}}}};
  std::printf(
      "\nRelative errors of Psi(t), modified Godunov, reference 1280 cells; thesis | here\n\n"
      "| example | cells | Linf | L1 | L2 | Linf | L1 | L2 |\n|---|---|---|---|---|---|---|---|\n");
  for (std::size_t e = 0; e < 3; ++e) {
    const Scene<double> scene(example(static_cast<int>(e) + 1, Grains::small));
    const auto reference = mixing_curve(scene, kLastTimes[e], kThesisGrid);
    for (std::size_t i = 0; i < kGrids.size(); ++i) {
      const Errors error = relative_errors(mixing_curve(scene, kLastTimes[e], kGrids[i]), reference);
      const Row& thesis = kThesis[e][i];
      std::printf("| %zu | %zu | %.5f | %.5f | %.5f | %.5f | %.5f | %.5f |\n", e + 1, kGrids[i], thesis[0],
                  thesis[1], thesis[2], error.most, error.l1, error.l2);
    }
  }
}

void print_curves() {
  std::printf(
      "\nE_mix, and Psi of 1280 cells of modified Godunov (front tracking, R = 0.02) at some times\n\n"
      "| example | E_mix | t = 0.25 | 0.5 | 0.75 | 1 | 1.5 | 2 |\n|---|---|---|---|---|---|---|---|\n");
  for (int e = 1; e <= 4; ++e) {
    const Scene<double> scene(example(e, Grains::small));
    std::printf("| %d | %.4f |", e, mixing(scene, on_cells(GodunovSolver{}, scene, 0, 100)).mixed);
    for (const double t : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0}) {
      std::printf(" %.4f", mixing(scene, on_cells(GodunovSolver{}, scene, t, kThesisGrid)).parameter);
      const Profile<double> fronts = tracked(scene, t, 0.02);
      if (fronts.n_cells() > 0) std::printf(" (%.4f)", mixing(scene, fronts).parameter);
      std::printf(" |");
    }
    std::printf("\n");
  }
  std::printf(
      "\nFront tracking: overshoot, and relative L1 distance from 20480 cells of modified Godunov at t = "
      "0.5\n\n"
      "| example | overshoot, large grains | R = 0.08 | 0.04 | 0.02 | 0.01 |\n|---|---|---|---|---|---|\n");
  for (int e = 1; e <= 4; ++e) {
    const Scene<double> scene(example(e, Grains::small));
    std::printf("| %d | %g |", e, tracked_overshoot(Scene<double>(example(e, Grains::large)), 0.02));
    const Profile<double> fine = on_cells(GodunovSolver{}, scene, 0.5, kFineGrid);
    for (const double resolution : {0.08, 0.04, 0.02, 0.01}) {
      const Profile<double> fronts = tracked(scene, 0.5, resolution);
      std::printf(" %.5f |", fronts.n_cells() > 0 ? l1_distance(fronts, fine) / fine.mass() : std::nan(""));
    }
    std::printf("\n");
  }
}

}  // namespace

int main() {
  print_overshoot();
  print_convergence();
  print_mixing();
  print_curves();
}
