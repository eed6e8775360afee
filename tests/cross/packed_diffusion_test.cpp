// SPDX-License-Identifier: BSD-3-Clause
// Diffusion in beds whose solid fraction varies: Crank-Nicolson against closed forms, an explicit scheme and the bed without
// diffusion.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "shearfront/diffusion/setup.hpp"
#include "shearfront/diffusion/solid_heights.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/random_scene.hpp"
#include "support/solid_scene.hpp"

namespace shearfront {
namespace {

SceneSpec<double> base(double D) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{0.4}, {1, 0.6}};
  spec.initial_breaks = {0.3, 0.65};
  spec.initial_values = {0.2, 0.9, 0.5};
  spec.diffusion = Diffusion<double>{};
  spec.diffusion->D = D;
  return spec;
}
Method crank_nicolson(std::uint64_t cells, double tolerance = 1e-5) {
  Method method("crank-nicolson");
  method.set("cells", cells);
  method.set("tolerance", tolerance);
  return method;
}
const std::vector<double> kHeights{0, 0.05, 0.2, 0.35, 0.5, 0.62, 0.8, 0.97, 1};

std::vector<DepthFunction<double>> packings() {
  return {Piecewise<double>{{0.25, 0.7}, {0.6, 0.35, 0.5}}, Table<double>{{0, 0.45, 1}, {0.62, 0.4, 0.55}},
          Exponential<double>{0.6, 3}};
}

TEST(PackedDiffusion, AConstantSolidFractionOnlyScales) {
  SceneSpec<double> spec = base(0.02);
  const Scene<double> plain(spec);
  spec.solid_fraction = Piecewise<double>{{}, {0.6}};
  const Scene<double> packed(spec);
  const SolverRequest request{.times = {0.3, 2, infinity<double>()}, .heights = kHeights};
  const SolverResult one = solve(plain, crank_nicolson(200), request),
                     other = solve(packed, crank_nicolson(200), request);
  ASSERT_TRUE(one.summary.usable() && other.summary.usable());
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    EXPECT_NEAR(other.samples[i].phi, 0.6 * one.samples[i].phi, 1e-11);
    EXPECT_NEAR(other.samples[i].M, 0.6 * one.samples[i].M, 1e-12);
  }
}

TEST(PackedDiffusion, KeepsTheGrains) {
  for (const DepthFunction<double>& c : packings()) {
    SceneSpec<double> spec = base(0.01);
    spec.solid_fraction = c;
    spec.temperature = Table<double>{{0, 1}, {1, 2}};
    const Scene<double> scene(spec);
    const SolverResult result = solve(scene, crank_nicolson(150), {.times = {0, 0.1, 1, 5}, .heights = {1}});
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(result.M(i, 0), scene.mass(), 1e-13);
  }
}

TEST(PackedDiffusion, AUniformShareStaysWhereNothingSegregates) {
  for (const DepthFunction<double>& c : packings()) {
    SceneSpec<double> spec = base(0.05);
    spec.solid_fraction = c;
    spec.scale = 1e-200;
    spec.initial_breaks = {}, spec.initial_values = {0.37};
    const Scene<double> scene(spec);
    const SolverResult result = solve(scene, crank_nicolson(100), {.times = {0.2, 10}, .heights = kHeights});
    ASSERT_TRUE(result.summary.usable());
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < kHeights.size(); ++j)
        EXPECT_NEAR(result.phi(i, j) / scene.initial_phi(kHeights[j]), 1, 1e-5);  // phi is linear in a cell
  }
}

TEST(PackedDiffusion, RestDoesNotDependOnTheSolidFractionButForItsAmount) {
  // x / (1 - x) = C exp(- int s a sqrt(T) / D dz).
  for (const DepthFunction<double>& c : packings()) {
    SceneSpec<double> spec = base(0.1);
    spec.solid_fraction = c;
    spec.temperature = Piecewise<double>{{0.5}, {1, 2.25}};
    const Scene<double> scene(spec);
    const auto exponent =
        [&](double z) {  // a is 1 below 0.4 and 0.6 above, sqrt(T) 1 below 0.5 and 1.5 above
          return (std::min(z, 0.4) + 0.6 * std::clamp(z - 0.4, 0.0, 0.1) + 0.9 * std::max(z - 0.5, 0.0)) /
                 0.1;
        };
    const auto share = [&](double z, double shift) { return 1 / (1 + std::exp(exponent(z) - shift)); };
    const auto grains = [&](double shift) {
      double all = 0, from = 0;
      for (const double to : {0.25, 0.4, 0.45, 0.5, 0.7, 1.0}) {
        const double last = std::nextafter(to, 0.0);
        all += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
            [&](double z) { return scene.solid_fraction_at(std::min(z, last)) * share(z, shift); }, from, to,
            5, 1e-10);
        from = to;
      }
      return all;
    };
    double low = -20, high = 20;
    for (int i = 0; i < 60; ++i) (grains((low + high) / 2) < scene.mass() ? low : high) = (low + high) / 2;
    double last = 0;
    for (const std::uint64_t cells : {50u, 100u, 200u}) {
      const std::vector<double> heights{0.05, 0.2, 0.35, 0.6, 0.85};
      const SolverResult result =
          solve(scene, crank_nicolson(cells), {.times = {infinity<double>()}, .heights = heights});
      ASSERT_TRUE(result.summary.usable());
      double worst = 0;
      for (std::size_t j = 0; j < heights.size(); ++j)
        worst = std::max(
            worst, std::abs(result.phi(0, j) - scene.solid_fraction_at(heights[j]) * share(heights[j], low)));
      EXPECT_LT(worst, 4e-3 * 2500 / static_cast<double>(cells * cells) + 1e-5);
      last = worst;
    }
    EXPECT_LT(last, 3e-4);
  }
}

