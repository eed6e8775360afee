// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"

namespace shearfront::exact {

/// The image of the exact solution (exact/canonical_form.hpp) at a height, approached from above or from below, and how its path begins.
template <Real Scalar>
struct PathNode {
  Scalar z, M, phi;
  PathKind kind;
  bool upward;
  std::size_t source, interface;
  bool turned, is_state;

  [[nodiscard]] bool is_of_family(const PathNode& other) const {
    return kind == other.kind && upward == other.upward && source == other.source &&
           interface == other.interface && turned == other.turned && is_state == other.is_state;
  }
};

/// Where the image of the exact solution at one time is smooth: between the interfaces, cut at shocks and kinks. All
/// heights and states are those of the canonical form.
///
/// A cut lies where the minimising path begins in another way. Optimal paths do not cross, so the heights
/// served by one source in one way are an interval, and its ends are found by bisection (where phi jumps
/// down, sped up by intersecting the values of M of both sides). Between the cuts phi is smooth; it does not decrease,
/// save in some beds of sloped pieces (is_monotone()).
/// Precondition: 0 < t < +infinity, or t = 0 for a smooth start. Cost of a cut: about 20 queries
/// for a shock, 50 for a kink.
template <Real Scalar>
class SmoothPieces {
 public:
  using Node = PathNode<Scalar>;

  SmoothPieces(const ExactSolution<Scalar>& exact, const Scalar& t) : exact_(&exact), t_(t) {
    const Medium<Scalar>& medium = exact.medium();
    const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
    narrow_ = Scalar(4) * unit_roundoff<Scalar>() *
              std::max({Scalar(medium.top() - medium.bottom()), size(medium.top()), size(medium.bottom())});
  }

  [[nodiscard]] bool is_monotone() const { return exact_->form().is_monotone(); }
  /// Bottom, interfaces, top.
  [[nodiscard]] const std::vector<Scalar>& boundaries() const { return exact_->medium().boundaries(); }

  [[nodiscard]] Node node(const Scalar& z) const {
    if (t_ == 0) return initial_node(z);
    const Medium<Scalar>& medium = exact_->medium();
    const auto path = medium.best_path(z, t_);
    const auto value = exact_->image_value(path, z);
    Node n{z,           value.M,        value.phi,   path.kind,    path.upward,
           path.source, path.interface, path.turned, path.is_state};
    if (medium.cells().shape) name_stretches(medium.cells(), n);
    return n;
  }
  /// The limit from below at an interface.
  [[nodiscard]] Node below(const Scalar& z) const {
    Node n = node(Scalar(z - narrow_ / Scalar(2)));
    n.M = node(z).M;
    n.z = z;
    return n;
  }

  /// Cuts [a.z, b.z], which must lie in one layer: smooth(low, high) for every piece, gap(low, high) for the
  /// rounding error between the two sides of a cut.
  template <class Smooth, class Gap>
  void split(const Node& a, const Node& b, const Smooth& smooth, const Gap& gap) const {
    if (!(b.z > a.z)) return;
    if (a.is_of_family(b)) return smooth(a, b);
    Node low = a, high = b;
    Scalar margin = Scalar(1) / Scalar(16);
    bool is_low = true;  // side of the intersection that is tried next
    for (int n = 0; high.z - low.z > narrow_; ++n) {
      const Scalar width = high.z - low.z;
      Scalar z = low.z + width / Scalar(2);
      const bool is_bisection = n % 4 == 3;
      if (!is_bisection) {
        const Scalar part = intersection(low, high) + (is_low ? Scalar(-margin) : margin);
        if (part > 0 && part < 1) z = low.z + width * part;
      }
      if (!(z > low.z && z < high.z)) z = low.z + width / Scalar(2);
      if (!(z > low.z && z < high.z)) break;
      const Node middle = node(z);
      const bool is_below = middle.is_of_family(low);
      if (!is_below && !middle.is_of_family(high)) {
        smooth(a, low);
        split(low, middle, smooth, gap);
        split(middle, high, smooth, gap);
        return smooth(high, b);
      }
      if (!is_bisection) adapt(is_below == is_low, margin, is_low);
      (is_below ? low : high) = middle;
    }
    smooth(a, low);
    gap(low, high);
    smooth(high, b);
  }

 private:
  /// Cells of one stretch of a smooth start, in one layer, are one source.
  static void name_stretches(const Cells<Scalar>& cells, Node& n) {
    const auto name = [&](std::size_t cell) {
      const auto& knots = cells.shape->knots();
      const auto stretch = std::upper_bound(knots.begin(), knots.end(), cells.x[cell]) - knots.begin();
      return static_cast<std::size_t>(stretch) * cells.first.size() + cells.layer[cell];
    };
    const bool is_inside = n.kind == PathKind::constant || n.is_state;
    if (is_inside && cells.is_curved(n.source)) n.source = name(n.source);
    if (n.turned) n.interface = cells.layer[n.interface];
  }
  /// The data of a smooth start.
  [[nodiscard]] Node initial_node(const Scalar& z) const {
    const Cells<Scalar>& cells = exact_->medium().cells();
    const std::size_t i = cells.cell_at(z);
    const Scalar M = z == exact_->medium().top() ? exact_->medium().mass() : cells.cumulative(z);
    return {z, M, cells.state(i, z), PathKind::constant, false, i, 0, false, false};
  }
  /// Where the lines of M through both ends cross, as a part of the way; 1/2 if phi does not jump down.
  static Scalar intersection(const Node& a, const Node& b) {
    const Scalar jump = a.phi - b.phi, width = b.z - a.z;
    if (!(jump > Scalar(1e-3))) return Scalar(0.5);
    return ((b.M - a.M) - b.phi * width) / (jump * width);
  }
  /// Intersections converge quadratically; after a miss more room is left.
  static void adapt(bool is_hit, Scalar& margin, bool& is_low) {
    using std::sqrt;
    if (!is_hit)
      margin = std::min(Scalar(0.25), Scalar(sqrt(margin)));
    else if (!is_low)
      margin = std::max(Scalar(margin * margin), Scalar(unit_roundoff<Scalar>()));
    if (is_hit) is_low = !is_low;
  }

  const ExactSolution<Scalar>* exact_;
  Scalar t_, narrow_;
};

/// Whether the image of the exact solution is constant in pieces at time t: in the steady state, and at t = 0 but for a smooth
/// start.
template <Real Scalar>
[[nodiscard]] bool is_at_rest(const ExactSolution<Scalar>& exact, const Scalar& t) {
  return !is_finite(t) || (t == Scalar(0) && !exact.form().start());
}
/// The image of the exact solution where it is.
template <Real Scalar>
[[nodiscard]] Profile<Scalar> profile_at_rest(const ExactSolution<Scalar>& exact, bool is_initial) {
  const CanonicalForm<Scalar>& form = exact.form();
  std::vector<Scalar> z{exact.medium().bottom()}, phi;
  if (is_initial) {
    phi = form.initial_values();
    z.insert(z.end(), form.initial_breaks().begin(), form.initial_breaks().end());
  } else {
    phi = {Scalar(1), Scalar(0)};
    z.push_back(exact.medium().steady_height());
  }
  z.push_back(exact.medium().top());
  return {std::move(z), phi, phi};
}

}  // namespace shearfront::exact
