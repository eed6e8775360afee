// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/crank_nicolson.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::diffusion {
namespace {

constexpr int kMaxIterations = 30;
constexpr int kMaxHalvings = 20;
/// Change of a state, over max |phi|, below which a matrix is kept for one more iteration.
constexpr double kSmallChange = 1e-3;

/// max |x_i|, written so that compilers without -ffast-math use vectors.
double largest_magnitude(const double* x, std::size_t n) {
  constexpr std::size_t kLanes = 8;
  double lanes[kLanes] = {};
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double y = std::abs(x[i + k]);
      lanes[k] = lanes[k] > y ? lanes[k] : y;
    }
  double largest = 0;
  for (; i < n; ++i) largest = std::max(largest, std::abs(x[i]));
  for (const double lane : lanes) largest = std::max(largest, lane);
  return largest;
}

}  // namespace

CrankNicolson::CrankNicolson(const Problem& problem, Options options, std::vector<Tangent> tangents)
    : problem_(problem),
      options_(std::move(options)),
      parameters_(std::move(tangents)),
      n_(problem.n_cells),
      width_(problem.width()),
      rule_(FaceRule::make(problem, options_.scheme)),
      matrix_(problem.ends == Ends::periodic ? n_ : n_ + 1, problem.ends == Ends::periodic),
      fluxes_(n_ + 1),
      phi_(n_ + 2),
      rest_(n_ + 2),
      inner_(n_ + 2),
      q_(n_ + 1),
      q_predicted_(n_ + 1),
      q_last_(n_ + 1),
      q_before_(n_ + 1),
      correction_(n_ + 1),
      control_(options_.tolerance) {
  SHEARFRONT_EXPECTS(n_ >= 2, "at least two cells");
  SHEARFRONT_EXPECTS(options_.dt > 0 || options_.tolerance > 0, "fixed steps or a tolerance");
  std::copy(problem.initial.begin(), problem.initial.end(), phi_.begin() + 1);
  set_ghosts(phi_);
  scale_ = largest_magnitude(phi_.data(), n_ + 2);
  std::visit(
      [&](const auto& flux) {
        const auto [lowest, highest] = flux.range();
        limit_ = 10 * std::max({scale_, std::abs(lowest), std::abs(highest)});
      },
      problem.flux);
  for (const Tangent& parameter : parameters_) {
    tangents_.push_back(parameter.initial);
    tangents_.back().resize(n_);
  }
}

Status CrankNicolson::advance_to(double t) {
  SHEARFRONT_EXPECTS(t >= time_, "forward in time");
  message_.clear();
  const Status status = options_.dt > 0 ? march_fixed(t) : march_adaptive(t);
  if (status == Status::ok || status == Status::steady) time_ = t;
  return status;
}

Status CrankNicolson::repeat(std::span<const TimeStep> steps) {
  for (const TimeStep& step : steps) {
    if (!attempt(step).converged) return Status::not_converged;
    commit(step);
    time_ += step.length;
  }
  return Status::ok;
}

Status CrankNicolson::march_fixed(double t) {
  if (n_steps() == 0) start_fixed();
  const double n_wanted = std::ceil((t - time_) / options_.dt * (1 - 1e-12));
  const auto n = static_cast<std::uint64_t>(std::max(n_wanted, 0.0));
  const double length = n > 0 ? (t - time_) / static_cast<double>(n) : 0;
  const double begin = time_;
  for (std::uint64_t i = 1; i <= n && !is_steady_; ++i) {
    const bool smoothed = n_steps() < 2 * n_smoothed_;
    const bool done =
        smoothed ? take(0.5 * length, 1) && take(0.5 * length, 1) : take(length, theta_of(length));
    if (!done) return Status::not_converged;
    time_ = begin + static_cast<double>(i) * length;
    is_steady_ = largest_change_ <= 0x1p-52 * scale_;
    if (const Status status = stop_reason(); status != Status::ok) return status;
  }
  return is_steady_ ? Status::steady : Status::ok;
}

Status CrankNicolson::stop_reason() {
  if (options_.progress && !options_.progress(time_, n_steps())) {
    message_ = "stopped by the caller at t = " + number_text(time_);
    return Status::interrupted;
  }
  if (n_steps() >= options_.max_steps) {
    message_ = "stopped after " + std::to_string(n_steps()) + " steps at t = " + number_text(time_);
    return Status::budget_reached;
  }
  return Status::ok;
}

Status CrankNicolson::give_up(double length) {
  message_ = "the iteration does not converge at t = " + number_text(time_) + ", not even for steps of " +
             number_text(length);
  if (options_.scheme == Scheme::central) message_ += "; take more cells or the fitted scheme";
  return Status::not_converged;
}

double CrankNicolson::theta_of(double length) const {
  return std::max(0.5, 1 - 1 / (length * rule_->explicit_rate()));
}

bool CrankNicolson::take(double length, double theta) {
  double left = length, part = length;
  for (int halvings = 0; left > 0;) {
    part = std::min(part, left);
    const TimeStep step{part, theta == 1 ? 1 : theta_of(part)};
    if (attempt(step).converged) {
      commit(step);
      left = part < left ? left - part : 0;
      continue;
    }
    flux_times_.n = 0;
    part /= 2;
    if (++halvings > kMaxHalvings) {
      give_up(part);
      return false;
    }
  }
  return true;
}