/// By another road: an explicit scheme on equal cells of z, amounts c x dz, conductance of the harmonic mean of D c.
std::vector<double> marched(const Scene<double>& scene, double t, std::size_t n) {
  const double dz = 1 / static_cast<double>(n);
  std::vector<double> c(n), x(n), rate(n + 1), conductance(n + 1), flux(n + 1);
  const auto middle = [&](std::size_t j) { return (static_cast<double>(j) + 0.5) * dz; };
  double fastest = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double lo = static_cast<double>(j) * dz;
    c[j] = scene.solid(lo, lo + dz) / dz;
    x[j] = scene.initial_amount(lo, lo + dz) / (c[j] * dz);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double z = static_cast<double>(i) * dz, eps = 1e-9;
    const auto at = [&](double height) {
      return scene.scale() * scene.rate_at(height) * scene.solid_fraction_at(height);
    };
    rate[i] = (at(z - eps) + at(z + eps)) / 2;
    const double below = scene.diffusivity_at(middle(i - 1)) * scene.solid_fraction_at(z - eps),
                 above = scene.diffusivity_at(middle(i)) * scene.solid_fraction_at(z + eps);
    conductance[i] = 2 / (1 / below + 1 / above) / dz;
    fastest = std::max(fastest, conductance[i] / (std::min(c[i - 1], c[i]) * dz));
  }
  const double n_steps = std::ceil(t * fastest / 0.2), dt = t / n_steps;
  const auto f = [](double share) { return share * (share - 1); };
  for (double k = 0; k < n_steps; ++k) {
    for (std::size_t i = 1; i < n; ++i)
      flux[i] = rate[i] * (f(x[i - 1]) + f(x[i])) / 2 - conductance[i] * (x[i] - x[i - 1]);
    for (std::size_t j = 0; j < n; ++j) x[j] += dt / (c[j] * dz) * (flux[j] - flux[j + 1]);
  }
  std::vector<double> M{0};
  for (std::size_t j = 0; j < n; ++j) M.push_back(M.back() + c[j] * x[j] * dz);
  return M;
}

TEST(PackedDiffusion, IsWhatAnExplicitSchemeFinds) {
  for (const DepthFunction<double>& c : packings()) {
    SceneSpec<double> spec = base(0.03);
    spec.solid_fraction = c;
    spec.temperature = Table<double>{{0, 1}, {1, 1.7}};
    const Scene<double> scene(spec);
    constexpr std::size_t kN = 100;
    std::vector<double> edges;
    for (std::size_t i = 0; i <= kN; ++i) edges.push_back(static_cast<double>(i) / kN);
    const SolverResult result = solve(scene, crank_nicolson(400), {.times = {0.5}, .heights = edges});
    ASSERT_TRUE(result.summary.usable());
    const std::vector<double> M = marched(scene, 0.5, kN);
    for (std::size_t i = 0; i <= kN; ++i) EXPECT_NEAR(result.M(0, i), M[i], 2e-4);
  }
}

