// SPDX-License-Identifier: BSD-3-Clause
// The density of a posterior and its gradient (in double) against the whole of it in 110 digits: coordinates by their
// formulas, the determinant of their differences, the exact solution, residuals, priors; and differences of that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/posterior.hpp"
#include "support/fit_scenes.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"
#include "support/unbounded_map.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using support::SceneMaker;
using Digits = std::vector<Real110>;

/// Where the differences are taken: of coordinates, then of the density.
const char* const kFineStep = "1e-45";
const char* const kCoarseStep = "1e-25";

class PosteriorInDigits {
 public:
  PosteriorInDigits(const FitSpec& spec, const Posterior& posterior)
      : spec_(spec), posterior_(posterior), map_(map_of(spec, posterior)) {}

  [[nodiscard]] Real110 log_density(const Digits& x) const {
    const Digits p = map_.values(x);
    Real110 sum = log_likelihood(p) + map_.log_volume(x, Real110(kFineStep));
    for (std::size_t i = 0; i < p.size(); ++i) sum += log_prior(posterior_.priors()[i], p[i]);
    return sum;
  }

 private:
  static support::UnboundedMap<Real110> map_of(const FitSpec& spec, const Posterior& posterior) {
    const Parameters parameters(spec.scene, spec.unknown);
    std::vector<Entry> entries;
    for (const Parameter& p : parameters) entries.push_back(p.entry);
    const VectorXd &low = posterior.lower(), &high = posterior.upper();
    return {entries, {low.begin(), low.end()}, {high.begin(), high.end()}, spec.unknown.shape};
  }

  static Real110 log_prior(const Prior& prior, const Real110& p) {
    const Real110 a = prior.first, b = prior.second;
    switch (prior.kind) {
      case PriorKind::normal:
        return -(p - a) * (p - a) / (2 * b * b);
      case PriorKind::lognormal:
        return -(log(p) - log(a)) * (log(p) - log(a)) / (2 * b * b) - log(p);
      case PriorKind::half_normal:
        return -p * p / (2 * a * a);
      case PriorKind::uniform:
        break;
    }
    return 0;
  }

  [[nodiscard]] Real110 log_likelihood(const Digits& p) const {
    SceneSpec<Real110> moved = scene_cast<Real110>(spec_.scene).spec();
    const auto places = entry_places(moved);
    const auto all = entries(moved);
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t k = 0; k < all.size(); ++k)
        if (all[k].name() == posterior_.names()[i]) *places[k] = p[i];
    const ExactSolution<Real110> solution{Scene<Real110>(moved)};
    const auto& rows = spec_.observations.rows;
    Real110 squares = 0;
    for (const Observation& o : rows) {
      const Real110 z = o.z, half = Real110(o.width) / 2, t = o.t;
      const Real110 seen = o.width > 0
                               ? (solution.at(z + half, t).M - solution.at(z - half, t).M) / (2 * half)
                               : solution.at(z, t).M;
      Real110 r = seen - o.value;
      if (o.sigma > 0) r /= o.sigma;
      squares += r * r;
    }
    const bool has_sigma = rows.front().sigma > 0;
    return has_sigma ? Real110(-squares / 2) : Real110(-static_cast<double>(rows.size()) / 2 * log(squares));
  }

  const FitSpec& spec_;
  const Posterior& posterior_;
  support::UnboundedMap<Real110> map_;
};

struct Tally {
  int compared = 0;
  std::map<std::string, int> of_priors, of_shapes, of_bounds;
};

Prior random_prior(const std::string& name, double start, bool is_rate, SceneMaker& make) {
  switch (make.integer(0, is_rate ? 3 : 1)) {
    case 0:
      return {name, PriorKind::uniform, start - make.uniform(0.01, 0.1) * start,
              start + make.uniform(0.01, 0.1)};
    case 1:
      return {name, PriorKind::normal, start + make.uniform(-0.05, 0.05), make.uniform(0.05, 0.5)};
    case 2:
      return {name, PriorKind::lognormal, start * make.uniform(0.8, 1.2), make.uniform(0.1, 1)};
    default:
      return {name, PriorKind::half_normal, start * make.uniform(0.5, 3)};
  }
}

