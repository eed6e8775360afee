// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "shearfront/solver/solver.hpp"
#include "shearfront/track/curved_front.hpp"
#include "shearfront/track/observers.hpp"
#include "shearfront/track/track.hpp"

namespace shearfront {

/// The exact course of one front from its origin up to (t_end, z_end).
struct CurvedTrace {
  CurvedNode front;
  double t_end, z_end;
};

/// Observer of curved fronts that keeps their courses and the events.
class CurvedRecord {
 public:
  static constexpr bool kActive = true;

  void ended(const CurvedNode& front, double t, double z) {
    if (t > front.t) traces_.push_back({front, t, z});
  }
  void met(const Collision& event) { events_.push_back(event); }

  [[nodiscard]] const std::vector<CurvedTrace>& traces() const { return traces_; }
  [[nodiscard]] const std::vector<Collision>& events() const { return events_; }

 private:
  std::vector<CurvedTrace> traces_;
  std::vector<Collision> events_;
};

/// A course as straight segments no farther from it than `tolerance` in height, each with the states next to its middle:
/// add(segment), states as values of u.
template <class Add>
void add_segments(const LevelCurves& grid, const CurvedTrace& trace, double tolerance, Add&& add) {
  const CurvedNode& f = trace.front;
  struct Point {
    double t, z;
  };
  const auto emit = [&](const Point& a, const Point& b) {
    const double z = a.z + (b.z - a.z) / 2;
    add(FrontSegment<double>{f.layer, a.t, a.z, b.t, b.z, grid.phi(f.layer, f.below, z),
                             grid.phi(f.layer, f.above, z)});
  };
  Point low{f.t, f.z};
  const Point last{trace.t_end, trace.z_end};
  if (f.direction == 0) return emit(low, last);
  std::vector<Point> ends{last};
  while (!ends.empty()) {
    const Point high = ends.back();
    const double z = low.z + (high.z - low.z) / 2, t = passage(grid, f, z).t;
    const double chord = high.t > low.t ? low.z + (high.z - low.z) * ((t - low.t) / (high.t - low.t)) : z;
    if (std::abs(chord - z) > tolerance && t > low.t && t < high.t) {
      ends.push_back({t, z});
      continue;
    }
    ends.pop_back();
    emit(low, high);
    low = high;
  }
}

}  // namespace shearfront
