// SPDX-License-Identifier: BSD-3-Clause
// Any flux with one extremum on linear and exponential pieces: against the closed forms of parabolas, the differential equation of a
// state, stacks of ever thinner layers, a naive scheme, differences, and 50 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/sloped_medium.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/checked.hpp"
#include "support/flux_scenes.hpp"
#include "support/scene_cast.hpp"
#include "support/table_scenes.hpp"

namespace shearfront {
namespace {

using exact::Cells;
using exact::PieceFluxes;
using exact::RateForm;
using exact::SlopedMedium;
using exact::SlopedPieces;
using support::FluxShape;
using support::SceneMaker;

/// Pieces of both forms with jumps, throats, humps and flats, by its own closed forms and as any other flux.
TEST(FluxPieces, ParabolasAreWhatTheirClosedFormsSay) {
  SceneMaker make(support::seed_of(5500));
  support::Checked checked({"values", "numbers"}, 500);
  for (int n = 0; n < 120; ++n) {
    std::vector<double> z = make.heights(make.integer(0, 10), 0, 1), low, high;
    z.insert(z.begin(), 0);
    z.push_back(1);
    std::vector<RateForm> forms;
    const auto rate = [&] { return std::exp(make.uniform(-2, 2)); };
    double last = rate();
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      low.push_back(make.integer(0, 3) == 0 ? rate() : last);
      high.push_back(last = make.integer(0, 4) == 0 ? low.back() : rate());
      forms.push_back(make.integer(0, 1) == 0 ? RateForm::linear : RateForm::exponential);
    }
    const std::vector<double> jumps = make.heights(make.integer(0, 4), 0, 1);
    std::vector<double> states;
    for (std::size_t i = 0; i <= jumps.size(); ++i)
      states.push_back(make.integer(0, 2) == 0   ? make.integer(0, 1)
                       : make.integer(0, 6) == 0 ? 0.5
                                                 : make.uniform(0, 1));
    const SlopedPieces<double> pieces(z, low, high, forms);
    const Cells<double> cells(jumps, states, z);
    auto fluxes = std::make_shared<PieceFluxes<double>>();
    fluxes->fluxes.emplace_back(Flux<double>(Quadratic<double>{}));
    fluxes->of_piece.assign(low.size(), 0);
    const SlopedMedium<double> closed(pieces, cells, cells.M.back()),
        any(pieces, cells, cells.M.back(), fluxes);
    for (int i = 0; i < 8; ++i) {
      const double height = make.integer(0, 4) == 0 ? z[z.size() / 2] : make.uniform(0, 1),
                   t = std::exp(make.uniform(-4, 3)) / closed.rate_at(make.uniform(0, 1));
      SCOPED_TRACE("bed " + std::to_string(n) + ", z = " + std::to_string(height) +
                   ", t = " + std::to_string(t));
      const auto a = closed.best_path(height, t), b = any.best_path(height, t);
      ASSERT_NEAR(a.value, b.value, 1e-13);
      checked.count("values");
      if (a.kind != b.kind || a.source != b.source || a.turned != b.turned || a.upward != b.upward) continue;
      EXPECT_NEAR(a.p, b.p, 1e-12);
      const auto by = closed.gradient(a, height, t), any_by = any.gradient(b, height, t);
      ASSERT_EQ(by.pieces.size(), any_by.pieces.size());
      // A state at the peak that leaves its piece has half of the digits.
      const bool is_at_peak = a.kind == exact::PathKind::constant && cells.phi[a.source] == 0.5;
      const auto expect = [&](double x, double y) {
        EXPECT_NEAR(x, y, (is_at_peak ? 1e-6 : 1e-8) * (1 + std::abs(x)));
      };
      for (std::size_t k = 0; k < by.pieces.size(); ++k) {
        expect(by.pieces[k].M, any_by.pieces[k].M);
        expect(by.pieces[k].phi, any_by.pieces[k].phi);
        checked.count("numbers");
      }
      for (std::size_t k = 1; k < by.boundaries.size(); ++k) {
        expect(by.boundaries[k].M, any_by.boundaries[k].M);
        expect(by.boundaries[k].phi, any_by.boundaries[k].phi);
      }
      expect(by.phi_start, any_by.phi_start);
      expect(by.phi_state, any_by.phi_state);
      expect(by.phi_log_scale, any_by.phi_log_scale);
    }
  }
}

/// Up to 12 points of a(z), with jumps and flats, or an exponential; one or two fluxes, c and T in layers.
SceneSpec<double> bent_scene(SceneMaker& make, FluxShape shape) {
  SceneSpec<double> spec = support::random_flux_scene(make, shape);
  const auto rate = [&] { return std::exp(make.uniform(-1.2, 1.2)); };
  if (make.integer(0, 5) == 0) {
    spec.shear_rate = Exponential<double>{rate(), std::exp(make.uniform(-1.5, 1))};
    return spec;
  }
  spec.shear_rate = support::table_with_knots(make, make.heights(make.integer(0, 10), 0, 1), rate);
  return spec;
}

/// a(z) in n layers between any two of its knots, of the same travel time for pure states.
Piecewise<double> layers_of(const SceneSpec<double>& spec, int n) {
  Piecewise<double> a;
  std::vector<double> cuts = std::visit([](const auto& model) { return model.knots(); }, spec.shear_rate);
  cuts.insert(cuts.begin(), 0);
  cuts.push_back(1);
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    if (!(cuts[k + 1] > cuts[k])) continue;
    for (int i = 0; i < n; ++i) {
      const double lo = i == 0 ? cuts[k] : cuts[k] + (cuts[k + 1] - cuts[k]) * i / n,
                   hi = i + 1 == n ? cuts[k + 1] : cuts[k] + (cuts[k + 1] - cuts[k]) * (i + 1) / n;
      if (lo > 0) a.breaks.push_back(lo);
      a.values.push_back(
          std::visit([&](const auto& model) { return model.harmonic_mean(lo, hi); }, spec.shear_rate));
    }
  }
  return a;
}

