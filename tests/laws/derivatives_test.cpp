// SPDX-License-Identifier: BSD-3-Clause
// Every shear rate with every flux and several initial states: the derivatives that the exact solver offers against
// differences in 110 digits, and a fit asks for every entry.
#include <gtest/gtest.h>

#include <algorithm>
#include <any>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/fit/forward.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solver/all.hpp"
#include "support/exact_scenes.hpp"
#include "support/model_types.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kLayers = 7;  // of staircases; no piece of a sample is a whole number of them high
constexpr double kTop =
    0.96875;  // no bed is symmetric: equal layers make a path at rest no smooth function of them

/// A jump, several of them, none.
const std::vector<support::ShareOfRange> kStarts{
    {{0.53125}, {0, 1}}, {{0.21875, 0.65625}, {0.3125, 0.90625, 0.125}}, {{}, {0.40625}}};

/// Samples of every shear rate.
class ExactDerivatives : public testing::TestWithParam<support::NamedDepthFunction> {
 public:
  /// Calls visit(spec) for every scene with so many of the samples that the solver solves.
  template <class Visit>
  static void for_each_scene(Visit&& visit, std::size_t most_samples = kNoEntry) {
    const auto& rates = GetParam().samples;
    const auto fluxes = support::every_flux(true);
    for (std::size_t i = 0; i < std::min(rates.size(), most_samples); ++i)
      support::for_each_exact_scene(rates[i], fluxes, kStarts, kTop, visit);
  }
  static void compare_with_differences(std::size_t most_of_costly, std::size_t most_samples);
};
INSTANTIATE_TEST_SUITE_P(ShearRates, ExactDerivatives, testing::ValuesIn(support::every_depth_function()),
                         support::name_of_parameter);

struct Difference {
  double phi = 0, M = 0;
  bool is_smooth = false;  ///< the same path on both sides
};

bool is_same_path(const exact::Path<Real110>& a, const exact::Path<Real110>& b) {
  const Real110 d = a.foot - b.foot;
  return a.kind == b.kind && a.upward == b.upward && a.source == b.source && a.interface == b.interface &&
         (d < 0 ? Real110(-d) : d) < Real110(1e-6);
}

Difference difference(const SceneSpec<Real110>& spec, std::size_t entry, const Real110& z, const Real110& t,
                      const exact::Path<Real110>& path) {
  const Real110 h("1e-20");
  ExactSolution<Real110>::Value values[2];
  for (const int side : {0, 1}) {
    SceneSpec<Real110> moved = spec;
    *entry_places(moved)[entry] += side == 0 ? Real110(-h) : h;
    if (!find_complaints(moved).empty()) return {};
    const ExactSolution<Real110> solution(Scene<Real110>(moved), {kLayers});
    const auto other = solution.path(z, t);
    if (!is_same_path(path, other)) return {};
    values[side] = solution.value_of(other, z, t);
  }
  return {to_double(Real110((values[1].phi - values[0].phi) / (2 * h))),
          to_double(Real110((values[1].M - values[0].M) / (2 * h))), true};
}

/// Of every scene of so many samples of a model all entries, or where they cost most (integrals of a law along pieces) only some of them, each time others.
void ExactDerivatives::compare_with_differences(std::size_t most_of_costly, std::size_t most_samples) {
  int n_scenes = 0, n_compared = 0, n_refused = 0;
  std::set<std::string> costly;  // fluxes whose derivatives along pieces have been compared
  std::set<std::string> all_costly;
  std::size_t number = 0, turn = 0;
  support::SceneMaker make(support::seed_of(5501));
  for_each_scene(
      [&](const SceneSpec<double>& spec) {
        // Of each flux the initial states in turn: many digits take time.
        if (spec.initial_breaks.size() != kStarts[(number++ / kStarts.size()) % kStarts.size()].breaks.size())
          return;
        const Scene<double> scene(spec);
        const bool is_costly = !scene.is_layered() && !spec.fluxes[0].is_parabola();
        const std::string flux(spec.fluxes[0].name());
        if (is_costly) all_costly.insert(flux);
        ++n_scenes;
        const ExactSolver::Options options{.layers = kLayers};
        const std::vector<Entry> all = entries(spec);
        std::vector<std::size_t> wanted;
        for (std::size_t i = 0; i < all.size(); ++i) {
          const bool is_refused = !ExactSolver::derivative_refusal(scene, options, all[i]).empty();
          is_refused ? ++n_refused : (wanted.push_back(i), 0);
        }
        if (is_costly && wanted.size() > most_of_costly) {
          const auto first = static_cast<std::ptrdiff_t>(turn++ % wanted.size());
          std::rotate(wanted.begin(), wanted.begin() + first, wanted.end());
        }
        std::size_t most = is_costly ? most_of_costly : kNoEntry;
        const Place place{std::exp(make.uniform(-2.5, 0.5)), make.uniform(0.05, 0.9)};
        std::any memory;
        const Linearisation exact = ExactSolver::linearise(scene, options, {place}, wanted, memory);
        ASSERT_EQ(exact.derivatives.size(), wanted.size());
        const Scene<Real110> precise = scene_cast<Real110>(scene);
        const ExactSolution<Real110> solution(precise, {kLayers});
        const Real110 z(place.z), t(place.t);
        const auto path = solution.path(z, t);
        for (std::size_t k = 0; k < wanted.size() && most > 0; ++k) {
          const Difference numeric = difference(precise.spec(), wanted[k], z, t, path);
          if (!numeric.is_smooth) continue;
          const Sample& by = exact.derivatives[k];
          EXPECT_NEAR(by.M, numeric.M, 1e-11 * (1 + std::abs(numeric.M)))
              << "dM/d " << all[wanted[k]].name() << " kind " << int(path.kind) << " z " << place.z << " t "
              << place.t;
          EXPECT_NEAR(by.phi, numeric.phi, 1e-9 * (1 + std::abs(numeric.phi)))
              << "dphi/d " << all[wanted[k]].name() << " kind " << int(path.kind) << " z " << place.z << " t "
              << place.t;
          ++n_compared;
          --most;
          if (is_costly) costly.insert(flux);
        }
      },
      most_samples);
  EXPECT_GT(n_scenes, 0);
  EXPECT_GT(n_compared, n_scenes);
  EXPECT_EQ(costly, all_costly) << "a flux without a comparison";
  EXPECT_GE(n_refused, 2 * n_scenes);  // the ends of the domain
}

