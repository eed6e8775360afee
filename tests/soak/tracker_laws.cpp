// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "oracles/verify.hpp"
#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/setup.hpp"
#include "soak/laws.hpp"
#include "support/scene_cast.hpp"

namespace shearfront::soak {
namespace {

using Tracked = Tracker<LevelGrid<double>>;

// docs/evidence/accuracy.md: mass to 1e-13 of the largest height, however many events.
constexpr double kMassSlack = 1e-13;
constexpr double kSpeedSlack = 1e-9;
// Small amounts, in states next to pure ones or in thin pieces: they move long after M is final to rounding.
constexpr double kTrace = 1e-3;
// Fronts of the first moment; larger grids are made coarser.
constexpr double kMostFronts = 1e5;

double affordable_resolution(const Bed& bed) {
  double resolution = bed.trial.options.at("resolution");
  const double n_pieces = static_cast<double>(bed.stack.n_layers() + bed.scene.initial_values().size());
  while (resolution < 1 &&
         LevelGrid<double>::exact_level_count(bed.stack, resolution) * n_pieces > kMostFronts)
    resolution = std::min(1.0, 2 * resolution);
  return resolution;
}

/// Relative rounding of the flux of the polygons, which acts like one of time. A level h is a state with
/// q = sqrt(1 - h / c) in a layer of capacity c; rounding moves h / c by some u and the state by e = 4 u / q,
/// at most 2 sqrt(u). A chord of length d between states on the curve follows by d e, next to fluxes of 1/4.
double polygon_rounding(const Bed& bed, double resolution) {
  const double u = unit_roundoff<double>();
  double largest = 0;
  const auto add_level = [&](double h) {
    for (std::size_t k = 0; k < bed.stack.n_layers(); ++k)
      if (const double c = bed.stack.rate(k); h < c)
        largest = std::max(largest, 4 * u / std::sqrt(std::max(1 - h / c, 4 * u)));
  };
  for (std::size_t k = 0; k < bed.stack.n_layers(); ++k) add_level(bed.stack.rate(k));
  for (const auto& piece : initial_pieces(bed.layered, bed.stack).states)
    add_level(4 * bed.stack.rate(piece.layer) * piece.phi * (1 - piece.phi));
  return bed.t_rounding() + 4 * resolution * largest;
}

/// What 1 - phi loses of the initial states, as a flux: the mirror image starts from others by so much.
double rounding_of_states(const Bed& bed) {
  double moved = 0, fastest = 0;
  for (const double phi : bed.layered.initial_values())
    moved = std::max(moved, std::abs((1 - (1 - phi)) - phi));
  for (std::size_t k = 0; k < bed.stack.n_layers(); ++k) fastest = std::max(fastest, bed.stack.rate(k));
  return moved * fastest;
}

/// Whether the states are counted to decide how the grid takes them: rounding may make two of one.
bool may_use_chords(const Bed& bed) {
  return bed.stack.n_layers() + bed.scene.initial_values().size() > LevelGrid<double>::kMaxExactStates;
}

bool same(const Profile<double>& a, const Profile<double>& b) {
  return a.z() == b.z() && a.below() == b.below() && a.above() == b.above();
}

void check_range_and_mass(const Bed& bed, const Profile<double>& profile, double mass, double t,
                          const std::string& what, Findings& findings) {
  findings.expect_near(profile.mass(), mass, kMassSlack * bed.trial.largest_height(), what + ": mass",
                       [&] { return at(t); });
  bool in_range = true;
  for (std::size_t i = 0; i < profile.n_cells(); ++i)
    in_range &= std::min(profile.below()[i], profile.above()[i]) >= 0 &&
                std::max(profile.below()[i], profile.above()[i]) <= 1;
  findings.expect(in_range, what + ": phi in [0, 1]", [&] { return at(t); });
}

void check_state(const Bed& bed, const Tracked& tracker, double mass, Findings& findings) {
  const double t = tracker.time(), size = bed.trial.largest_height();
  findings.expect_near(tracker.mass(), mass, kMassSlack * size, "tracker: mass of unrounded positions",
                       [&] { return at(t); });
  check_range_and_mass(bed, tracker.profile(), mass, t, "tracker", findings);
  check_range_and_mass(bed, linear_profile(tracker), mass, t, "tracker, lines", findings);
  const auto violations = verify(tracker, kMassSlack * size, kSpeedSlack);
  findings.expect(violations.empty(), "tracker: order, Rankine-Hugoniot, entropy, interfaces, walls", [&] {
    return violations.front() + " and " + std::to_string(violations.size() - 1) + " more";
  });
}

/// The tracker solves the problem of the polygon f~ >= f exactly. By the minimum over paths its M~ lies below
/// M; since f~ <= f + d^2 / 4 and f~ <= (1 - d) f for states at most d apart (the last where a chord ends in
/// a pure state),
///     M(z, (1 - d) t) <= M~(z, t) <= M(z, t),   M - M~ <= t max(s a) d^2 / 4.
class Bracket {
 public:
  Bracket(const Bed& bed, double resolution)
      : bed_(bed),
        resolution_(resolution),
        slack_(4 * bed.M_rounding() + kMassSlack * bed.trial.largest_height()) {
    for (std::size_t k = 0; k < bed.stack.n_layers(); ++k) fastest_ = std::max(fastest_, bed.stack.rate(k));
    const std::vector<double>& values = bed.scene.initial_values();
    const std::vector<double>& breaks = bed.scene.initial_breaks();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double impurity = std::min(values[i], 1 - values[i]);
      has_traces_ |= impurity > 0 && impurity < kTrace;
      has_traces_ |= i > 0 && i < breaks.size() && breaks[i] - breaks[i - 1] < kTrace * bed.trial.height();
    }
  }
  void check(const Profile<double>& profile, double t, Findings& findings) const {
    const double rounding = bed_.t_rounding();
    const double later = std::isfinite(t) ? t * (1 + rounding) : t,
                 sooner = resolution_ < 1 ? t * (1 - resolution_) * (1 - rounding) : 0;
    for (const double z : bed_.heights) {
      double least = bed_.layered_exact.M(z, sooner);
      if (std::isfinite(t))
        least = std::max(least, bed_.layered_exact.M(z, t * (1 - rounding)) -
                                    t * fastest_ * resolution_ * resolution_ / 4);
      findings.expect_between(profile.at(z).M, least, bed_.layered_exact.M(z, later), slack_,
                              "tracker: M against the exact solution", [&] { return at(z, t); });
    }
  }
  /// An event after which M no longer grows, `H` being its growth just before. Where data are nearly pure the
  /// last of M comes in trickles below its rounding: then only the bound from below holds.
  void check_time(const std::optional<double>& tracked, const std::optional<double>& exact, double H,
                  const std::string& what, Findings& findings) const {
    if (!has_traces_)
      findings.expect(tracked.has_value() == exact.has_value(), what + " exists in both",
                      [&] { return exact ? number_text(*exact) : std::string("exact: never"); });
    if (!tracked || !exact || !(H > 0)) return;
    const double latest = resolution_ < 1 && !has_traces_ ? *exact / (1 - resolution_) : infinity<double>();
    findings.expect_between(*tracked, *exact, latest, bed_.t_rounding() * *exact + slack_ / H, what,
                            [] { return std::string("event"); });
  }

