// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shearfront/exact/rate_form.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// How a route passes a run.
enum class Passes : std::uint8_t { upwards, downwards, both };

/// Bounds of |r'| / r in a piece from the rate r1 to r2.
template <Real Scalar>
struct RelativeBends {
  Scalar least, most;

  RelativeBends(RateForm form, const Scalar& bend, const Scalar& r1, const Scalar& r2) {
    const Scalar size = bend < 0 ? Scalar(-bend) : bend;
    least = form == RateForm::linear ? Scalar(size / std::max(r1, r2)) : size;
    most = form == RateForm::linear ? Scalar(size / std::min(r1, r2)) : size;
  }
};

/// Bounds of the time that a way takes, for a range of h and without its runs one by one: it consists of stretches on which r
/// rises or falls without a jump. Where |r'| / r lies between two bounds on a stretch from r_1 to r_2,
///
///     T = (2 / (k h)) |q_2 - q_1| = (2 / k) |1 / r_1 - 1 / r_2| / (q_1 + q_2)
///
/// with some k between them, and a turn at the end of one that falls from A takes (4 / (k h)) q_A together with it. Pieces through a
/// smooth bed are a few stretches with almost one k. Cost: O(stretches). A way of more than kMost has no bounds, nor has one in a bed of few
/// pieces, where they cost more than the runs.
template <Real Scalar>
class SlopedStretches {
 public:
  struct Times {
    Scalar least, most;
    /// Whether a time may lie between, rounding included.
    [[nodiscard]] bool may_be(const Scalar& t) const {
      const Scalar slack = Scalar(1) / Scalar(1 << 20);
      return !(least * (Scalar(1) - slack) > t) && !(most * (Scalar(1) + slack) < t);
    }
  };
  using Bends = RelativeBends<Scalar>;

  /// A stretch from the rate `begin`, away from z, to `end`.
  struct Stretch {
    Scalar begin, end, flat;  ///< flat: its length
    Bends bends;
    int slope;
    Passes passes;
    std::size_t cell;  ///< one that has its flux
  };

  explicit SlopedStretches(bool is_on) : is_off_(!is_on) {}
  /// In a bed of fewer pieces they cost more than the runs.
  static constexpr std::size_t kFew = 24;

  /// The next run away from z, over d of a cell from the rate r1 to r2; the last one had the same flux or not.
  void add(const Bends& bends, const Scalar& d, const Scalar& r1, const Scalar& r2, Passes passes,
           std::size_t cell, bool is_same_flux) {
    if (!(d > 0) || is_full()) return;
    const int slope = r2 > r1 ? 1 : r2 < r1 ? -1 : 0;
    Stretch* last = all_.empty() ? nullptr : &all_.back();
    if (last == nullptr || last->slope != slope || last->passes != passes || !is_same_flux ||
        !(last->end == r1)) {
      all_.push_back({r1, r2, d, bends, slope, passes, cell});
      return;
    }
    last->end = r2;
    last->flat += d;
    last->bends.least = std::min(last->bends.least, bends.least);
    last->bends.most = std::max(last->bends.most, bends.most);
  }

  [[nodiscard]] bool is_off() const { return is_off_; }
  /// Whether there are no bounds.
  [[nodiscard]] bool is_full() const { return is_off_ || all_.size() > kMost; }
  [[nodiscard]] const auto& all() const { return all_; }
  /// h from h0 to h1, of all runs.
  [[nodiscard]] Times times(const Scalar& h0, const Scalar& h1) const {
    if (is_full()) return {Scalar(0), infinity<Scalar>()};
    Times all{Scalar(0), Scalar(0)};
    add_first(all_.size(), h0, h1, all);
    return all;
  }
  /// And of a turn in a piece that is entered at the rate `entry`.
  [[nodiscard]] Times times_with_turn(const Scalar& h0, const Scalar& h1, const Scalar& entry,
                                      Bends bends) const {
    if (is_full()) return {Scalar(0), infinity<Scalar>()};
    Times all{Scalar(0), Scalar(0)};
    Scalar begin = entry;
    std::size_t n = all_.size();
    if (n > 0 && all_.back().passes == Passes::both && all_.back().slope < 0 && all_.back().end == entry) {
      const Stretch& last = all_[--n];
      begin = last.begin;
      bends.least = std::min(bends.least, last.bends.least);
      bends.most = std::max(bends.most, last.bends.most);
    }
    add_first(n, h0, h1, all);
    const Scalar four(4);
    all.least += four * std::max(Scalar(0), Scalar(q(h1, begin) - kRoot)) / (bends.most * h1);
    all.most += most_in_turn(h0, begin, bends);
    return all;
  }
  /// Most time that a state of |2 p0 - 1| = q0 needs to the end of its cell, where the rate is `exit`.
  [[nodiscard]] static Scalar most_from_state(const Scalar& h0, const Scalar& h1, const Scalar& q0,
                                              const Scalar& exit, const Bends& bends) {
    const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
    const Scalar change = std::max(size(Scalar(q(h0, exit) - q0)), size(Scalar(q(h1, exit) - q0))) + kRoot;
    return h0 > 0 ? Scalar(Scalar(2) * change / (bends.least * h0)) : infinity<Scalar>();
  }

