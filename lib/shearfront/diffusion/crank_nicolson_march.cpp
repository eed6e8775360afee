// SPDX-License-Identifier: BSD-3-Clause
// Fixed and adaptive steps, and the end of a run.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/extended_flux.hpp"
#include "shearfront/diffusion/largest_magnitude.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::diffusion {
namespace {

constexpr int kMaxHalvings = 20;

double steps_over(double span, double length) {
  return std::max(0.0, std::ceil(span / length * (1 - 1e-12)));
}

}  // namespace

std::string too_many_steps(double span, double length, std::uint64_t most) {
  const double wanted = steps_over(span, length);
  if (wanted <= static_cast<double>(most)) return "";
  return number_text(wanted, 3) + " steps of " + number_text(length) + " are needed, at most " +
         std::to_string(most) + " are made";
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
    if (const Status status = stop_reason(); status != Status::ok) return status;
  }
  return Status::ok;
}

Status CrankNicolson::march_fixed(double t) {
  if (n_steps() == 0) start_fixed();
  if (is_steady_) return Status::steady;
  // More than any budget allows is no count of its own.
  const auto n = static_cast<std::uint64_t>(std::min(steps_over(t - time_, options_.dt), 1e18));
  const double length = n > 0 ? (t - time_) / static_cast<double>(n) : 0;
  const double begin = time_;
  for (std::uint64_t i = 1; i <= n && !is_steady_; ++i) {
    const bool smoothed = n_steps() < 2 * n_smoothed_;
    const bool done =
        smoothed ? take(0.5 * length, 1) && take(0.5 * length, 1) : take(length, theta_of(length));
    if (!done) return Status::not_converged;
    time_ = begin + static_cast<double>(i) * length;
    is_steady_ = largest_change_ <= 0x1p-52 * scale_ * std::min(1.0, last_length_ * stiffness_);
    if (is_steady_) rest_time_ = time_;
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
    const double turn_share = flux_times_.turn_share(step.theta, length);
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
    } else if (!control_.accept(length, result.surprise * share / scale_,
                                result.turn * turn_share / scale_)) {
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
  const double fastest = fastest_slope(problem_.flux) * largest_magnitude(problem_.rate.data(), n_ + 1);
  stiffness_ = (4 * largest_d / narrowest_ + 2 * fastest) / narrowest_;
  if (options_.smoothed_steps || !(options_.dt * largest_d > narrowest_ * narrowest_)) return;
  const std::vector<double> rates = initial_rates();
  double bend = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double below = i > 0 ? rates[i - 1] : rates[i], above = i + 1 < n_ ? rates[i + 1] : rates[i];
    bend = std::max(bend, std::abs(below - 2 * rates[i] + above));
  }
  if (bend > 0.5 * largest_magnitude(rates.data(), n_)) n_smoothed_ = 2;
}

void CrankNicolson::start_adaptive(double t) {
  const std::vector<double> rates = initial_rates();
  const double rate = largest_magnitude(rates.data(), n_);  // which knows no NaN
  is_steady_ = std::all_of(rates.begin(), rates.end(), [](double r) { return r == 0; });
  control_.start(rate / scale_, t - time_);
}

void CrankNicolson::try_rest() {
  if (n_steps() < n_rest_checked_ + 10 || largest_change_ > options_.tolerance * scale_) return;
  n_rest_checked_ = n_steps();
  const FluxTimes times = std::exchange(flux_times_, FluxTimes{});
  const TimeStep step{1e4 * time_, 1};
  if (attempt(step).converged) {
    for_each_divergence(q_, [&](std::size_t j, double d) { correction_[j] = step.length * d; });
    if (largest_magnitude(correction_.data(), n_) <= 0.1 * options_.tolerance * scale_) {
      commit(step);
      is_steady_ = true;
      rest_time_ = time_;
      return;
    }
  }
  flux_times_ = times;
}

}  // namespace shearfront::diffusion
