// SPDX-License-Identifier: BSD-3-Clause
// Fluxes between a layer L below and a layer R above: the ten cases of Table 4.1 of the thesis named in
// docs/evidence/packing.md, and what a fine run makes of them.
#include "shearfront/fv/face_flux.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/fv/march.hpp"
#include "shearfront/model/flux/all.hpp"
#include "support/random_scene.hpp"
#include "support/thesis_cases.hpp"

namespace shearfront {
namespace {

using fv::Rule;

using support::kTenCases;
using support::ThesisCase;

double flux(Rule rule, double phi_l, double c_l, double phi_r, double c_r) {
  const fv::FluxShape f(Quadratic<double>{});
  return fv::face_flux(rule, {&f, c_l, c_l, phi_l / c_l}, {&f, c_r, c_r, phi_r / c_r}, c_l);
}

TEST(FaceFlux, TenCasesOfTheThesis) {
  for (const ThesisCase& c : kTenCases)
    EXPECT_NEAR(flux(Rule::godunov, c.phi_l, c.c_l, c.phi_r, c.c_r), c.expected, 1e-16) << c.name;
}

// It takes the flux of L or R where the other side cannot carry it: cases 3 and 10, and minima of either
// side.
TEST(FaceFlux, ClassicalFluxIsNotMatchedInCases3And10) {
  for (const ThesisCase& c : kTenCases) {
    const double classical = flux(Rule::classical_godunov, c.phi_l, c.c_l, c.phi_r, c.c_r);
    const std::string number(c.name, std::string(c.name).find(':'));
    if (number == "3") {
      EXPECT_NEAR(classical, support::small_grains_flux(c.phi_r, c.c_r), 1e-16);
    }
    if (number == "10") {  // phi falls: the larger one of both own fluxes, not what both can carry
      EXPECT_NEAR(classical, support::small_grains_flux(c.phi_r, c.c_r), 1e-16);
      EXPECT_NE(classical, c.expected);
    }
    if (number == "1" || number == "2" || number == "7" || number == "8") {
      EXPECT_NEAR(classical, c.expected, 1e-16) << c.name;
    }
  }
}

TEST(FaceFlux, ClassicalIsGodunovBetweenEqualCells) {
  for (int l = 0; l <= 20; ++l)
    for (int r = 0; r <= 20; ++r) {
      const double phi_l = 0.03 * l, phi_r = 0.03 * r;
      EXPECT_EQ(flux(Rule::classical_godunov, phi_l, 0.6, phi_r, 0.6),
                flux(Rule::godunov, phi_l, 0.6, phi_r, 0.6));
    }
}

// A Riemann problem is self-similar: what flows through the interface of a fine run for long is its flux.
TEST(FaceFlux, GodunovFluxIsTheFluxOfAFineRun) {
  support::SceneMaker maker(support::seed_of(13000));
  const std::vector<Flux<double>> minima{Quadratic<double>{}, Cubic<double>{}, RichardsonZaki<double>{}};
  const std::vector<Flux<double>> maxima{Lwr<double>{}, Triangular<double>{0.3, 1.0}, Lwr<double>{}};
  for (int number = 0; number < 200; ++number) {
    SCOPED_TRACE("problem " + std::to_string(number));
    const auto& kind = number % 2 == 0 ? minima : maxima;
    SceneSpec<double> spec;
    spec.fluxes = {kind[std::size_t(maker.integer(0, 2))], kind[std::size_t(maker.integer(0, 2))]};
    spec.flux_breaks = spec.initial_breaks = {0.5};
    spec.shear_rate = Piecewise<double>{{0.5}, {maker.uniform(0.3, 2), maker.uniform(0.3, 2)}};
    spec.solid_fraction = Piecewise<double>{{0.5}, {maker.uniform(0.2, 0.7), maker.uniform(0.2, 0.7)}};
    spec.initial_values = {maker.uniform(0, 1), maker.uniform(0, 1)};
    spec.outside_bottom = OutsideState<double>{{}, {spec.initial_values[0]}};
    spec.outside_top = OutsideState<double>{{}, {spec.initial_values[1]}};
    const Scene<double> scene(spec);
    const fv::Grid grid = fv::equal_cells(scene, 200);
    fv::March march({}, scene, grid);
    march.set_outside({spec.initial_values[0], spec.initial_values[1]});
    const std::vector<double> k = fv::cell_rates(scene, grid), capacity = fv::capacities(scene, grid);
    const auto above = [&] {
      const std::vector<double> x = march.shares().x;
      double sum = 0;
      for (std::size_t j = 100; j < 200; ++j) sum += capacity[j] * x[j];
      return sum;
    };
    // Nothing reaches the ends within 90 steps; there the flux is that of the initial state.
    const fv::FluxShape f_l(spec.fluxes[0]), f_r(spec.fluxes[1]);
    const double out = k[199] * f_r.value(spec.initial_values[1]);
    const double expected = fv::face_flux(Rule::godunov, {&f_l, k[99], 1, spec.initial_values[0]},
                                          {&f_r, k[100], 1, spec.initial_values[1]}, 1);
    for (int i = 0; i < 30; ++i) march.step(march.largest_step());
    const double before = above();
    for (int i = 0; i < 60; ++i) march.step(march.largest_step());
    EXPECT_NEAR((above() - before) / (60 * march.largest_step()) + out, expected, 1e-3 * (k[99] + k[100]));
  }
}

}  // namespace
}  // namespace shearfront
