// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/residual_rows.hpp"

#include <algorithm>
#include <numeric>

namespace shearfront::fit {

using Eigen::Index;

Eigen::VectorXd ResidualRows::residuals(const Eigen::VectorXd& values) const {
  Eigen::VectorXd r(size());
  double model = 0;
  for (Index i = 0; i < size(); ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    if (!row.continues) model = 0;
    for (const Term& term : row.model) model += term.coefficient * values[static_cast<Index>(term.index)];
    r[i] = row.weight * (model - row.target);
  }
  return r;
}

Eigen::MatrixXd ResidualRows::jacobian(const Eigen::MatrixXd& derivatives) const {
  Eigen::MatrixXd j(size(), derivatives.cols());
  Eigen::RowVectorXd model(derivatives.cols());
  for (Index i = 0; i < size(); ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    if (!row.continues) model.setZero();
    for (const Term& term : row.model)
      model += term.coefficient * derivatives.row(static_cast<Index>(term.index));
    j.row(i) = row.weight * model;
  }
  return j;
}

bool ResidualRows::are_single() const {
  return std::all_of(rows.begin(), rows.end(),
                     [](const Row& row) { return row.data.size() == 1 && !row.continues; });
}

ResidualRows ResidualRows::selected(const std::vector<bool>& keep) const {
  ResidualRows some{field, points, {}, unit};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (keep[i]) some.rows.push_back(rows[i]);
  return some;
}

std::size_t RowBuilder::place(double t, double z) {
  const auto near = places_.lower_bound({t, z - slack_});
  if (near != places_.end() && near->first.t == t && near->first.z <= z + slack_) return near->second;
  places_.emplace(Place{t, z}, rows_.points.size());
  rows_.points.push_back({t, z});
  return rows_.points.size() - 1;
}

/// Terms of one place added up; what cancels is left out.
static void merge(Terms& terms) {
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.index < b.index; });
  Terms merged;
  for (const Term& term : terms) {
    if (!merged.empty() && merged.back().index == term.index)
      merged.back().coefficient += term.coefficient;
    else
      merged.push_back(term);
  }
  merged.erase(
      std::remove_if(merged.begin(), merged.end(), [](const Term& term) { return term.coefficient == 0; }),
      merged.end());
  terms = std::move(merged);
}

void RowBuilder::data(std::size_t k, double coefficient) {
  if (!row_.data.empty() && row_.data.back().index == k)
    row_.data.back().coefficient += coefficient;
  else
    row_.data.push_back({k, coefficient});
}

void RowBuilder::finish_row() {
  finish_row_of_sum();
  end_sum();
}

void RowBuilder::finish_row_of_sum() {
  merge(row_.model);
  const auto variance_of = [&](const Term& term) {
    if (term.coefficient == 0) return 0.0;
    const double sigma = observations_->rows[term.index].sigma;
    return std::pow(term.coefficient * (sigma > 0 ? sigma : 1), 2);
  };
  for (const Term& term : row_.data) {
    target_ += term.coefficient * observations_->rows[term.index].value;
    if (last_.coefficient != 0 && last_.index != term.index) {
      variance_ += variance_of(last_);
      last_.coefficient = 0;
    }
    last_ = {term.index, last_.coefficient + term.coefficient};
  }
  row_.target = target_;
  row_.weight = 1 / std::sqrt(variance_ + variance_of(last_));
  rows_.rows.push_back(std::move(row_));
  row_ = {};
  row_.continues = true;
}

void RowBuilder::end_sum() {
  row_ = {};
  last_ = {};
  target_ = variance_ = 0;
}

std::vector<MeasuredProfile> measured_profiles(const Observations& observations) {
  const std::vector<Observation>& rows = observations.rows;
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(rows[a].t, rows[a].z) < std::pair(rows[b].t, rows[b].z);
  });
  std::vector<MeasuredProfile> profiles;
  for (const std::size_t i : order) {
    if (profiles.empty() || profiles.back().t != rows[i].t) profiles.push_back({rows[i].t, {}});
    profiles.back().rows.push_back(i);
  }
  return profiles;
}

}  // namespace shearfront::fit
