// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/grid_transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shearfront/diffusion/cell_rise.hpp"
#include "shearfront/diffusion/refined_cells.hpp"
#include "support/random_scene.hpp"

namespace shearfront::diffusion {
namespace {

using support::SceneMaker;
using support::seed_of;

/// A bed [-1, 2] after some rounds of random splits and merges.
Problem random_grid(SceneMaker& maker, RefinedCells& cells) {
  for (int round = 0; round < 4; ++round) {
    std::vector<double> wanted(cells.size());
    for (double& width : wanted) width = std::pow(2, maker.uniform(-7, 1));
    cells.apply(cells.changes_towards(wanted));
  }
  Problem p;
  p.bottom = -1;
  p.top = 2;
  p.faces = cells.faces();
  p.n_cells = cells.size();
  return p;
}

/// Mean of c0 + c1 z + c2 z^2 over [a, b].
double mean(const std::array<double, 3>& c, double a, double b) {
  const double m = 0.5 * (a + b), h = b - a;
  return c[0] + c[1] * m + c[2] * (m * m + h * h / 12);
}

TEST(RefinedCells, AreTheSameAgainAfterSplittingAndMerging) {
  SceneMaker maker(seed_of(1));
  RefinedCells cells(-1, 2, 7);
  const std::vector<double> before = cells.faces();
  for (int i = 0; i < 8; ++i) cells.apply(cells.changes_towards(std::vector<double>(cells.size(), 0.001)));
  EXPECT_EQ(cells.size(), 7u << 8);
  for (int i = 0; i < 8; ++i) cells.apply(cells.changes_towards(std::vector<double>(cells.size(), 10.0)));
  EXPECT_EQ(cells.faces(), before);
}

TEST(RefinedCells, FacesDoNotDependOnTheWay) {
  SceneMaker maker(seed_of(2));
  RefinedCells fine(-1, 2, 5);
  for (int i = 0; i < 12; ++i) fine.apply(std::vector<CellChange>(fine.size(), CellChange::split));
  const std::vector<double> all = fine.faces();
  for (int i = 0; i < 50; ++i) {
    RefinedCells cells(-1, 2, 5);
    for (const double z : random_grid(maker, cells).faces)
      EXPECT_TRUE(std::binary_search(all.begin(), all.end(), z));
  }
}

TEST(RefinedCells, SplitNoMoreThanThirtyTimes) {
  RefinedCells cells(0, 1, 2);
  for (int i = 0; i < 40; ++i) {
    std::vector<double> wanted(cells.size(), 10.0);
    wanted[0] = 1e-300;
    cells.apply(cells.changes_towards(wanted));
  }
  EXPECT_EQ(cells.faces()[1], std::ldexp(0.5, -RefinedCells::kMostHalvings));
}

TEST(GridTransfer, ParabolasAndCubicsStayWhatTheyAre) {
  for (std::uint64_t number = 0; number < 200; ++number) {
    SceneMaker maker(seed_of(30 + number));
    RefinedCells cells(-1, 2, 6);
    const Problem before = random_grid(maker, cells);
    const std::array<double, 3> c{0.5, maker.uniform(-0.1, 0.1), maker.uniform(-0.05, 0.05)};
    const auto cubic = [&](double z) { return c[0] - z * (c[1] + z * (c[2] + 0.7 * z)); };
    std::vector<double> means, fluxes, wanted;
    for (std::size_t j = 0; j < before.n_cells; ++j) {
      means.push_back(mean(c, before.face(j), before.face(j + 1)));
      wanted.push_back(std::pow(2, maker.uniform(-7, 1)));
    }
    for (const double z : before.faces) fluxes.push_back(cubic(z));
    const std::vector<CellChange> changes = cells.changes_towards(wanted);
    cells.apply(changes);
    const std::vector<double> faces = cells.faces();
    const std::vector<double> moved = transfer_means(before, means, changes);
    const std::vector<double> moved_fluxes = transfer_fluxes(before, fluxes, changes);
    ASSERT_EQ(moved.size(), cells.size());
    ASSERT_EQ(moved_fluxes.size(), faces.size());
    for (std::size_t j = 0; j < moved.size(); ++j)
      EXPECT_NEAR(moved[j], mean(c, faces[j], faces[j + 1]), 1e-13) << "seed " << seed_of(30 + number);
    for (std::size_t i = 0; i < faces.size(); ++i)
      EXPECT_NEAR(moved_fluxes[i], cubic(faces[i]), 1e-11) << "seed " << seed_of(30 + number);
  }
}

TEST(GridTransfer, RoughStatesKeepTheirMassAndRange) {
  for (std::uint64_t number = 0; number < 200; ++number) {
    SceneMaker maker(seed_of(300 + number));
    RefinedCells cells(-1, 2, 6);
    const Problem before = random_grid(maker, cells);
    std::vector<double> means, wanted;
    double mass = 0, moved_mass = 0;
    for (std::size_t j = 0; j < before.n_cells; ++j) {
      means.push_back(maker.integer(0, 2) == 0 ? maker.integer(0, 1) : maker.uniform(0, 1));
      wanted.push_back(std::pow(2, maker.uniform(-7, 1)));
      mass += means[j] * before.width(j);
    }
    const std::vector<CellChange> changes = cells.changes_towards(wanted);
    cells.apply(changes);
    const std::vector<double> faces = cells.faces(), moved = transfer_means(before, means, changes);
    for (std::size_t j = 0; j < moved.size(); ++j) {
      EXPECT_TRUE(moved[j] >= 0 && moved[j] <= 1) << moved[j] << ", seed " << seed_of(300 + number);
      moved_mass += moved[j] * (faces[j + 1] - faces[j]);
    }
    EXPECT_NEAR(moved_mass, mass, 1e-14) << "seed " << seed_of(300 + number);
  }
}

TEST(CellRise, EqualCellsGivenByTheirFacesRiseAlike) {
  SceneMaker maker(seed_of(5));
  Problem equal;
  equal.n_cells = 8;
  Problem given = equal;
  for (std::size_t i = 0; i <= 8; ++i) given.faces.push_back(equal.face(i));
  std::vector<double> means;
  for (int j = 0; j < 8; ++j) means.push_back(maker.uniform(0, 1));
  for (const Ends ends : {Ends::no_flux, Ends::periodic}) {
    equal.ends = given.ends = ends;
    for (std::size_t j = 0; j < 8; ++j)
      EXPECT_NEAR(half_rise(given, means, j), half_rise(equal, means, j), 1e-15) << j;
  }
}

}  // namespace
}  // namespace shearfront::diffusion
