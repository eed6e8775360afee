// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/path.hpp"

namespace shearfront::exact {

template <Real Scalar>
class CanonicalForm;

/// Momentum at the start of a path and what it lacks to 1, each to a few units in the last place.
template <Real Scalar>
struct StartMomentum {
  Scalar p{0}, missing{1};

  /// d M / d (height of an initial jump from `below` to anything), the path starting there.
  [[nodiscard]] Scalar against(const Scalar& below) const {
    return p > missing ? Scalar((below - Scalar(1)) + missing) : Scalar(below - p);
  }
};

/// Derivatives of M and phi with respect to what a path depends on besides the initial data: the numbers of every
/// piece of the bed, every inner boundary, and the height of its start (at fixed initial M).
template <Real Scalar>
struct PathGradient {
  struct Pair {
    Scalar M{0}, phi{0};
  };
  std::size_t first = 0;  ///< the lowest piece the path touches
  /// Such as most paths need: a query takes no memory from the heap.
  template <std::size_t n>
  using Pairs = boost::container::small_vector<Pair, n>;
  Pairs<24> pieces;      ///< Medium::numbers_per_piece() for each of first, first + 1, ...
  Pairs<12> boundaries;  ///< boundaries[n]: the lower boundary of piece first + n, n >= 1
  StartMomentum<Scalar> start;
  Scalar phi_start{0};      ///< d phi / d (height of the source), fan kind
  Scalar phi_state{0};      ///< d phi / d (initial state), constant kind
  Scalar phi_log_scale{0};  ///< d phi / d log s
};

/// A bed in which the Lax-Hopf formula is evaluated: pieces between boundaries(), in each of which a(z) has a form
/// with closed travel times. In the coordinates of a canonical form: states 0 .. 1, H >= 0.
template <Real Scalar>
class Medium {
 public:
  Medium(Cells<Scalar> cells, Scalar mass) : cells_(std::move(cells)), mass_(std::move(mass)) {}
  virtual ~Medium() = default;

  [[nodiscard]] const Cells<Scalar>& cells() const { return cells_; }
  [[nodiscard]] const Scalar& bottom() const { return cells_.x.front(); }
  [[nodiscard]] const Scalar& top() const { return cells_.x.back(); }
  [[nodiscard]] const Scalar& mass() const { return mass_; }
  /// Where the pure states meet in the end.
  [[nodiscard]] Scalar steady_height() const { return std::min(Scalar(bottom() + mass_), top()); }

  /// Bottom, inner boundaries of the pieces, top.
  [[nodiscard]] virtual const std::vector<Scalar>& boundaries() const = 0;
  /// How many numbers describe a(z) in a piece: 1 where it is constant (r = s a), 2 where it is linear or exponential (r at
  /// both ends).
  [[nodiscard]] virtual std::size_t numbers_per_piece() const = 0;
  /// Best path that does not start at a wall; kind none if there is none. May return any candidate whose
  /// value exceeds `upper` when the best one does. Domain: bottom <= z <= top, 0 < t < infinity.
  [[nodiscard]] virtual Path<Scalar> best_free(const Scalar& z, const Scalar& t,
                                               const Scalar& upper) const = 0;
  /// The same among paths with H > 0 only.
  [[nodiscard]] virtual Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const = 0;
  /// The best path as best_free() or best_moving() find it, for those who ask at many places near one another: `near` is
  /// what came out at the last one. It makes a search shorter where its start is a good one here, too.
  [[nodiscard]] virtual Path<Scalar> best_beside(const Path<Scalar>& /*near*/, const Scalar& z,
                                                 const Scalar& t, bool is_moving) const {
    return is_moving ? best_moving(z, t) : best_free(z, t, infinity<Scalar>());
  }
  /// Time a pure state (H = 0) needs from one height to another: |int dz / (s a)| for the quadratic flux.
  [[nodiscard]] virtual Scalar pure_travel_time(const Scalar& from, const Scalar& to) const = 0;
  /// Whether that of the bottom, or of the top, has come to z by the time t.
  [[nodiscard]] virtual bool is_reached_from(bool is_bottom, const Scalar& z, const Scalar& t) const {
    return pure_travel_time(is_bottom ? bottom() : top(), z) <= t;
  }
  /// Final amount minus the value of a path that best_free(z, t) returned.
  [[nodiscard]] virtual Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                         FinalAmount amount) const = 0;
  /// Four times the largest flux at z (s a for the quadratic flux); at a boundary the value above it, at the top the
  /// value below.
  [[nodiscard]] virtual Scalar rate_at(const Scalar& z) const = 0;
  /// Flux H of the state phi at z, with the same choice at a boundary.
  [[nodiscard]] virtual Scalar flux_at(const Scalar& z, const Scalar& phi) const = 0;
  /// First time at which phi next to inner boundary i leaves its initial states (exact/first_wave.hpp); empty if
  /// it never does.
  [[nodiscard]] virtual std::optional<Scalar> first_wave(std::size_t i) const = 0;
  /// Derivatives along a path that best_path(z, t) returned. Cost: O(pieces touched).
  [[nodiscard]] virtual PathGradient<Scalar> gradient(const Path<Scalar>& path, const Scalar& z,
                                                      const Scalar& t) const = 0;

