// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <any>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/scene/entries.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/field.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/solver/option.hpp"

/// What every solver offers to the program, the fits and the cross tests. A solver never includes another
/// solver.
namespace shearfront {

/// Called now and then with (t, collisions or cell updates so far); returns false to stop with
/// Status::interrupted.
using Progress = std::function<bool(double, std::uint64_t)>;

/// What a run is to keep beside the solution.
struct Watch {
  bool timeline = false;  ///< event times are wanted (solvers with has_timeline)
  bool fronts = false;    ///< front segments are wanted (solvers with has_fronts)
  Progress progress;
  double last_time =
      0;  ///< the latest time that will be asked for, where it is known: work that is too much for
          ///< it is refused before any is done
};

/// One front of a front-tracking solution from its birth to its end: a straight segment of the (t, z) plane
/// with the states on both sides. Interfaces and walls are not fronts and appear in no list of segments.
template <Real Scalar>
struct FrontSegment {
  std::size_t layer;
  Scalar t_begin, z_begin, t_end, z_end;
  Scalar phi_below, phi_above;
};

/// A computation under way, from t = 0 on.
class Run {
 public:
  virtual ~Run() = default;

  /// Goes on to time t, not before the time reached; +infinity asks for the steady state. Status::ok, or steady: nothing
  /// changes any more; otherwise summary() says why it ended, and there is no field.
  virtual Status advance(double t) = 0;
  /// The solution at the time reached; valid until the next advance(). Precondition: advance() was called, with success.
  [[nodiscard]] virtual const Field& field() = 0;
  /// Event times; empty if the solver knows none. May go on to the steady state.
  [[nodiscard]] virtual std::optional<Timeline<double>> timeline() { return std::nullopt; }
  /// The fronts up to the time reached.
  [[nodiscard]] virtual std::vector<FrontSegment<double>> fronts() { return {}; }
  /// How it went so far.
  [[nodiscard]] virtual Summary summary() const = 0;
};

/// What a solver promises; the cross tests check exactly what is promised here.
struct Guarantees {
  bool diffusion = false;          ///< solves beds with diffusion, and no others
  bool exact = false;              ///< M and phi to rounding
  bool conservative = false;       ///< M(top, t) equals the initial mass to rounding
  bool bounded = false;            ///< phi stays in the range of the flux
  double order_phi = 0;            ///< L1 order of phi in the resolution, 0 if exact
  double order_M = 0;              ///< order of M in the resolution, 0 if exact; see also order_M of Solver
  double least_order_M = 0;        ///< the same where it is less, 0 if nowhere
  std::string_view where_least{};  ///< which scenes those are, for `shearfront list`
  bool has_slab = false;    ///< solves slabs, phi(x, z, t), and no others; the field is then the mean over x
  bool has_fronts = false;  ///< can return front segments
  bool has_timeline = false;  ///< can return event times
  bool has_profiles = false;  ///< can return the solution as a function of z: it is linear in pieces
};

/// A place in the (t, z) plane.
struct Place {
  double t = 0, z = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// How far a number may be moved to smaller and to larger values, in its own unit.
struct StepRange {
  double down = std::numeric_limits<double>::infinity();
  double up = std::numeric_limits<double>::infinity();
};

/// Samples at some places and their derivatives with respect to some numbers of the scene.
struct Linearisation {
  std::vector<Sample> samples;      ///< one per place
  std::vector<Sample> derivatives;  ///< [place * number of entries + entry]: d phi, d M
  /// Of a solution made of events, empty otherwise: per entry, how far it may be moved alone while the order of events up to the last
  /// place stays as it is to first order (track/linearise.hpp). Beyond that the derivatives are those of another order.
  std::vector<StepRange> order_holds;
  /// The order itself as a number: of two runs with equal ones it is the same. 0 where order_holds is empty.
  std::uint64_t order = 0;
  Summary summary;
};

/// Samples at some places and the derivatives of one weighted sum of them.
struct LinearSum {
  std::vector<Sample> samples;   ///< one per place
  std::vector<double> gradient;  ///< one per entry
  Summary summary;
};

/// Called with the samples once they are known; returns the weights of phi and M of each in a sum.
using SumWeights = std::function<std::vector<Sample>(const std::vector<Sample>&)>;

/// Integrals of a function of the share at some times, and their derivatives.
struct LinearIntegrals {
  std::vector<double> integrals;         ///< one per time
  std::vector<double> derivatives;       ///< [time * number of entries + entry]
  std::vector<double> mass_derivatives;  ///< of int phi dz
  Summary summary;
};

/// Event times and their derivatives.
struct LinearTimeline {
  Timeline<double> times;
  TimelineDerivatives derivatives;  ///< with respect to the entries asked for, in their order
  Summary summary;
};

/// A solver. Its Options list their fields (solver/option.hpp).
///
///   order_M   optional, where guarantees() has a least_order_M: whether this scene is one of those, as the order of M
///   refusal   why it cannot solve the scene with these options, in one clause; empty if it can. It names no other
///             solver: what can solve the scene instead is found by asking all (solver/method.hpp)
///   start     precondition: refusal is empty. The scene must outlive the run
///   forewarning  optional: what is known before a run of the work it may become, in one clause; empty if that is little,
///             and where there is a refusal
template <class S>
concept Solver = requires(const Scene<double>& scene, const typename S::Options& options,
                          const Watch& watch) {
  { S::kName } -> std::convertible_to<std::string_view>;
  { S::kDescription } -> std::convertible_to<std::string_view>;
  { S::kScenes } -> std::convertible_to<std::string_view>;  ///< which scenes it solves, for `shearfront list`
  { S::guarantees() } -> std::same_as<Guarantees>;
  { S::refusal(scene, options) } -> std::same_as<std::string>;
  { S::start(scene, options, watch) } -> std::same_as<std::unique_ptr<Run>>;
};

/// The order of M that a solver promises for a scene.
template <Solver S>
[[nodiscard]] double order_M_of(const Scene<double>& scene) {
  if constexpr (requires { S::order_M(scene); })
    return S::order_M(scene);
  else
    return S::guarantees().order_M;
}

/// A solver that can differentiate its solution, exactly up to rounding.
///
///   derivative_refusal  why it has no derivatives with respect to an entry of the scene; empty if it has
///   linearise           samples at the places, and derivatives with respect to entries(scene.spec())[i] for i of
///                       `entries` (none: samples only). `memory` is what the solver likes to keep from one call to the
///                       next, with numbers near by; empty at first. `progress` as in Watch. Preconditions: both refusals
///                       are empty
///   has_steps           optional: whether phi is constant between jumps that move with the entries. Its derivative at a place is then 0 or
///                       that of a state, and what a misfit of phi changes with the jumps is not in it
///   linearise_sum       optional: samples and d/dp sum_i (w_i.phi phi_i + w_i.M M_i), p the entries, at a cost that hardly grows with their
///                       number, where has_linear_sum(options) says so: that of what linearise gives, up to rounding, and the
///                       samples to the bit. `weights` is not called for a run that does not come to its end. Preconditions:
///                       those of linearise, and finite times
///   linearise_integrals, linearise_timeline  optional: the same of int c g(phi / c) dz at some times, 0 <= t <= infinity, where g
///                       has a slope, and of the event times
template <class S>
concept DifferentiableSolver = Solver<S> &&
    requires(const Scene<double>& scene, const typename S::Options& options, const Entry& entry,
             const std::vector<Place>& places, const std::vector<std::size_t>& entries, std::any& memory,
             const Progress& progress) {
  { S::derivative_refusal(scene, options, entry) } -> std::same_as<std::string>;
  { S::linearise(scene, options, places, entries, memory, progress) } -> std::same_as<Linearisation>;
};

}  // namespace shearfront