Status CrankNicolson::march_adaptive(double t) {
  if (control_.length() == 0 && t > time_) start_adaptive(t);
  int failures = 0;
  while (time_ < t && !is_steady_) {
    const double left = t - time_;
    double length = control_.length();
    if (length >= left) {
      length = left;
    } else if (2 * length > left) {
      length = 0.5 * left;
    }
    const bool has_estimate = n_steps() >= 3;
    const TimeStep step{length, has_estimate ? theta_of(length) : 1};
    const double share = flux_times_.local_error_share(length);
    const Attempt result = attempt(step);
    if (!result.converged) {
      control_.shorten(0.5 * length);
      flux_times_.n = 0;
      if (++failures <= kMaxHalvings) continue;
      return give_up(length);
    }
    failures = 0;
    if (!has_estimate) {
      control_.grow(length);
    } else if (!control_.accept(length, result.surprise * share / scale_)) {
      continue;
    }
    const double now = length == left ? t : time_ + length;
    commit(step);
    time_ = now;
    try_rest();
    if (const Status status = stop_reason(); status != Status::ok) return status;
  }
  return is_steady_ ? Status::steady : Status::ok;
}

void CrankNicolson::start_fixed() {
  n_smoothed_ = options_.smoothed_steps.value_or(0);
  const double largest_d = largest_magnitude(problem_.diffusivity.data(), n_ + 1);
  if (options_.smoothed_steps || !(options_.dt * largest_d > width_ * width_)) return;
  const std::vector<double> rates = initial_rates();
  double bend = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double below = i > 0 ? rates[i - 1] : rates[i], above = i + 1 < n_ ? rates[i + 1] : rates[i];
    bend = std::max(bend, std::abs(below - 2 * rates[i] + above));
  }
  if (bend > 0.5 * largest_magnitude(rates.data(), n_)) n_smoothed_ = 2;
}

void CrankNicolson::start_adaptive(double t) {
  const double rate = largest_magnitude(initial_rates().data(), n_);
  is_steady_ = rate == 0;
  control_.start(rate / scale_, t - time_);
}

std::vector<double> CrankNicolson::initial_rates() {
  rule_->evaluate(phi_.data(), fluxes_);
  std::vector<double> rates(n_);
  for (std::size_t i = 0; i < n_; ++i) rates[i] = fluxes_.value[i] - fluxes_.value[i + 1];
  return rates;
}

void CrankNicolson::try_rest() {
  if (n_steps() < n_rest_checked_ + 10 || largest_change_ > options_.tolerance * scale_) return;
  n_rest_checked_ = n_steps();
  const FluxTimes times = std::exchange(flux_times_, FluxTimes{});
  const TimeStep step{1e4 * time_, 1};
  if (attempt(step).converged) {
    for (std::size_t i = 0; i < n_; ++i) correction_[i] = step.length * (q_[i + 1] - q_[i]);
    if (largest_magnitude(correction_.data(), n_) <= 0.1 * options_.tolerance * scale_) {
      commit(step);
      is_steady_ = true;
      return;
    }
  }
  flux_times_ = times;
}

CrankNicolson::Attempt CrankNicolson::attempt(const TimeStep& step) {
  const double tau = step.theta * step.length;
  predict(step);
  place_inner(tau);
  Attempt result;
  result.converged = iterate(tau, step.theta);
  if (result.converged && flux_times_.n == 2) {
    for (std::size_t i = 0; i <= n_; ++i) correction_[i] = q_[i] - q_predicted_[i];
    for (std::size_t i = 0; i < n_; ++i) correction_[i] = step.length * (correction_[i + 1] - correction_[i]);
    result.surprise = largest_magnitude(correction_.data(), n_);
  }
  return result;
}

void CrankNicolson::predict(const TimeStep& step) {
  const double factor = flux_times_.factor(step.theta * step.length);
  for (std::size_t i = 0; i <= n_; ++i)
    q_[i] = q_predicted_[i] = q_last_[i] + factor * (q_last_[i] - q_before_[i]);
}

void CrankNicolson::place_inner(double tau) {
  for (std::size_t i = 0; i < n_; ++i) inner_[i + 1] = phi_[i + 1] - tau * (q_[i + 1] - q_[i]);
  set_ghosts(inner_);
}

bool CrankNicolson::iterate(double tau, double theta) {
  // A fitted step must end in its bounds and tangents need a root: to rounding, which is reached when the
  // next change, this one times the rate of convergence, would be rounding.
  const bool is_newton = options_.iteration == Iteration::newton;
  const bool to_rounding = options_.scheme == Scheme::fitted || !parameters_.empty();
  const double wanted = options_.iteration_tolerance * scale_ * theta;
  double last_change = 0;
  for (int k = 0; k < kMaxIterations; ++k) {
    if (is_newton) {
      rule_->evaluate(inner_.data(), fluxes_);
    } else {
      rule_->evaluate_lagged(inner_.data(), phi_.data(), fluxes_);
    }
    // After a small change the matrix of the iteration before is as good, and needs no divisions.
    const bool same_matrix = is_newton && !to_rounding && k > 0 && last_change < kSmallChange * scale_;
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
  if (is_periodic) correction_[n_] = correction_[0];
  for (std::size_t i = 0; i <= n_; ++i) q_[i] += correction_[i];
  for (std::size_t i = 0; i < n_; ++i) correction_[i] = tau * (correction_[i + 1] - correction_[i]);
  for (std::size_t i = 0; i < n_; ++i) inner_[i + 1] -= correction_[i];
  set_ghosts(inner_);
  // A pivot that vanished leaves no x finite.
  return std::isfinite(inner_[1]) ? largest_magnitude(correction_.data(), n_) : inner_[1];
}

void CrankNicolson::commit(const TimeStep& step) {
  if (!parameters_.empty()) commit_tangents(step);
  for (std::size_t i = 0; i < n_; ++i) correction_[i] = step.length * (q_[i + 1] - q_[i]);
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
  steps_.push_back(step);
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