  /// The same of any state in a cell of this width between the rates `least` and `most`, h from h0 to h1.
  [[nodiscard]] static Scalar most_through(const Scalar& h0, const Scalar& h1, const Scalar& width,
                                           const Scalar& least, const Scalar& most, const Bends& bends) {
    const Scalar slow = least * std::max(Scalar(0), Scalar(q(h1, least) - kRoot));
    const Scalar by_speed = slow > 0 ? Scalar(width / slow) : infinity<Scalar>();
    return std::min(by_speed, most_in_turn(h0, most, bends) / Scalar(2));
  }
  /// Most time from the rate `entry` to a turn in this piece and back.
  [[nodiscard]] static Scalar most_in_turn(const Scalar& h0, const Scalar& entry, const Bends& bends) {
    return h0 > 0 && bends.least > 0 ? Scalar(Scalar(4) * (q(h0, entry) + kRoot) / (bends.least * h0))
                                     : infinity<Scalar>();
  }

 private:
  static constexpr std::size_t kMost = 12;
  /// What q may be off by where r - h is all rounding.
  static constexpr double kRoot = 0x1p-24;

  [[nodiscard]] static Scalar q(const Scalar& h, const Scalar& r) {
    using std::sqrt;
    return h < r ? Scalar(sqrt(Scalar((r - h) / r))) : Scalar(0);
  }
  void add_first(std::size_t n, const Scalar& h0, const Scalar& h1, Times& all) const {
    for (std::size_t i = 0; i < n; ++i) {
      const Stretch& s = all_[i];
      // By the fastest and the slowest place; where r changes by more than rounding, also as above.
      const Scalar passes(s.passes == Passes::both ? 2 : 1), two(2);
      const Scalar &most = std::max(s.begin, s.end), &least = std::min(s.begin, s.end);
      const Scalar fast = most * (q(h0, most) + kRoot),
                   slow = least * std::max(Scalar(0), Scalar(q(h1, least) - kRoot));
      Scalar lower = s.flat / fast, upper = slow > 0 ? Scalar(s.flat / slow) : infinity<Scalar>();
      // Not 1 / r_1 - 1 / r_2, and no better than the rates themselves: a part of a piece whose slope is a few units in the last place may
      // have all of it or nothing.
      const Scalar rounding = Scalar(8) * unit_roundoff<Scalar>() * most;
      const Scalar gap = most - least;
      if (s.slope != 0 && gap > rounding) {
        const Scalar at_h0 = q(h0, s.begin) + q(h0, s.end) + kRoot,
                     at_h1 = std::max(Scalar(0), Scalar(q(h1, s.begin) + q(h1, s.end) - kRoot));
        lower = std::max(lower, Scalar(two * (gap - rounding) / most / least / (s.bends.most * at_h0)));
        if (at_h1 > 0)
          upper = std::min(upper, Scalar(two * (gap + rounding) / most / least / (s.bends.least * at_h1)));
      }
      all.least += passes * lower;
      all.most += passes * upper;
    }
  }

  boost::container::small_vector<Stretch, 4> all_;
  bool is_off_;
};

}  // namespace shearfront::exact
