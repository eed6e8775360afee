// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "shearfront/diffusion/cole_hopf_uniform.hpp"
#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/model/flux/all.hpp"

/// Complaints with diffusion whose solutions are known, and errors of computed ones.
namespace shearfront::diffusion::support {

/// int over [a, b] / (b - a), Gauss with three points.
template <class Function>
double mean_over(double a, double b, const Function& g) {
  const double x = 0.5 * (b - a) * std::sqrt(0.6), m = 0.5 * (a + b);
  return (5 * g(m - x) + 8 * g(m) + 5 * g(m + x)) / 18;
}

template <class Function>
std::vector<double> cell_means(const Problem& p, const Function& g) {
  std::vector<double> all;
  for (std::size_t i = 0; i < p.n_cells; ++i) {
    const double z = p.bottom + static_cast<double>(i) * p.width();
    all.push_back(mean_over(z, z + p.width(), g));
  }
  return all;
}

/// Constant r and D, from a uniform state.
inline Problem uniform_problem(double length, std::size_t n, double rate, double diffusivity, double phi) {
  Problem p;
  p.top = length;
  p.n_cells = n;
  p.rate.assign(n + 1, rate);
  p.diffusivity.assign(n + 1, diffusivity);
  p.initial.assign(n, phi);
  return p;
}

/// Exact cell means for a problem of uniform_problem().
inline std::vector<double> uniform_start_means(const Problem& p, double t) {
  const UniformStart<double> exact(p.bottom, p.top, p.rate[0], p.diffusivity[0], p.initial[0]);
  std::vector<double> all;
  double below = 0;
  for (std::size_t i = 1; i <= p.n_cells; ++i) {
    const double z = i == p.n_cells ? p.top : p.bottom + static_cast<double>(i) * p.width();
    const double cumulative = exact.at(z, t).cumulative;
    all.push_back((cumulative - below) / p.width());
    below = cumulative;
  }
  return all;
}

/// Differences of cell means in the max norm, L2 and H1.
struct Errors {
  double max = 0, l2 = 0, h1 = 0;

  Errors() = default;
  Errors(std::span<const double> a, std::span<const double> b, double width) {
    double values = 0, slopes = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double d = a[i] - b[i];
      max = std::max(max, std::abs(d));
      values += d * d * width;
      if (i > 0) slopes += (d - (a[i - 1] - b[i - 1])) * (d - (a[i - 1] - b[i - 1])) / width;
    }
    l2 = std::sqrt(values);
    h1 = std::sqrt(values + slopes);
  }
};

/// The travelling kink of speed c = -1/4 for r = 1, D = 0.01, at y0 = 0.2 in the beginning.
inline double kink(double y, double t) {
  constexpr double kSpeed = -0.25, kDiffusivity = 0.01;
  return 0.5 * (1 + kSpeed) * (1 + std::tanh(-(1 + kSpeed) * (y - 0.2 - kSpeed * t) / (2 * kDiffusivity)));
}

/// At t = 2 on [-half, half], n cells a unit of length, with homogeneous Neumann conditions: the kink fulfils
/// them to 2e-5 for half = 1/2 (phi itself to 2e-7) and to 1e-20 for half = 1.
inline Errors kink_errors(std::size_t n, double dt, double half = 0.5) {
  const auto n_cells = static_cast<std::size_t>(2 * half * static_cast<double>(n));
  Problem p = uniform_problem(1, n_cells, 1, 0.01, 0);
  p.bottom = -half;
  p.top = half;
  p.ends = Ends::neumann;
  p.initial = cell_means(p, [](double y) { return kink(y, 0); });
  Options options;
  options.dt = dt;
  CrankNicolson run(p, options);
  run.advance_to(2);
  return {run.states(), cell_means(p, [](double y) { return kink(y, 2); }), p.width()};
}

/// Periodic viscous Burgers from sin x on [0, 2 pi] by Cole-Hopf: u = -2 mu (ln w)_x and w the convolution of
/// exp((cos x - 1) / (2 mu)) with the heat kernel, here by the trapezoidal rule on [-20, 20] standard
/// deviations, which converges geometrically.
inline double burgers(double x, double t, double mu) {
  if (t == 0) return std::sin(x);
  constexpr int kHalf = 200;
  const double deviation = std::sqrt(2 * mu * t);
  double w = 0, moment = 0, largest = -1e300;
  std::array<double, 2 * kHalf + 1> exponents;
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double s = 20.0 * i / kHalf;
    const auto k = static_cast<std::size_t>(i + kHalf);
    exponents[k] = (std::cos(x + deviation * s) - 1) / (2 * mu) - 0.5 * s * s;
    largest = std::max(largest, exponents[k]);
  }
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double s = 20.0 * i / kHalf;
    const double weight = std::exp(exponents[static_cast<std::size_t>(i + kHalf)] - largest);
    w += weight;
    moment += weight * std::sin(x + deviation * s);
  }
  return moment / w;
}

inline Errors burgers_errors(std::size_t n, double dt, double mu, double t) {
  const double pi = std::acos(-1.0);
  Problem p = uniform_problem(2 * pi, n, 1, mu, 0);
  p.flux = Burgers<double>{};
  p.ends = Ends::periodic;
  p.initial = cell_means(p, [](double x) { return std::sin(x); });
  Options options;
  options.dt = dt;
  CrankNicolson run(p, options);
  run.advance_to(t);
  return {run.states(), cell_means(p, [&](double x) { return burgers(x, t, mu); }), p.width()};
}

}  // namespace shearfront::diffusion::support
