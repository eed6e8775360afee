// SPDX-License-Identifier: BSD-3-Clause
// Every shear rate with every flux and several initial states: the ends of the bed against places next to them, derivatives of event
// times and of the height of the bed against differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_share_integral.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/exact/timeline_derivatives.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "support/exact_scenes.hpp"
#include "support/random_scene.hpp"
#include "support/scene_cast.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kFewPieces = 7;
constexpr std::size_t kSomePieces = 64;
constexpr double kBedTop = 0.96875;

const std::vector<support::ShareOfRange> kBedStarts{{{0.53125}, {0, 1}},
                                                    {{0.21875, 0.65625}, {0.3125, 0.90625, 0.125}},
                                                    {{0.21875, 0.65625}, {0, 0.90625, 0.125}},
                                                    {{}, {0.40625}}};

/// The first sample of every shear rate.
class ExactOnEveryBed : public testing::TestWithParam<support::NamedDepthFunction> {
 public:
  /// Calls visit(spec) for every scene; of beds for which pieces stand only for some, unless all are wanted.
  template <class Visit>
  static void for_each_scene(bool are_all_wanted, Visit&& visit) {
    support::for_each_exact_scene(
        GetParam().samples.front(), support::every_flux(false), kBedStarts, kBedTop,
        [&](const SceneSpec<double>& spec) {
          const bool is_quick =
              (spec.fluxes[0].is_parabola() && spec.initial_breaks == kBedStarts.front().breaks) ||
              ExactSolution<double>(Scene<double>(spec), {kFewPieces}).is_exact();
          if (are_all_wanted || is_quick) visit(spec);
        });
  }
  static void compare_event_times(bool are_all_wanted);
  static void compare_heights(bool are_all_wanted);
};
INSTANTIATE_TEST_SUITE_P(ShearRates, ExactOnEveryBed, testing::ValuesIn(support::every_depth_function()),
                         support::name_of_parameter);

/// At the top a bed of pieces had paths that turned beyond it (flux no parabola): phi 0.5 for 1, and a height of the bed off by 1e-5.
TEST_P(ExactOnEveryBed, AtItsEndsIsWhatIsNextToThem) {
  int n_compared = 0;
  for_each_scene(true, [&](const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene, {kFewPieces});
    for (const bool is_top : {false, true})
      for (const double t : {1e-3, 0.01, 0.05, 0.15, 0.4, 1.0, 3.0}) {
        const double end = is_top ? scene.top() : scene.bottom(), inwards = is_top ? -1e-9 : 1e-9;
        const double near = solution.phi(end + inwards, t), nearer = solution.phi(end + inwards / 64, t);
        if (std::abs(near - nearer) > 1e-3) continue;  // something is passing
        EXPECT_NEAR(solution.phi(end, t), nearer, 1e-3) << (is_top ? "top" : "bottom") << " at t = " << t;
        ++n_compared;
      }
  });
  EXPECT_GT(n_compared, 100);
}

/// M(z', t) - M(z, t) is int phi between: at jumps of the start, knots, ends of pieces and walls as everywhere else.
struct Continuity {
  int n_compared = 0;

  void check(const SceneSpec<double>& spec, std::size_t n_pieces) {
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene, {n_pieces});
    std::vector<double> heights = solution.form().layers().boundaries();
    for (const auto& more : {scene.initial_breaks(), scene.initial_knots()})
      heights.insert(heights.end(), more.begin(), more.end());
    const auto range = spec.fluxes[0].range();
    const double most = std::max(std::abs(range.lowest), std::abs(range.highest)), step = 1e-9;
    for (const double z : heights)
      for (const double t : {1e-3, 0.05, 0.15, 0.4, 1.0})
        for (const double other : {z - step, z + step}) {
          if (other < scene.bottom() || other > scene.top()) continue;
          EXPECT_NEAR(solution.M(z, t), solution.M(other, t), 1.001 * most * step + 1e-13) << z << ' ' << t;
          ++n_compared;
        }
  }
};

TEST_P(ExactOnEveryBed, MIsContinuousAtKnotsAndJumps) {
  Continuity continuity;
  for_each_scene(true, [&](const SceneSpec<double>& spec) { continuity.check(spec, kFewPieces); });
  EXPECT_GT(continuity.n_compared, 500);
}

