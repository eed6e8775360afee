// SPDX-License-Identifier: BSD-3-Clause
// Steady chutes: closed forms, a march in x and z, and the same by several methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront {
namespace {

/// s a = S / (3 c) with c = 0.6 in the source: 1/3 after division by c.
SceneSpec<double> source_chute(const Velocity<double>& u, std::vector<double> breaks,
                               std::vector<double> values) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.scale = 1.0 / 3;
  spec.velocity = u;
  spec.initial_breaks = std::move(breaks);
  spec.initial_values = std::move(values);
  return spec;
}
const UniformVelocity<double> kPlug{1};
const LinearVelocity<double> kShear{0, 2};

struct ReferenceRow {
  const char* name;
  SceneSpec<double> spec;
  double x_star, z_star;
};
std::vector<ReferenceRow> reference_rows() {
  return {{"plug flow, mixed", source_chute(kPlug, {}, {0.6}), 3, 0.6},
          {"shear, mixed", source_chute(kShear, {}, {0.6}), 3, std::sqrt(0.6)},
          {"plug flow, small above 0.4", source_chute(kPlug, {0.4}, {0, 1}), 5.939387691339814, 0.6},
          {"plug flow, small above 0.6", source_chute(kPlug, {0.6}, {0, 1}), 5.939387691339814, 0.4},
          {"shear, small above 0.4", source_chute(kShear, {0.4}, {0, 1}), 5.199636334, std::sqrt(0.84)},
          {"shear, small above 0.6", source_chute(kShear, {0.6}, {0, 1}), 5.88, 0.8}};
}

TEST(SteadyChute, HasTheEventDistancesOfTheSource) {
  for (const ReferenceRow& row : reference_rows()) {
    SCOPED_TRACE(row.name);
    const Timeline<double> times = event_times(Scene<double>(row.spec));
    ASSERT_TRUE(times.t_star);
    EXPECT_NEAR(*times.t_star, row.x_star, 5e-10);
    EXPECT_NEAR(times.steady_height, row.z_star, 1e-14);
  }
}

TEST(SteadyChute, HasTheClosedFormsToRounding) {
  for (const double slip : {0.0, 0.25, 1.0})
    for (const double z_r : {0.2, 0.5, 0.85})
      for (const double rate : {0.5, 2.0}) {
        SceneSpec<double> spec = source_chute(LinearVelocity<double>{slip, 1.5}, {z_r}, {0, 1});
        spec.scale = rate;
        const auto psi = [&](double z) { return slip * z + 0.75 * z * z; };
        const double split = std::sqrt(psi(z_r)) + std::sqrt(psi(1) - psi(z_r));
        const Timeline<double> unmixed = event_times(Scene<double>(spec));
        EXPECT_NEAR(*unmixed.t_star, split * split / rate, 1e-13 * split * split / rate);
        EXPECT_NEAR(*unmixed.t0, psi(z_r) / rate, 1e-14 * psi(1) / rate);
        EXPECT_NEAR(*unmixed.t1, (psi(1) - psi(z_r)) / rate, 1e-14 * psi(1) / rate);
        spec.initial_breaks = {}, spec.initial_values = {z_r};
        const Timeline<double> mixed = event_times(Scene<double>(spec));
        EXPECT_NEAR(*mixed.t_star, psi(1) / rate, 1e-13 * psi(1) / rate);
        EXPECT_NEAR(psi(mixed.steady_height), z_r * psi(1), 1e-13);
        EXPECT_NEAR(mixed.mass, z_r * psi(1), 1e-13);
      }
}

TEST(SteadyChute, FrontTrackingFindsTheSame) {
  for (const ReferenceRow& row : reference_rows()) {
    SCOPED_TRACE(row.name);
    Method method("front-tracking");
    method.set("resolution", 0.01);
    const Timeline<double> times = event_times(Scene<double>(row.spec), method);
    ASSERT_TRUE(times.t_star);
    EXPECT_NEAR(*times.t_star, row.x_star, 2e-4 * row.x_star);
    EXPECT_NEAR(times.steady_height, row.z_star, 1e-12);
  }
}

