// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "soak/findings.hpp"
#include "soak/trial.hpp"

/// The laws, engine by engine. Every bound is a theorem about the equation, or what the headers promise;
/// constants in front of the unit roundoff are derived where they are named.
namespace shearfront::soak {

/// A trial with its exact solution. For a smooth a(z) also the staircase that the tracker uses, which has an
/// exact solution of its own.
struct Bed {
  explicit Bed(const Trial& trial);

  const Trial& trial;
  Scene<double> scene;
  LayerStack<double> stack;  ///< the scene's layers, or the staircase
  Scene<double> layered;     ///< the scene on that stack
  ExactSolution<double> exact, layered_exact;
  /// The rates of the staircase lie within those of `exact` times [slower, faster]; both 1 if the scene is
  /// layered.
  double slower = 1, faster = 1;
  std::vector<double> heights;  ///< where to look: at random, at and next to interfaces and jumps
  std::vector<double> times;    ///< 0, early, late and infinity

  /// Rounding that M may have: the exact engine promises c u (top - bottom) with c of the order of the
  /// layers crossed; a path crosses each at most twice.
  [[nodiscard]] double M_rounding() const;
  /// Relative rounding of a time: a sum over the layers, each term right to a few units.
  [[nodiscard]] double t_rounding() const;
};

/// Where a law does not hold.
inline std::string at(double t) { return "t = " + number_text(t); }
inline std::string at(double z, double t) { return "z = " + number_text(z) + ", t = " + number_text(t); }

void check_exact(const Bed& bed, Findings& findings);
/// phi = dM/dz, H = dM/dt, derivatives, double against 50 digits: expensive.
void check_exact_in_50_digits(const Bed& bed, Findings& findings);
void check_tracker(const Bed& bed, Findings& findings);
/// Two data on one grid.
void check_tracker_pair(const Bed& bed, Findings& findings);
/// Every solver of the list against what it guarantees.
void check_solvers(const Bed& bed, Findings& findings);
/// The scene as text and back.
void check_text(const Trial& trial, Findings& findings);

/// All of it, on the trial of one seed.
[[nodiscard]] Findings check_trial(const Trial& trial);

/// A scene of any kind (every flux and pair of fluxes, c(z), T(z), smooth starts, tables, chutes, walls, open and joined
/// ends, diffusion, any units) through every solver that takes it: it ends, range, mass, M monotone, scaling by powers of
/// two, exact near Godunov, text. The mildly hard scenes; those of draw_trial() are harder, of one flux.
[[nodiscard]] Findings check_any_kind(std::uint64_t seed);
[[nodiscard]] std::string text_of_any_kind(std::uint64_t seed);

}  // namespace shearfront::soak