/// At a jump of the start between flat pieces a flux that is no parabola had no path: M = 1/2 there for 0.07.
TEST(ExactOnFlatPieces, MIsContinuousAtKnotsAndJumps) {
  Continuity continuity;
  support::SceneMaker make(support::seed_of(77000));
  FluxList<double>::for_each([&]<class F>() {
    for (const F& flux : F::samples())
      for (const bool is_smooth : {false, true}) {
        SceneSpec<double> spec;
        spec.fluxes = {flux};
        spec.shear_rate = Table<double>{{0, 0.125, 0.375, 0.5, 0.75, 0.875, 1}, {2, 1, 1, 1, 1, 1.5, 1.5}};
        const auto range = flux.range();
        if (is_smooth) {
          spec.initial_state = support::random_start(make, range.lowest, range.highest);
        } else {
          spec.initial_breaks = {0.25, 0.375, 0.625, 0.9375};
          for (int n = 0; n < 5; ++n)
            spec.initial_values.push_back(make.uniform(range.lowest, range.highest));
        }
        if (!find_complaints(spec).empty() || !ExactSolver::refusal(Scene<double>(spec), {}).empty())
          continue;
        SCOPED_TRACE(std::string(F::kName) + (is_smooth ? " smooth" : ""));
        continuity.check(spec, 32);
      }
  });
  EXPECT_GT(continuity.n_compared, 1000);
}

template <Real Scalar>
std::vector<std::optional<Scalar>> times_of(const Timeline<Scalar>& timeline) {
  std::vector<std::optional<Scalar>> all{timeline.t0, timeline.t1, timeline.t_star};
  for (const auto& at : timeline.interfaces) {
    all.push_back(at.first);
    all.push_back(at.last);
  }
  return all;
}
std::vector<std::vector<double>> rows_of(const TimelineDerivatives& by) {
  std::vector<std::vector<double>> all{by.t0, by.t1, by.t_star};
  for (const auto& at : by.interfaces) {
    all.push_back(at.first);
    all.push_back(at.last);
  }
  return all;
}

/// Times of the scene with an entry moved by h.
template <Real Scalar>
std::vector<std::optional<Scalar>> moved_times(SceneSpec<Scalar> spec, std::size_t entry, const Scalar& h) {
  *entry_places(spec)[entry] += h;
  if (!find_complaints(spec).empty()) return {};
  return times_of(exact_timeline(ExactSolution<Scalar>(Scene<Scalar>(spec), {kFewPieces})));
}

void ExactOnEveryBed::compare_event_times(bool are_all_wanted) {
  int n_scenes = 0, n_compared = 0, n_wanted = 0;
  for_each_scene(are_all_wanted, [&](const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    ++n_scenes;
    const ExactSolution<double> solution(scene, {kFewPieces});
    const Timeline<double> timeline = exact_timeline(solution);
    const auto times = times_of(timeline);
    const auto rows = rows_of(timeline_derivatives(solution, timeline));
    ASSERT_EQ(rows.size(), times.size());
    const Real110 step("1e-20");
    const double wide = 1e-5;
    const std::vector<Entry> all = entries(spec);
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (!ExactSolver::derivative_refusal(scene, {}, all[e]).empty()) continue;
      // In many digits only what has closed forms, and, where they take time, not all of it.
      const bool is_sample = are_all_wanted || (n_scenes == 1 && e % 3 == 0);
      const bool is_costly =
          !scene.is_layered() && !(spec.fluxes[0].is_parabola() && solution.form().has_pieces() && is_sample);
      std::vector<std::optional<double>> numeric;
      if (is_costly) {
        const auto low = moved_times(spec, e, -wide), high = moved_times(spec, e, wide);
        for (std::size_t i = 0; i < std::min(low.size(), high.size()); ++i)
          numeric.push_back(low[i] && high[i] ? std::optional((*high[i] - *low[i]) / (2 * wide))
                                              : std::nullopt);
      } else {
        const SceneSpec<Real110> precise = scene_cast<Real110>(scene).spec();
        const auto low = moved_times(precise, e, Real110(-step)), high = moved_times(precise, e, step);
        for (std::size_t i = 0; i < std::min(low.size(), high.size()); ++i)
          numeric.push_back(low[i] && high[i]
                                ? std::optional(to_double(Real110((*high[i] - *low[i]) / (2 * step))))
                                : std::nullopt);
      }
      if (numeric.size() != rows.size()) continue;  // not to both sides
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!times[i] || *times[i] == 0 || !std::isfinite(*times[i]) || !numeric[i]) continue;
        ++n_wanted;
        if (rows[i].empty()) continue;
        // A pure state at a wall that is moved is none.
        if (all[e].field == "initial.values" && i < 2) continue;
        const double tolerance = is_costly ? 1e-6 : 1e-10;
        EXPECT_NEAR(rows[i][e], *numeric[i], tolerance * (*times[i] + std::abs(*numeric[i])))
            << "time " << i << " = " << *times[i] << " by " << all[e].name();
        ++n_compared;
      }
    }
  });
  EXPECT_GT(n_scenes, 0);
  EXPECT_GT(n_compared, n_scenes);
  EXPECT_GE(n_compared, 0.8 * n_wanted);
}

