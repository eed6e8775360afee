// SPDX-License-Identifier: BSD-3-Clause
// Sides of fluxes that are cubics in pieces: the coefficients against the models, integrals against partial fractions and against the model's own
// values on many thin panels, in 110 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/inverse_flux.hpp"
#include "shearfront/exact/law_run.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using exact::InverseFlux;
using exact::LawSide;
using support::SceneMaker;

/// A flux through points of a convex function whose slope changes by random factors.
FluxTable<double> random_flux_table(SceneMaker& make) {
  for (;;) {
    FluxTable<double> flux{{0}, {0}};
    for (const double phi : make.heights(make.integer(1, 6), 0, 1)) flux.phi.push_back(phi);
    flux.phi.push_back(1);
    const double skew = make.uniform(0.5, 2), bow = make.uniform(0.2, 1);
    for (std::size_t i = 1; i < flux.phi.size(); ++i) {
      const double u = std::pow(flux.phi[i], skew);
      flux.values.push_back(i + 1 == flux.phi.size() ? 0 : -u * (1 - u) * (1 - bow * u));
    }
    Complaints complaints;
    flux.check("", complaints);
    if (complaints.empty() && flux.curvature() == Curvature::convex && flux.extrema().size() == 1)
      return flux;
  }
}

FluxTable<Real110> in_many_digits(const FluxTable<double>& flux) {
  FluxTable<Real110> all;
  for (const double x : flux.phi) all.phi.emplace_back(x);
  for (const double x : flux.values) all.values.emplace_back(x);
  return all;
}

/// Means of 1 / G, (G - m G') / G and (G - m G') / G^2 from the model alone, by panels that are thin beside their distance from 0.
struct PlainMeans {
  Real110 inverse{0}, bow{0}, bow_over_height{0};

