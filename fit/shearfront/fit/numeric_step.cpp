// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/numeric_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace shearfront::fit {

using Eigen::Index;
using Eigen::VectorXd;

double computational_noise(const VectorXd& values) {
  const Index n = values.size() - 1;
  if (n < 3) return 0;
  VectorXd differences = values;
  VectorXd sigma = VectorXd::Zero(n);
  std::vector<bool> changes_sign(static_cast<std::size_t>(n), false);
  double gamma = 1;  // (k!)^2 / (2 k)!
  for (Index k = 1; k <= n; ++k) {
    const Index rows = n + 1 - k;
    for (Index i = 0; i < rows; ++i) differences[i] = differences[i + 1] - differences[i];
    gamma *= 0.5 * static_cast<double>(k) / (2 * static_cast<double>(k) - 1);
    const auto d = differences.head(rows);
    sigma[k - 1] = std::sqrt(gamma * d.squaredNorm() / static_cast<double>(rows));
    changes_sign[static_cast<std::size_t>(k - 1)] = d.minCoeff() * d.maxCoeff() < 0;
  }
  // The first order from which three estimates agree within a factor 4 and the differences change sign.
  for (Index k = 0; k + 3 <= n; ++k) {
    const auto three = sigma.segment(k, 3);
    if (three.maxCoeff() <= 4 * three.minCoeff() && changes_sign[static_cast<std::size_t>(k)])
      return sigma[k];
  }
  return 0;
}

VectorXd numeric_steps(const ResidualFunction& residuals, const VectorXd& u, const VectorXd& at_u,
                       double smallest, double unit) {
  constexpr Index kValues = 9;
  constexpr double kTiny = 1e-7;
  // Steps of different size in each coordinate, so that no symmetry of the scene hides the noise.
  VectorXd direction(u.size());
  for (Index j = 0; j < u.size(); ++j)
    direction[j] = std::max(1.0, std::abs(u[j])) * (1 + 0.1 * static_cast<double>(j));
  std::vector<VectorXd> along;
  for (Index k = 0; k < kValues; ++k) {
    along.push_back(k == 0 ? at_u : residuals(u + kTiny * static_cast<double>(k) * direction));
    if (along.back().size() != at_u.size()) return VectorXd::Constant(u.size(), std::max(smallest, 1e-4));
  }
  double sum = 0;
  for (Index i = 0; i < at_u.size(); ++i) {
    VectorXd values(kValues);
    for (Index k = 0; k < kValues; ++k) values[k] = along[static_cast<std::size_t>(k)][i];
    const double noise = computational_noise(values);
    sum += noise * noise;
  }
  const double noise = std::sqrt(sum / static_cast<double>(std::max<Index>(1, at_u.size())));
  const double size =
      std::max(unit, std::sqrt(at_u.squaredNorm() / static_cast<double>(std::max<Index>(1, at_u.size()))));
  const double h = std::clamp(std::cbrt(3 * std::max(noise / size, std::numeric_limits<double>::epsilon())),
                              smallest, 0.1);
  // By powers of two: an estimate of noise is one of its order, and derivatives should not follow its digits.
  const double rough = std::min(0.1, smallest * std::exp2(std::ceil(std::log2(h / smallest))));
  return rough * u.cwiseAbs().cwiseMax(1.0);
}

VectorXd difference(const ResidualFunction& residuals, const VectorXd& u, const VectorXd& at_u, Index j,
                    double step) {
  VectorXd up = u, down = u;
  up[j] += step;
  down[j] -= step;
  const VectorXd above = residuals(up), below = residuals(down);
  if (above.size() == at_u.size() && below.size() == at_u.size()) return (above - below) / (up[j] - down[j]);
  if (above.size() == at_u.size()) return (above - at_u) / (up[j] - u[j]);
  if (below.size() == at_u.size()) return (at_u - below) / (u[j] - down[j]);
  return VectorXd::Constant(at_u.size(), std::numeric_limits<double>::quiet_NaN());
}

Difference best_difference(const ResidualFunction& residuals, const VectorXd& u, const VectorXd& at_u,
                           Index j, double step) {
  const double longest = kLongestStep * std::max(1.0, std::abs(u[j]));
  Difference best{difference(residuals, u, at_u, j, step), step, 0};
  VectorXd fine = best.column;
  for (bool is_first = true; is_first || (best.error > kGoodColumn && 2 * step <= longest);
       is_first = false) {
    const VectorXd coarse = difference(residuals, u, at_u, j, 2 * step);
    const double norm = fine.norm(), error = norm > 0 ? (coarse - fine).norm() / norm : 0;
    if (is_first || error < best.error) best = {fine, step, error};
    if (!coarse.allFinite()) break;
    fine = coarse;
    step *= 2;
  }
  return best;
}

}  // namespace shearfront::fit
