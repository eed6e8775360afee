// SPDX-License-Identifier: BSD-3-Clause
// The exact derivatives against central differences of the exact solution in 50 digits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/checked.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

using support::SceneMaker;
using Spec = SceneSpec<Real110>;

struct PhiM {
  Real110 phi, M;
};

PhiM solve(Spec spec, std::size_t entry, const Real110& step, std::size_t layers, const Real110& z,
           const Real110& t) {
  *entry_places(spec)[entry] += step;
  const auto value = ExactSolution<Real110>(Scene<Real110>(spec), {layers}).at(z, t);
  return {value.phi, value.M};
}

/// Second-order difference quotient, one-sided where a state would leave [0, 1].
PhiM difference(const Spec& spec, std::size_t entry, bool is_state, std::size_t layers, const Real110& z,
                const Real110& t) {
  const Real110 h("1e-17");
  Spec copy = spec;
  const Real110 here = *entry_places(copy)[entry];
  const auto at = [&](int steps) { return solve(spec, entry, h * steps, layers, z, t); };
  if (is_state && (here == 0 || here == 1)) {
    const int sign = here == 0 ? 1 : -1;
    const PhiM a = at(0), b = at(sign), c = at(2 * sign);
    const Real110 H = 2 * h * sign;
    return {(4 * b.phi - 3 * a.phi - c.phi) / H, (4 * b.M - 3 * a.M - c.M) / H};
  }
  const PhiM lo = at(-1), hi = at(1);
  return {(hi.phi - lo.phi) / (2 * h), (hi.M - lo.M) / (2 * h)};
}