TEST_P(ExactOnEveryBed, DerivativesOfEventTimesAreDifferences) { compare_event_times(false); }

void ExactOnEveryBed::compare_heights(bool are_all_wanted) {
  int n_scenes = 0, n_compared = 0;
  support::SceneMaker make(support::seed_of(5502));
  for_each_scene(are_all_wanted, [&](const SceneSpec<double>& spec) {
    const Scene<double> scene(spec);
    if (!BedHeight::refusal(scene).empty()) return;
    ++n_scenes;
    if (!scene.is_layered() && !spec.fluxes[0].is_parabola() && spec.initial_breaks.size() == 2)
      return;  // cost
    const ExactSolution<double> solution(scene, {kSomePieces});
    const Derivatives<double> derivatives(solution);
    const BedHeight bed(scene);
    for (const double t : {0.0, std::exp(make.uniform(-2.5, 0.5)), infinity<double>()}) {
      const double integral = share_integral(solution, t, bed.integrand());
      const std::vector<double> by = share_integral_derivatives(solution, derivatives, t, bed.integrand()),
                                mass_by = derivatives.at(scene.top(), 0).M;
      const std::vector<Entry> all = entries(spec);
      for (std::size_t e = 0; e < all.size(); ++e) {
        if (!ExactSolver::derivative_refusal(scene, {}, all[e]).empty()) continue;
        const auto height = [&](double step) {
          SceneSpec<double> moved = spec;
          *entry_places(moved)[e] += step;
          if (!find_complaints(moved).empty()) return std::nan("");
          const Scene<double> other(moved);
          const BedHeight own(other);
          return own.height(share_integral(ExactSolution<double>(other, {kSomePieces}), t, own.integrand()));
        };
        const auto numeric = [&](double h) {
          return (8 * (height(h) - height(-h)) - (height(2 * h) - height(-2 * h))) / (12 * h);
        };
        const double fine = numeric(5e-4), coarse = numeric(2e-3);
        if (!std::isfinite(fine)) continue;
        // Three points to a piece are near enough to what pieces cost.
        const double slack = solution.is_exact() ? 1e-8 : 1e-6 + 5e-3 * std::abs(fine);
        EXPECT_NEAR(bed.height_by(integral, by[e], mass_by[e]), fine, slack + 3 * std::abs(fine - coarse))
            << "at t = " << t << " by " << all[e].name();
        ++n_compared;
      }
    }
  });
  EXPECT_GT(n_scenes, 0);
  EXPECT_GT(n_compared, n_scenes);
}

TEST_P(ExactOnEveryBed, DerivativesOfItsHeightAreDifferences) { compare_heights(false); }

class SlowExactOnEveryBed : public ExactOnEveryBed {};
INSTANTIATE_TEST_SUITE_P(ShearRates, SlowExactOnEveryBed, testing::ValuesIn(support::every_depth_function()),
                         support::name_of_parameter);

TEST_P(SlowExactOnEveryBed, DerivativesOfEventTimesAreDifferences) { compare_event_times(true); }
TEST_P(SlowExactOnEveryBed, DerivativesOfItsHeightAreDifferences) { compare_heights(true); }

