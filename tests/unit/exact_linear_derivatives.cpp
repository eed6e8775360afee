// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of tables: reference values of another program, and places where terms of them are infinite.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/table_scenes.hpp"

namespace shearfront {
namespace {

using support::four_pieces;
using support::one_piece;
using support::table_scene;

Entry entry_named(const SceneSpec<double>& spec, const std::string& name, std::size_t& place) {
  const auto all = entries(spec);
  for (place = 0; place < all.size(); ++place)
    if (all[place].name() == name) return all[place];
  ADD_FAILURE() << name;
  return all.front();
}

TEST(LinearPieceDerivatives, AreTheReferenceValues) {
  struct Case {
    SceneSpec<double> spec;
    double z, t;
    std::string name;
    double M, phi;
  };
  const double any = NAN;
  const std::vector<Case> cases{
      {one_piece(), 0.3, 0.5, "shear_rate.values[0]", 0.08480452094079, -0.02719386630407586},
      {one_piece(), 0.3, 0.5, "shear_rate.values[1]", 0.06693950434107, 0.09575314021191129},
      {one_piece(), 0.3, 0.5, "shear_rate.scale", 0.15621445696317, any},
      {one_piece(), 0.3, 0.5, "initial.breaks[0]", -0.50754114440425, any},
      {one_piece(), 0.3, 0.2, "shear_rate.values[0]", 0.02656887622377, any},
      {one_piece(), 0.3, 0.2, "shear_rate.values[1]", 0.01855700767669, any},
      {one_piece(), 0.3, 0.2, "initial.breaks[0]", -0.25927197782812, any},
      {four_pieces(), 0.5, 1, "shear_rate.values[1]", 0.01385237237874, any},
      {four_pieces(), 0.5, 1, "shear_rate.values[2]", 0.19459051048505, any},
      {four_pieces(), 0.5, 1, "shear_rate.z[1]", 0.06649138741794, any},
      {four_pieces(), 0.5, 1, "shear_rate.z[2]", 0.63969483042996, any},
      {four_pieces(), 0.62, 0.3, "shear_rate.values[1]", 0.00065290459569, -0.02606159554593217},
      {four_pieces(), 0.62, 0.3, "shear_rate.values[2]", 0.02968811254435, -0.2222625598100639},
      {four_pieces(), 0.62, 0.3, "shear_rate.values[3]", 0.00276355785326, 0.03923783235019867},
      {four_pieces(), 0.62, 0.3, "shear_rate.z[3]", -0.00552711570652, any},
      {four_pieces(), 0.35, 0.3, "shear_rate.values[0]", 0.00240407178249, any},
      {four_pieces(), 0.35, 0.3, "shear_rate.values[1]", 0.06125314903352, any},
      {four_pieces(), 0.35, 0.3, "shear_rate.z[1]", 0.10077092197638, any},
      {four_pieces(), 0.35, 0.3, "initial.breaks[0]", -0.25212548820721, any},
  };
  for (const Case& c : cases) {
    const ExactSolution<double> exact{Scene<double>(c.spec)};
    const auto at = Derivatives<double>(exact).at(c.z, c.t);
    std::size_t place = 0;
    entry_named(c.spec, c.name, place);
    EXPECT_NEAR(at.M[place], c.M, 1e-13) << c.name << " z " << c.z;
    if (!std::isnan(c.phi)) {
      EXPECT_NEAR(at.phi[place], c.phi, 1e-12) << c.name << " z " << c.z;
    }
  }
}

/// A jump inside a flat piece: at its own height the fan stands still.
TEST(LinearPieceDerivatives, AreFiniteAtASourceInAFlatPiece) {
  for (const auto& table :
       {Table<double>{{0, 0.3, 0.6, 1}, {2, 1, 1, 0.5}}, Table<double>{{0, 0.3, 0.6, 1}, {0.5, 1, 1, 2}}}) {
    const ExactSolution<double> exact{Scene<double>(table_scene(table, {0.5}, {0, 1}))};
    const auto at = Derivatives<double>(exact).at(0.5, 0.05);
    EXPECT_EQ(at.value.phi, 0.5);
    EXPECT_NEAR(at.value.M, 0.05 / 4, 1e-16);
    double sum = 0;
    for (const double by : at.M) {
      EXPECT_TRUE(std::isfinite(by));
      sum += by;
    }
    for (const double by : at.phi) EXPECT_TRUE(std::isfinite(by));
    EXPECT_TRUE(std::isfinite(sum));
  }
}

/// dT/dh is infinite where such a path starts.
TEST(LinearPieceDerivatives, AreThoseOfDifferencesWhereAStateOfOneHalfLeavesItsPiece) {
  SceneSpec<double> spec;
  spec.shear_rate = Table<double>{{0, 0.5, 1}, {1, 2, 2.2}};
  spec.initial_values = {0.5};
  const Scene<double> scene(spec);
  const ExactSolution<double> exact(scene);
  const std::vector<Entry> all = entries(spec);
  int n_checked = 0;
  for (const double z : {0.51, 0.52, 0.53})
    for (const double t : {0.2, 0.25, 0.3}) {
      const auto path = exact.path(z, t);
      if (path.kind != exact::PathKind::constant || !(path.foot < 0.5)) continue;
      const auto at = Derivatives<double>(exact).at(z, t);
      for (std::size_t e = 0; e < all.size(); ++e) {
        const bool is_end = all[e].field == "shear_rate.z" && all[e].index != 1;
        if (is_end || !derivative_refusal(scene, all[e]).empty()) continue;
        constexpr double kStep = 1e-6;
        double M[2], phi[2];
        for (const int side : {0, 1}) {
          SceneSpec<double> moved = spec;
          *entry_places(moved)[e] += side == 0 ? -kStep : kStep;
          const ExactSolution<double> other{Scene<double>(moved)};
          M[side] = other.M(z, t), phi[side] = other.phi(z, t);
        }
        EXPECT_NEAR(at.M[e], (M[1] - M[0]) / (2 * kStep), 1e-7) << all[e].name() << ' ' << z << ' ' << t;
        EXPECT_NEAR(at.phi[e], (phi[1] - phi[0]) / (2 * kStep), 1e-5)
            << all[e].name() << ' ' << z << ' ' << t;
        ++n_checked;
      }
    }
  EXPECT_GT(n_checked, 10);
}

}  // namespace
}  // namespace shearfront