class FluxPieceShapes : public testing::TestWithParam<FluxShape> {};

/// A path forgotten would show as a difference that does not fall with the layers, those of a stack falling with the power 3/2.
TEST_P(FluxPieceShapes, AreTheLimitOfManyLayers) {
  SceneMaker make(support::seed_of(5600 + static_cast<std::uint64_t>(GetParam())));
  double coarse = 0, fine = 0;
  for (int n = 0; n < 20; ++n) {
    const SceneSpec<double> spec = bent_scene(make, GetParam());
    const ExactSolution<double> exact{Scene<double>(spec)};
    ASSERT_TRUE(exact.is_exact());
    SceneSpec<double> few = spec, many = spec;
    few.shear_rate = layers_of(spec, 6);
    many.shear_rate = layers_of(spec, 48);
    const ExactSolution<double> with_few{Scene<double>(few)}, with_many{Scene<double>(many)};
    for (int i = 0; i < 6; ++i) {
      const double z = make.uniform(0, 1), t = std::exp(make.uniform(-3, 1.5)), M = exact.M(z, t);
      coarse = std::max(coarse, std::abs(with_few.M(z, t) - M));
      const double left = std::abs(with_many.M(z, t) - M);
      EXPECT_LT(left, 5e-3) << "scene " << n << ", z = " << z << ", t = " << t;
      fine = std::max(fine, left);
    }
  }
  EXPECT_GT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 6);  // 8^(3/2) = 23 but for throats, whose capacity is of the first order
}

