// SPDX-License-Identifier: BSD-3-Clause
#include "soak/curved.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "shearfront/io/scene_text.hpp"
#include "shearfront/track/curved_field.hpp"
#include "shearfront/track/curved_reconstruct.hpp"
#include "shearfront/track/tracker.hpp"
#include "soak/laws.hpp"
#include "support/curved_scenes.hpp"

namespace shearfront::soak {
namespace {

using CurvedTracker = Tracker<LevelCurves, NoObserver, CurvedSystem<NoObserver>>;

constexpr double kCurvedMassSlack = 1e-12, kCurvedOrderSlack = 1e-12;  // heights are 1
constexpr std::uint64_t kMostCurvedEvents = 500'000;

/// A bed under way with all that its laws need to be seen.
struct CurvedRun {
  Scene<double> scene;
  std::shared_ptr<const CurvedBed> bed;
  CurvedTracker tracker;

  CurvedRun(const SceneSpec<double>& spec, double resolution)
      : scene(spec),
        bed(make(scene, resolution)),
        tracker(CurvedSystem<NoObserver>(bed->grid, bed->scene.problem, {}, SIZE_MAX)) {}
  static std::shared_ptr<const CurvedBed> make(const Scene<double>& scene, double resolution) {
    CurvedScene curved = curved_scene(scene, resolution);
    LevelPlan plan = plan_levels(curved.problem, resolution);
    return std::make_shared<const CurvedBed>(std::move(curved), std::move(plan), resolution);
  }
  Status advance(double t) {
    RunLimits limits;
    limits.max_collisions = kMostCurvedEvents;
    return tracker.advance_to(t, limits);
  }
  [[nodiscard]] CurvedSnapshot snapshot() const { return snapshot_of(tracker.system(), tracker.time()); }
  /// Of a grain of the fastest place through the bed.
  [[nodiscard]] double unit_time() const {
    double rate = 0;
    for (const RatePiece& piece : bed->scene.problem.pieces) rate = std::max({rate, piece.low, piece.high});
    return 1 / rate;
  }
  /// Positions as they are, before rounding is cut off.
  [[nodiscard]] double disorder() const {
    double worst = 0, last = -infinity<double>();
    const auto& fronts = tracker.system().fronts();
    fronts.for_each([&](FrontIndex i, const CurvedNode& node) {
      const double z = fronts.is_boundary(i) ? node.z : position_of(bed->grid, node, tracker.time());
      worst = std::max(worst, last - z);
      last = z;
    });
    return worst;
  }
};

class CurvedLaws {
 public:
  CurvedLaws(const CurvedTrial& trial, CurvedWorst& worst) : trial_(trial), worst_(worst) {}

  Findings run() {
    found_.n_scenes = 1;
    CurvedRun direct(trial_.spec, trial_.resolution);
    const double unit = direct.unit_time();
    times_ = {0.0, 0.1 * unit, 0.4 * unit, unit, 2.5 * unit};
    if (trial_.kind == CurvedKind::hostile)
      for (const double later : {1e2, 1e4, 1e7, 1e11}) times_.push_back(later * unit);
    CurvedRun stopped = direct;
    if (!reach_rest(direct)) return std::move(found_);
    for (const double t : times_) {
      stopped.advance(t);
      check_state(stopped, at(t));
    }
    check_restart(direct, stopped);
    check_scaling(direct);
    if (trial_.kind == CurvedKind::parabola) check_mirror();
    return std::move(found_);
  }

 private:
  bool reach_rest(CurvedRun& run) {
    const Status status = run.advance(infinity<double>());
    ++found_.n_runs;
    found_.n_collisions += run.tracker.n_collisions();
    found_.expect(status == Status::steady, "curved fronts come to rest", [&] {
      return std::to_string(run.tracker.n_collisions()) +
             " collisions, t = " + number_text(run.tracker.time());
    });
    if (status != Status::steady) return false;
    check_state(run, "at rest");
    for (const State state : run.snapshot().state)
      found_.expect(run.bed->grid.level(state) == 0, "what rests is pure",
                    [&] { return "state " + std::to_string(state); });
    return true;
  }

  void check_state(const CurvedRun& run, const std::string& when) {
    const auto where = [&] { return when; };
    const CurvedSnapshot snapshot = run.snapshot();
    const double mass = run.scene.mass(), order = run.disorder(),
                 amount = run.bed->scene.heights.amount_of(snapshot.z.back(), snapshot.below.back());
    found_.expect_near(amount, mass, kCurvedMassSlack, "curved fronts keep the mass", where);
    found_.expect_between(order, 0, 0, kCurvedOrderSlack, "curved fronts keep their order", where);
    worst_.mass = std::max(worst_.mass, std::abs(amount - mass));
    worst_.order = std::max(worst_.order, order);
    const CurvedReconstruction lines(*run.bed, run.tracker.system().fronts(), snapshot);
    check_profile(run, *CurvedField(run.bed, snapshot).profile(), "steps", when);
    check_profile(run, lines.profile(), "lines", when);
  }
  void check_profile(const CurvedRun& run, const Profile<double>& profile, const std::string& of,
                     const std::string& when) {
    const auto where = [&] { return of + ", " + when; };
    found_.expect_near(profile.mass(), run.scene.mass(), kCurvedMassSlack, "profiles keep the mass", where);
    double least = 0, excess = 0;
    for (std::size_t i = 0; i < profile.n_cells(); ++i) {
      const double middle = profile.z()[i] + (profile.z()[i + 1] - profile.z()[i]) / 2;
      const bool is_in_layers = is_constant_in_pieces<double>(run.scene.spec().solid_fraction);
      const auto check = [&](double z, double phi) {
        least = std::min(least, phi);
        excess = std::max(excess, phi - run.scene.range_at(is_in_layers ? middle : z).highest * (1 + 4e-16));
      };
      check(profile.z()[i], profile.below()[i]);
      check(profile.z()[i + 1], profile.above()[i]);
    }
    found_.expect(least >= 0 && excess <= 0, "phi stays in its range",
                  [&] { return number_text(least) + ", " + number_text(excess) + ": " + where(); });
  }

