// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/solver/solver.hpp"

/// Observers see every collision of a Tracker and cannot steer it: they get constant views, and the tracker
/// reads nothing from them. An observer is a template argument, so the one that does nothing costs nothing.
namespace shearfront {

/// A front as it stands at a collision: born at (t, z), with its states. `slot` is its own from its birth to its end; later
/// fronts may have it again.
template <Real Scalar>
struct FrontView {
  std::size_t layer;
  Scalar t, z, speed;
  State below, above;
  std::uint32_t slot;
};

/// Fronts that met in one point and fronts that left it. boundary is the index of the interface or wall in
/// whose point they met (0 the bottom wall, n_layers the top wall), kNoBoundary inside a layer. After time 0 `under` and `over` are the
/// neighbours of these fronts, which are boundaries if slot <= n_layers (their layer is then their index); none beyond the ends.
template <Real Scalar>
struct CollisionView {
  static constexpr std::size_t kNoBoundary = static_cast<std::size_t>(-1);
  Scalar t, z;
  std::size_t boundary = kNoBoundary;
  std::vector<FrontView<Scalar>> incoming, outgoing;
  std::optional<FrontView<Scalar>> under, over;
};

struct NoObserver {
  static constexpr bool kActive = false;
};

/// Segments by the time and height at which they begin, then from the slowest to the fastest.
template <Real Scalar>
void sort_by_begin(std::vector<FrontSegment<Scalar>>& segments) {
  std::stable_sort(segments.begin(), segments.end(), [](const auto& a, const auto& b) {
    if (a.t_begin != b.t_begin) return a.t_begin < b.t_begin;
    if (a.z_begin != b.z_begin) return a.z_begin < b.z_begin;
    return a.z_end < b.z_end;
  });
}

/// Keeps segments only: what a picture needs.
template <Real Scalar>
class SegmentRecord {
 public:
  static constexpr bool kActive = true;

  template <class Grid>
  void collision(const Grid& grid, const CollisionView<Scalar>& view) {
    for (const FrontView<Scalar>& f : view.incoming) end_of(grid, f, view.t, view.z);
  }
  /// A front that ends at (t, z): in a collision, or still alive when the record is closed.
  template <class Grid>
  void end_of(const Grid& grid, const FrontView<Scalar>& f, const Scalar& t, const Scalar& z) {
    segments_.push_back({f.layer, f.t, f.z, t, z, grid.phi(f.layer, f.below), grid.phi(f.layer, f.above)});
  }
  void close() { sort_by_begin(segments_); }
  [[nodiscard]] const std::vector<FrontSegment<Scalar>>& segments() const { return segments_; }

 private:
  std::vector<FrontSegment<Scalar>> segments_;
};

/// Keeps everything: front segments and collisions, in the order of time once the record is closed.
template <Real Scalar>
class History {
 public:
  static constexpr bool kActive = true;

  template <class Grid>
  void collision(const Grid& grid, const CollisionView<Scalar>& view) {
    record_.collision(grid, view);
    collisions_.push_back(view);
  }
  template <class Grid>
  void end_of(const Grid& grid, const FrontView<Scalar>& f, const Scalar& t, const Scalar& z) {
    record_.end_of(grid, f, t, z);
  }
  void close() {
    record_.close();
    std::stable_sort(collisions_.begin(), collisions_.end(),
                     [](const auto& a, const auto& b) { return a.t < b.t || (a.t == b.t && a.z < b.z); });
  }
  [[nodiscard]] const std::vector<FrontSegment<Scalar>>& segments() const { return record_.segments(); }
  [[nodiscard]] const std::vector<CollisionView<Scalar>>& collisions() const { return collisions_; }

 private:
  SegmentRecord<Scalar> record_;
  std::vector<CollisionView<Scalar>> collisions_;
};

}  // namespace shearfront