void expect_derivatives(const SceneSpec<double>& in_double, const Real110& z, const Real110& t,
                        const std::string& label, std::size_t layers = 0) {
  const Scene<Real110> scene = scene_cast<Real110>(Scene<double>(in_double));
  const Spec& spec = scene.spec();
  const ExactSolution<Real110> solution(scene, {layers});
  const auto exact = Derivatives<Real110>(solution).at(z, t);
  const auto path = solution.path(z, t);
  EXPECT_EQ(exact.value.M, solution.M(z, t));
  Spec copy = spec;
  const std::vector<Entry> all = entries(spec);
  support::Checked checked({"shear rate", "initial state"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Entry& parameter = all[i];
    if (!derivative_refusal(scene, parameter).empty()) continue;
    // The ends of a table may not leave the ends of the bed.
    if (parameter.field == "shear_rate.z" && (parameter.index == 0 || !(*entry_places(copy)[i] < spec.top)))
      continue;
    const PhiM numeric = difference(spec, i, parameter.field == "initial.values", layers, z, t);
    const Real110 &dM = exact.M[i], &dphi = exact.phi[i];
    const double size_M = 1 + std::abs(to_double(dM)), size_phi = 1 + std::abs(to_double(dphi));
    EXPECT_LT(abs(to_double(Real110(dM - numeric.M))), 1e-20 * size_M)
        << label << " dM/d " << parameter.name() << " kind " << int(path.kind) << " z " << z << " t " << t
        << " exact " << dM << " numeric " << numeric.M;
    // Far from its mean phi may bend sharply: the difference quotient is worth h^2 phi'''.
    EXPECT_LT(abs(to_double(Real110(dphi - numeric.phi))), 1e-20 * size_phi * size_phi * size_phi)
        << label << " dphi/d " << parameter.name() << " kind " << int(path.kind) << " z " << z << " t " << t
        << " exact " << dphi << " numeric " << numeric.phi;
    checked.count(parameter.field.starts_with("shear_rate.") ? "shear rate" : "initial state");
  }
}

void check_random_scenes(std::uint64_t first, std::uint64_t count) {
  for (std::uint64_t n = first; n < first + count; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    const int layers = make.integer(1, 6);
    const auto spec = n % 2 == 0 ? make.step(layers, make.order()) : make.data(layers, make.order(), 5);
    for (int k = 0; k < 3; ++k) {
      const Real110 z(make.uniform(0, 1)), t(std::exp(make.uniform(std::log(0.02), std::log(4.0))));
      expect_derivatives(spec, z, t, "seed " + std::to_string(seed));
    }
  }
}

TEST(ExactDerivatives, LayeredScenesAgreeWithDifferences) { check_random_scenes(1, 12); }
TEST(SlowExactDerivatives, ManyLayeredScenesAgreeWithDifferences) { check_random_scenes(100, 500); }

void check_exponential_scenes(std::uint64_t most) {
  for (std::uint64_t n = 1; n <= most; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    auto spec = n % 2 == 0 ? make.step(1, make.order()) : make.data(1, make.order(), 5);
    spec.shear_rate = Exponential<double>{make.uniform(0.5, 4), make.uniform(0.1, 2)};
    spec.scale = make.uniform(0.5, 2);
    for (int k = 0; k < 3; ++k) {
      const Real110 z(make.uniform(0, 1)), t(std::exp(make.uniform(std::log(0.02), std::log(4.0))));
      expect_derivatives(spec, z, t, "seed " + std::to_string(seed));
    }
  }
}
TEST(ExactDerivatives, ExponentialScenesAgreeWithDifferences) { check_exponential_scenes(6); }
TEST(SlowExactDerivatives, ManyExponentialScenesAgreeWithDifferences) { check_exponential_scenes(25); }

/// Several exponential pieces: a cut where the temperature jumps, the centre of a chute, which moves, both.
void check_exponential_pieces(std::uint64_t most) {
  for (std::uint64_t n = 1; n <= most; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    auto spec = n % 2 == 0 ? make.step(1, make.order()) : make.data(1, make.order(), 5);
    if (n % 3 == 0)
      spec.shear_rate = Exponential<double>{make.uniform(0.5, 4), make.uniform(0.2, 2)};
    else
      spec.shear_rate = Chute<double>{make.uniform(0.5, 2), make.uniform(0.2, 2), make.uniform(0.1, 0.9)};
    if (n % 3 != 1) spec.temperature = Piecewise<double>{{make.uniform(0.1, 0.9)}, {1, make.uniform(0.5, 2)}};
    spec.scale = make.uniform(0.5, 2);
    for (int k = 0; k < 4; ++k) {
      const Real110 z(make.uniform(0, 1)), t(std::exp(make.uniform(std::log(0.02), std::log(4.0))));
      expect_derivatives(spec, z, t, "seed " + std::to_string(seed));
    }
  }
}
TEST(ExactDerivatives, ExponentialPiecesAgreeWithDifferences) { check_exponential_pieces(6); }
TEST(SlowExactDerivatives, ManyExponentialPiecesAgreeWithDifferences) { check_exponential_pieces(18); }

TEST(ExactDerivatives, TableScenesAgreeWithDifferences) {
  for (std::uint64_t n = 1; n <= 4; ++n) {
    const std::uint64_t seed = support::seed_of(n);
    SceneMaker make(seed);
    auto spec = make.step(1, make.order());
    spec.shear_rate = Table<double>{{0, 0.3, 0.6, 1},
                                    {make.uniform(0.5, 3), make.uniform(0.5, 3), make.uniform(0.5, 3), 0.4}};
    const Real110 z(make.uniform(0, 1)), t(make.uniform(0.1, 1));
    expect_derivatives(spec, z, t, "seed " + std::to_string(seed), 16);
  }
}

// The speed of the path at its start and the slope of the flux there are both next to 0: by two roundings d phi / d(state) was off by a
// factor (0.0052 for 0.0076). In doubles half of the digits are left.
TEST(ExactDerivatives, OfStatesAtThePeakHoldInDoubles) {
  SceneMaker make(support::seed_of(9200));
  int n_compared = 0;
  for (int n = 0; n < 3000 && n_compared < 120; ++n) {
    SceneSpec<double> spec;
    Table<double> rate;
    const int n_knots = make.integer(3, 7);
    for (int i = 0; i < n_knots; ++i) {
      rate.z.push_back(static_cast<double>(i) / (n_knots - 1));
      rate.values.push_back(std::exp(make.uniform(-1, 1)));
    }
    spec.shear_rate = rate;
    spec.initial_breaks = {make.uniform(0.1, 0.4), make.uniform(0.5, 0.9)};
    spec.initial_values = {make.uniform(0, 1), 0.5, make.uniform(0, 1)};
    const double z = make.uniform(0.05, 0.95), t = std::exp(make.uniform(-2, 0.5));
    const ExactSolution<double> solution{Scene<double>(spec)};
    const auto path = solution.path(z, t);
    if (path.kind != exact::PathKind::constant || solution.medium().cells().phi[path.source] != 0.5) continue;
    const std::vector<Entry> all = entries(spec);
    std::size_t state = 0;
    while (all[state].name() != "initial.values[1]") ++state;
    const Spec precise = scene_cast<Real110>(Scene<double>(spec)).spec();
    const double by = to_double(difference(precise, state, true, 0, Real110(z), Real110(t)).phi);
    EXPECT_NEAR(Derivatives<double>(solution).at(z, t).phi[state], by, 1e-6 * (1 + std::abs(by)))
        << "bed " << n;
    ++n_compared;
  }
  EXPECT_EQ(n_compared, 120);
}

TEST(ExactDerivatives, WallsAndTheSteadyStateDependOnlyOnTheMass) {
  SceneMaker make(support::seed_of(3));
  const auto spec = make.step(3, SceneMaker::Order::falling);
  const ExactSolution<double> solution{Scene<double>(spec)};
  const Derivatives<double> derivatives(solution);
  const auto all = entries(spec);
  const auto place = [&](const std::string& name) {
    std::size_t i = 0;
    while (all[i].name() != name) ++i;
    return i;
  };
  const std::size_t jump = place("initial.breaks[0]"), scale = place("shear_rate.scale");
  const auto above = derivatives.at(0.95, infinity<double>());
  EXPECT_EQ(above.M[jump], -1.0);
  EXPECT_EQ(above.M[scale], 0.0);
  EXPECT_EQ(derivatives.at(0.01, infinity<double>()).M[jump], 0.0);
  const auto start = derivatives.at(0.95, 0.0);
  EXPECT_EQ(start.M[jump], -1.0);
  EXPECT_EQ(start.phi[place("initial.values[1]")], 1.0);
}

}  // namespace
}  // namespace shearfront