TEST(PackedDiffusion, TendsToTheBedWithoutDiffusion) {
  for (const char* name : {"2", "3", "4"}) {
    SCOPED_TRACE(name);
    const Scene<double> sharp =
        read_scene(SHEARFRONT_SOURCE_DIR "/datasets/packing-example-" + std::string(name) + "/scene.toml");
    SolverRequest request{.times = {0.5}, .heights = {}};
    for (int i = 0; i <= 50; ++i)
      request.heights.push_back(sharp.bottom() + (sharp.top() - sharp.bottom()) * i / 50.0);
    const SolverResult without = solve(sharp, "front-tracking", request);
    ASSERT_TRUE(without.summary.usable());
    double last = 0;
    for (const double D : {3e-2, 1e-2, 3e-3}) {
      SceneSpec<double> spec = sharp.spec();
      spec.diffusion = Diffusion<double>{};
      spec.diffusion->D = D;
      const Scene<double> scene(spec);
      const SolverResult with = solve(scene, crank_nicolson(400, 1e-4), request);
      ASSERT_TRUE(with.summary.usable()) << with.summary.message;
      double worst = 0;
      for (std::size_t i = 0; i < with.samples.size(); ++i)
        worst = std::max(worst, std::abs(with.samples[i].M - without.samples[i].M));
      if (last > 0) {
        EXPECT_LT(worst, 0.6 * last);
      }
      last = worst;
    }
    EXPECT_LT(last, 1e-2);
  }
}

/// The same on, with cells that follow the fronts: at once with D, or to what the tracker itself is off by.
TEST(SlowPackedDiffusion, TendsToTheBedWithoutDiffusionDownToLittle) {
  for (const char* name : {"2", "3", "4"}) {
    SCOPED_TRACE(name);
    const Scene<double> sharp =
        read_scene(SHEARFRONT_SOURCE_DIR "/datasets/packing-example-" + std::string(name) + "/scene.toml");
    SolverRequest request{.times = {0.5}, .heights = {}};
    for (int i = 0; i <= 50; ++i)
      request.heights.push_back(sharp.bottom() + (sharp.top() - sharp.bottom()) * i / 50.0);
    const SolverResult without = solve(sharp, "front-tracking", request);
    ASSERT_TRUE(without.summary.usable());
    double last = 0;
    for (const double D : {1e-2, 1e-3, 3e-4}) {
      SceneSpec<double> spec = sharp.spec();
      spec.diffusion = Diffusion<double>{};
      spec.diffusion->D = D;
      Method method = crank_nicolson(400, 1e-4);
      method.set("cell-tolerance", 0.02);
      const SolverResult with = solve(Scene<double>(spec), method, request);
      ASSERT_TRUE(with.summary.usable()) << with.summary.message;
      double worst = 0;
      for (std::size_t i = 0; i < with.samples.size(); ++i)
        worst = std::max(worst, std::abs(with.samples[i].M - without.samples[i].M));
      if (last > 0) {
        EXPECT_LT(worst, last / 2.5) << D;
      }
      last = worst;
    }
    EXPECT_LT(last, 4e-4);
  }
}

TEST(PackedDiffusion, DerivativesAreThoseOfTheSamples) {
  SceneSpec<double> spec = base(0.02);
  spec.solid_fraction = Table<double>{{0, 0.45, 1}, {0.62, 0.4, 0.55}};
  const Scene<double> scene(spec);
  const Method method = crank_nicolson(60, 1e-6);
  const std::vector<Entry> all = entries(scene.spec());
  const std::vector<Place> places{{0.3, 0.2}, {0.3, 0.7}, {1, 0.45}};
  int n_checked = 0;
  for (std::size_t e = 0; e < all.size(); ++e) {
    if (!method.has_derivative(scene, all[e]) || all[e].range != Range::positive) continue;
    std::any memory;
    const Linearisation lines = method.linearise(scene, places, {e}, memory);
    ASSERT_TRUE(lines.summary.usable());
    const auto moved = [&](double by) {
      SceneSpec<double> other = spec;
      *entry_places(other)[e] *= 1 + by;
      std::any none;
      return method.linearise(Scene<double>(other), places, {}, none).samples;
    };
    const double number = *entry_places(spec)[e], h = 1e-4;
    const auto up = moved(h), down = moved(-h);
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_NEAR(lines.derivatives[i].M, (up[i].M - down[i].M) / (2 * h * number), 2e-5) << all[e].name();
    ++n_checked;
  }
  EXPECT_GE(n_checked, 4);  // two rates, the scale, D
  for (const Entry& entry : all)
    if (entry.field.starts_with("solid_fraction")) {
      EXPECT_FALSE(method.has_derivative(scene, entry));
    }
}

TEST(SolidHeights, GoThereAndBack) {
  for (int i = 0; i < 50; ++i) {
    support::SceneMaker maker(static_cast<unsigned>(i));
    const Scene<double> scene(support::solid_data(maker, support::Grains::small));
    const diffusion::SolidHeights solid(scene);
    for (int k = 0; k <= 200; ++k) {
      const double m = k / 200.0, z = solid.height(m);
      EXPECT_NEAR(solid.coordinate(z), m, 1e-14);
      EXPECT_NEAR(m, scene.solid(0, z) / scene.solid(0, 1), 1e-14);
    }
  }
}

}  // namespace
}  // namespace shearfront