/// Layers with a start of one or two jumps, some of their numbers unknown, with noise; bounds, shape, priors, and what is
/// measured at random.
FitSpec random_posterior_fit(SceneMaker& make, Tally& tally) {
  const auto shape = static_cast<Shape>(make.integer(0, 2));
  SceneSpec<double> scene = make.data(make.integer(2, 3), SceneMaker::Order::falling, 2);
  auto& rates = std::get<Piecewise<double>>(scene.shear_rate).values;
  if (shape == Shape::convex) {
    double step = make.uniform(0.1, 0.5);
    for (std::size_t k = rates.size() - 1; k-- > 0; step += make.uniform(0.1, 1))
      rates[k] = rates[k + 1] + step;
  }
  const bool is_bin = make.integer(0, 1) == 0;
  const ObservationPlan plan{{make.uniform(0.2, 0.6), make.uniform(1, 3)},
                             {0.15, make.uniform(0.25, 0.6), 0.8},
                             is_bin ? Quantity::bin : Quantity::cumulative,
                             is_bin ? 0.12 : 0};
  std::vector<std::string> unknowns{"shear_rate.values", "shear_rate.breaks"};
  if (!scene.initial_breaks.empty() && make.integer(0, 1) == 0) unknowns.emplace_back("initial.breaks");
  FitSpec spec = support::fit_of(
      scene, support::observed(scene, plan, make.uniform(0.005, 0.05), 7, make.integer(0, 1) == 0), unknowns);
  spec.unknown.shape = shape;
  const int bounds = make.integer(0, 2);  // those of Parameters, none above, close ones
  tally.of_bounds[std::to_string(bounds)]++;
  tally.of_shapes[std::to_string(static_cast<int>(shape))]++;
  for (const Parameter& p : Parameters(spec.scene, spec.unknown)) {
    const bool is_rate = p.entry.field == "shear_rate.values";
    spec.unknown.lower.push_back(bounds == 2 && is_rate ? p.start / 2 : p.lower);
    spec.unknown.upper.push_back(!is_rate || bounds == 0 ? p.upper
                                 : bounds == 1           ? infinity<double>()
                                                         : 2 * p.start);
    if (make.integer(0, 2) == 0) continue;
    spec.priors.push_back(random_prior(p.name(), p.start, is_rate, make));
    tally.of_priors[std::string(kPriorNames[static_cast<std::size_t>(spec.priors.back().kind)])]++;
  }
  return spec;
}

void densities_of_random_problems(std::uint64_t first, std::uint64_t count, Tally& tally) {
  for (std::uint64_t number = first; number < first + count; ++number) {
    const std::uint64_t seed = support::seed_of(number);
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker make(seed);
    const FitSpec spec = random_posterior_fit(make, tally);
    const Posterior posterior(spec);
    VectorXd x = posterior.coordinates(Parameters(spec.scene, spec.unknown).start());
    for (double& one : x) one += make.uniform(-0.02, 0.02);
    const LogDensity at = posterior.at_coordinates(x);
    ASSERT_EQ(at.failure, "");
    const PosteriorInDigits exact(spec, posterior);
    const Digits here(x.begin(), x.end());
    EXPECT_NEAR(at.value, to_double(exact.log_density(here)), 1e-11 * (1 + std::abs(at.value)));
    EXPECT_EQ(posterior.at_coordinates(x, false).value, at.value);
    for (Index j = 0; j < x.size(); ++j) {
      Digits above = here, below = here;
      above[static_cast<std::size_t>(j)] += Real110(kCoarseStep);
      below[static_cast<std::size_t>(j)] -= Real110(kCoarseStep);
      const double slope = to_double(
          Real110((exact.log_density(above) - exact.log_density(below)) / (2 * Real110(kCoarseStep))));
      EXPECT_NEAR(at.gradient[j], slope, 1e-11 * (1 + at.gradient.cwiseAbs().maxCoeff()))
          << posterior.names()[static_cast<std::size_t>(j)];
      ++tally.compared;
    }
  }
}

TEST(PosteriorInDigits, IsTheDensityWithItsGradient) {
  Tally tally;
  densities_of_random_problems(1, 20, tally);
  EXPECT_GT(tally.compared, 60);
}

TEST(SlowPosteriorInDigits, IsTheDensityWithItsGradientOf100Problems) {
  Tally tally;
  densities_of_random_problems(1000, 100, tally);
  EXPECT_GT(tally.compared, 300);
  EXPECT_EQ(tally.of_priors.size(), 4U);
  EXPECT_EQ(tally.of_shapes.size(), 3U);
  EXPECT_EQ(tally.of_bounds.size(), 3U);
}

}  // namespace
}  // namespace shearfront::fit
