// SPDX-License-Identifier: BSD-3-Clause
// Integrals of what is smooth: right to their tolerance, and as cheap in a narrow interval as in a wide one. The kind of fault: an
// estimate for one interval held against a tolerance for another, so that 1000 knots of a start cost 4 million rules.
#include "shearfront/numeric/quadrature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

constexpr unsigned kHalvings = 12;

TEST(Quadrature, OneRuleForPolynomialsOfAnyWidth) {
  for (const double width : {1e-12, 1e-6, 1e-3, 1.0, 1e6, 1e12}) {
    int n = 0;
    const auto cubic = [&](double z) { return ++n, std::pow(z / width, 3); };
    const double found = integral_of_smooth<double>(cubic, 0.0, width, kHalvings, 1e-14);
    EXPECT_NEAR(found, width / 4, 1e-15 * width) << width;
    EXPECT_EQ(n, 15) << width;
  }
}

TEST(Quadrature, HalvesTowardsAnEndThatIsNotSmooth) {
  for (const double width : {1e-6, 1.0, 1e6}) {
    int n = 0;
    const auto root = [&](double z) { return ++n, std::sqrt(z / width); };
    const double found = integral_of_smooth<double>(root, 0.0, width, 40, 1e-12);
    EXPECT_NEAR(found, width * 2 / 3, 1e-11 * width) << width;
    EXPECT_LE(n, 15 * (1 + 2 * 40)) << width;
  }
}

TEST(Quadrature, AmountsOfTabulatedStartsInTabulatedBedsAreThoseOfSimpson) {
  support::SceneMaker make(support::seed_of(77));
  for (int number = 0; number < 20; ++number) {
    Table<double> c;
    TableInitial<double> start;
    std::vector<double> z{0, 1};
    for (int i = 0; i < 40; ++i) z.push_back(make.uniform(0, 1));
    std::sort(z.begin(), z.end());
    for (const double height : z) {
      c.z.push_back(height);
      c.values.push_back(make.uniform(0.4, 0.6));
      start.z.push_back(height);
      start.values.push_back(make.uniform(0, 1));
    }
    SceneSpec<double> spec;
    spec.shear_rate = Piecewise<double>{{}, {1.0}};
    spec.solid_fraction = c;
    spec.initial_state = start;
    const Scene<double> scene(spec);
    double simpson = 0;
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      const double middle = z[i] + (z[i + 1] - z[i]) / 2;
      simpson += (z[i + 1] - z[i]) / 6 *
                 (scene.initial_phi(z[i]) + 4 * scene.initial_phi(middle) + scene.initial_phi(z[i + 1]));
    }
    EXPECT_NEAR(scene.initial_amount(0.0, 1.0), simpson, 1e-14);
  }
}

}  // namespace
}  // namespace shearfront
