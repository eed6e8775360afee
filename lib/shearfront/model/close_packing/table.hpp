// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/close_packing/model.hpp"

namespace shearfront {

/// Measured packings of mixtures: linear between the points (share[i], values[i]).
///
/// Domain: share strictly increasing from 0 to 1, 0 < values < 1. Cost of a value: O(log points).
template <Real Scalar>
struct PackingTable {
  static constexpr std::string_view kName = "table";
  static constexpr std::string_view kFormula = "linear between the points (share[i], values[i])";

  std::vector<Scalar> share, values;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "share", .also = "from 0 to 1, ascending"}, self.share);
    visit(FieldInfo{.key = "values", .range = Range::positive, .limits = {.high = 1}}, self.values);
  }
  void check(const std::string& prefix, Complaints& complaints) const {
    const auto add = [&](std::string key, std::string value, std::string constraint) {
      complaints.push_back({prefix + std::move(key), std::move(value), std::move(constraint)});
    };
    const auto element = [](std::string_view key, std::size_t i) {
      return std::string(key) + "[" + std::to_string(i) + "]";
    };
    if (share.size() < 2)
      return complaints.push_back(
          wrong_length(prefix + "share", share.size(), "must have at least 2 entries"));
    if (values.size() != share.size())
      complaints.push_back(
          wrong_length(prefix + "values", values.size(),
                       "must have as many entries as share (" + std::to_string(share.size()) + ")"));
    for (std::size_t i = 1; i < share.size(); ++i)
      if (is_finite(share[i]) && is_finite(share[i - 1]) && !(share[i] > share[i - 1]))
        add(element("share", i), number_text(share[i]),
            "must be greater than the entry before it (" + number_text(share[i - 1]) + ")");
    if (is_finite(share.front()) && share.front() != 0)
      add("share[0]", number_text(share.front()), "must be 0 (large grains only)");
    if (is_finite(share.back()) && share.back() != 1)
      add(element("share", share.size() - 1), number_text(share.back()), "must be 1 (small grains only)");
  }

  [[nodiscard]] Scalar value(const Scalar& x) const {
    const std::size_t i = interval_of(x);
    const Scalar w = (x - share[i]) / (share[i + 1] - share[i]);
    return values[i] + w * (values[i + 1] - values[i]);
  }
  [[nodiscard]] Scalar derivative(const Scalar& x) const {
    const std::size_t i = interval_of(x);
    return (values[i + 1] - values[i]) / (share[i + 1] - share[i]);
  }
  [[nodiscard]] std::vector<Scalar> kinks() const { return {share.begin() + 1, share.end() - 1}; }

  static std::vector<PackingTable> samples() {
    const auto numbers = [](std::initializer_list<double> xs) {
      return std::vector<Scalar>(xs.begin(), xs.end());
    };
    return {{numbers({0, 1}), numbers({0.5, 0.625})},
            {numbers({0, 0.25, 0.5, 1}), numbers({0.625, 0.6875, 0.671875, 0.625})}};
  }

 private:
  [[nodiscard]] std::size_t interval_of(const Scalar& x) const {
    const auto it = std::upper_bound(share.begin() + 1, share.end() - 1, x);
    return static_cast<std::size_t>(it - share.begin()) - 1;
  }
};

}  // namespace shearfront