  /// The best of all paths, those from the walls included.
  [[nodiscard]] Path<Scalar> best_path(const Scalar& z, const Scalar& t) const {
    return best_with_walls(z, t, [&](const Scalar& upper) { return best_free(z, t, upper); });
  }
  /// The same at many heights, ascending.
  [[nodiscard]] virtual std::vector<Path<Scalar>> best_paths(const std::vector<Scalar>& z,
                                                             const Scalar& t) const {
    std::vector<Path<Scalar>> paths;
    paths.reserve(z.size());
    for (const Scalar& height : z) paths.push_back(best_path(height, t));
    return paths;
  }

 protected:
  /// The best of the paths from the walls and of what best_free(upper) gives.
  template <class BestFree>
  [[nodiscard]] Path<Scalar> best_with_walls(const Scalar& z, const Scalar& t,
                                             const BestFree& best_free) const;
  /// phi = 1 from the bottom.
  [[nodiscard]] Path<Scalar> bottom_path(const Scalar& z) const {
    Path<Scalar> wall;
    wall.value = z - bottom();
    wall.p = Scalar(1);
    wall.kind = PathKind::bottom_wall;
    wall.upward = true;
    wall.foot = bottom();
    return wall;
  }
  /// phi = 0 from the top.
  [[nodiscard]] Path<Scalar> top_path() const {
    Path<Scalar> wall;
    wall.value = mass_;
    wall.kind = PathKind::top_wall;
    wall.foot = top();
    return wall;
  }

  Cells<Scalar> cells_;
  Scalar mass_;
};

template <Real Scalar>
template <class BestFree>
Path<Scalar> Medium<Scalar>::best_with_walls(const Scalar& z, const Scalar& t,
                                             const BestFree& best_free) const {
  Path<Scalar> wall;
  if (is_reached_from(true, z, t)) wall = bottom_path(z);
  // At the top the state below the wall is asked for: the wall's own path (value m for every t) counts only
  // where it is strictly better. A path with H = 0 and p = 1 has the value m as well; rounding must not
  // decide.
  const bool at_top = z == top();
  const Scalar tie = Scalar(64) * unit_roundoff<Scalar>() * (top() - bottom());
  const bool full = at_top && wall.value <= mass_ + tie;
  if (!(mass_ > wall.value) && !full && is_reached_from(false, z, t)) wall = top_path();
  Path<Scalar> free = best_free(wall.value);
  if (at_top && free.kind != PathKind::none && free.H == 0 && free.upward && free.value <= wall.value + tie)
    return free;
  return free.better_than(wall) ? free : wall;
}

/// The medium of a canonical form: layers of parabolas, of other fluxes, or pieces with a linear or an
/// exponential rate.
template <Real Scalar>
[[nodiscard]] std::shared_ptr<const Medium<Scalar>> make_medium(const CanonicalForm<Scalar>& form);

}  // namespace shearfront::exact