  /// `direct` is at rest, `stopped` is not.
  void check_restart(const CurvedRun& direct, CurvedRun& stopped) {
    const auto where = [] { return std::string(); };
    CurvedTracker copy = stopped.tracker;
    copy.run_to_steady();
    stopped.advance(infinity<double>());
    const CurvedSnapshot a = direct.snapshot(), b = stopped.snapshot();
    found_.expect(a.z == b.z && a.state == b.state && a.below == b.below, "stops change nothing", where);
    for (const CurvedTracker* other : {&stopped.tracker, &copy}) {
      found_.expect(other->last_collision() == direct.tracker.last_collision() &&
                        other->n_collisions() == direct.tracker.n_collisions(),
                    "stops and copies change no event", [&] {
                      return number_text(other->last_collision()) + " for " +
                             number_text(direct.tracker.last_collision());
                    });
    }
    CurvedRun again(trial_.spec, trial_.resolution), at_once(trial_.spec, trial_.resolution);
    const double t = times_.back();
    for (int i = 1; i < 7; ++i) again.advance(t * i / 7);
    again.advance(t);
    at_once.advance(t);
    const CurvedSnapshot c = again.snapshot(), d = at_once.snapshot();
    found_.expect(c.z == d.z && c.state == d.state && c.below == d.below, "stops change nothing",
                  [&] { return at(t); });
  }

  /// Twice the scale is half of every time.
  void check_scaling(const CurvedRun& direct) {
    SceneSpec<double> spec = trial_.spec;
    spec.scale *= 2;
    CurvedRun twice(spec, trial_.resolution);
    twice.advance(infinity<double>());
    const auto last = [](const CurvedRun& run) {
      return run.tracker.last_collision() * run.bed->scene.time_unit;
    };
    found_.expect(
        2 * last(twice) == last(direct) && twice.tracker.n_collisions() == direct.tracker.n_collisions(),
        "twice the scale halves all times",
        [&] { return number_text(2 * last(twice)) + " for " + number_text(last(direct)); });
  }

  /// u(z, t) of a bed is 1 - u(1 - z, t) of the bed upside down. Levels are chosen alike, so what differs is rounding.
  void check_mirror() {
    constexpr double kMirrorSlack = 1e-11;
    CurvedRun run(trial_.spec, trial_.resolution),
        turned(support::turned_over(trial_.spec), trial_.resolution);
    for (const double t : times_) {
      run.advance(t);
      turned.advance(t);
      const CurvedField a(run.bed, run.snapshot()), b(turned.bed, turned.snapshot());
      for (int i = 0; i <= 20; ++i) {
        const double z = 0.05 * i;
        // M(z) = m - (1 - z) + M_mirror(1 - z).
        const double M = a.at(z).M, mirrored = run.scene.mass() - (1 - z) + b.at(1 - z).M;
        found_.expect_near(M, mirrored, kMirrorSlack, "upside down is the mirror image",
                           [&] { return at(z, t); });
        worst_.mirror = std::max(worst_.mirror, std::abs(M - mirrored));
      }
    }
  }

  const CurvedTrial& trial_;
  CurvedWorst& worst_;
  Findings found_;
  std::vector<double> times_;
};

}  // namespace

CurvedTrial draw_curved(CurvedKind kind, std::uint64_t seed) {
  support::SceneMaker maker(seed ^ 0xc0ffeeULL);
  const double resolution = std::pow(10.0, maker.uniform(-2, -0.3));
  switch (kind) {
    case CurvedKind::parabola:
      return {kind, seed, support::random_curved_spec(seed), resolution};
    case CurvedKind::any_flux:
      return {kind, seed, support::random_curved_flux_spec(seed), resolution};
    case CurvedKind::smooth:  // of many pieces where it is fine
      return {kind, seed, support::random_smooth_spec(seed), std::max(resolution, 0.03)};
    default:
      return {kind, seed, support::hostile_curved_spec(seed), resolution};
  }
}
CurvedTrial draw_curved(std::uint64_t seed) {
  constexpr CurvedKind kKinds[] = {CurvedKind::parabola, CurvedKind::any_flux, CurvedKind::smooth};
  return draw_curved(kKinds[seed % 3], seed);
}

std::string text_of(const CurvedTrial& trial) {
  return "# curved, seed " + std::to_string(trial.seed) + ", resolution " + number_text(trial.resolution) +
         "\n" + scene_text(trial.spec);
}

Findings check_curved(const CurvedTrial& trial, CurvedWorst* worst) {
  CurvedWorst ignored;
  return CurvedLaws(trial, worst ? *worst : ignored).run();
}

}  // namespace shearfront::soak