TEST_P(FluxPieceShapes, GodunovConverges) {
  SceneMaker make(support::seed_of(5700 + static_cast<std::uint64_t>(GetParam())));
  double sum[2] = {0, 0};
  for (int n = 0; n < 10; ++n) {
    const SceneSpec<double> spec = bent_scene(make, GetParam());
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    const double t = make.uniform(0.1, 0.6);
    for (const bool is_fine : {false, true}) {
      const std::size_t cells = is_fine ? 800 : 100;
      const std::vector<double> phi = support::godunov_any_scene(scene, t, cells);
      double M = 0, worst = 0;
      for (std::size_t j = 0; j < cells; ++j) {
        M += phi[j] / static_cast<double>(cells);
        worst = std::max(worst,
                         std::abs(exact.M(static_cast<double>(j + 1) / static_cast<double>(cells), t) - M));
      }
      sum[is_fine] += worst;
      if (is_fine) {
        EXPECT_LT(worst, 8e-3) << "scene " << n;
      }
    }
  }
  EXPECT_LT(sum[1], sum[0] / 3);
}

TEST_P(FluxPieceShapes, HaveTheDerivativesOfTheirDifferences) {
  SceneMaker make(support::seed_of(5800 + static_cast<std::uint64_t>(GetParam())));
  support::Checked checked({""}, 200);
  for (int n = 0; n < 25; ++n) {
    const SceneSpec<double> spec = bent_scene(make, GetParam());
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    const Derivatives<double> derivatives(exact);
    const std::vector<Entry> all = entries(spec);
    const double z = make.uniform(0, 1), t = std::exp(make.uniform(-2, 1));
    const auto path = exact.path(z, t);
    const auto at = derivatives.at(z, t);
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (!derivative_refusal(scene, all[e]).empty()) continue;
      constexpr double kStep = 1e-6;
      double M[2], phi[2];
      bool is_same = true;
      for (const int side : {0, 1}) {
        SceneSpec<double> moved = spec;
        *entry_places(moved)[e] += (side == 0 ? -1 : 1) * kStep;
        if (!find_complaints(moved).empty()) {
          is_same = false;
          break;
        }
        const ExactSolution<double> other{Scene<double>(moved)};
        const auto p = other.path(z, t);
        is_same = is_same && p.kind == path.kind && p.upward == path.upward && p.turned == path.turned &&
                  other.medium().cells().n_cells() == exact.medium().cells().n_cells() &&
                  p.source == path.source;
        M[side] = other.M(z, t), phi[side] = other.phi(z, t);
      }
      if (!is_same || std::abs(at.phi[e]) > 30) continue;
      const auto where = [&] {
        return "scene " + std::to_string(n) + ", " + all[e].name() + ", z = " + std::to_string(z) +
               ", t = " + std::to_string(t);
      };
      const double dM = (M[1] - M[0]) / (2 * kStep), dphi = (phi[1] - phi[0]) / (2 * kStep);
      // One-sided where the capacities of both sides of the place of rest are equal: there M has a kink.
      if (const double M_here = exact.M(z, t);
          std::abs((M[1] - M_here) - (M_here - M[0])) > 1e-3 * kStep * (1 + std::abs(dM)))
        continue;
      EXPECT_NEAR(at.M[e], dM, 1e-6 * (1 + std::abs(dM))) << where();
      EXPECT_NEAR(at.phi[e], dphi, 1e-5 * (1 + std::abs(dphi))) << where();
      checked.count();
    }
  }
}

