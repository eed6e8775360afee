// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shearfront/diffusion/face_rule.hpp"
#include "shearfront/diffusion/grid_transfer.hpp"
#include "shearfront/diffusion/problem.hpp"
#include "shearfront/diffusion/step_control.hpp"
#include "shearfront/diffusion/tridiagonal.hpp"
#include "shearfront/solution/summary.hpp"

namespace shearfront::diffusion {

struct Options {
  double dt = 0;         ///< largest time step; 0: steps are chosen for `tolerance`
  double tolerance = 0;  ///< adaptive steps: aim for the error of time stepping, in units of max |phi|
  Scheme scheme = Scheme::central;
  double iteration_tolerance = 1e-8;  ///< largest change of a state in the last iteration, over max |phi|
  /// Fixed steps: so many first steps are two halves of backward Euler each. Unset: two if the step is long
  /// for the grid (D dt > dz^2) and the rate of change at t = 0 is rough (its second difference exceeds half
  /// of it somewhere, as where data do not satisfy the condition at a wall), else none.
  std::optional<std::size_t> smoothed_steps;
  std::uint64_t max_steps = 1'000'000'000;
  bool keeps_steps = true;  ///< for steps()
  /// Called after every step with (t, steps so far); return false to stop with Status::interrupted.
  std::function<bool(double, std::uint64_t)> progress;
  /// Called after every step with the present problem and states; may return another grid for the
  /// next one. Precondition: the first problem has `faces`.
  std::function<std::optional<Regrid>(const Problem&, std::span<const double>)> regrid;
};

/// One step of the scheme below.
struct TimeStep {
  double length, theta;
};

/// Why steps of this length do not get over a span of time: more than `most` are needed. Empty if they do.
[[nodiscard]] std::string too_many_steps(double span, double length, std::uint64_t most);

/// Crank-Nicolson for segregation with diffusion (see Problem): means phi_j of the cells, fluxes F_i of the
/// faces (see Scheme) at a state v inside the step,
///
///   v_j = phi_j^n - theta dt (F_{j+1} - F_j) / dz,   phi_j^{n+1} = phi_j^n - dt (F_{j+1} - F_j) / dz,
///   F = F(v),   theta = 1/2:  v is the mean of phi^n and phi^{n+1}.
///
/// Unknowns of the nonlinear system are the fluxes, which makes the scheme conservative in every iterate.
/// Guaranteed:
///   (1) the mass sum phi_j dz_j is that of the beginning, to 1e-15 relative, after any number of steps and
///       whether or not the iteration converged (walls, periodic; neumann: up to what passes the ends);
///   (2) second order in dt and dz for smooth data (central; fitted where the cell Peclet number is small);
///   (3) Scheme::fitted with walls or periodic ends: phi stays in [lo, hi] if f(lo) = f(hi) = 0, up to
///       rounding, for all steps; if r is constant (neumann, periodic) no new extrema appear. Proof:
///       the flux is monotone, so the implicit part of a step obeys the comparison principle for any dt, and
///       the explicit part does if (1 - theta) dt L <= 1, L = explicit_rate(). Hence
///       theta = max(1/2, 1 - 1 / (dt L)): second order in dt as long as dt L <= 2, of first order beyond.
///       (No scheme of order two has such bounds for all steps: Bolley & Crouzeix 1978, RAIRO Anal. Numer. 12, 237-245.)
///   (4) tangents are the derivatives of the computed states for the same steps, to rounding (equal cells only).
///
/// On another grid (Options::regrid) the states and the fluxes of the last two steps go on, see
/// grid_transfer.hpp; the mass stays what it is, and fitted states stay in the range of the flux.
///
/// Adaptive steps: the local error is estimated from the distance to a quadratic extrapolation in time and
/// kept at c tolerance^(3/2), so that the error of a run is proportional to the tolerance. Where theta > 1/2 the
/// part of first order, (theta - 1/2) dt^2 phi_tt, is kept at c tolerance^2 as well. They start with short steps of backward Euler, which also damp what data that do not satisfy the conditions at the walls
/// excite. They grow without bound; at rest they end, see is_steady().
///
/// Cost: O(N) a step and iteration; usually one iteration a step. Each tangent costs one further right-hand
/// side. Source: Christov (2018), Materials Physics and Mechanics 35, 21-27; Gresho, Lee & Sani (1980) for
/// the control of steps; Rannacher (1984), Numer. Math. 43, 309-327 for the smoothing.
class CrankNicolson {
 public:
  CrankNicolson(const Problem& problem, Options options, std::vector<Tangent> tangents = {});

  /// Goes on to time t >= time(), exactly; +infinity asks for the steady state (adaptive steps). Status::ok;
  /// steady: at rest; budget_reached, interrupted; not_converged: the iteration failed even for steps 2^20
  /// times shorter than wanted, or led to states ten times as large as any of the beginning and of the range
  /// of the flux, as Scheme::central may where the cell Peclet number |r| W dz / D is far above 2; the states
  /// are then those before the failure. See message().
  Status advance_to(double t);
  /// Makes the given steps (of another run), the tangents along with them.
  Status repeat(std::span<const TimeStep> steps);