 private:
  const Bed& bed_;
  double resolution_, slack_, fastest_ = 0;
  bool has_traces_ = false;
};

void check_timeline(const Bed& bed, const Bracket& bracket, const Timeline<double>& tracked,
                    Findings& findings) {
  const Timeline<double> exact = exact_timeline(bed.layered);
  const auto growth = [&](double z, const std::optional<double>& t) {
    return t ? bed.layered_exact.H(z, *t * (1 - 1e-9)) : 0.0;
  };
  bracket.check_time(tracked.t_star, exact.t_star, growth(exact.steady_height, exact.t_star), "tracker: t*",
                     findings);
  if (tracked.interfaces.size() != exact.interfaces.size()) return;
  for (std::size_t i = 0; i < exact.interfaces.size(); ++i)
    bracket.check_time(tracked.interfaces[i].last, exact.interfaces[i].last,
                       growth(exact.interfaces[i].z, exact.interfaces[i].last),
                       "tracker: last wave at an interface", findings);
}

/// To the steady state, checked; the number of collisions, or nothing if there are too many.
bool check_run(const Bed& bed, const TrackingSetup<double>& setup, double resolution, const RunLimits& limits,
               Findings& findings) {
  Tracked tracker(setup);
  const Bracket bracket(bed, resolution);
  const double mass = bed.scene.mass();
  bool done = true;
  for (const double t : bed.times) {
    const Status status = tracker.advance_to(t, limits);
    done = status == Status::ok || status == Status::steady;
    if (!done) break;
    check_state(bed, tracker, mass, findings);
    bracket.check(tracker.profile(), t, findings);
  }
  ++findings.n_runs;
  findings.n_collisions += tracker.n_collisions();
  findings.n_cut_short += done ? 0 : 1;
  if (done && tracker.is_steady())
    check_timeline(bed, bracket, tracked_timeline(tracker, bed.layered, setup.stack), findings);
  return done;
}

void check_every_event(const Bed& bed, const TrackingSetup<double>& setup, Findings& findings) {
  constexpr int kMostEvents = 60;
  Tracked tracker(setup);
  double last = 0;
  for (int i = 0; i < kMostEvents && tracker.step(); ++i) {
    findings.expect(tracker.time() >= last, "tracker: events in the order of time", [&] { return at(last); });
    last = tracker.time();
    check_state(bed, tracker, bed.scene.mass(), findings);
  }
}

void check_stops(const Bed& bed, const TrackingSetup<double>& setup, Findings& findings) {
  Tracked direct(setup), stopped(setup);
  direct.advance_to(bed.trial.late);
  for (const double part : {0.0, 0.1, 0.37, 0.9}) stopped.advance_to(part * bed.trial.late);
  Tracked copy = stopped;
  copy.advance_to(bed.trial.late);
  findings.expect(same(copy.profile(), direct.profile()), "tracker: stopped and copied = direct",
                  [&] { return at(bed.trial.late); });
  stopped.run_to_steady(), direct.run_to_steady();
  findings.expect(
      stopped.last_collision() == direct.last_collision() &&
          stopped.n_collisions() == direct.n_collisions() && same(stopped.profile(), direct.profile()),
      "tracker: stopped and run to the end = direct", [&] { return at(direct.last_collision()); });
}

/// A new tracker that starts from the state at `early`. M of both: the polygon's problem, started anew.
void check_restart(const Bed& bed, const TrackingSetup<double>& setup, Findings& findings) {
  Tracked direct(setup);
  direct.advance_to(bed.trial.early);
  const auto state = direct.snapshot();
  std::vector<Piece<double>> pieces;
  for (std::size_t i = 0; i < state.state.size(); ++i)
    if (state.z[i + 1] > state.z[i]) pieces.push_back({state.layer[i], state.z[i + 1], state.state[i]});
  Tracked restarted(setup.grid, pieces, setup.ends);
  const double rounding = bed.t_rounding() * bed.trial.late;
  restarted.advance_to(bed.trial.late - bed.trial.early);
  const Profile<double> after = restarted.profile();
  direct.advance_to(std::max(bed.trial.early, bed.trial.late - rounding));
  const Profile<double> sooner = direct.profile();
  direct.advance_to(bed.trial.late + rounding);
  const Profile<double> later = direct.profile();
  const double slack = 4 * bed.M_rounding() + 2 * kMassSlack * bed.trial.largest_height();
  for (const double z : bed.heights)
    findings.expect_between(after.at(z).M, sooner.at(z).M, later.at(z).M, slack, "tracker: restart = direct",
                            [&] { return at(z, bed.trial.late); });
}

void check_symmetries(const Bed& bed, const TrackingSetup<double>& setup, double resolution,
                      Findings& findings) {
  const double t = bed.trial.late;
  Tracked tracker(setup);
  tracker.advance_to(t);
  const Profile<double> profile = tracker.profile();
  SceneSpec<double> spec = bed.layered.spec();
  const double factor = std::ldexp(1.0, static_cast<int>(bed.trial.seed % 41) - 20);
  spec.scale *= factor;
  const Scene<double> fast(spec);
  const TrackingSetup<double> fast_setup(fast, resolution);
  Tracked scaled(fast_setup);
  scaled.advance_to(t / factor);
  findings.expect(
      same(scaled.profile(), profile) && scaled.last_collision() * factor == tracker.last_collision(),
      "tracker: scaling by powers of two", [&] { return at(t); });

  const SceneSpec<double> mirror_spec = upside_down(bed.layered.spec());
  if (!find_complaints(mirror_spec).empty() || may_use_chords(bed)) return;
  const Scene<double> mirror(mirror_spec);
  const TrackingSetup<double> mirror_setup(mirror, resolution);
  if (mirror_setup.grid.n_levels() != setup.grid.n_levels())
    return;  // a piece of an ulp has gone: another grid
  Tracked mirrored(mirror_setup);
  const double rounding = polygon_rounding(bed, resolution) * t;
  mirrored.advance_to(t - rounding);
  const Profile<double> sooner = mirrored.profile();
  mirrored.advance_to(t + rounding);
  const Profile<double> later = mirrored.profile();
  const double n_moved = static_cast<double>(bed.stack.n_layers() + bed.scene.initial_values().size()),
               slack = 4 * bed.M_rounding() + rounding_of_states(bed) * t +
                       (2 * kMassSlack + 4 * unit_roundoff<double>() * n_moved) * bed.trial.largest_height();
  for (const double z : bed.heights) {
    const double reflected = bed.scene.bottom() + (bed.scene.top() - z), below = z - bed.scene.bottom();
    findings.expect_between(profile.at(z).M, below - (mirror.mass() - sooner.at(reflected).M),
                            below - (mirror.mass() - later.at(reflected).M), slack, "tracker: upside down",
                            [&] { return at(z, t); });
  }
}

void check_observer(const Bed& bed, const TrackingSetup<double>& setup, Findings& findings) {
  Tracked silent(setup);
  Tracker<LevelGrid<double>, History<double>> watched(setup);
  silent.advance_to(bed.trial.late), watched.advance_to(bed.trial.late);
  findings.expect(same(silent.profile(), watched.profile()), "tracker: observers do not steer",
                  [&] { return at(bed.trial.late); });
  const History<double> history = watched.record();
  std::uint64_t n_collisions = 0, n_born = 0;
  for (const auto& c : history.collisions()) {
    n_collisions += c.incoming.empty() ? 0 : 1;
    n_born += c.outgoing.size();
  }
  findings.expect(n_collisions == watched.n_collisions() && n_born == history.segments().size(),
                  "tracker: observers see every collision and every front",
                  [&] { return at(bed.trial.late); });
}

/// Double and 50 digits solve the same polygon's problem, up to rounding.
void check_50_digits(const Bed& bed, const TrackingSetup<double>& setup, double resolution,
                     Findings& findings) {
  const double t = bed.trial.late;
  Tracked tracker(setup);
  tracker.advance_to(t);
  if (may_use_chords(bed) || tracker.n_collisions() > 300 || tracker.n_fronts_max() > 3000) return;
  const Scene<Real110> fine = scene_cast<Real110>(bed.layered);
  const TrackingSetup<Real110> fine_setup(fine, Real110(resolution));
  Tracker<LevelGrid<Real110>> oracle(fine_setup);
  const Real110 rounding = polygon_rounding(bed, resolution) * t;
  oracle.advance_to(t - rounding);
  const Profile<Real110> sooner = oracle.profile();
  oracle.advance_to(t + rounding);
  const Profile<Real110> later = oracle.profile();
  const Profile<double> profile = tracker.profile();
  const double slack = 4 * bed.M_rounding() + kMassSlack * bed.trial.largest_height();
  for (const double z : bed.heights)
    findings.expect_between(profile.at(z).M, to_double(sooner.at(z).M), to_double(later.at(z).M), slack,
                            "tracker: M in double and in 50 digits", [&] { return at(z, t); });
}

/// The grid of the paper rounds rates and data; the laws then hold for what it has made of them.
void check_singular_mapping(const Bed& bed, double resolution, const RunLimits& limits, Findings& findings) {
  double largest = 0, least = infinity<double>();
  for (std::size_t k = 0; k < bed.stack.n_layers(); ++k) {
    largest = std::max(largest, bed.stack.shear_rate(k));
    least = std::min(least, bed.stack.shear_rate(k));
  }
  const double delta = least * std::max(resolution, 0.05);
  if (largest / delta * static_cast<double>(bed.stack.n_layers() + bed.scene.initial_values().size()) > 2e4)
    return;
  const TrackingSetup<double> setup(bed.layered, delta, GridKind::singular_mapping);
  Tracked tracker(setup);
  const double mass = tracker.mass();
  for (const double t : {bed.trial.early, bed.trial.late}) {
    const Status status = tracker.advance_to(t, limits);
    if (status != Status::ok && status != Status::steady) break;
    check_state(bed, tracker, mass, findings);
  }
  ++findings.n_runs;
  findings.n_collisions += tracker.n_collisions();
}

}  // namespace

