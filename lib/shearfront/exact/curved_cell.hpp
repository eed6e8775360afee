// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/geometry.hpp"

namespace shearfront::exact {

/// Where inside a curved cell the best path to (z, t) starts, among those that go straight to z.
///
/// With C(y) the cost from y to z in the time t, the value is G(y) = M0(y) + C(y), and G' = phi(y, 0) - p(y), p the momentum at
/// the start. In one layer C is CONVEX: the cost of a route is jointly convex in its start and the times spent in each layer,
/// and their sum is given. Where phi rises, M0 is convex, too: one minimum, where G' changes its sign. Where phi falls, M0
/// is concave, and the tangents of C at both ends of an interval bound G from below by the least of its values at the ends
/// and where the tangents meet (concave between). Intervals are halved until that bound exceeds the best value:
/// no minimum is missed, M is found to kSlack roundings of the height.
template <Real Scalar, class Law>
class CurvedCell {
 public:
  struct Start {
    Scalar y{0};
    Scalar M{0}, cost{0};
    Scalar p{0}, phi{0};
    FanState<Scalar> fan;

    [[nodiscard]] Scalar value() const { return M + cost; }
    [[nodiscard]] Scalar slope() const { return phi - p; }  ///< of the value
  };

  CurvedCell(const Law& law, const Cells<Scalar>& cells, const Sweep<Scalar>& sweep, std::size_t cell,
             const Scalar& z, const Scalar& t, const Scalar& limit)
      : law_(law), cells_(cells), sweep_(sweep), cell_(cell), z_(z), t_(t), limit_(limit) {
    rounding_ = Scalar(kSlack) * unit_roundoff<Scalar>() * (law.top() - law.bottom());
  }

  /// Calls found(start) for every local minimum in [lo, hi] that may be less than the limit. `reach`: how far from the end of
  /// the way through its layer a start can be.
  template <class Found>
  void run(const Scalar& lo, const Scalar& hi, const Scalar& reach, const Found& found) {
    Start a = start_at(lo), b = start_at(hi);
    // At an end a minimum has no slope; all others are those of the fans of the points.
    if (a.slope() == 0) found(a);
    if (b.slope() == 0) found(b);
    // The cost has an end there: the value may be least at it with any slope that leads inwards.
    const Scalar& exit = sweep_.exit(law_, z_);
    if (sweep_.upward && !(lo > exit - reach) && (a.slope() > 0 || is_fastest(a))) found(a);
    if (!sweep_.upward && !(hi < exit + reach) && (b.slope() < 0 || is_fastest(b))) found(b);
    const bool rises = cells_.phi[cell_] < cells_.phi_high[cell_];
    if (rises) {
      if (a.slope() < 0 && b.slope() > 0) found(root(a, b));
      return;
    }
    if (Law::kIsSymmetric && sweep_.start == sweep_.own) return in_own_parabola(a, b, found);
    least_ = std::min(a.value(), b.value());
    split(a, b, found, 0);
  }

 private:
  static constexpr int kSlack = 256;

  [[nodiscard]] Start start_at(const Scalar& y) const {
    const std::size_t j = sweep_.start;
    const bool up = sweep_.upward;
    Start s;
    s.y = y;
    s.M = cells_.M[cell_] + cells_.inside(cell_, y);
    s.phi = cells_.state(cell_, y);
    const Scalar& exit = sweep_.exit(law_, z_);
    const Scalar d = std::max(Scalar(0), up ? Scalar(exit - y) : Scalar(y - exit));
    const Scalar lean = law_.peaks(y, z_);
    if (d == 0 && !(sweep_.T0 > 0)) {  // it rests
      s.fan.reachable = true;
      s.fan.r_min = law_.rate[j];
      s.fan.H = s.fan.r_min / Scalar(4);
    } else {
      s.fan = law_.solve_fan(sweep_, d, t_, lean, infinity<Scalar>());
    }
    if (d == 0 && law_.rate[j] < Scalar(4) * s.fan.H) rest_before_leaving(s);
    if (!s.fan.reachable) {  // as far away as the fastest, to rounding
      s.fan.r_min = std::min(law_.rate[j], sweep_.r_min);
      s.fan.x = Scalar(1);
      s.cost = up ? Scalar(z_ - y) : Scalar(0);
      s.p = Scalar(up ? 1 : 0);
      return s;
    }
    s.cost = lean + s.fan.Q / Scalar(2) + s.fan.H * t_;
    s.p = law_.momentum(j, up, law_.q_on(j, up, s.fan.r_min, s.fan.x), s.fan.H);
    return s;
  }

