// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "shearfront/fv/face_flux.hpp"
#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/muscl.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

struct Scheme {
  Rule rule = Rule::godunov;
  FaceCoefficient face_coefficient = FaceCoefficient::harmonic;
  std::optional<Limiter> limiter{};  ///< second order with rule godunov (fv/muscl.hpp)
};

/// x = phi / c of all cells: their means and, where x is linear inside, half its rise across each (else empty).
struct CellShares {
  std::vector<double> x, half_rise;
};

/// The states of all cells and their march in time, one explicit step after the other:
///
///   x_j -= dt / (int_cell c dz) (F_{j+1} - F_j),   F by a Rule; for muscl twice, as SSP-RK2
///
/// Ends: at a wall F = 0; at an open end Godunov's flux (of the other rules their own) between the state outside,
/// taken for one of the flux and coefficient of the end cell, and that cell, so what enters and what leaves is
/// decided as at any other face, in the sense of Bardos, LeRoux & Nedelec (1979), Comm. PDE 4, 1017-1034; a
/// periodic bed has one more inner face.
///
/// What is stored is the amount of grains, capacity times v (FluxShape), in units of the largest capacity. Amounts,
/// and what crosses a face in a step, are rounded to multiples of 2^-51, so that
///   (1) nothing is lost in an addition: the amount in the bed changes by inflow() only, for ever;
///   (2) tails do not fade into subnormal numbers, which cost a hundred times the time of normal ones;
///   (3) a bed at rest stays at rest.
/// (4) x is in [lo, hi] whatever the rounding (godunov, engquist_osher): a cell that has a rounding more than it can
///     hold counts as full.
/// (5) L1 contraction, and x <= y stays x <= y, both to rounding (first order of these two): two solutions move apart by no
///     more than 2^-50 of what half the widest cell holds for each update of a cell.
/// Price: an amount below 2^-52 in a step is lost on its way. Where c and the cells are equal that is 2^-52 of phi.
/// Cost: tests/bench/fv_bench.cpp. Memory: about 70 bytes per cell, 110 for muscl.
class March {
 public:
  /// Preconditions: see refusal() in fv/run.hpp.
  March(const Scheme& scheme, const Scene<double>& scene, const Grid& grid);

  [[nodiscard]] std::size_t n_cells() const { return amounts_.size(); }
  /// The time that the fastest waves take across the bed.
  [[nodiscard]] double crossing_time() const { return crossing_time_; }
  /// Up to which the bounds hold; for the other rules half of it. Infinite if nothing moves.
  [[nodiscard]] double largest_step() const { return largest_step_; }
  /// Shares beyond the open ends from now on; NaN: none (a wall).
  void set_outside(std::array<double, 2> shares) { outside_ = shares; }
  void step(double dt);
  /// Other means of the shares, one a cell, for the steps to come.
  void restart(std::span<const double> shares);

  [[nodiscard]] CellShares shares() const;
  /// After a step of dt; the march itself stays where it is.
  [[nodiscard]] CellShares shares_after(double dt);
  /// What has come in through both ends since the beginning.
  [[nodiscard]] double inflow() const { return parts_[0].flux.sign * unit_ * inflow_; }

  /// In units of the largest capacity, multiples of kQuantum: v = -1 is -capacities()[j], v = 1 is capacities()[j].
  [[nodiscard]] const std::vector<double>& amounts() const { return amounts_; }
  [[nodiscard]] const std::vector<double>& capacities() const { return capacities_; }
  static constexpr double kQuantum = 0x1p-51;

  /// Whether settled_amounts() are the end of every march: between walls, by a monotone rule, fluxes with one
  /// extremum that vanish in pure states.
  [[nodiscard]] bool has_steady_state() const { return has_steady_state_; }
  /// The state in which no face carries a flux: pure where the grains collect, pure on the other side, with one
  /// mixed cell between (godunov, muscl) or two (engquist_osher, whose steady shocks have
  /// f(alpha) + f(beta) = f(m)). It is the only one: without flux, a face of godunov has v = 1 below it or v = -1
  /// above it, one of engquist_osher f(max(l, m)) + f(min(r, m)) = f(m); both force this order of states.
  [[nodiscard]] std::vector<double> settled_amounts() const;
  void settle() { amounts_ = settled_amounts(); }

 private:
  /// Cells first ... end - 1 have one flux.
  struct Part {
    FluxShape flux;
    std::size_t first, end;
  };
  [[nodiscard]] FaceSide side(const Part& part, std::size_t j, double v) const {
    return {&part.flux, rates_[j], solid_fractions_.empty() ? 1 : solid_fractions_[j], part.flux.share(v)};
  }
  /// What the two stages of a step of second order fill in; v has a cell more at either end.
  struct Stages {
    explicit Stages(std::size_t n)
        : v(n + 2, 1.0), rises(n), bottoms(n), tops(n), crossing(n + 1), second_crossing(n + 1) {
      v.back() = -1;
    }
    std::vector<double> v, rises, bottoms, tops, crossing, second_crossing, amounts;
  };

  void set_face_rates(const Scene<double>& scene, const Grid& grid);
  [[nodiscard]] double state(std::size_t j) const;
  [[nodiscard]] double end_flux(std::size_t end) const;
  void first_order_step(double scale);
  void second_order_step(double scale);
  /// Amounts that cross the faces first ... end - 1, inner ones above the first cell of the part. below[i] and
  /// above[i]: the states at face first + i.
  void cross_faces(const Part& part, std::size_t first, std::size_t end, const double* below,
                   const double* above, double scale, double* crossing) const;

  Scheme scheme_;
  std::vector<Part> parts_;
  std::vector<double> amounts_, capacities_, inverses_;  ///< inverses_: of capacities_, not below
  std::vector<double> rates_, face_rates_, solid_fractions_;
  std::optional<Muscl> muscl_;
  std::optional<Stages> stages_;
  double unit_ = 1, limit_ = 1, inflow_ = 0, largest_step_ = 0, crossing_time_ = 0;
  bool is_periodic_, has_steady_state_ = false;
  std::array<double, 2> outside_;
};

}  // namespace shearfront::fv