TEST_P(ExactDerivatives, AreDifferencesInManyDigits) { compare_with_differences(1, 1); }

class SlowExactDerivatives : public ExactDerivatives {};
INSTANTIATE_TEST_SUITE_P(ShearRates, SlowExactDerivatives, testing::ValuesIn(support::every_depth_function()),
                         support::name_of_parameter);

TEST_P(SlowExactDerivatives, OfAllEntriesAreDifferencesInManyDigits) {
  compare_with_differences(kNoEntry, kNoEntry);
}

TEST_P(ExactDerivatives, AFitCanAskForEveryEntry) {
  int checked = 0;
  for_each_scene([&](const SceneSpec<double>& spec) {
    fit::ForwardSpec exact;
    exact.method = Method::of<ExactSolver>({.layers = kLayers});
    bool is_first = true;
    for (const Entry& entry : entries(spec)) {
      if (entry.field.starts_with("domain.")) continue;
      fit::UnknownSpec unknown;
      unknown.parameters = {entry.name()};
      const fit::Parameters parameters(Scene<double>(spec), unknown);
      for (const auto observable : {fit::Observable::phi, fit::Observable::M, fit::Observable::bed_height}) {
        // The integrals of one unknown are those of all.
        if (observable == fit::Observable::bed_height &&
            (!is_first || !BedHeight::refusal(parameters.start_scene()).empty()))
          continue;
        const fit::Forward forward(parameters, exact, observable, {{0.2, 0.3}, {0.2, 0.7}, {1, 0.5}});
        const auto at = forward.predict(parameters.start(), forward.has_derivatives());
        ASSERT_TRUE(at.is_valid()) << entry.name() << ": " << at.failure;
        if (forward.has_derivatives()) {
          ASSERT_EQ(at.derivatives.rows(), 3) << entry.name();
          EXPECT_TRUE(at.derivatives.allFinite()) << entry.name();
        }
        ++checked;
      }
      is_first = false;
    }
  });
  EXPECT_GT(checked, 0);
}

/// A model without what it may leave out.
template <class Model>
struct Bare : Model {
  using Model::Model;
  explicit Bare(const Model& model) : Model(model) {}
  void harmonic_mean_derivatives() const = delete;
  void knot_entries() const = delete;
};

template <class Model>
class MeanDerivatives : public testing::Test {};
TYPED_TEST_SUITE(MeanDerivatives, support::ModelTypes<DepthFunctionList<double>>::Type, support::ModelName);

TYPED_TEST(MeanDerivatives, AreTheSameForAModelThatLeavesThemOut) {
  int compared = 0;
  for (const TypeParam& model : TypeParam::samples()) {
    const Bare<TypeParam> bare(model);
    EXPECT_EQ(knot_entries(bare), knot_entries(model));
    std::vector<double> cuts{0, 1};
    for (const double z : model.knots())
      if (z > 0 && z < 1) cuts.push_back(z);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
      for (const double part : {1.0, 0.5, 0.0625}) {
        const double lo = cuts[i], hi = part == 1 ? cuts[i + 1] : lo + part * (cuts[i + 1] - lo);
        // At its end a rate that vanishes there has a derivative to one side only.
        if (model.value(hi) == 0) continue;
        std::vector<double> mine(64, 0.0), theirs(64, 0.0);
        harmonic_mean_derivatives(model, lo, hi, [&](std::size_t e, double by) { mine[e] += by; });
        harmonic_mean_derivatives(bare, lo, hi, [&](std::size_t e, double by) { theirs[e] += by; });
        for (std::size_t e = 0; e < mine.size(); ++e)
          EXPECT_NEAR(mine[e], theirs[e], 1e-9 * (1 + std::abs(mine[e])))
              << "entry " << e << " over " << lo << " " << hi;
        ++compared;
      }
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace shearfront
