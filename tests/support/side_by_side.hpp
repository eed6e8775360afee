// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "shearfront/track/setup.hpp"

/// Runs of one tracker in double and in 50 digits, compared event by event.
namespace shearfront::support {

/// One collision: where it was, which states met, when.
template <Real Scalar>
struct Event {
  std::size_t layer, boundary;  ///< boundary: CollisionView::kNoBoundary inside a layer
  State below, above;           ///< outermost states of the fronts that met
  Scalar t, z;

  [[nodiscard]] auto kind() const { return std::tuple(boundary, layer, below, above); }
};

/// Observer that keeps the collisions and nothing else.
template <Real Scalar>
class EventLog {
 public:
  static constexpr bool kActive = true;

  template <class Grid>
  void collision(const Grid&, const CollisionView<Scalar>& view) {
    if (view.incoming.empty()) return;  // the start
    const auto &first = view.incoming.front(), &last = view.incoming.back();
    events_.push_back({first.layer, view.boundary, first.below, last.above, view.t, view.z});
  }
  template <class Grid>
  void end_of(const Grid&, const FrontView<Scalar>&, const Scalar&, const Scalar&) {}
  void close() {}
  [[nodiscard]] const std::vector<Event<Scalar>>& events() const { return events_; }

 private:
  std::vector<Event<Scalar>> events_;
};

/// The largest differences between two runs. Times relative, everything else relative to the height of the
/// bed.
struct Differences {
  std::size_t events = 0;     ///< collisions of the 50-digit run
  std::size_t unmatched = 0;  ///< collisions of either run that the other does not have
  std::size_t displaced = 0;  ///< collisions that come earlier in the double run than one they follow
  double displaced_by = 0;    ///< by how much at most, relative time
  double time = 0, place = 0, t_star = 0, M = 0, position = 0;

  void add(const Differences& other) {
    events += other.events;
    unmatched += other.unmatched;
    displaced += other.displaced;
    displaced_by = std::max(displaced_by, other.displaced_by);
    time = std::max(time, other.time);
    place = std::max(place, other.place);
    t_star = std::max(t_star, other.t_star);
    M = std::max(M, other.M);
    position = std::max(position, other.position);
  }
};

/// What a run leaves behind.
template <Real Scalar>
struct Run {
  std::vector<Event<Scalar>> events;
  std::vector<std::vector<Scalar>> M, z;  ///< per time: M at equidistant heights, heights of all fronts
  Scalar t_star{0}, height{1};
};

template <Real Scalar>
[[nodiscard]] Run<Scalar> run(const Scene<Scalar>& scene, double resolution, const std::vector<double>& times,
                              int n_heights = 32) {
  const TrackingSetup<Scalar> setup(scene, Scalar(resolution));
  Tracker<LevelGrid<Scalar>, EventLog<Scalar>> tracker(setup);
  Run<Scalar> result;
  result.height = scene.top() - scene.bottom();
  for (const double t : times) {
    tracker.advance_to(Scalar(t));
    const Profile<Scalar> profile = tracker.profile();
    result.z.push_back(profile.z());
    auto& M = result.M.emplace_back();
    for (int i = 1; i < n_heights; ++i)
      M.push_back(profile.at(scene.bottom() + result.height * (Scalar(i) / Scalar(n_heights))).M);
  }
  tracker.run_to_steady();
  result.t_star = tracker.last_collision();
  result.events = tracker.observer().events();
  return result;
}

namespace side_by_side_detail {

/// Events of one kind in the order of time; those that coincide within rounding in the order of height.
template <Real Scalar>
void sort(std::vector<const Event<Scalar>*>& events) {
  const Scalar coincide(1e-9);
  std::sort(events.begin(), events.end(), [](auto* a, auto* b) { return a->t < b->t; });
  for (auto begin = events.begin(); begin != events.end();) {
    auto end = begin + 1;
    while (end != events.end() && (*end)->t - (*(end - 1))->t <= coincide * (*end)->t) ++end;
    std::sort(begin, end, [](auto* a, auto* b) { return a->z < b->z; });
    begin = end;
  }
}

inline double size(double x) { return x < 0 ? -x : x; }

template <Real A, Real B>
double relative(const A& x, const B& y) {
  const B d = B(x) - y;
  return y == 0 ? size(to_double(d)) : size(to_double(B(d / y)));
}

}  // namespace side_by_side_detail

/// `run` against `oracle`, which has at least its precision.
template <Real A, Real B>
[[nodiscard]] Differences compare(const Run<A>& run, const Run<B>& oracle) {
  using namespace side_by_side_detail;
  Differences out;
  out.events = oracle.events.size();
  using Kind = std::tuple<std::size_t, std::size_t, State, State>;
  std::map<Kind, std::pair<std::vector<const Event<A>*>, std::vector<const Event<B>*>>> kinds;
  for (const auto& e : run.events) kinds[e.kind()].first.push_back(&e);
  for (const auto& e : oracle.events) kinds[e.kind()].second.push_back(&e);
  std::vector<std::pair<A, B>> times;
  for (auto& [kind, events] : kinds) {
    auto& [mine, theirs] = events;
    sort(mine);
    sort(theirs);
    if (mine.size() != theirs.size()) {
      out.unmatched += mine.size() + theirs.size();
      continue;
    }
    for (std::size_t i = 0; i < mine.size(); ++i) {
      times.emplace_back(mine[i]->t, theirs[i]->t);
      out.time = std::max(out.time, relative(mine[i]->t, theirs[i]->t));
      out.place = std::max(out.place, size(to_double(B((B(mine[i]->z) - theirs[i]->z) / oracle.height))));
    }
  }
  std::sort(times.begin(), times.end());
  B latest(0);
  for (const auto& [mine, theirs] : times) {
    if (theirs < latest) {
      ++out.displaced;
      out.displaced_by = std::max(out.displaced_by, to_double(B((latest - theirs) / latest)));
    }
    latest = std::max(latest, theirs);
  }
  out.t_star = relative(run.t_star, oracle.t_star);
  for (std::size_t k = 0; k < run.M.size(); ++k) {
    for (std::size_t i = 0; i < run.M[k].size(); ++i)
      out.M = std::max(out.M, size(to_double(B((B(run.M[k][i]) - oracle.M[k][i]) / oracle.height))));
    if (run.z[k].size() != oracle.z[k].size()) continue;  // a moment within rounding of a collision
    for (std::size_t i = 0; i < run.z[k].size(); ++i)
      out.position =
          std::max(out.position, size(to_double(B((B(run.z[k][i]) - oracle.z[k][i]) / oracle.height))));
  }
  return out;
}

}  // namespace shearfront::support
