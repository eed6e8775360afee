// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/slab/rows.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace shearfront::slab {
namespace {

/// Rise over a cell from the differences to both neighbours: monotonised central.
double mc_rise(double below, double above) {
  const double central = 0.5 * (below + above), least = 2 * std::min(std::abs(below), std::abs(above));
  if (!(below * above > 0)) return 0;
  return std::abs(central) < least ? central : std::copysign(least, central);
}

}  // namespace

Rows::Rows(std::size_t n, std::vector<double> shift, const std::vector<double>& diffusion)
    : n_(n), shift_(std::move(shift)) {
  for (const double amount : diffusion) {
    if (spreads_.empty() || spreads_.back().amount != amount) {
      const double theta = amount > 0 ? std::max(0.5, 1 - 0.5 / amount) : 0.5, k = theta * amount;
      Spread& spread = spreads_.emplace_back(Spread{amount, theta, diffusion::Tridiagonal(n, true)});
      const std::vector<double> lower(n, k), upper(n, -k);
      std::vector<double> any(n);
      spread.matrix.solve(1, lower, upper, any);
    }
    which_.push_back(spreads_.size() - 1);
  }
}

void Rows::advance(double* states, std::size_t stride, std::size_t first, std::size_t end) const {
  constexpr std::size_t kBlock = 8;  // a line of the cache holds so many rows of a column
  std::vector<double> rows(kBlock * n_), moved(n_ + 3), out(n_ + 2);
  for (std::size_t j = first; j < end; j += kBlock) {
    const std::size_t m = std::min(kBlock, end - j);
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < m; ++k) rows[k * n_ + i] = states[i * stride + j + k];
    for (std::size_t k = 0; k < m; ++k) {
      double* row = &rows[k * n_];
      carry(row, shift_[j + k], moved.data(), out.data());
      std::copy(moved.begin() + 2, moved.begin() + 2 + static_cast<std::ptrdiff_t>(n_), row);
      const Spread& by = spreads_[which_[j + k]];
      if (by.amount > 0) spread(by, row, out.data());
    }
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < m; ++k) states[i * stride + j + k] = rows[k * n_ + i];
  }
}

/// to[2 ... n + 1]; has two cells before and one behind.
void Rows::carry(const double* from, double shift, double* to, double* out) const {
  const double whole = std::floor(shift), r = shift - whole;
  const double turns = std::floor(whole / static_cast<double>(n_));
  const auto by = static_cast<std::ptrdiff_t>(whole - turns * static_cast<double>(n_));  // 0 ... n - 1
  double* const q = to + 2;
  std::copy(from + static_cast<std::ptrdiff_t>(n_) - by, from + n_, q);
  std::copy(from, from + static_cast<std::ptrdiff_t>(n_) - by, q + by);
  if (r == 0) return;
  to[0] = q[n_ - 2], to[1] = q[n_ - 1], q[n_] = q[0];
  // out[i + 1] leaves cell i; out[0] the cell before the first.
  for (std::size_t i = 0; i <= n_; ++i) {
    const double here = to[i + 1], below = here - to[i], above = to[i + 2] - here;
    out[i] = r * (here + 0.5 * (1 - r) * mc_rise(below, above));
  }
  out[n_] = out[0];  // the last cell is the one before the first
  for (std::size_t i = 0; i < n_; ++i) q[i] += out[i] - out[i + 1];
}

/// F_i between cells i - 1 and i, in units of dx / dt.
void Rows::spread(const Spread& by, double* q, double* flux) const {
  flux[0] = by.amount * (q[n_ - 1] - q[0]);
  for (std::size_t i = 1; i < n_; ++i) flux[i] = by.amount * (q[i - 1] - q[i]);
  by.matrix.solve_again(std::span<double>(flux, n_));
  flux[n_] = flux[0];
  for (std::size_t i = 0; i < n_; ++i) q[i] += flux[i] - flux[i + 1];
}

}  // namespace shearfront::slab
