// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <utility>

#include "shearfront/diffusion/problem.hpp"
#include "support/any_flux.hpp"
#include "support/random_scene.hpp"

/// Random problems with diffusion: any flux with f = 0 at both ends of its range, r with jumps of size and
/// sign, D over decades and 0 on some faces, rough initial states.
namespace shearfront::diffusion::support {

inline std::pair<double, double> range_of(const Problem& p) {
  const auto [lowest, highest] = p.flux.range();
  return {lowest, highest};
}

inline Problem random_problem(shearfront::support::SceneMaker& maker, Ends ends, bool constant_rate = false) {
  static const auto fluxes = shearfront::support::unimodal_fluxes();
  Problem p;
  p.flux = fluxes[static_cast<std::size_t>(maker.integer(0, static_cast<int>(fluxes.size()) - 1))];
  p.ends = ends;
  p.n_cells = static_cast<std::size_t>(maker.integer(2, 60));
  const double largest_d = std::pow(10, maker.uniform(-6, 0));
  double rate = maker.uniform(-2, 2);
  for (std::size_t i = 0; i <= p.n_cells; ++i) {
    if (!constant_rate && maker.integer(0, 9) == 0) rate = maker.uniform(-2, 2);
    p.rate.push_back(constant_rate ? rate : rate + maker.uniform(-0.1, 0.1));
    p.diffusivity.push_back(maker.integer(0, 4) == 0 ? 0 : largest_d * maker.uniform(0, 1));
  }
  if (ends == Ends::periodic) {
    p.rate.back() = p.rate.front();
    p.diffusivity.back() = p.diffusivity.front();
  }
  const auto [lowest, highest] = range_of(p);
  for (std::size_t i = 0; i < p.n_cells; ++i) {
    const double share = maker.integer(0, 2) == 0 ? maker.integer(0, 1) : maker.uniform(0, 1);
    p.initial.push_back(share == 1 ? highest : lowest + (highest - lowest) * share);
  }
  return p;
}

}  // namespace shearfront::diffusion::support