  /// Other states at the present time, for the steps to come; their own fluxes predict those of the next step, so that it
  /// does not depend on what was before. Precondition: no tangents.
  void restart(std::span<const double> states);

  [[nodiscard]] std::span<const double> states() const { return {phi_.data() + 1, n_}; }
  /// With the grid of states().
  [[nodiscard]] const Problem& problem() const { return problem_; }
  /// Derivatives of states() with respect to parameter k.
  [[nodiscard]] std::span<const double> tangent(std::size_t k) const { return tangents_[k]; }
  [[nodiscard]] double time() const { return time_; }
  /// Length of the last step.
  [[nodiscard]] double step() const { return last_length_; }
  [[nodiscard]] const std::vector<TimeStep>& steps() const { return steps_; }
  [[nodiscard]] std::uint64_t n_steps() const { return n_steps_; }
  /// Linear systems solved, those of tangents and rejected steps included.
  [[nodiscard]] std::uint64_t n_iterations() const { return n_iterations_; }
  /// Sum of their cells.
  [[nodiscard]] std::uint64_t n_cell_updates() const { return n_cell_updates_; }
  /// Whether the fluxes have balanced; how short a step was does not count. Fixed steps: the last one changed no
  /// state by more than its rounding, nor faster than the rounding of the fluxes does. Adaptive steps: a last
  /// step of backward Euler of 10^4 times the time elapsed moved no state by more than a tenth of the tolerance,
  /// and the states are those after it: no flux then differs from its balance by more than 1e-5 tolerance
  /// max |phi| height / t. advance_to() then only sets the time.
  [[nodiscard]] bool is_steady() const { return is_steady_; }
  /// The time by then. Precondition: is_steady().
  [[nodiscard]] double rest_time() const { return rest_time_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  struct Attempt {
    bool converged = false;
    double surprise = 0;  ///< largest distance of a state from its extrapolation
    double turn = 0;      ///< theta > 1/2: largest change of a state by other fluxes than in the last step
  };

  Attempt attempt(const TimeStep& step);
  bool iterate(double tau, double theta);
  void predict(const TimeStep& step);
  void place_inner(double tau);
  double correct(double tau, bool same_matrix);
  void commit(const TimeStep& step);
  void move_to(Regrid next);
  /// All that depends on the cells but not on their states.
  void set_grid();
  void commit_tangents(const TimeStep& step);
  void set_ghosts(std::vector<double>& v) const;
  /// put(j, (F_{j+1} - F_j) / dz_j) for all cells, from q = F / u.
  template <class Put>
  void for_each_divergence(const std::vector<double>& q, const Put& put) const {
    if (per_width_.empty()) {
      for (std::size_t j = 0; j < n_; ++j) put(j, q[j + 1] - q[j]);
    } else {
      for (std::size_t j = 0; j < n_; ++j) put(j, (q[j + 1] - q[j]) * per_width_[j]);
    }
  }

  Status march_fixed(double t);
  Status march_adaptive(double t);
  /// A step of the length wanted, or as many shorter ones as the iteration needs.
  bool take(double length, double theta);
  [[nodiscard]] double theta_of(double length) const;
  void start_adaptive(double t);
  void start_fixed();
  /// phi_t at the beginning, of the cells.
  [[nodiscard]] std::vector<double> initial_rates();
  void try_rest();
  [[nodiscard]] Status stop_reason();
  Status give_up(double length);

  Problem problem_;
  Options options_;
  std::vector<Tangent> parameters_;
  std::size_t n_;
  double narrowest_;               ///< dz
  std::vector<double> per_width_;  ///< u / dz of the cells (see FaceFluxes); empty: 1
  std::unique_ptr<FaceRule> rule_;
  Tridiagonal matrix_;
  FaceFluxes fluxes_;
  std::vector<double> phi_, rest_, inner_;  ///< with a cell beyond each end; rest_: what rounding left over
  std::vector<double> q_, q_predicted_, q_last_, q_before_, correction_;  ///< F / u
  std::vector<std::vector<double>> tangents_;
  FluxTimes flux_times_;
  StepControl control_;
  double scale_ = 0;  ///< max |phi|
  double limit_ = 0;  ///< of |v|: beyond it the scheme has become unstable
  double largest_change_ = 0, time_ = 0, rest_time_ = 0;
  double last_length_ = 0;
  double stiffness_ = 0;  ///< fixed steps: the largest rate at which fluxes change a state
  std::vector<TimeStep> steps_;
  std::uint64_t n_steps_ = 0, n_iterations_ = 0, n_cell_updates_ = 0, n_rest_checked_ = 0, n_smoothed_ = 0;
  bool is_steady_ = false;
  std::string message_;
};

}  // namespace shearfront::diffusion
