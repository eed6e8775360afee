// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront {

/// phi over z at one time: linear on every cell, with jumps allowed between cells.
///
/// Cell i is [z[i], z[i+1]] with phi running from below[i] (at z[i]) to above[i] (at z[i+1]); piecewise
/// constant data have below == above. Heights ascend; cells of width 0 are allowed and carry no mass.
template <Real Scalar>
class Profile {
 public:
  struct Value {
    Scalar phi, M;
  };

  Profile() = default;
  Profile(std::vector<Scalar> z, std::vector<Scalar> below, std::vector<Scalar> above)
      : z_(std::move(z)), below_(std::move(below)), above_(std::move(above)) {
    SHEARFRONT_EXPECTS(z_.size() == below_.size() + 1 && below_.size() == above_.size(),
                       "sizes of a profile");
    cumulative_.reserve(z_.size());
    cumulative_.push_back(Scalar(0));
    CompensatedSum<Scalar> sum;
    for (std::size_t i = 0; i < below_.size(); ++i) {
      sum += (z_[i + 1] - z_[i]) * ((below_[i] + above_[i]) / Scalar(2));
      cumulative_.push_back(sum.value());
    }
  }

  [[nodiscard]] std::size_t n_cells() const { return below_.size(); }
  [[nodiscard]] const std::vector<Scalar>& z() const { return z_; }
  [[nodiscard]] const std::vector<Scalar>& below() const { return below_; }
  [[nodiscard]] const std::vector<Scalar>& above() const { return above_; }
  /// int phi dz over the whole domain.
  [[nodiscard]] Scalar mass() const { return cumulative_.back(); }
  /// M at the cell edges z().
  [[nodiscard]] const std::vector<Scalar>& cumulative() const { return cumulative_; }

  /// phi and M at one height; at a jump the value above it, at the top the value below. Cost: O(log cells).
  [[nodiscard]] Value at(const Scalar& z) const {
    const auto it = std::upper_bound(z_.begin() + 1, z_.end() - 1, z);
    return in_cell(static_cast<std::size_t>(it - z_.begin()) - 1, z);
  }
  /// phi and M at many heights in one pass; heights need not be sorted. Cost: O(cells + n log n).
  [[nodiscard]] std::vector<Value> at(const std::vector<Scalar>& heights) const {
    std::vector<std::size_t> order(heights.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    if (!std::is_sorted(heights.begin(), heights.end()))
      std::sort(order.begin(), order.end(),
                [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
    std::vector<Value> values(heights.size());
    std::size_t cell = 0;
    for (const std::size_t i : order) {
      while (cell + 1 < n_cells() && !(heights[i] < z_[cell + 1])) ++cell;
      values[i] = in_cell(cell, heights[i]);
    }
    return values;
  }

 private:
  [[nodiscard]] Value in_cell(std::size_t i, const Scalar& z) const {
    const Scalar width = z_[i + 1] - z_[i];
    const Scalar d = z - z_[i];
    if (!(width > 0) || below_[i] == above_[i]) return {above_[i], cumulative_[i] + d * above_[i]};
    const Scalar phi = below_[i] + (above_[i] - below_[i]) * (d / width);
    return {phi, cumulative_[i] + d * ((below_[i] + phi) / Scalar(2))};
  }

  std::vector<Scalar> z_, below_, above_, cumulative_;
};

/// int |p - q| dz over their common domain, exactly (both are piecewise linear). Cost: O(cells of both).
template <Real Scalar>
[[nodiscard]] Scalar l1_distance(const Profile<Scalar>& p, const Profile<Scalar>& q) {
  CompensatedSum<Scalar> sum;
  std::size_t i = 0, j = 0;
  Scalar z = std::max(p.z().front(), q.z().front());
  const auto value = [](const Profile<Scalar>& f, std::size_t cell, const Scalar& height) {
    const Scalar width = f.z()[cell + 1] - f.z()[cell];
    if (!(width > 0)) return f.above()[cell];
    return f.below()[cell] + (f.above()[cell] - f.below()[cell]) * ((height - f.z()[cell]) / width);
  };
  while (i < p.n_cells() && j < q.n_cells()) {
    const Scalar& end = std::min(p.z()[i + 1], q.z()[j + 1]);
    if (end > z) {
      const Scalar at_z = value(p, i, z) - value(q, j, z);
      const Scalar at_end = value(p, i, end) - value(q, j, end);
      const Scalar size_z = at_z < 0 ? -at_z : at_z, size_end = at_end < 0 ? -at_end : at_end;
      const bool crosses = (at_z < 0) != (at_end < 0) && size_z + size_end > 0;
      sum += crosses ? (end - z) * (size_z * size_z + size_end * size_end) / (Scalar(2) * (size_z + size_end))
                     : (end - z) * (size_z + size_end) / Scalar(2);
      z = end;
    }
    const bool p_done = !(p.z()[i + 1] > z), q_done = !(q.z()[j + 1] > z);
    if (p_done) ++i;
    if (q_done) ++j;
  }
  return sum.value();
}

}  // namespace shearfront
