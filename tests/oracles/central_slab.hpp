// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace shearfront::oracles {

/// The slab of the source by another road than the splitting: large grains, c_t + u c_x + (S a c (1 - c))_z = D (c_xx + c_zz), by central
/// differences of fourth order of the means of n x n cells without limiters (diffusion keeps them smooth on 64 cells and more) and
/// Runge-Kutta steps of fourth order. S = 0.5, D = 0.01, a = 3.0994652327 sqrt(1 - z), a block of ones in x < 2/3, z < 3/4.
class CentralSlab {
 public:
  explicit CentralSlab(std::size_t n) : n_(n), h_(1 / static_cast<double>(n)), c_(n * n) {
    for (std::size_t j = 0; j <= n; ++j) face_.push_back(kS * shear(height(j)));
    for (std::size_t j = 0; j < n; ++j) {
      u_.push_back((flow(height(j + 1)) - flow(height(j))) / h_);
      bend_.push_back(shear(height(j) + h_ / 2) * h_ * h_ / 12);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        c_[i * n + j] =
            std::clamp((2.0 / 3 - height(i)) / h_, 0.0, 1.0) * std::clamp((0.75 - height(j)) / h_, 0.0, 1.0);
  }

  void march(double t) {
    const double steps = std::ceil(t / std::min(0.18 * h_ * h_ / kD, 0.25 * h_)), dt = t / steps;
    std::vector<double> k1(c_.size()), k2 = k1, k3 = k1, k4 = k1, at = k1;
    const auto stage = [&](const std::vector<double>& slope, double part, std::vector<double>& next) {
      for (std::size_t i = 0; i < c_.size(); ++i) at[i] = c_[i] + part * dt * slope[i];
      rates(at, next);
    };
    for (double step = 0; step < steps; ++step) {
      rates(c_, k1);
      stage(k1, 0.5, k2);
      stage(k2, 0.5, k3);
      stage(k3, 1, k4);
      for (std::size_t i = 0; i < c_.size(); ++i) c_[i] += dt / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
  }

  /// c(1/2, 1/2), the corner of four cells, from the six nearest means each way: of sixth order.
  [[nodiscard]] double at_middle() const {
    constexpr double kWeights[] = {1 / 60.0, -8 / 60.0, 37 / 60.0, 37 / 60.0, -8 / 60.0, 1 / 60.0};
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        sum += kWeights[i] * kWeights[j] * c_[(n_ / 2 - 3 + i) * n_ + n_ / 2 - 3 + j];
    return sum;
  }

 private:
  static constexpr double kS = 0.5, kD = 0.01, kShear = 3.0994652327;
  static double shear(double z) { return kShear * std::sqrt(std::max(1 - z, 0.0)); }
  /// int u dz but for a constant, u = (2/3) kShear (1 - (1 - z)^(3/2)).
  static double flow(double z) { return 2.0 / 3 * kShear * (z + 0.4 * std::pow(std::max(1 - z, 0.0), 2.5)); }
  [[nodiscard]] double height(std::size_t j) const { return static_cast<double>(j) * h_; }

  void rates(const std::vector<double>& c, std::vector<double>& out) const {
    std::vector<double> flux(n_ + 1, 0.0);
    for (std::size_t i = 0; i < n_; ++i) {
      const double* q = &c[i * n_];
      for (std::size_t j = 1; j < n_; ++j) {
        double mean = (q[j - 1] + q[j]) / 2, slope = (q[j] - q[j - 1]) / h_;
        if (j >= 2 && j + 1 < n_) {
          mean = (7 * (q[j - 1] + q[j]) - q[j - 2] - q[j + 1]) / 12;
          slope = (15 * (q[j] - q[j - 1]) - (q[j + 1] - q[j - 2])) / (12 * h_);
        }
        flux[j] = face_[j] * mean * (1 - mean) - kD * slope;
      }
      const auto column = [&](std::size_t away) { return &c[(i + away) % n_ * n_]; };
      const double *l2 = column(n_ - 2), *l1 = column(n_ - 1), *r1 = column(1), *r2 = column(2);
      for (std::size_t j = 0; j < n_; ++j) {
        // The mean of u c over a cell is that of u times that of c and a part of their slopes.
        const std::size_t lo = j > 0 ? j - 1 : j, hi = j + 1 < n_ ? j + 1 : j;
        const double width = static_cast<double>(hi - lo) * h_;
        const double carried = u_[j] * (8 * (r1[j] - l1[j]) - (r2[j] - l2[j])) / (12 * h_) +
                               bend_[j] * ((r1[hi] - r1[lo]) - (l1[hi] - l1[lo])) / (2 * h_ * width);
        const double spread = kD * (16 * (r1[j] + l1[j]) - 30 * q[j] - r2[j] - l2[j]) / (12 * h_ * h_);
        out[i * n_ + j] = spread - carried - (flux[j + 1] - flux[j]) / h_;
      }
    }
  }

  std::size_t n_;
  double h_;
  std::vector<double> c_, face_, u_, bend_;
};

}  // namespace shearfront::oracles
