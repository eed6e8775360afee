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
    for (const Term& term : this->model(static_cast<std::size_t>(i)))
      model += term.coefficient * values[static_cast<Index>(term.index)];
    r[i] = row.weight * (model - row.target);
  }
  if (noise) r = noise->whitened(r);
  return r;
}

Eigen::MatrixXd ResidualRows::jacobian(const Eigen::MatrixXd& derivatives) const {
  Eigen::MatrixXd j(size(), derivatives.cols());
  Eigen::RowVectorXd model(derivatives.cols());
  for (Index i = 0; i < size(); ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    if (!row.continues) model.setZero();
    for (const Term& term : this->model(static_cast<std::size_t>(i)))
      model += term.coefficient * derivatives.row(static_cast<Index>(term.index));
    j.row(i) = row.weight * model;
  }
  return noise ? noise->whitened(j) : j;
}

Eigen::VectorXd ResidualRows::slopes(const Eigen::VectorXd& of_rows) const {
  Eigen::VectorXd s = of_rows;
  if (noise) s = noise->whitened_transposed(s);
  Eigen::VectorXd of_points = Eigen::VectorXd::Zero(static_cast<Index>(points.size()));
  double later = 0;  // of this row and of those that go on from it
  for (std::size_t i = rows.size(); i-- > 0;) {
    later += rows[i].weight * s[static_cast<Index>(i)];
    for (const Term& term : model(i)) of_points[static_cast<Index>(term.index)] += term.coefficient * later;
    if (!rows[i].continues) later = 0;
  }
  return of_points;
}

bool ResidualRows::are_single() const {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].continues || data(i).size() != 1) return false;
  return true;
}

ResidualRows ResidualRows::selected(const std::vector<bool>& keep) const {
  ResidualRows some;
  some.field = field;
  some.points = points;
  some.unit = unit;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!keep[i]) continue;
    const auto of_model = model(i), of_data = data(i);
    some.model_terms.insert(some.model_terms.end(), of_model.begin(), of_model.end());
    some.data_terms.insert(some.data_terms.end(), of_data.begin(), of_data.end());
    Row& row = some.rows.emplace_back(rows[i]);
    row.model_end = some.model_terms.size();
    row.data_end = some.data_terms.size();
  }
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
static void merge(std::vector<Term>& terms) {
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.index < b.index; });
  std::size_t n = 0;
  for (const Term& term : terms) {
    if (n > 0 && terms[n - 1].index == term.index)
      terms[n - 1].coefficient += term.coefficient;
    else
      terms[n++] = term;
  }
  terms.resize(n);
  std::erase_if(terms, [](const Term& term) { return term.coefficient == 0; });
}

void RowBuilder::data(std::size_t k, double coefficient) {
  if (!data_.empty() && data_.back().index == k)
    data_.back().coefficient += coefficient;
  else
    data_.push_back({k, coefficient});
}

void RowBuilder::finish_row() {
  finish_row_of_sum();
  end_sum();
}

void RowBuilder::finish_row_of_sum() {
  merge(model_);
  const auto variance_of = [&](const Term& term) {
    if (term.coefficient == 0) return 0.0;
    const double sigma = observations_->rows[term.index].sigma;
    return std::pow(term.coefficient * (sigma > 0 ? sigma : 1), 2);
  };
  for (const Term& term : data_) {
    target_ += term.coefficient * observations_->rows[term.index].value;
    if (last_.coefficient != 0 && last_.index != term.index) {
      variance_ += variance_of(last_);
      last_.coefficient = 0;
    }
    last_ = {term.index, last_.coefficient + term.coefficient};
  }
  rows_.model_terms.insert(rows_.model_terms.end(), model_.begin(), model_.end());
  rows_.data_terms.insert(rows_.data_terms.end(), data_.begin(), data_.end());
  rows_.rows.push_back({rows_.model_terms.size(), rows_.data_terms.size(), target_,
                        1 / std::sqrt(variance_ + variance_of(last_)), continues_});
  model_.clear();
  data_.clear();
  continues_ = true;
}

void RowBuilder::end_sum() {
  model_.clear();
  data_.clear();
  continues_ = false;
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