  PlainMeans(const FluxTable<Real110>& flux, const Real110& depth, bool is_up, const Real110& m1,
             const Real110& m2) {
    using Rule = boost::math::quadrature::gauss<Real110, 30>;
    const Real110 end = is_up ? flux.phi.back() : flux.phi.front();
    std::vector<Real110> cuts{m1, m2};
    for (const Real110& x : flux.phi) {
      const Real110 m = is_up ? Real110(1 - x) : x;
      if (m > m1 && m < m2) cuts.push_back(m);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      for (Real110 from = cuts[i]; from < cuts[i + 1];) {
        const Real110 to = std::min(cuts[i + 1], Real110(from * Real110(1.03125)));
        const Real110 half = (to - from) / 2, middle = from + half;
        for (std::size_t n = 0; n < Rule::abscissa().size(); ++n)
          for (const int side : {-1, 1}) {
            const Real110 m = middle + half * Rule::abscissa()[n] * side, x = is_up ? Real110(end - m) : m;
            const Real110 G = -flux.value(x) / depth, slope = (is_up ? 1 : -1) * flux.derivative(x) / depth,
                          weight = Rule::weights()[n] * half / (m2 - m1);
            inverse += weight / G;
            bow += weight * (G - m * slope) / G;
            bow_over_height += weight * (G - m * slope) / (G * G);
          }
        from = to;
      }
  }
};

void expect_close(const Real110& a, const Real110& b, double relative, const std::string& what) {
  const Real110 size = b < 0 ? Real110(-b) : b, gap = a < b ? Real110(b - a) : Real110(a - b);
  EXPECT_LE(to_double(Real110(gap / size)), relative) << what << ": " << to_double(a) << " " << to_double(b);
}

TEST(FluxBranch, MeansOfTablesAreThoseOfThinPanels) {
  SceneMaker make(support::seed_of(5590));
  for (int n = 0; n < 6; ++n) {
    const FluxTable<double> table = random_flux_table(make);
    const FluxTable<Real110> fine = in_many_digits(table);
    const InverseFlux<double> flux{Flux<double>(table)};
    const InverseFlux<Real110> precise{Flux<Real110>(fine)};
    const Real110 depth = -fine.value(fine.extrema().front());
    for (const bool is_up : {false, true}) {
      ASSERT_NE(flux.branch(is_up), nullptr);
      const LawSide<double> side(flux, is_up);
      const LawSide<Real110> precise_side(precise, is_up);
      const double m1 = side.reach() * std::exp(make.uniform(-4, -0.1));
      const double m2 = n % 3 == 0 ? m1 * (1 + 1e-3) : m1 + (side.reach() - m1) * make.uniform(0.1, 0.999);
      const PlainMeans plain(fine, depth, is_up, Real110(m1), Real110(m2));
      const std::string at =
          "table " + std::to_string(n) + " from " + std::to_string(m1) + " to " + std::to_string(m2);
      const Real110 a(m1), b(m2);
      expect_close(precise_side.mean_inverse(a, b), plain.inverse, 1e-98, at);
      expect_close(precise_side.mean_bow(a, b), plain.bow, 1e-98, at);
      expect_close(precise_side.mean_bow_over_height(a, b), plain.bow_over_height, 1e-98, at);
      expect_close(Real110(side.mean_inverse(m1, m2)), plain.inverse, 1e-14, at);
      expect_close(Real110(side.mean_bow(m1, m2)), plain.bow, 1e-13, at);
      expect_close(Real110(side.mean_bow_over_height(m1, m2)), plain.bow_over_height, 1e-13, at);
    }
  }
}

/// 1 / (m (1 - m) (1 - g m)) = 1 / m + 1 / ((1 - g) (1 - m)) - g^2 / ((1 - g) (1 - g m)).
TEST(FluxBranch, MeansOfCubicsAreThoseOfPartialFractions) {
  for (const double g : {0.0625, 0.25, 0.5})
    for (const double low : {1e-300, 1e-30, 1e-3, 0.2})
      for (const double high : {0.25, 0.375}) {
        const auto integral = [&](const Real110& m) {
          const Real110 gamma(g), rest = 1 - gamma;
          return Real110(log(m) - log(Real110(1 - m)) / rest + gamma / rest * log(Real110(1 - gamma * m)));
        };
        const Cubic<Real110> cubic{Real110(g)};
        const Real110 depth = -cubic.value(cubic.extrema().front()), a(low), b(high);
        const Real110 mean = depth * (integral(b) - integral(a)) / (b - a);
        const InverseFlux<Real110> precise{Flux<Real110>(cubic)};
        const InverseFlux<double> flux{Flux<double>(Cubic<double>{g})};
        const std::string at = "gamma " + std::to_string(g);
        expect_close(LawSide<Real110>(precise, false).mean_inverse(a, b), mean, 1e-100, at);
        expect_close(Real110(LawSide<double>(flux, false).mean_inverse(low, high)), mean, 4e-15, at);
      }
}

TEST(FluxBranch, KnowsWhatItsModelKnows) {
  SceneMaker make(support::seed_of(5591));
  std::vector<Flux<double>> all{Cubic<double>{0.25}, Cubic<double>{0.5}, LwrCubic<double>{0.125, 0.5},
                                Triangular<double>{0.25, 1}};
  for (int n = 0; n < 20; ++n) all.emplace_back(random_flux_table(make));
  for (const Flux<double>& model : all) {
    const InverseFlux<double> flux(model);
    const auto range = model.range();
    const double width = range.highest - range.lowest, depth = std::abs(model.value(model.extrema().front()));
    const bool is_concave = model.curvature() == Curvature::concave;
    for (const bool is_up : {false, true}) {
      const auto place = [&](double u) {
        return is_concave ? range.highest - width * u : range.lowest + width * u;
      };
      for (int i = 0; i < 50; ++i) {
        const double reach = flux.reach(is_up), d = reach * make.uniform(0, 1), m = reach - d;
        const double u = is_up ? flux.peak() + d : flux.peak() - d;
        const double G = std::abs(model.value(place(u))) / depth;
        EXPECT_NEAR(flux.lack(d, is_up), 1 - G, 1e-15);
        EXPECT_NEAR(flux.flux_beside(m, is_up), G, 1e-15);
        EXPECT_NEAR(flux.slope(d, is_up), std::abs(model.derivative(place(u))) * width / depth, 1e-13);
        EXPECT_NEAR(flux.inverse(flux.lack(d, is_up), is_up), d,
                    1e-15 + 4e-16 * reach / std::sqrt(1e-16 + 1 - G));
        const double tiny = std::exp(make.uniform(-600, -1)) * reach;
        EXPECT_NEAR(flux.distance_beside(flux.flux_beside(tiny, is_up), is_up) / tiny, 1, 4e-15);
      }
    }
  }
}

}  // namespace
}  // namespace shearfront