/// Paths of a flux with a kink that come too early spend the time that is left where the capacity is least: at a knot, at their
/// start, or at their end.
TEST(KinkedFluxes, DerivativesOfPathsThatRestAreDifferences) {
  support::SceneMaker make(support::seed_of(5503));
  int n_rests = 0, n_compared = 0;
  for (int k = 0; k < 400; ++k) {
    const auto fluxes = Triangular<double>::samples();
    SceneSpec<double> spec;
    spec.fluxes = {fluxes[static_cast<std::size_t>(k) % fluxes.size()]};
    Table<double> rate;
    const int n = 2 + k % 4;
    for (int i = 0; i <= n; ++i) {
      rate.z.push_back(i == 0 || i == n ? double(i / n) : (i + make.uniform(-0.3, 0.3)) / n);
      rate.values.push_back(make.uniform(0.2, 2));
    }
    spec.shear_rate = rate;
    spec.initial_breaks = {make.uniform(0.2, 0.45), make.uniform(0.5, 0.8)};
    const auto range = spec.fluxes[0].range();
    for (int i = 0; i < 3; ++i)
      spec.initial_values.push_back(range.lowest + make.uniform(0.02, 0.98) * (range.highest - range.lowest));
    const Scene<double> scene(spec);
    const ExactSolution<double> solution(scene);
    const Derivatives<double> derivatives(solution);
    const std::vector<Entry> all = entries(spec);
    for (int q = 0; q < 6; ++q) {
      const double z = make.uniform(0.03, 0.97), t = std::exp(make.uniform(-3, 1));
      const auto path = solution.path(z, t);
      if (path.kind != exact::PathKind::fan || path.x != 0 || path.turned) continue;
      ++n_rests;
      const auto by = derivatives.at(z, t);
      for (std::size_t e = 0; e < all.size(); ++e) {
        if (!derivative_refusal(scene, all[e]).empty()) continue;
        const auto M_at = [&](double h) {
          SceneSpec<double> moved = spec;
          *entry_places(moved)[e] += h;
          return find_complaints(moved).empty() ? ExactSolution<double>(Scene<double>(moved)).M(z, t)
                                                : std::nan("");
        };
        const double fine = (M_at(1e-6) - M_at(-1e-6)) / 2e-6, coarse = (M_at(2e-6) - M_at(-2e-6)) / 4e-6;
        if (!(std::abs(fine - coarse) < 1e-7)) continue;  // another path on one side
        EXPECT_NEAR(by.M[e], fine, 1e-6) << all[e].name() << " at z " << z << " t " << t;
        ++n_compared;
      }
    }
  }
  EXPECT_GT(n_rests, 5);
  EXPECT_GT(n_compared, 50);
}

/// Beside a contact of a straight branch paths of several families tie, and one jump was added for each.
TEST(KinkedFluxes, DerivativesOfHeightsOfRandomBedsAreDifferences) {
  support::SceneMaker make(support::seed_of(5504));
  std::vector<Flux<double>> fluxes;
  for (const auto& flux : Triangular<double>::samples()) fluxes.emplace_back(flux);
  for (const auto& flux : FluxTable<double>::samples()) fluxes.emplace_back(flux);
  for (const auto& flux : LwrCubic<double>::samples()) fluxes.emplace_back(flux);
  int n_compared = 0;
  for (int k = 0; k < 300; ++k) {
    SceneSpec<double> spec;
    spec.fluxes = {fluxes[static_cast<std::size_t>(k) % fluxes.size()]};
    if (k % 3 == 0)
      spec.shear_rate = Piecewise<double>{{}, {make.uniform(0.3, 2)}};
    else
      spec.shear_rate =
          Piecewise<double>{{make.uniform(0.3, 0.7)}, {make.uniform(0.3, 2), make.uniform(0.3, 2)}};
    const auto range = spec.fluxes[0].range();
    const auto state = [&] {
      return range.lowest + make.uniform(0.02, 0.98) * (range.highest - range.lowest);
    };
    spec.initial_breaks = {make.uniform(0.2, 0.8)};
    spec.initial_values = {state(), state()};
    const Scene<double> scene(spec);
    if (!ExactSolver::refusal(scene, {}).empty() || !BedHeight::refusal(scene).empty()) continue;
    const ExactSolution<double> solution(scene);
    const Derivatives<double> derivatives(solution);
    const BedHeight bed(scene);
    const std::vector<Entry> all = entries(spec);
    for (int q = 0; q < 3; ++q) {
      const double t = std::exp(make.uniform(-3, 0.7));
      const double integral = share_integral(solution, t, bed.integrand());
      const std::vector<double> by = share_integral_derivatives(solution, derivatives, t, bed.integrand()),
                                mass_by = derivatives.at(scene.top(), 0).M;
      for (std::size_t e = 0; e < all.size(); ++e) {
        if (!derivative_refusal(scene, all[e]).empty()) continue;
        const auto numeric = [&](double h) {
          double heights[2];
          for (const int side : {0, 1}) {
            SceneSpec<double> moved = spec;
            *entry_places(moved)[e] += side == 0 ? -h : h;
            if (!find_complaints(moved).empty()) return std::nan("");
            const Scene<double> other(moved);
            const BedHeight own(other);
            heights[side] = own.height(share_integral(ExactSolution<double>(other), t, own.integrand()));
          }
          return (heights[1] - heights[0]) / (2 * h);
        };
        const double fine = numeric(1e-5), coarse = numeric(4e-5);
        if (!(std::abs(fine - coarse) < 1e-3)) continue;  // a kink
        EXPECT_NEAR(bed.height_by(integral, by[e], mass_by[e]), fine, 1e-6 + 3 * std::abs(fine - coarse))
            << spec.fluxes[0].name() << " at t = " << t << " by " << all[e].name();
        ++n_compared;
      }
    }
  }
  EXPECT_GT(n_compared, 1000);
}

}  // namespace
}  // namespace shearfront
