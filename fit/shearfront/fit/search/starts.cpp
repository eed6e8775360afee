// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/search/starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string field_of(const std::string& name) { return name.substr(0, name.find('[')); }

bool is_break(const std::string& field) {
  constexpr std::string_view kEnd = ".breaks";
  return field.size() > kEnd.size() && field.substr(field.size() - kEnd.size()) == kEnd;
}

}  // namespace

StartPoints::StartPoints(const Coordinates& coordinates, const VectorXd& start_u, std::uint64_t seed,
                         double widest)
    : coordinates_(&coordinates),
      lower_(coordinates.lowest_values()),
      upper_(coordinates.highest_values()),
      shift_(start_u.size()),
      sequence_(static_cast<std::size_t>(start_u.size())) {
  const VectorXd start = coordinates.values(start_u);
  std::mt19937_64 engine(seed);
  for (Index j = 0; j < start.size(); ++j) {
    shift_[j] = static_cast<double>(engine() >> 11) * 0x1p-53;
    if (coordinates.is_positive(j)) {
      lower_[j] = std::log(std::max(lower_[j], start[j] / widest));
      upper_[j] = std::log(std::min(upper_[j], start[j] * widest));
      continue;
    }
    const double reach = std::max(coordinates.unit(j), std::abs(start[j]));
    if (!std::isfinite(lower_[j])) lower_[j] = start[j] - reach;
    if (!std::isfinite(upper_[j])) upper_[j] = start[j] + reach;
  }
}

VectorXd StartPoints::next() {
  const Index n = shift_.size();
  VectorXd p(n);
  for (Index j = 0; j < n; ++j) {
    const double share = static_cast<double>(sequence_()) * 0x1p-64 + shift_[j];
    p[j] = lower_[j] + (upper_[j] - lower_[j]) * (share - std::floor(share));
    if (coordinates_->is_positive(j)) p[j] = std::exp(p[j]);
  }
  for (Index first = 0, last = 0; first < n; first = last) {
    const std::string field = field_of(coordinates_->name(first));
    for (last = first + 1; last < n && field_of(coordinates_->name(last)) == field;) ++last;
    if (is_break(field)) std::sort(p.begin() + first, p.begin() + last);
  }
  std::vector<double> values;
  for (const Index k : coordinates_->shaped()) values.push_back(p[k]);
  std::sort(values.rbegin(), values.rend());
  for (std::size_t k = 0; k < values.size(); ++k) p[coordinates_->shaped()[k]] = values[k];
  return coordinates_->coordinates(p);
}

}  // namespace shearfront::fit
