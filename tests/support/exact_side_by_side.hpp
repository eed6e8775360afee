// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "support/closeness.hpp"

/// The exact engine in double and in 50 digits, compared point by point.
namespace shearfront::support {

/// A place and a time where the exact solution is asked for.
struct Point {
  double z, t;
};

/// The largest differences between two evaluations. M is relative to the height of the bed, phi, H and times
/// to themselves, derivatives (each times its parameter, heights times the height of the bed) to the largest
/// of the same quantity at the same point.
struct ExactDifferences {
  std::size_t points = 0;
  std::size_t other_path = 0;  ///< points where another path is the minimum: a shock, or the edge of a fan
  std::size_t other_time = 0;  ///< times that only one of the two has
  double M = 0, phi = 0, H = 0, first = 0, last = 0, dM = 0, dphi = 0;

  void add(const ExactDifferences& other) {
    points += other.points;
    other_path += other.other_path;
    other_time += other.other_time;
    for (const auto member :
         {&ExactDifferences::M, &ExactDifferences::phi, &ExactDifferences::H, &ExactDifferences::first,
          &ExactDifferences::last, &ExactDifferences::dM, &ExactDifferences::dphi})
      this->*member = std::max(this->*member, other.*member);
  }
};

namespace exact_side_by_side_detail {

/// What each derivative is multiplied by: its entry, of heights the height of the bed; 0 where it is refused. Asking
/// for a refusal takes as long as there are entries: once per scene, not per point.
template <Real Scalar>
std::vector<Scalar> units(const Scene<Scalar>& scene) {
  std::vector<Scalar> all;
  SceneSpec<Scalar> spec = scene.spec();
  const auto places = entry_places(spec);
  const auto named = entries(spec);
  for (std::size_t i = 0; i < named.size(); ++i) {
    const bool is_height = named[i].field.ends_with(".breaks") || named[i].field.ends_with(".z");
    all.push_back(!derivative_refusal(scene, named[i]).empty() ? Scalar(0)
                  : is_height                                  ? Scalar(scene.top() - scene.bottom())
                  : named[i].field == "initial.values"         ? Scalar(1)
                                                               : *places[i]);
  }
  return all;
}

}  // namespace exact_side_by_side_detail

/// Everything the exact engine says about a scene, at some points.
template <Real Scalar>
struct ExactRun {
  Scene<Scalar> scene;
  Timeline<Scalar> timeline;
  std::vector<typename Derivatives<Scalar>::At> values;
  std::vector<exact::Path<Scalar>> paths;
  std::vector<Scalar> units;

  /// Without `timeline` only the points are evaluated.
  ExactRun(const Scene<Scalar>& of, const std::vector<Point>& points, bool with_timeline = true)
      : scene(of), units(exact_side_by_side_detail::units(of)) {
    if (with_timeline) timeline = exact_timeline(scene);
    const ExactSolution<Scalar> solution(scene);
    const Derivatives<Scalar> derivatives(solution);
    for (const Point& p : points) {
      values.push_back(derivatives.at(Scalar(p.z), Scalar(p.t)));
      paths.push_back(solution.path(Scalar(p.z), Scalar(p.t)));
    }
  }
};

namespace exact_side_by_side_detail {

template <Real Scalar>
std::vector<Scalar> scaled(const std::vector<Scalar>& units, const std::vector<Scalar>& derivatives) {
  std::vector<Scalar> all;
  for (std::size_t i = 0; i < units.size(); ++i) all.push_back(units[i] * derivatives[i]);
  return all;
}

template <Real A, Real B>
double difference(const std::vector<A>& x, const std::vector<B>& y) {
  B largest(0), worst(0);
  const auto size = [](const B& v) { return v < 0 ? B(-v) : v; };
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, size(y[i]));
    worst = std::max(worst, size(B(x[i]) - y[i]));
  }
  return largest > 0 ? to_double(B(worst / largest)) : to_double(worst);
}

}  // namespace exact_side_by_side_detail

/// `run` against `oracle`, which has at least its precision.
template <Real A, Real B>
[[nodiscard]] ExactDifferences compare(const ExactRun<A>& run, const ExactRun<B>& oracle) {
  using namespace exact_side_by_side_detail;
  ExactDifferences out;
  const auto time = [&](const std::optional<A>& x, const std::optional<B>& y, double& worst) {
    if (x.has_value() != y.has_value()) {
      ++out.other_time;
    } else if (x) {
      worst = std::max(worst, relative_error(B(*x), *y));
    }
  };
  time(run.timeline.t0, oracle.timeline.t0, out.first);
  time(run.timeline.t1, oracle.timeline.t1, out.first);
  time(run.timeline.t_star, oracle.timeline.t_star, out.last);
  for (std::size_t i = 0; i < oracle.timeline.interfaces.size(); ++i) {
    time(run.timeline.interfaces[i].first, oracle.timeline.interfaces[i].first, out.first);
    time(run.timeline.interfaces[i].last, oracle.timeline.interfaces[i].last, out.last);
  }
  const B height = oracle.scene.top() - oracle.scene.bottom();
  out.points = run.values.size();
  for (std::size_t i = 0; i < run.values.size(); ++i) {
    const auto& mine = run.values[i];
    const auto& theirs = oracle.values[i];
    out.M = std::max(out.M, std::abs(to_double(B((B(mine.value.M) - theirs.value.M) / height))));
    const auto& p = run.paths[i];
    const auto& q = oracle.paths[i];
    if (p.kind != q.kind || p.source != q.source || p.upward != q.upward || p.interface != q.interface) {
      ++out.other_path;
      continue;
    }
    out.phi = std::max(out.phi, relative_error(B(mine.value.phi), theirs.value.phi));
    out.H = std::max(out.H, relative_error(B(mine.value.H), theirs.value.H));
    out.dM = std::max(out.dM, difference(scaled(run.units, mine.M), scaled(oracle.units, theirs.M)));
    out.dphi = std::max(out.dphi, difference(scaled(run.units, mine.phi), scaled(oracle.units, theirs.phi)));
  }
  return out;
}

}  // namespace shearfront::support