/// By another road: Godunov's scheme for u phi that marches in x on cells of z, phi_j u_j += dx / dz (F_j - F_{j+1}).
std::vector<double> marched_in_x(const Scene<double>& scene, double x_end, std::size_t n) {
  const double dz = 1.0 / static_cast<double>(n);
  std::vector<double> passing(n), u(n), phi(n), face(n + 1);
  for (std::size_t j = 0; j < n; ++j) {
    const double z = static_cast<double>(j) * dz;
    u[j] = scene.flow(z, z + dz) / dz;
    passing[j] = scene.initial_amount(z, z + dz) / dz;  // which is of what passes
  }
  const double slowest = *std::min_element(u.begin(), u.end());
  double fastest = 0;
  for (std::size_t i = 1; i < n; ++i)
    fastest = std::max(fastest, scene.scale() * scene.rate_at(static_cast<double>(i) * dz));
  const double n_steps = std::ceil(x_end * fastest / (0.5 * slowest * dz)), dx = x_end / n_steps;
  const auto f = [](double x) { return x * (x - 1); };
  for (double k = 0; k < n_steps; ++k) {
    for (std::size_t j = 0; j < n; ++j) phi[j] = passing[j] / u[j];
    for (std::size_t i = 1; i < n; ++i)
      face[i] = scene.scale() * scene.rate_at(static_cast<double>(i) * dz) *
                std::max(f(std::max(phi[i - 1], 0.5)), f(std::min(phi[i], 0.5)));
    for (std::size_t j = 0; j < n; ++j) passing[j] += dx / dz * (face[j] - face[j + 1]);
  }
  std::vector<double> M{0};
  for (std::size_t j = 0; j < n; ++j) M.push_back(M.back() + passing[j] * dz);
  return M;
}

double distance_of_M(const Scene<double>& scene, const Method& method, double x, std::size_t n) {
  SolverRequest request;
  request.times = {x};
  for (std::size_t i = 0; i <= n; ++i)
    request.heights.push_back(static_cast<double>(i) / static_cast<double>(n));
  const SolverResult result = solve(scene, method, request);
  EXPECT_TRUE(result.summary.usable()) << result.summary.message;
  const std::vector<double> M = marched_in_x(scene, x, n);
  double worst = 0;
  for (std::size_t i = 0; i <= n && result.summary.usable(); ++i)
    worst = std::max(worst, std::abs(result.M(0, i) - M[i]));
  return worst;
}

TEST(SteadyChute, IsWhatAMarchInXAndZFinds) {
  for (const Velocity<double>& u :
       {Velocity<double>(kShear), Velocity<double>(TableVelocity<double>{{0, 0.5, 1}, {0.2, 0.4, 1.5}}),
        Velocity<double>(LinearVelocity<double>{1.2, -1})})
    for (const DepthFunction<double>& a :
         {DepthFunction<double>(Piecewise<double>{{0.3}, {1, 2}}),
          DepthFunction<double>(Exponential<double>{2, 0.5}),
          DepthFunction<double>(Table<double>{{0, 0.6, 1}, {0.5, 1, 0.75}})}) {
      SceneSpec<double> spec = source_chute(u, {0.5}, {0.1, 0.9});
      spec.shear_rate = a;
      const Scene<double> scene(spec);
      const double coarse = distance_of_M(scene, "exact", 0.5, 50),
                   fine = distance_of_M(scene, "exact", 0.5, 200);
      EXPECT_LT(fine, 4e-3);
      EXPECT_LT(fine, 0.55 * coarse);
    }
}

TEST(SteadyChute, ScalesWithAUniformVelocity) {
  SceneSpec<double> spec = source_chute(UniformVelocity<double>{2.5}, {0.4}, {0.2, 0.8});
  spec.shear_rate = Exponential<double>{2, 0.5};
  const Scene<double> chute(spec);
  spec.velocity.reset();
  const Scene<double> bed(spec);
  const std::vector<double> heights{0, 0.1, 0.35, 0.6, 0.9, 1};
  const SolverResult along = solve(chute, "exact", {.times = {2, 5}, .heights = heights});
  const SolverResult in_time = solve(bed, "exact", {.times = {2 / 2.5, 5 / 2.5}, .heights = heights});
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < heights.size(); ++j) {
      EXPECT_NEAR(along.phi(i, j), in_time.phi(i, j), 1e-13);
      EXPECT_NEAR(along.M(i, j), 2.5 * in_time.M(i, j), 1e-13);
    }
}

