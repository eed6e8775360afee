// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/replicates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace shearfront::detail {
namespace {

auto place_of(const Observation& o) { return std::tie(o.t, o.z, o.width); }

/// Positions of the rows by their places; empty where no place occurs twice.
std::vector<std::size_t> by_place(const std::vector<Observation>& rows) {
  const auto is_descent = [](const Observation& a, const Observation& b) {
    return !(place_of(a) < place_of(b));
  };
  if (std::adjacent_find(rows.begin(), rows.end(), is_descent) == rows.end()) return {};
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (place_of(rows[a]) == place_of(rows[b])) return a < b;
    return place_of(rows[a]) < place_of(rows[b]);
  });
  return order;
}

}  // namespace

std::vector<RepeatedPlace> repeated_places(const std::vector<Observation>& rows) {
  const std::vector<std::size_t> order = by_place(rows);
  std::vector<RepeatedPlace> repeated;
  for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
    if (place_of(rows[order[i]]) == place_of(rows[order[first]]))
      repeated.push_back({order[i], order[first]});
    else
      first = i;
  }
  return repeated;
}

Means average_replicates(std::vector<Observation>& rows) {
  Means result;
  const std::vector<std::size_t> order = by_place(rows);
  if (order.empty()) {
    result.kept.resize(rows.size());
    std::iota(result.kept.begin(), result.kept.end(), std::size_t{0});
    return result;
  }
  std::vector<double> means(rows.size());
  std::vector<std::size_t> counts(rows.size(), 0);  // of the values a kept row stands for
  double spread = 0;  // the root of a sum of squares, of numbers as large as doubles are
  std::size_t n_free = 0;
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    for (end = first; end < order.size() && place_of(rows[order[end]]) == place_of(rows[order[first]]);)
      ++end;
    const auto n = static_cast<double>(end - first);
    const double one = rows[order[first]].value;
    double mean = one;  // to the bit, where all are the same
    for (std::size_t i = first; i < end; ++i) mean += rows[order[i]].value / n - one / n;
    for (std::size_t i = first; i < end; ++i) spread = std::hypot(spread, rows[order[i]].value - mean);
    n_free += end - first - 1;
    means[order[first]] = mean;
    counts[order[first]] = end - first;
  }
  if (n_free > 0) spread /= std::sqrt(static_cast<double>(n_free));
  result.spread = spread;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (counts[i] > 0) result.kept.push_back(i);
  if (!std::isfinite(spread)) return result;
  for (std::size_t k = 0; k < result.kept.size(); ++k) {
    const std::size_t i = result.kept[k];
    rows[k] = rows[i];
    rows[k].value = means[i];
    if (spread > 0) rows[k].sigma = spread / std::sqrt(static_cast<double>(counts[i]));
  }
  rows.resize(result.kept.size());
  return result;
}

}  // namespace shearfront::detail