  /// In the layer of z a parabola's p is linear in y, so that the slope of the value, as phi, bends one way only: it changes its sign from
  /// - to + once at most, beyond its extremum if both ends have the same.
  template <class Found>
  void in_own_parabola(const Start& a, const Start& b, const Found& found) const {
    if (a.slope() < 0 && b.slope() > 0) return found(root(a, b));
    const bool is_below = a.slope() < 0 && !(b.slope() > 0), is_above = !(a.slope() < 0) && b.slope() > 0;
    if (!is_below && !is_above) return;
    const Scalar sign(is_below ? 1 : -1);  // of what the slope has to become inside
    Start m = start_at(Scalar(a.y + (b.y - a.y) / Scalar(2)));
    const Scalar bend = sign * (m.slope() - (a.slope() + b.slope()) / Scalar(2));
    if (!(bend > Scalar(16) * unit_roundoff<Scalar>())) return;  // straight, or bent the other way
    Scalar lo = a.y, hi = b.y;
    constexpr int kMost = 80;
    for (int n = 0; n < kMost && !(sign * m.slope() > 0); ++n) {
      const bool is_upper = hi - m.y > m.y - lo;
      const Scalar y = is_upper ? Scalar(m.y + (hi - m.y) * Scalar(0.381966))
                                : Scalar(m.y - (m.y - lo) * Scalar(0.381966));
      if (y == m.y || !(y > lo && y < hi)) return;
      Start next = start_at(y);
      if (sign * next.slope() > sign * m.slope()) {
        (is_upper ? lo : hi) = m.y;
        m = next;
      } else {
        (is_upper ? hi : lo) = y;
      }
    }
    if (!(sign * m.slope() > 0)) return;
    if (is_below && a.slope() < 0) found(root(a, m));
    if (is_above && b.slope() > 0) found(root(m, b));
  }
  /// On the way out of a layer that carries less than the way beyond it takes, a path rests: the limit of those that start deeper
  /// in it, and cheaper than to leave at once.
  void rest_before_leaving(Start& s) const {
    s.fan.r_min = law_.rate[sweep_.start];
    s.fan.x = Scalar(0);
    s.fan.H = s.fan.r_min / Scalar(4);
    s.fan.Q = Scalar(0);
    sweep_.for_each_crossed(law_, [&](const Scalar& width, std::size_t k) {
      s.fan.Q += width * law_.q(k, sweep_.upward, Scalar(law_.rate[k] - s.fan.r_min));
    });
  }
  /// Where a branch of the flux is straight, its states are as fast as pure ones: starts farther away are out of reach, and
  /// one that is just in reach may be a minimum whatever its slope.
  [[nodiscard]] bool is_fastest(const Start& s) const {
    const std::size_t j = sweep_.start;
    if (law_.excess(j, s.phi, sweep_.upward) < 0) return false;
    const Leg<Scalar> leg = leg_between<Scalar>(law_, s.y, z_, Scalar(law_.h_of(j, s.phi) / Scalar(4)));
    const Scalar pure = pure_travel_time<Scalar>(law_, s.y, z_);
    return leg.time <= pure * (Scalar(1) + Scalar(64) * unit_roundoff<Scalar>());
  }
  [[nodiscard]] Start root(const Start& a, const Start& b) const {
    std::uintmax_t most = 200;
    const Scalar u = unit_roundoff<Scalar>();
    const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
    const auto [lo, hi] = boost::math::tools::toms748_solve(
        [&](const Scalar& y) { return start_at(y).slope(); }, a.y, b.y, a.slope(), b.slope(),
        [&](const Scalar& x, const Scalar& y) { return y - x <= Scalar(2) * u * std::max(size(x), size(y)); },
        most);
    Start low = start_at(lo), high = start_at(hi);
    return size(low.slope()) < size(high.slope()) ? low : high;
  }

  /// No value between a and b is less.
  [[nodiscard]] Scalar bound(const Start& a, const Start& b) const {
    const Scalar width = b.y - a.y, bend = a.p - b.p;
    const Scalar least = std::min(a.value(), b.value());
    if (!(bend > 0)) return least;
    const Scalar s = std::clamp(Scalar(((a.cost - b.cost) - b.p * width) / bend), Scalar(0), width);
    const Scalar cost = std::min(Scalar(a.cost - a.p * s), Scalar(b.cost + b.p * (width - s)));
    return std::min(least, Scalar(cells_.M[cell_] + cells_.inside(cell_, Scalar(a.y + s)) + cost));
  }

  template <class Found>
  void split(const Start& a, const Start& b, const Found& found, int depth) {
    const bool has_root = a.slope() < 0 && b.slope() > 0;
    // The least value so far may lie within rounding of the minimum beside it.
    const bool is_beside = has_root && least_ < limit_ && !(std::min(a.value(), b.value()) > least_);
    if (!is_beside && bound(a, b) >= std::min(limit_, least_) - rounding_) return;
    constexpr int kMost = 60;
    Start m;
    if (has_root) {
      m = root(a, b);
      limit_ = std::min(limit_, m.value());
      found(m);
      m.p = m.phi;  // no slope: its own halves do not find it again
    } else {
      const Scalar y = a.y + (b.y - a.y) / Scalar(2);
      if (depth == kMost || !(y > a.y && y < b.y)) return;
      m = start_at(y);
      if (m.slope() == 0) {
        limit_ = std::min(limit_, m.value());
        found(m);
      }
      least_ = std::min(least_, m.value());
    }
    split(a, m, found, depth + 1);
    split(m, b, found, depth + 1);
  }

  const Law& law_;
  const Cells<Scalar>& cells_;
  const Sweep<Scalar>& sweep_;
  std::size_t cell_;
  Scalar z_, t_, limit_, rounding_, least_{0};
};

}  // namespace shearfront::exact
