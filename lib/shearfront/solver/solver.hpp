// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/front_segment.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/share_function.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/solver/scope.hpp"

/// What every solver offers to the program, the fits and the cross tests. A solver never includes another
/// solver.
namespace shearfront {

enum class GridKind { levels, singular_mapping };
enum class Reconstruction { constant, linear };
enum class Limiter { minmod, mc, van_leer };
enum class FaceCoefficient { harmonic, value };
/// Their names in files and on the command line, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> kGridNames{"levels", "singular-mapping"};
inline constexpr std::array<std::string_view, 2> kReconstructionNames{"constant", "linear"};
inline constexpr std::array<std::string_view, 3> kLimiterNames{"minmod", "mc", "van-leer"};
inline constexpr std::array<std::string_view, 2> kFaceCoefficientNames{"harmonic", "value"};

/// Settings of all solvers; each reads those it knows.
struct SolverOptions {
  double resolution =
      0.01;  ///< front tracking: largest spacing of phi between neighbouring states of a fan, (0, 1]
  GridKind grid = GridKind::levels;
  Reconstruction reconstruct = Reconstruction::constant;
  std::size_t layers = 0;                        ///< smooth a(z): number of layers; 0 lets the solver choose
  std::uint64_t max_collisions = 4'000'000'000;  ///< stop with Status::budget_reached after so many
  std::size_t cells = 400;                       ///< finite volumes: number of cells, 1 to 1e8
  /// Finite volumes: time step in terms of the largest for which phi is proved to stay in its range, (0, 1].
  /// That step has the Courant number s max a max |f'| dt / dz = 1 in first order and 1/2 in second.
  double cfl = 1.0;
  Limiter limiter = Limiter::mc;  ///< muscl: what bounds the slopes
  /// engquist-osher: coefficient of a face, harmonic mean of a between the middles of the cells or a(z) there
  FaceCoefficient face_coefficient = FaceCoefficient::harmonic;
  bool align_cells = false;  ///< finite volumes: edges of cells on interfaces, equal cells within a layer
  bool local_steps = false;  ///< finite volumes: slow parts of the bed take longer steps
  double time_step = 0;      ///< crank-nicolson: fixed time step; 0: chosen by the tolerance
  double tolerance = 1e-5;   ///< crank-nicolson: aim for the error that time steps make in phi
  /// crank-nicolson: cells are halved where phi bends by more than this from one to the next; 0: equal cells
  double cell_tolerance = 0;
  bool monotone = false;  ///< crank-nicolson: no wiggles where cells are coarse, of first order
  /// Called now and then with (t, collisions or cell updates so far); return false to stop with
  /// Status::interrupted.
  std::function<bool(double, std::uint64_t)> progress;
};

/// What to compute. Times in any order, >= 0; +infinity asks for the steady state. Heights in any order,
/// inside the domain.
struct SolverRequest {
  std::vector<double> times;
  std::vector<double> heights;
  bool timeline = false;      ///< event times wanted
  bool fronts = false;        ///< front segments wanted (solvers that have fronts)
  bool profiles = false;      ///< phi over the whole domain wanted (solvers that have profiles)
  ShareFunction integrand{};  ///< g, if int c g(phi / c) dz over the bed is wanted
};

struct Sample {
  double phi = 0;  ///< concentration; at a jump the value above it, at the top wall the value below
  double M = 0;    ///< int_bottom^z phi
};

struct SolverResult {
  std::vector<Sample> samples;  ///< samples[i * heights.size() + j] belongs to times[i], heights[j]
  std::optional<Timeline<double>> timeline;
  std::vector<FrontSegment<double>> fronts;
  std::vector<Profile<double>> profiles;  ///< profiles[i] belongs to times[i]; the samples are its values
  std::vector<double> integrals;          ///< integrals[i], of the integrand, belongs to times[i]
  Summary summary;
};

/// What a solver promises; the cross tests check exactly what is promised here.
struct Guarantees {
  Scope scope;                ///< what it solves; anything else is Status::unsupported
  bool exact = false;         ///< M and phi to rounding
  bool conservative = false;  ///< M(top, t) equals the initial mass to rounding
  bool bounded = false;       ///< phi stays in the range of the flux
  double order_phi = 0;       ///< L1 order of phi in the resolution, 0 if exact
  double order_M = 0;         ///< order of M in the resolution, 0 if exact
  bool has_fronts = false;    ///< can return front segments
  bool has_timeline = false;  ///< can return event times
  bool has_profiles = false;  ///< can return the solution as a function of z: it is linear in pieces
};

template <class S>
concept Solver = requires(const Scene<double>& scene, const SolverRequest& request,
                          const SolverOptions& options) {
  { S::kName } -> std::convertible_to<std::string_view>;
  { S::kDescription } -> std::convertible_to<std::string_view>;
  { S::guarantees() } -> std::same_as<Guarantees>;
  { S::solve(scene, request, options) } -> std::same_as<SolverResult>;
};

}  // namespace shearfront
