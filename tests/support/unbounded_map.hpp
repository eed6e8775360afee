// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/entries.hpp"

/// The unbounded coordinates of a posterior by their formulas and nothing else: no derivatives, no order of evaluation, each
/// unknown looked up by its name. An oracle in as many digits as the scalar has.
namespace shearfront::support {

template <Real S>
class UnboundedMap {
 public:
  UnboundedMap(std::vector<Entry> entries, std::vector<double> lower, std::vector<double> upper,
               fit::Shape shape)
      : entries_(std::move(entries)), lower_(std::move(lower)), upper_(std::move(upper)), shape_(shape) {}

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  [[nodiscard]] std::vector<S> values(const std::vector<S>& x) const {
    std::vector<std::optional<S>> known(size());
    std::vector<S> p;
    for (std::size_t i = 0; i < size(); ++i) p.push_back(value(i, x, known));
    return p;
  }

  /// dp_i/dx_j by central differences with the step h, [j][i].
  [[nodiscard]] std::vector<std::vector<S>> derivative(const std::vector<S>& x, const S& h) const {
    std::vector<std::vector<S>> columns;
    for (std::size_t j = 0; j < size(); ++j) {
      std::vector<S> above = x, below = x;
      above[j] += h;
      below[j] -= h;
      const std::vector<S> high = values(above), low = values(below);
      columns.emplace_back();
      for (std::size_t i = 0; i < size(); ++i) columns.back().push_back((high[i] - low[i]) / (2 * h));
    }
    return columns;
  }

  /// log |det dp/dx| of those differences, by elimination with the largest pivot.
  [[nodiscard]] S log_volume(const std::vector<S>& x, const S& h) const {
    using std::abs, std::log;
    std::vector<std::vector<S>> a = derivative(x, h);
    S sum = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < size(); ++i)
        if (abs(a[i][k]) > abs(a[pivot][k])) pivot = i;
      std::swap(a[k], a[pivot]);
      sum += log(abs(a[k][k]));
      for (std::size_t i = k + 1; i < size(); ++i) {
        const S factor = a[i][k] / a[k][k];
        for (std::size_t j = k; j < size(); ++j) a[i][j] -= factor * a[k][j];
      }
    }
    return sum;
  }

 private:
  /// The unknown of the same array whose index is the nearest in this direction.
  [[nodiscard]] std::optional<std::size_t> neighbour(std::size_t i, bool is_above) const {
    std::optional<std::size_t> nearest;
    for (std::size_t k = 0; k < size(); ++k) {
      if (entries_[k].field != entries_[i].field || k == i) continue;
      const std::size_t mine = entries_[i].index, its = entries_[k].index;
      if (is_above ? its < mine : its > mine) continue;
      if (!nearest || (is_above ? its < entries_[*nearest].index : its > entries_[*nearest].index))
        nearest = k;
    }
    return nearest;
  }

  [[nodiscard]] S value(std::size_t i, const std::vector<S>& x, std::vector<std::optional<S>>& known) const {
    using std::exp, std::isinf, std::log;
    if (known[i]) return *known[i];
    const bool is_shaped = shape_ != fit::Shape::none && entries_[i].field == "shear_rate.values";
    const bool is_break = entries_[i].field.ends_with("breaks");
    std::optional<S> floor;
    if (const auto next = is_shaped ? neighbour(i, true) : is_break ? neighbour(i, false) : std::nullopt) {
      floor = value(*next, x, known);
      if (const auto second = neighbour(*next, true); second && is_shaped && shape_ == fit::Shape::convex)
        floor = 2 * *floor - value(*second, x, known);
    }
    const double l = lower_[i], h = upper_[i];
    S p;
    if (std::isinf(l) && std::isinf(h) && !floor) {
      p = x[i];
    } else if (std::isinf(l) && !floor) {
      p = S(h) - exp(x[i]);
    } else {
      const S low = floor && (std::isinf(l) || *floor > S(l)) ? *floor : S(l);
      if (std::isinf(h))
        p = low + exp(x[i]);
      else if (!floor && l > 0 && h > 10 * l)
        p = exp(log(low) + (log(S(h)) - log(low)) / (1 + exp(-x[i])));
      else
        p = low + (S(h) - low) / (1 + exp(-x[i]));
    }
    known[i] = p;
    return p;
  }

  std::vector<Entry> entries_;
  std::vector<double> lower_, upper_;
  fit::Shape shape_;
};

}  // namespace shearfront::support
