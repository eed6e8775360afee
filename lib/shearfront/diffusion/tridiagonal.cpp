// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/tridiagonal.hpp"

#include <algorithm>

#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {

Tridiagonal::Tridiagonal(std::size_t n, bool is_cyclic)
    : n_(n),
      first_(is_cyclic ? 1 : 0),
      middle_(first_ + (n - first_) / 2),
      lower_(n),
      upper_(n),
      inverse_(n),
      next_(n),
      from_first_(is_cyclic ? n : 0) {
  SHEARFRONT_EXPECTS(n > first_, "at least one row, two if cyclic");
}

void Tridiagonal::solve(double factor, std::span<const double> lower, std::span<const double> upper,
                        std::span<double> s) {
  for (std::size_t i = 0; i < n_; ++i) {
    lower_[i] = factor * lower[i];
    upper_[i] = factor * upper[i];
  }
  if (first_ == 0) {
    eliminate(s.data());
    return;
  }
  std::fill(from_first_.begin(), from_first_.end(), 0.0);
  from_first_[1] += lower_[1];
  from_first_[n_ - 1] -= upper_[n_ - 1];
  eliminate(from_first_.data());
  solve_again(s);
}

void Tridiagonal::solve_again(std::span<double> s) const {
  substitute(s.data());
  if (first_ == 1) close_cycle(s.data());
}

// Rows below the middle become x_i = s_i + next_i x_{i+1}, rows above it x_i = s_i + next_i x_{i-1}.
void Tridiagonal::eliminate(double* __restrict s) {
  const double* __restrict const l = lower_.data();
  const double* __restrict const u = upper_.data();
  double* __restrict const inverse = inverse_.data();
  double* __restrict const next = next_.data();
  double c_below = 0, s_below = 0, c_above = 0, s_above = 0;
  const auto rise = [&](std::size_t i) {
    const double pivot = (1 + l[i] - u[i]) - l[i] * c_below;
    c_below = next[i] = -u[i] / pivot;
    inverse[i] = 1 / pivot;
    s_below = s[i] = (s[i] + l[i] * s_below) * inverse[i];
  };
  const auto sink = [&](std::size_t i) {
    const double pivot = (1 + l[i] - u[i]) + u[i] * c_above;
    c_above = next[i] = l[i] / pivot;
    inverse[i] = 1 / pivot;
    s_above = s[i] = (s[i] - u[i] * s_above) * inverse[i];
  };
  std::size_t low = first_, high = n_ - 1;
  for (; low < middle_ && high > middle_; ++low, --high) {
    rise(low);
    sink(high);
  }
  for (; low < middle_; ++low) rise(low);
  for (; high > middle_; --high) sink(high);
  const std::size_t m = middle_;
  inverse[m] = 1 / ((1 + l[m] - u[m]) - l[m] * c_below + u[m] * c_above);
  s[m] = (s[m] + l[m] * s_below - u[m] * s_above) * inverse[m];
  spread(s);
}

void Tridiagonal::substitute(double* __restrict s) const {
  const double* __restrict const l = lower_.data();
  const double* __restrict const u = upper_.data();
  double s_below = 0, s_above = 0;
  std::size_t low = first_, high = n_ - 1;
  const auto rise = [&](std::size_t i) { s_below = s[i] = (s[i] + l[i] * s_below) * inverse_[i]; };
  const auto sink = [&](std::size_t i) { s_above = s[i] = (s[i] - u[i] * s_above) * inverse_[i]; };
  for (; low < middle_ && high > middle_; ++low, --high) {
    rise(low);
    sink(high);
  }
  for (; low < middle_; ++low) rise(low);
  for (; high > middle_; --high) sink(high);
  s[middle_] = (s[middle_] + lower_[middle_] * s_below - upper_[middle_] * s_above) * inverse_[middle_];
  spread(s);
}

void Tridiagonal::spread(double* __restrict s) const {
  const double* __restrict const next = next_.data();
  double below = s[middle_], above = s[middle_];
  std::size_t low = middle_, high = middle_ + 1;
  for (; low > first_ && high < n_; ++high) {
    --low;
    below = s[low] = s[low] + next[low] * below;
    above = s[high] = s[high] + next[high] * above;
  }
  while (low > first_) {
    --low;
    below = s[low] = s[low] + next[low] * below;
  }
  for (; high < n_; ++high) above = s[high] = s[high] + next[high] * above;
}

void Tridiagonal::close_cycle(double* __restrict s) const {
  const double* const z = from_first_.data();
  const std::size_t last = n_ - 1;
  const double l = lower_[0], u = upper_[0];
  const double x = (s[0] + l * s[last] - u * s[1]) / ((1 + l - u) - l * z[last] + u * z[1]);
  s[0] = x;
  for (std::size_t i = 1; i < n_; ++i) s[i] += z[i] * x;
}

}  // namespace shearfront::diffusion
