// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace shearfront::tools {

/// Cells around the distinct ones of some coordinates: edges midway between neighbours, the outermost cells
/// symmetric but inside [low, high]. Neighbouring cells are joined until at most kMostCells are left.
class CellAxis {
 public:
  static constexpr std::size_t kMostCells = 120;  // more of them are narrower than a printed dot

  CellAxis(std::vector<double> coordinates, double low, double high) {
    std::sort(coordinates.begin(), coordinates.end());
    const double same = 1e-9 * (coordinates.back() - coordinates.front());
    std::vector<double> x;
    for (const double c : coordinates)
      if (x.empty() || c - x.back() > same) x.push_back(c);
    n_distinct_ = x.size();
    if (x.size() == 1) {
      edges_ = {low, high};
      return;
    }
    const std::size_t stride = (x.size() + kMostCells - 1) / kMostCells;
    edges_ = {std::max(low, x[0] - (x[1] - x[0]) / 2)};
    for (std::size_t i = stride; i < x.size(); i += stride) edges_.push_back((x[i - 1] + x[i]) / 2);
    const std::size_t last = x.size() - 1;
    edges_.push_back(std::min(high, x[last] + (x[last] - x[last - 1]) / 2));
  }

  [[nodiscard]] std::size_t n_distinct() const { return n_distinct_; }
  [[nodiscard]] std::size_t size() const { return edges_.size() - 1; }
  [[nodiscard]] double low(std::size_t i) const { return edges_[i]; }
  [[nodiscard]] double high(std::size_t i) const { return edges_[i + 1]; }
  [[nodiscard]] std::size_t cell_of(double x) const {
    const auto inner = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, x);
    return static_cast<std::size_t>(inner - edges_.begin()) - 1;
  }

 private:
  std::size_t n_distinct_ = 0;
  std::vector<double> edges_;
};

}  // namespace shearfront::tools
