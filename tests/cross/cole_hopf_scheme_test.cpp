// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shearfront/diffusion/cole_hopf_burgers.hpp"
#include "shearfront/diffusion/cole_hopf_uniform.hpp"
#include "shearfront/digits/real110.hpp"
#include "support/checked.hpp"
#include "support/closeness.hpp"
#include "support/crank_nicolson.hpp"

namespace shearfront::diffusion {
namespace {

/// Largest difference of the means over cells.
double distance_to_scheme(double rate, double d, double start, double t, std::size_t n, std::size_t n_steps) {
  const std::vector<double> cells = support::plain_crank_nicolson(rate, d, start, t, n, n_steps);
  const UniformStart<double> exact(0, 1, rate, d, start);
  double worst = 0, below = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double above = exact.at(double(i + 1) / double(n), t).cumulative;
    worst = std::max(worst, std::abs((above - below) * double(n) - cells[i]));
    below = above;
  }
  return worst;
}

TEST(ColeHopf, AgreesWithAFineIndependentScheme) {
  EXPECT_LT(distance_to_scheme(1, 0.5, 0.55, 0.3, 500, 300), 1e-6);
  EXPECT_LT(distance_to_scheme(-1, 0.1, 0.55, 0.5, 1000, 500), 1e-6);
  EXPECT_LT(distance_to_scheme(1, 0.1, 0.2, 1.5, 2000, 1000), 1e-6);
}

TEST(ColeHopf, IsTheLimitOfAnIndependentSchemeAtSecondOrder) {
  for (const double d : {0.1, 0.02}) {
    const double coarse = distance_to_scheme(1, d, 0.55, 0.5, 200, 200),
                 fine = distance_to_scheme(1, d, 0.55, 0.5, 400, 400);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05) << d;
  }
}

/// The Fourier-Bessel series with digits enough for its cancellation by exp(1 / mu).
class BesselSeries {
 public:
  explicit BesselSeries(double mu) : mu_(mu) {
    // I_n(k) = sum_m (k/2)^(2 m + n) / (m! (m + n)!), positive terms.
    const Real110 half = 1 / (4 * mu_);
    Real110 first(1);
    for (int n = 0; n == 0 || bessel_.back() > bessel_.front() * Real110("1e-105"); ++n) {
      if (n > 0) first *= half / n;
      Real110 term = first, sum = first;
      for (int m = 1; term > sum * Real110("1e-112"); ++m) sum += term *= half * half / (m * (m + n));
      bessel_.push_back(sum);
    }
  }
  [[nodiscard]] Real110 value(double x, double t) const {
    Real110 top(0), bottom = bessel_[0];
    for (std::size_t i = 1; i < bessel_.size(); ++i) {
      const Real110 n(static_cast<int>(i)), angle = n * Real110(x);
      const Real110 term = 2 * bessel_[i] * exp(Real110(-mu_ * n * n * Real110(t)));
      top += n * term * sin(angle);
      bottom += term * cos(angle);
    }
    return 2 * mu_ * top / bottom;
  }

 private:
  Real110 mu_;
  std::vector<Real110> bessel_;
};

TEST(ColeHopf, PeriodicBurgersIsTheBesselSeries) {
  shearfront::support::Checked checked({""}, 20);
  for (const double mu : {1.0, 0.1, 0.01}) {
    const BesselSeries series(mu);
    const PeriodicBurgers<Real110> exact(Real110(mu), 1, 1);
    const PeriodicBurgers<double> rounded(mu, 1, 1);
    for (const double t : {0.2, 2.0, 30.0})
      for (const double x : {1e-3, 1.0, 3.0, 5.0}) {
        if (mu * t > 3) continue;
        const Real110 reference = series.value(x, t);
        const auto error = [&](const Real110& u) { return support::relative_error(u, reference); };
        EXPECT_LT(error(Real110(exact.at(x, t).value)), 1e-45) << mu << ' ' << t << ' ' << x;
        EXPECT_LT(error(Real110(rounded.at(x, t).value)), 1e-12) << mu << ' ' << t << ' ' << x;
        checked.count();
      }
  }
}

}  // namespace
}  // namespace shearfront::diffusion
