// SPDX-License-Identifier: BSD-3-Clause
// One step: see crank_nicolson_march.cpp for how they follow each other.
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/largest_magnitude.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {
namespace {

constexpr int kMaxIterations = 30;
/// Change of a state, over max |phi|, below which a matrix is kept for one more iteration.
constexpr double kSmallChange = 1e-3;

}  // namespace

CrankNicolson::CrankNicolson(const Problem& problem, Options options, std::vector<Tangent> tangents)
    : problem_(problem),
      options_(std::move(options)),
      parameters_(std::move(tangents)),
      n_(problem.n_cells),
      matrix_(2, false),
      fluxes_(0),
      phi_(n_ + 2),
      rest_(n_ + 2),
      q_last_(n_ + 1),
      q_before_(n_ + 1),
      control_(options_.tolerance) {
  SHEARFRONT_EXPECTS(n_ >= 2, "at least two cells");
  SHEARFRONT_EXPECTS(parameters_.empty() || (problem.has_equal_cells() && !options_.regrid),
                     "derivatives on a grid of equal cells");
  SHEARFRONT_EXPECTS(!options_.regrid || !problem.has_equal_cells(), "cells given by their faces");
  set_grid();
  SHEARFRONT_EXPECTS(options_.dt > 0 || options_.tolerance > 0, "fixed steps or a tolerance");
  std::copy(problem.initial.begin(), problem.initial.end(), phi_.begin() + 1);
  set_ghosts(phi_);
  scale_ = largest_magnitude(phi_.data(), n_ + 2);
  const auto [lowest, highest] = problem.flux.range();
  limit_ = 10 * std::max({scale_, std::abs(lowest), std::abs(highest)});
  for (const Tangent& parameter : parameters_) {
    tangents_.push_back(parameter.initial);
    tangents_.back().resize(n_);
  }
}

void CrankNicolson::set_grid() {
  n_ = problem_.n_cells;
  const bool is_periodic = problem_.ends == Ends::periodic;
  rule_ = FaceRule::make(problem_, options_.scheme);
  matrix_ = Tridiagonal(is_periodic ? n_ : n_ + 1, is_periodic);
  fluxes_ = FaceFluxes(n_ + 1);
  inner_.resize(n_ + 2);
  for (auto* faces : {&q_, &q_predicted_, &correction_}) faces->resize(n_ + 1);
  narrowest_ = problem_.width(0);
  per_width_.clear();
  if (problem_.has_equal_cells()) return;
  per_width_.reserve(n_);
  for (std::size_t j = 0; j < n_; ++j) {
    narrowest_ = std::min(narrowest_, problem_.width(j));
    per_width_.push_back(1 / problem_.width(j));
  }
}

void CrankNicolson::move_to(Regrid next) {
  const std::span<const double> means = states();
  const std::vector<double> phi = transfer_means(problem_, means, next.changes);
  std::vector<double> rest = transfer_constants({rest_.data() + 1, n_}, next.changes);
  rest.insert(rest.begin(), 0);
  rest.push_back(0);
  q_last_ = transfer_fluxes(problem_, q_last_, next.changes);
  q_before_ = transfer_fluxes(problem_, q_before_, next.changes);
  problem_ = std::move(next.problem);
  set_grid();
  phi_.resize(n_ + 2);
  std::copy(phi.begin(), phi.end(), phi_.begin() + 1);
  set_ghosts(phi_);
  rest_ = std::move(rest);
}

void CrankNicolson::restart(std::span<const double> states) {
  SHEARFRONT_EXPECTS(parameters_.empty() && states.size() == n_, "states of the grid, and no tangents");
  std::copy(states.begin(), states.end(), phi_.begin() + 1);
  std::fill(rest_.begin(), rest_.end(), 0.0);
  set_ghosts(phi_);
  scale_ = largest_magnitude(phi_.data(), n_ + 2);
  flux_times_ = {};
  rule_->evaluate(phi_.data(), fluxes_);
  std::copy(fluxes_.value.begin(), fluxes_.value.end(), q_last_.begin());
}

std::vector<double> CrankNicolson::initial_rates() {
  rule_->evaluate(phi_.data(), fluxes_);
  std::vector<double> rates(n_);
  for_each_divergence(fluxes_.value, [&](std::size_t j, double d) { rates[j] = -d; });
  return rates;
}

CrankNicolson::Attempt CrankNicolson::attempt(const TimeStep& step) {
  const double tau = step.theta * step.length;
  predict(step);
  place_inner(tau);
  Attempt result;
  result.converged = iterate(tau, step.theta);
  if (result.converged && flux_times_.n == 2) {
    for (std::size_t i = 0; i <= n_; ++i) correction_[i] = q_[i] - q_predicted_[i];
    for_each_divergence(correction_, [&](std::size_t j, double d) { correction_[j] = step.length * d; });
    result.surprise = largest_magnitude(correction_.data(), n_);
    if (step.theta > 0.5) {
      for (std::size_t i = 0; i <= n_; ++i) correction_[i] = q_[i] - q_last_[i];
      for_each_divergence(correction_, [&](std::size_t j, double d) { correction_[j] = step.length * d; });
      result.turn = largest_magnitude(correction_.data(), n_);
    }
  }
  return result;
}

void CrankNicolson::predict(const TimeStep& step) {
  const double factor = flux_times_.factor(step.theta * step.length);
  for (std::size_t i = 0; i <= n_; ++i)
    q_[i] = q_predicted_[i] = q_last_[i] + factor * (q_last_[i] - q_before_[i]);
}

void CrankNicolson::place_inner(double tau) {
  for_each_divergence(q_, [&](std::size_t j, double d) { inner_[j + 1] = phi_[j + 1] - tau * d; });
  set_ghosts(inner_);
}

bool CrankNicolson::iterate(double tau, double theta) {
  // A fitted step must end in its bounds and tangents need a root: to rounding, which is reached when the
  // next change, this one times the rate of convergence, would be rounding.
  const bool to_rounding = options_.scheme == Scheme::fitted || !parameters_.empty();
  const double wanted = options_.iteration_tolerance * scale_ * theta;
  double last_change = 0;
  for (int k = 0; k < kMaxIterations; ++k) {
    rule_->evaluate(inner_.data(), fluxes_);
    // After a small change the matrix of the iteration before is as good, and needs no divisions.
    const bool same_matrix = !to_rounding && k > 0 && last_change < kSmallChange * scale_;
    const double change = correct(tau, same_matrix);
    if (!std::isfinite(change)) return false;
    const double rate = k > 0 ? std::min(1.0, change / last_change) : 1;
    if (change <= wanted && (!to_rounding || !(rate * change > 0x1p-50 * scale_)))
      return largest_magnitude(inner_.data(), n_ + 2) <= limit_;
    last_change = same_matrix ? scale_ : change;
  }
  return false;
}

double CrankNicolson::correct(double tau, bool same_matrix) {
  const bool is_periodic = problem_.ends == Ends::periodic;
  const std::size_t n = is_periodic ? n_ : n_ + 1;
  for (std::size_t i = 0; i <= n_; ++i) correction_[i] = fluxes_.value[i] - q_[i];
  if (same_matrix) {
    matrix_.solve_again({correction_.data(), n});
  } else {
    matrix_.solve(tau, {fluxes_.by_below.data(), n}, {fluxes_.by_above.data(), n}, {correction_.data(), n});
  }
  ++n_iterations_;
  n_cell_updates_ += n_;
  if (is_periodic) correction_[n_] = correction_[0];
  for (std::size_t i = 0; i <= n_; ++i) q_[i] += correction_[i];
  for_each_divergence(correction_, [&](std::size_t j, double d) { correction_[j] = tau * d; });
  for (std::size_t i = 0; i < n_; ++i) inner_[i + 1] -= correction_[i];
  set_ghosts(inner_);
  // A pivot that vanished leaves no x finite.
  return std::isfinite(inner_[1]) ? largest_magnitude(correction_.data(), n_) : inner_[1];
}

void CrankNicolson::commit(const TimeStep& step) {
  if (!parameters_.empty()) commit_tangents(step);
  for_each_divergence(q_, [&](std::size_t j, double d) { correction_[j] = step.length * d; });
  largest_change_ = largest_magnitude(correction_.data(), n_);
  for (std::size_t i = 1; i <= n_; ++i) {
    const double change = rest_[i] - correction_[i - 1];
    const double next = phi_[i] + change;
    rest_[i] = change - (next - phi_[i]);
    phi_[i] = next;
  }
  set_ghosts(phi_);
  scale_ = largest_magnitude(phi_.data(), n_ + 2);
  flux_times_.push(step.theta * step.length, step.length);
  std::swap(q_before_, q_last_);
  std::swap(q_last_, q_);
  ++n_steps_;
  last_length_ = step.length;
  if (options_.keeps_steps) steps_.push_back(step);
  if (!options_.regrid) return;
  for (int i = 0; i < RefinedCells::kMostHalvings; ++i) {
    std::optional<Regrid> next = options_.regrid(problem_, states());
    if (!next) break;
    move_to(std::move(*next));
  }
}

// With x = dq of the step: x_i = by_below dv_below + by_above dv_above + dF_i/dp, dv = dphi - tau diff x.
void CrankNicolson::commit_tangents(const TimeStep& step) {
  const double tau = step.theta * step.length;
  const bool is_periodic = problem_.ends == Ends::periodic;
  const std::size_t n = is_periodic ? n_ : n_ + 1;
  rule_->evaluate(inner_.data(), fluxes_);
  std::vector<double> change(n_ + 1);
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    std::vector<double>& dphi = tangents_[k];
    rule_->evaluate_tangent(inner_.data(), parameters_[k], change);
    for (std::size_t i = 0; i <= n_; ++i) {
      const double below = i > 0 ? dphi[i - 1] : is_periodic ? dphi[n_ - 1] : 0;
      const double above = i < n_ ? dphi[i] : is_periodic ? dphi[0] : 0;
      change[i] += fluxes_.by_below[i] * below + fluxes_.by_above[i] * above;
    }
    if (k == 0) {
      matrix_.solve(tau, {fluxes_.by_below.data(), n}, {fluxes_.by_above.data(), n}, {change.data(), n});
    } else {
      matrix_.solve_again({change.data(), n});
    }
    ++n_iterations_;
    n_cell_updates_ += n_;
    if (is_periodic) change[n_] = change[0];
    for (std::size_t i = 0; i < n_; ++i) dphi[i] -= step.length * (change[i + 1] - change[i]);
  }
}

void CrankNicolson::set_ghosts(std::vector<double>& v) const {
  const bool is_periodic = problem_.ends == Ends::periodic;
  v[0] = v[is_periodic ? n_ : 1];
  v[n_ + 1] = v[is_periodic ? 1 : n_];
}

}  // namespace shearfront::diffusion
