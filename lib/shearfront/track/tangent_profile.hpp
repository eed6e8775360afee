// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shearfront/numeric/dual.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/track/front_tangents.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/snapshot.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

/// The solution of a tracker whose fronts carry derivatives, at its time, N entries at once: what a tracker is to linear_profile(), with
/// numbers that carry their derivatives. So derivatives are those of the lines that the run itself returns.
template <class AnyTracker, std::size_t N = 8>
class TangentProfile {
 public:
  using Scalar = Dual<N>;
  using Grid = std::remove_cvref_t<decltype(std::declval<const AnyTracker&>().grid())>;

  /// Columns first ... first + N - 1; those beyond the last are 0.
  TangentProfile(const AnyTracker& tracker, const StateMotion<Grid>& motion,
                 const std::vector<SceneTangent>& scenes, const std::vector<StateTangent>& states,
                 std::size_t first)
      : tracker_(tracker), motion_(motion), scenes_(scenes), states_(states), first_(first) {}

  [[nodiscard]] const TangentProfile& grid() const { return *this; }
  [[nodiscard]] Scalar phi(std::size_t layer, State i) const {
    return with(tracker_.grid().phi(layer, i), tracker_.observer().table().phi(layer, i));
  }
  [[nodiscard]] bool is_fan_step(std::size_t layer, State l, State r) const {
    return tracker_.grid().is_fan_step(layer, l, r);
  }
  [[nodiscard]] Scalar fan_rate(std::size_t layer, State l, State r) const {
    Scalar rate(tracker_.grid().fan_rate(layer, l, r));
    for (std::size_t j = 0; j < n(); ++j)
      rate.d[j] = motion_.fan_rate(scenes_[first_ + j], states_[first_ + j], layer, l, r);
    return rate;
  }
  /// As snapshot_of() has it.
  [[nodiscard]] Snapshot<Scalar> snapshot() const {
    Snapshot<Scalar> s;
    const FrontTangents& tangents = tracker_.observer();
    const double now = tracker_.time();
    std::vector<double> moved(tangents.table().n_columns());
    tracker_.for_each_node([&](bool is_boundary, const FrontView<double>& node, double z) {
      Scalar age(0);
      if (is_boundary) {
        s.z.push_back(with(z, tangents.table().boundary(node.layer)));
      } else {
        tangents.moved(node, now, moved.data());
        z = std::max(std::min(z, tracker_.grid().boundary(node.layer + 1)), s.z.back().v);
        s.z.push_back(with(z, moved.data()));
        age = with(now - node.t, tangents.births(node));
        for (double& by : age.d) by = -by;
      }
      s.layer.push_back(node.layer);
      s.state.push_back(node.above);
      s.is_front.push_back(!is_boundary);
      s.age.push_back(age);
    });
    s.layer.pop_back();
    s.state.pop_back();
    return s;
  }
  [[nodiscard]] Profile<Scalar> constant() const {
    Snapshot<Scalar> s = snapshot();
    std::vector<Scalar> values;
    for (std::size_t i = 0; i < s.state.size(); ++i) values.push_back(phi(s.layer[i], s.state[i]));
    return {std::move(s.z), values, values};
  }
  [[nodiscard]] Profile<Scalar> linear() const { return linear_profile(*this); }

 private:
  [[nodiscard]] std::size_t n() const {
    return std::min(N, tracker_.observer().table().n_columns() - first_);
  }
  [[nodiscard]] Scalar with(double value, const double* row) const {
    Scalar x(value);
    for (std::size_t j = 0; j < n(); ++j) x.d[j] = row[first_ + j];
    return x;
  }

  const AnyTracker& tracker_;
  const StateMotion<Grid>& motion_;
  const std::vector<SceneTangent>& scenes_;
  const std::vector<StateTangent>& states_;
  std::size_t first_;
};

}  // namespace shearfront