TEST_P(FluxPieceShapes, ComeToRestWhenTheySay) {
  SceneMaker make(support::seed_of(5900 + static_cast<std::uint64_t>(GetParam())));
  support::Checked checked({""}, 12);
  for (int n = 0; n < 8; ++n) {
    const SceneSpec<double> spec = bent_scene(make, GetParam());
    const ExactSolution<double> exact{Scene<double>(spec)};
    const auto times = exact_timeline(exact);
    const double inf = infinity<double>();
    const auto check = [&](double z, double last) {
      const double after = exact.M(z, last * (1 + 1e-9)), before = exact.M(z, last * (1 - 1e-4));
      EXPECT_NEAR(after, exact.M(z, inf), 1e-12) << "scene " << n << ", z = " << z;
      if (last > 0 && std::abs(exact.H(z, last * (1 - 1e-4))) > 1e-6) {
        EXPECT_GT(std::abs(before - after), 1e-11) << "scene " << n << ", z = " << z;
        checked.count();
      }
    };
    ASSERT_TRUE(times.t_star);
    check(times.steady_height, *times.t_star);
    for (const auto& at : times.interfaces) {
      ASSERT_EQ(at.first.has_value(), at.last.has_value()) << "scene " << n << ", z = " << at.z;
      if (at.last) check(at.z, *at.last);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, FluxPieceShapes,
                         testing::Values(FluxShape::concave_parabolas, FluxShape::convex,
                                         FluxShape::concave));

/// Where T and c vary smoothly, pieces stand for the bed, of second order in their number.
TEST(FluxPieces, SmoothBedsHaveTheSecondOrder) {
  SceneMaker make(support::seed_of(5960));
  double error[2] = {0, 0};
  for (int n = 0; n < 6; ++n) {
    SceneSpec<double> spec = make.data(1, SceneMaker::Order::random, 3);
    spec.fluxes = {Flux<double>(Cubic<double>{make.uniform(0, 0.5)})};
    const auto table = [&](double lo, double hi) {
      return Table<double>{{0, make.uniform(0.3, 0.6), 1},
                           {make.uniform(lo, hi), make.uniform(lo, hi), make.uniform(lo, hi)}};
    };
    spec.shear_rate = table(0.5, 3);
    spec.temperature = table(0.5, 2);
    spec.solid_fraction = table(0.4, 0.7);
    for (double& share : spec.initial_values) share *= 0.9;
    const Scene<double> scene(spec);
    const ExactSolution<double> fine(scene, {256}), by_tolerance(scene, {0, 1e-5});
    EXPECT_FALSE(fine.is_exact());
    EXPECT_TRUE(by_tolerance.meets_tolerance());
    for (const bool is_many : {false, true}) {
      const ExactSolution<double> exact(scene, {is_many ? 32U : 8U});
      for (int i = 0; i < 8; ++i) {
        const double z = make.uniform(0, 1), t = std::exp(make.uniform(-2, 2)), M = fine.M(z, t);
        error[is_many] = std::max(error[is_many], std::abs(exact.M(z, t) - M));
        if (is_many) {
          EXPECT_NEAR(by_tolerance.M(z, t), M, 1e-4);
        }
      }
    }
  }
  EXPECT_GT(error[0], 1e-5);
  EXPECT_LT(error[1], error[0] / 6);
}

/// phi_t = -s a'(z) f(phi) where phi is the same all around, by the method of Runge and Kutta.
TEST(FluxPieces, AStateInsideOneLinearPieceFollowsItsEquation) {
  support::Checked checked({""}, 12);
  for (const double gamma : {0.0, 0.2, 0.5})
    for (const double phi0 : {0.2, 0.8}) {
      const Cubic<double> flux{gamma};
      SceneSpec<double> spec;
      spec.fluxes = {Flux<double>(flux)};
      spec.shear_rate = Table<double>{{0, 1}, {1, 3}};
      spec.initial_values = {phi0};
      const ExactSolution<double> exact{Scene<double>(spec)};
      for (const double t : {0.01, 0.1}) {
        double phi = phi0;
        constexpr int kSteps = 2000;
        const double h = t / kSteps;
        const auto rate = [&](double p) { return -2 * flux.value(p); };
        for (int n = 0; n < kSteps; ++n) {
          const double a = rate(phi), b = rate(phi + h / 2 * a), c = rate(phi + h / 2 * b),
                       d = rate(phi + h * c);
          phi += h / 6 * (a + 2 * b + 2 * c + d);
        }
        EXPECT_NEAR(exact.phi(0.5, t), phi, 1e-13) << gamma << ' ' << phi0 << ' ' << t;
        EXPECT_NEAR(exact.phi(0.6, t), phi, 1e-13) << gamma << ' ' << phi0 << ' ' << t;
        checked.count();
      }
    }
}

/// Of hundreds of pieces each takes a narrow part of the times only, and a search that has spent its samples has still to look where it
/// knows a root to be: it missed every tenth path here, with M off by 0.01.
TEST(FluxPieces, HundredsOfThemHideNoPath) {
  const auto table = [](int n) {
    SceneSpec<double> spec;
    Table<double> a;
    for (int i = 0; i <= n; ++i) {
      a.z.push_back(static_cast<double>(i) / n);
      a.values.push_back(1.55 * std::sqrt(1.05 - a.z.back()));
    }
    spec.fluxes = {Flux<double>(Cubic<double>{0.3})};
    spec.shear_rate = a;
    spec.initial_breaks = {0.5};
    spec.initial_values = {0, 1};
    return ExactSolution<double>{Scene<double>(spec)};
  };
  const auto coarse = table(100), fine = table(800);
  for (const double t : {2.11, 2.14, 2.17}) {
    EXPECT_NEAR(fine.M(0.5, t), coarse.M(0.5, t), 1e-4) << t;  // tables of second order
    EXPECT_NEAR(fine.phi(0.5, t), coarse.phi(0.5, t), 1e-2) << t;
  }
}

/// Nothing moves more than the largest flux takes along: a throat that is too far away gives no path. Its way there was gone on with
/// through pieces that the search had not come to, which made the time negative.
TEST(FluxPieces, ThroatsOutOfReachGiveNoPath) {
  SceneMaker make(support::seed_of(5960));
  for (int n = 0; n < 60; ++n) {
    SceneSpec<double> spec;
    spec.fluxes = {n % 2 == 0 ? Flux<double>(Triangular<double>{0.25, 1}) : Flux<double>(Cubic<double>{0.3})};
    const double end = n == 0 ? 0.85 : make.uniform(0.5, 1), step = make.uniform(0, 0.01);
    Table<double> a{{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.5, 1}, {0.9, 0.95, 1, 1.12, 1.121, 1.122, end, 0.9}};
    if (n > 0)
      for (std::size_t i = 0; i < 6; ++i)
        a.values[i] = i < 3 ? make.uniform(end, 1.1) : 1.12 + step * static_cast<double>(i);
    spec.shear_rate = a;
    spec.initial_values = {n == 0 ? 0.55 : make.uniform(0, 1)};
    const ExactSolution<double> exact{Scene<double>(spec)};
    constexpr double kTime = 1e-3, kMostFlux = 2;
    for (int i = 1; i < 20; ++i)
      EXPECT_NEAR(exact.M(0.05 * i, kTime), 0.05 * i * spec.initial_values[0], kTime * kMostFlux)
          << n << ", " << 0.05 * i;
  }
}

TEST(SlowFluxPieces, AreTheSameInManyDigits) {
  SceneMaker make(support::seed_of(5950));
  for (int n = 0; n < 3; ++n) {
    SceneSpec<double> spec;
    spec.fluxes = {Flux<double>(Cubic<double>{0.3})};
    spec.shear_rate = Table<double>{{0, 0.4, 1}, {1, make.uniform(0.3, 3), make.uniform(0.3, 3)}};
    spec.initial_breaks = {0.3, 0.7};
    spec.initial_values = {make.uniform(0, 1), 1, make.uniform(0, 1)};
    const Scene<double> scene(spec);
    const ExactSolution<double> exact(scene);
    const ExactSolution<Real110> many(scene_cast<Real110>(scene));
    for (const double z : {0.2, 0.55, 0.8})
      for (const double t : {0.05, 0.6})
        EXPECT_NEAR(exact.M(z, t), to_double(many.M(z, t)), 4e-15) << "scene " << n << ' ' << z << ' ' << t;
  }
}

}  // namespace
}  // namespace shearfront
