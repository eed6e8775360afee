// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "shearfront/numeric/dual.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/track/front_tangents.hpp"
#include "shearfront/track/moving_bed.hpp"
#include "shearfront/track/reconstruct.hpp"
#include "shearfront/track/snapshot.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

/// The solution of a tracker whose fronts carry derivatives, at its time, N entries at once: what a tracker is to linear_profile(), with
/// numbers that carry their derivatives. So derivatives are those of the lines that the run itself returns.
template <std::size_t N, class AnyTracker>
class TangentProfile {
 public:
  using Scalar = Dual<N>;
  using Grid = std::remove_cvref_t<decltype(std::declval<const AnyTracker&>().grid())>;

  /// Columns first ... first + N - 1; those beyond the last are 0.
  TangentProfile(const AnyTracker& tracker, const StateMotion<Grid>& motion,
                 const std::vector<track_detail::MotionColumn>& columns, std::size_t first)
      : tracker_(tracker), motion_(motion), columns_(columns), first_(first) {}

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
      rate.d[j] = motion_.fan_rate(columns_[first_ + j].scene, columns_[first_ + j].states, layer, l, r);
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
  const std::vector<track_detail::MotionColumn>& columns_;
  std::size_t first_;
};

/// Derivatives of the solution that is constant between fronts, all columns at once, at heights in ascending order: calls
/// take(i, phi, M) with the derivatives at heights[i] by column. By one sweep from the bottom up,
///
///     dM = sum over the cells below (dphi_j (z_j+1 - z_j) + phi_j (dz_j+1 - dz_j)).
///
/// Cost: O(columns (fronts + heights)).
template <class AnyTracker, class Take>
void for_each_constant_tangent(const AnyTracker& tracker, const std::vector<double>& heights, Take&& take) {
  const FrontTangents& tangents = tracker.observer();
  const TangentTable& table = tangents.table();
  const std::size_t n = table.n_columns();
  std::vector<double> sum(n, 0.0), low(n), high(n), M(n);
  double z_low = 0;
  std::size_t layer = 0, next = 0;
  State state = 0;
  bool is_first = true;
  tracker.for_each_node([&](bool is_boundary, const FrontView<double>& node, double z) {
    const bool is_top = is_boundary && node.layer == tracker.grid().n_layers();
    if (is_boundary) {
      std::copy_n(table.boundary(node.layer), n, high.begin());
    } else {
      tangents.moved(node, tracker.time(), high.data());
      z = std::max(std::min(z, tracker.grid().boundary(node.layer + 1)), z_low);
    }
    if (!is_first) {
      const double phi = tracker.grid().phi(layer, state), width = z - z_low;
      const double* by = table.phi(layer, state);
      for (; next < heights.size() && (is_top || heights[next] < z); ++next) {
        const double above = heights[next] - z_low;
        for (std::size_t j = 0; j < n; ++j) M[j] = sum[j] + by[j] * above - phi * low[j];
        take(next, by, M.data());
      }
      for (std::size_t j = 0; j < n; ++j) sum[j] += by[j] * width + phi * (high[j] - low[j]);
    }
    is_first = false;
    z_low = z, layer = node.layer, state = node.above;
    low.swap(high);
  });
}

}  // namespace shearfront