void check_tracker(const Bed& bed, Findings& findings) {
  const double resolution = affordable_resolution(bed);
  const TrackingSetup<double> setup(bed.layered, resolution);
  const RunLimits limits{bed.trial.count("max-collisions"), {}};
  if (!check_run(bed, setup, resolution, limits, findings)) return;
  check_every_event(bed, setup, findings);
  check_stops(bed, setup, findings);
  check_restart(bed, setup, findings);
  check_symmetries(bed, setup, resolution, findings);
  check_observer(bed, setup, findings);
  if (bed.trial.seed % 4 == 0) check_50_digits(bed, setup, resolution, findings);
  check_singular_mapping(bed, resolution, limits, findings);
}

void check_tracker_pair(const Bed& bed, Findings& findings) {
  const double resolution = affordable_resolution(bed);
  support::SceneMaker make(bed.trial.seed + 3);
  SceneSpec<double> v = bed.layered.spec(), w = v;
  for (std::size_t i = 0; i < v.initial_values.size(); ++i) {
    v.initial_values[i] = make.integer(0, 2) == 0 ? make.integer(0, 1) : make.uniform(0, 1);
    w.initial_values[i] = std::max(bed.layered.initial_values()[i], v.initial_values[i]);
  }
  const Scene<double> scenes[3] = {bed.layered, Scene<double>(v), Scene<double>(w)};
  std::vector<LayerState<double>> states;
  std::vector<InitialPieces<double>> pieces;
  for (const Scene<double>& scene : scenes) {
    pieces.push_back(initial_pieces(scene, bed.stack));
    states.insert(states.end(), pieces.back().states.begin(), pieces.back().states.end());
  }
  const auto built = LevelGrid<double>::exact_levels(bed.stack, resolution, states);
  std::vector<Tracked> trackers;
  auto begin = built.states.begin();
  for (const auto& p : pieces) {
    const auto end = begin + static_cast<std::ptrdiff_t>(p.states.size());
    trackers.emplace_back(built.grid, on_grid(p, std::vector<State>(begin, end)), Ends<double>{});
    begin = end;
  }
  const RunLimits limits{bed.trial.count("max-collisions"), {}};
  const double slack = 10 * kMassSlack * bed.trial.largest_height();
  double last = l1_distance(trackers[0].profile(), trackers[1].profile());
  for (const double t : {bed.trial.early / 8, bed.trial.early, bed.trial.late, 16 * bed.trial.late}) {
    for (Tracked& tracker : trackers) {
      const Status status = tracker.advance_to(t, limits);
      if (status != Status::ok && status != Status::steady) return;
    }
    const double now = l1_distance(trackers[0].profile(), trackers[1].profile());
    findings.expect_between(now, 0, last, slack, "tracker: L1 contraction", [&] { return at(t); });
    last = now;
    findings.expect_near(l1_distance(trackers[0].profile(), trackers[2].profile()),
                         trackers[2].mass() - trackers[0].mass(), slack, "tracker: comparison",
                         [&] { return at(t); });
  }
  findings.n_runs += 3;
  for (const Tracked& tracker : trackers) findings.n_collisions += tracker.n_collisions();
}

}  // namespace shearfront::soak
