// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <string>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/riemann/state.hpp"

namespace shearfront {

/// The envelope of the polygon of one layer between two states: the lower convex one of l | r if l < r, the
/// upper concave one if l > r.
///
/// The polygon is taken run by run, a run being states between which it bends one way. Vertices inside a run
/// that bends against the envelope are never on it, so such a run is one chord; of a run that bends with it
/// the envelope holds a part, whose ends are points of tangency. Along such a run the side of the tangent on
/// which a point lies changes once, so the point is found by doubling steps from the outer end of the run and
/// halving: a shock that takes up the next step of a fan costs a few slopes, whatever the number of states.
/// Guaranteed: the envelope of all states, up to the rounding of speed(). Cost: O(fronts) for what is
/// emitted, and O(log^2 states) per run. Errors: ContractViolation for states beyond those of the layer. Source: the monotone chain of Andrew (1979), Inf. Process. Lett. 9,
/// 216-219, with runs instead of points.
template <StateGrid Grid>
class Envelope {
 public:
  Envelope(const Grid& grid, std::size_t layer, State l, State r)
      : grid_(grid), layer_(layer), is_lower_(l < r), lowest_(std::min(l, r)) {
    const State highest = std::max(l, r);
    const Bend with = is_lower_ ? Bend::convex : Bend::concave;
    const Bend against = is_lower_ ? Bend::concave : Bend::convex;
    if (lowest_ < 0 || !(highest < grid.n_states(layer))) refuse(l, r);
    while (end() < highest) {
      const State chord = std::min(grid.run_end(layer, end(), against), highest);
      const State run = std::min(grid.run_end(layer, end(), with), highest);
      if (!(std::max(run, chord) > end())) refuse(l, r);
      if (run > chord)
        add_run(run);
      else
        add_chord(chord);
    }
  }

  /// Calls emit(below, above) for every front, from l to r.
  template <class Emit>
  void for_each(Emit&& emit) const {
    if (is_lower_) {
      for (const Part& part : parts_)
        for (State i = part.from; i < part.to;) {
          const State next = part.is_run ? std::min(grid_.next_vertex(layer_, i), part.to) : part.to;
          emit(i, next);
          i = next;
        }
    } else {
      for (auto part = parts_.rbegin(); part != parts_.rend(); ++part)
        for (State i = part->to; i > part->from;) {
          const State next =
              part->is_run ? std::max(grid_.previous_vertex(layer_, i), part->from) : part->from;
          emit(i, next);
          i = next;
        }
    }
  }

 private:
  /// Between states that the layer does not have the loop would not come to its end.
  [[noreturn]] void refuse(State l, State r) const {
    throw ContractViolation("an envelope of states " + std::to_string(l) + " | " + std::to_string(r) +
                            " that layer " + std::to_string(layer_) + " does not have");
  }

  struct Part {
    State from, to;
    bool is_run;
  };
  /// What is left of the parts when a chord to a new point is added: so many, the last one up to `end`.
  struct Tangent {
    std::size_t n_parts;
    State end;
  };

  [[nodiscard]] State end() const { return parts_.empty() ? lowest_ : parts_.back().to; }
  /// Whether the path p, q, r bends as the envelope does.
  [[nodiscard]] bool bends(State p, State q, State r) const {
    const auto before = grid_.speed(layer_, p, q), after = grid_.speed(layer_, q, r);
    return is_lower_ ? before < after : after < before;
  }

  /// First of `begin`, begin + step, ... before `end` for which holds() is false, `end` if there is none; it
  /// is true up to some place and false from there on.
  template <class Holds>
  [[nodiscard]] static State first_failure(State begin, State end, State step, const Holds& holds) {
    const State n = (end - begin) * step;
    State good = -1, bad = 0;
    for (State width = 1; bad < n && holds(begin + step * bad); width *= 2) {
      good = bad;
      bad = n - bad > width ? bad + width : n;
    }
    while (bad - good > 1) {
      const State middle = good + (bad - good) / 2;
      (holds(begin + step * middle) ? good : bad) = middle;
    }
    return begin + step * bad;
  }

  /// The tangent to the parts from the point v above them.
  [[nodiscard]] Tangent tangent_to(State v) const {
    for (std::size_t n = parts_.size(); n > 0; --n) {
      const Part& part = parts_[n - 1];
      if (!part.is_run) {
        if (bends(part.from, part.to, v)) return {n, part.to};
        continue;
      }
      const State last =
          first_failure(part.from + 1, part.to + 1, 1, [&](State q) { return bends(q - 1, q, v); }) - 1;
      if (last > part.from) return {n, last};
    }
    return {0, lowest_};
  }
  void add_chord(State v) {
    const Tangent tangent = tangent_to(v);
    parts_.resize(tangent.n_parts);
    if (!parts_.empty()) parts_.back().to = tangent.end;
    parts_.push_back({tangent.end, v, false});
  }
  /// A run from end() to v that bends as the envelope does.
  void add_run(State v) {
    const State begin = end();
    if (!parts_.empty()) {
      // Backwards from v as long as the envelope of all before still bends the right way into the run.
      const State touch = first_failure(v - 1, begin - 1, -1,
                                        [&](State q) {
                                          const Part& last = parts_.back();
                                          const State before = q > begin     ? tangent_to(q).end
                                                               : last.is_run ? last.to - 1
                                                                             : last.from;
                                          return bends(before, q, q + 1);
                                        }) +
                          1;
      if (touch > begin) add_chord(touch);
      if (touch == v) return;
    }
    parts_.push_back({end(), v, true});
  }

  const Grid& grid_;
  std::size_t layer_;
  bool is_lower_;
  State lowest_;
  boost::container::small_vector<Part, 8> parts_;
};

}  // namespace shearfront
