// SPDX-License-Identifier: BSD-3-Clause
// The kind of fault: a tolerance, a step or a default that has a unit. Every scene of the data sets by every solver that takes
// it, with heights times L and times times T: phi stays, M goes with L, event times go with T. By even powers of two (for the
// sake of square roots) every operation is the same but for its exponent: equal to the bit. By powers of ten: to rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shearfront/io/scene_file.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/checked.hpp"
#include "support/options.hpp"
#include "support/scene_units.hpp"

namespace shearfront {
namespace {

/// What a solver says of a scene, in the units of L = T = 1.
struct Answer {
  Status status = Status::not_run;
  std::vector<double> phi, M, times;
};

/// Times and heights at which a scene has something to say: until a wave has crossed the bed a few times. None is a round number:
/// on the face of a cell, or where a front stands, rounding decides on which side the state is taken.
SolverRequest request_of(const Scene<>& scene) {
  const double height = scene.top() - scene.bottom();
  double fastest = 0;
  for (int i = 0; i < 16; ++i)
    fastest = std::max(fastest, std::abs(scene.rate_at(scene.bottom() + height * (i + 0.5) / 16)));
  SolverRequest request;
  for (const double t : {0.127, 0.493, 1.97}) request.times.push_back(t * height / fastest);
  for (const double z : {0.0617, 0.2473, 0.4391, 0.8119})
    request.heights.push_back(scene.bottom() + z * height);
  return request;
}

template <class S>
std::optional<Answer> answer_of(const SceneSpec<>& spec, SolverRequest request, double L, double T) {
  const Scene<> scene(support::in_units(spec, L, T));
  const auto options = support::options_of<S>({{"resolution", 0.05}, {"cells", 32}});
  if (!S::refusal(scene, options).empty()) return {};
  for (double& t : request.times) t *= T;
  for (double& z : request.heights) z *= L;
  request.timeline = S::guarantees().has_timeline;
  const SolverResult result = solve<S>(scene, request, options);
  Answer answer{result.summary.status, {}, {}, {}};
  for (const Sample& sample : result.samples) {
    answer.phi.push_back(sample.phi);
    answer.M.push_back(sample.M / L);
  }
  const auto add = [&](const std::optional<double>& t) {
    answer.times.push_back(t ? *t / T : std::numeric_limits<double>::infinity());
  };
  if (result.timeline) {
    for (const auto& t : {result.timeline->t0, result.timeline->t1, result.timeline->t_star}) add(t);
    for (const auto& at : result.timeline->interfaces) {
      add(at.first);
      add(at.last);
    }
  }
  return answer;
}

std::vector<std::string> scene_files() {
  std::vector<std::string> all;
  for (const auto& file : std::filesystem::recursive_directory_iterator(SHEARFRONT_SOURCE_DIR "/datasets"))
    if (file.path().filename().string().starts_with("scene") && file.path().extension() == ".toml")
      all.push_back(file.path().string());
  std::sort(all.begin(), all.end());
  return all;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance,
                 std::string_view what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] == expected[i]) continue;
    EXPECT_NEAR(found[i], expected[i], tolerance * std::max(1.0, std::abs(expected[i]))) << what << " " << i;
  }
}

using Unit = std::pair<double, double>;

/// Every solver in every scene; `units` are factors of heights and times.
template <class Tolerance>
void check_units(const std::vector<Unit>& units, const Tolerance& tolerance_of) {
  support::Checked checked(std::initializer_list<std::string_view>{});
  SolverList::for_each([&]<class S>() {
    if (!S::guarantees().has_slab) checked.expect(S::kName);
  });
  for (const std::string& file : scene_files()) {
    SCOPED_TRACE(file);
    const Scene<> scene = read_scene<double>(file);
    if (scene.spec().velocity) continue;  // a chute has units of velocities besides
    const auto all = entries(scene.spec());
    if (std::any_of(all.begin(), all.end(), [](const Entry& e) { return e.name() == "shear_rate.gravity"; }))
      continue;  // which is a height over the square of a time
    const SolverRequest request = request_of(scene);
    SolverList::for_each([&]<class S>() {
      SCOPED_TRACE(std::string(S::kName));
      const std::optional<Answer> one = answer_of<S>(scene.spec(), request, 1, 1);
      if (!one || testing::Test::HasFatalFailure()) return;
      for (const auto& [L, T] : units) {
        SCOPED_TRACE("heights times " + std::to_string(std::log10(L)) + ", times " +
                     std::to_string(std::log10(T)) + " (powers of ten)");
        const std::optional<Answer> other = answer_of<S>(scene.spec(), request, L, T);
        ASSERT_TRUE(other) << "refused";
        ASSERT_EQ(name_of(other->status), name_of(one->status));
        const double tolerance = tolerance_of(S::guarantees());
        expect_near(other->phi, one->phi, tolerance, "phi");
        expect_near(other->M, one->M, tolerance, "M");
        expect_near(other->times, one->times, tolerance, "event time");
        checked.count(S::kName);
      }
    });
  }
}

TEST(Units, PowersOfTwoChangeExponentsOnly) {
  std::vector<Unit> units;
  for (const auto& [k, m] : {std::pair{-30, 0}, {30, 0}, {0, 30}, {-16, 24}})
    units.emplace_back(std::exp2(k), std::exp2(m));
  check_units(units, [](const Guarantees&) { return 0.0; });
}

TEST(Units, PowersOfTenChangeRoundingOnly) {
  std::vector<Unit> units;
  for (const auto& [k, m] : {std::pair{-9, 0}, {9, 0}, {0, -9}, {0, 9}, {-9, 9}})
    units.emplace_back(std::pow(10.0, k), std::pow(10.0, m));
  check_units(units, [](const Guarantees&) { return 1e-9; });
}

}  // namespace
}  // namespace shearfront