TEST(SlowSteadyChute, PureGrainsAreCarriedByTheRatioOfBothVelocities) {
  // dz/dx = s a / u: the first small grains are at the bottom after int u / (s a) dz.
  for (const DepthFunction<double>& a : {DepthFunction<double>(Exponential<double>{2, 0.5}),
                                         DepthFunction<double>(Chute<double>{1, 0.3, 0.5})}) {
    BagnoldVelocity<double> u = BagnoldVelocity<double>::samples().front();
    SceneSpec<double> spec = source_chute(u, {0.6}, {0, 1});
    spec.shear_rate = a;
    const Scene<double> scene(spec);
    const auto distance = [&](double lo, double hi) {
      return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
          [&](double z) { return u.value(z) / (scene.scale() * scene.rate_at(z)); }, lo, hi, 15, 1e-12);
    };
    const Timeline<double> times = event_times(scene);
    // a stands as a table: off by 1.2e-6 a'', here a'' = a / decay^2 with a decay of at least 0.3.
    const double most = 1.2e-6 / (0.3 * 0.3);
    EXPECT_NEAR(*times.t0 / distance(0, 0.6), 1, most);
    EXPECT_NEAR(*times.t1 / distance(0.6, 1), 1, most);
  }
}

TEST(SteadyChute, KeepsWhatPasses) {
  SceneSpec<double> spec = source_chute(kShear, {0.3}, {0.2, 0.7});
  spec.solid_fraction = Piecewise<double>{{0.5}, {0.6, 0.5}};
  const Scene<double> scene(spec);
  for (const char* name : {"exact", "front-tracking", "engquist-osher", "godunov"}) {
    SCOPED_TRACE(name);
    const SolverResult result = solve(scene, name, {.times = {0, 0.7, 2}, .heights = {1}});
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    // psi = z^2: what passes is 0.6 * 0.2 * 0.09 + 0.6 * 0.7 * (0.25 - 0.09) + 0.5 * 0.7 * 0.75.
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(result.M(i, 0), 0.0108 + 0.0672 + 0.2625, 1e-12);
  }
}

TEST(SteadyChute, WithDiffusionRestsAtALogisticProfileInZ) {
  // s a f = D phi_z at rest, whatever u: phi / (1 - phi) = C exp(-s a z / D), with what passes for C.
  SceneSpec<double> spec = source_chute(kShear, {}, {0.5});
  spec.scale = 1;
  spec.diffusion = Diffusion<double>{};
  spec.diffusion->D = 0.05;
  const Scene<double> scene(spec);
  const auto phi_at = [](double z, double z0) { return 1 / (1 + std::exp((z - z0) / 0.05)); };
  const auto passing = [&](double z0) {
    return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        [&](double z) { return 2 * z * phi_at(z, z0); }, 0.0, 1.0, 15, 1e-12);
  };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (passing((low + high) / 2) < 0.5 ? low : high) = (low + high) / 2;
  double last = 0;
  for (const double cells : {200.0, 400.0}) {
    Method method("crank-nicolson");
    method.set("cells", static_cast<std::uint64_t>(cells));
    const std::vector<double> heights{0.3, 0.5, 0.65, 0.7, 0.75, 0.9};
    const SolverResult result = solve(scene, method, {.times = {infinity<double>()}, .heights = heights});
    ASSERT_TRUE(result.summary.usable()) << result.summary.message;
    double worst = 0;
    for (std::size_t j = 0; j < heights.size(); ++j)
      worst = std::max(worst, std::abs(result.phi(0, j) - phi_at(heights[j], low)));
    EXPECT_LT(worst, 2e-3);
    if (last > 0) {
      EXPECT_LT(worst, 0.35 * last);  // second order
    }
    last = worst;
  }
}

TEST(SteadyChute, FrontsLieOnTheCurvesOfTheirStates) {
  // Mixed inflow, u = 2 z: the shocks from both walls are straight in psi = z^2.
  const Scene<double> scene(source_chute(kShear, {}, {0.6}));
  SolverRequest request;
  request.times = {3};
  request.fronts = true;
  const SolverResult result = solve(scene, "front-tracking", request);
  ASSERT_GT(result.fronts.size(), 10u);
  for (const auto& front : result.fronts) {
    const double up = 0.2 * front.t_end, down = 1 - 0.4 * front.t_end / 3;  // psi of both
    const double psi = front.z_end * front.z_end;
    EXPECT_TRUE(std::abs(psi - up) < 1e-12 || std::abs(psi - down) < 1e-12)
        << front.t_end << " " << front.z_end;
  }
}

}  // namespace
}  // namespace shearfront
