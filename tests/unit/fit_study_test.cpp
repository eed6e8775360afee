// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "shearfront/fit/study/sobol_indices.hpp"
#include "shearfront/fit/study/study_design.hpp"
#include "shearfront/fit/study/study_runs.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/own_folder.hpp"

namespace shearfront::fit {
namespace {

StudySpec written(const std::string& text) {
  static int n = 0;
  const std::string path = (support::own_folder() / ("study-" + std::to_string(++n) + ".toml")).string();
  std::ofstream(path) << text;
  return read_study(path);
}

const std::string kStudyScene =
    "scene = \"" SHEARFRONT_SOURCE_DIR "/datasets/may-2010-piecewise/scene.toml\"\n";
const std::string kTwo =
    "[[vary]]\nentry = \"shear_rate.values[0]\"\nuniform = [1, 3]\n[[vary]]\nentry = "
    "\"shear_rate.values[1]\"\nlog-uniform = [0.1, 1]\n";
const std::string kOutputs =
    "[outputs]\nevents = [\"t_0\", \"t*\", \"t_c(1)\"]\nquantities = [\"phi\", \"M\", \"bed-height\", "
    "\"mixing\"]\ntimes = [0.5, 2]\nheights = [0.1, 0.7]\n";

std::string design(const std::string& kind, int runs, int seed = 1) {
  return "[design]\nkind = \"" + kind + "\"\nruns = " + std::to_string(runs) +
         "\nseed = " + std::to_string(seed) + "\n";
}

TEST(StudyDesign, AGridHasEveryCombinationTheLastFastest) {
  const StudySpec spec = written(kStudyScene +
                                 "[[vary]]\nentry = \"shear_rate.values[0]\"\nlist = [1, 2]\n[[vary]]\nentry "
                                 "= \"initial.breaks[0]\"\nrange = [0.4, 0.6]\ncount = 3\n" +
                                 kOutputs);
  const auto points = study_points(spec);
  ASSERT_EQ(points.size(), 6u);
  EXPECT_EQ(points[0], (std::vector<double>{1, 0.4}));
  EXPECT_EQ(points[1], (std::vector<double>{1, 0.5}));
  EXPECT_EQ(points[5], (std::vector<double>{2, 0.6}));
}

TEST(StudyDesign, ALatinHypercubeHasOnePointInEverySlice) {
  constexpr int kRuns = 37;
  const StudySpec spec = written(kStudyScene + kTwo + design("latin-hypercube", kRuns, 5) + kOutputs);
  const auto points = study_points(spec);
  for (std::size_t j = 0; j < 2; ++j) {
    std::vector<int> counts(kRuns, 0);
    for (const auto& point : points) {
      const double u = j == 0 ? (point[0] - 1) / 2 : std::log10(point[1]) + 1;
      ++counts[static_cast<std::size_t>(u * kRuns)];
    }
    EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), kRuns) << "entry " << j;
  }
  EXPECT_EQ(points, study_points(spec));
}

/// The first points of the sequence after 0 are known: (1/2, 1/2), (3/4, 1/4), (1/4, 3/4).
TEST(StudyDesign, ASobolSequenceIsTheKnownOne) {
  const StudySpec spec = written(kStudyScene +
                                 "[[vary]]\nentry = \"shear_rate.values[0]\"\nuniform = [1, "
                                 "2]\n[[vary]]\nentry = \"shear_rate.values[1]\"\nuniform = [1, 2]\n" +
                                 design("sobol", 3) + kOutputs);
  const auto points = study_points(spec);
  const std::vector<std::vector<double>> known{{1.5, 1.5}, {1.75, 1.25}, {1.25, 1.75}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(points[i][j], known[i][j], 1e-9) << i << ' ' << j;
}

TEST(StudyDesign, DistributionsHaveTheirMoments) {
  constexpr int kRuns = 4000;
  const StudySpec spec =
      written(kStudyScene +
              "[[vary]]\nentry = \"initial.breaks[0]\"\nnormal = [0.5, 0.02]\n[[vary]]\nentry = "
              "\"shear_rate.values[1]\"\nlognormal = [0.3, 0.1]\n" +
              design("latin-hypercube", kRuns) + kOutputs);
  double mean = 0, square = 0, log_mean = 0, log_square = 0;
  for (const auto& point : study_points(spec)) {
    mean += point[0] / kRuns;
    square += (point[0] - 0.5) * (point[0] - 0.5) / kRuns;
    log_mean += std::log(point[1] / 0.3) / kRuns;
    log_square += std::pow(std::log(point[1] / 0.3), 2) / kRuns;
  }
  EXPECT_NEAR(mean, 0.5, 1e-5);  // slices make the error of a mean much less than 0.02 / sqrt(n)
  EXPECT_NEAR(std::sqrt(square), 0.02, 1e-4);
  EXPECT_NEAR(log_mean, 0, 1e-4);
  EXPECT_NEAR(std::sqrt(log_square), 0.1, 1e-3);
}

/// Ishigami's function has closed forms: with a = 7, b = 0.1 first indices 0.3139, 0.4424, 0, total 0.5576, 0.4424, 0.2437.
TEST(SobolIndices, OfIshigamisFunction) {
  StudySpec spec;
  spec.design = DesignKind::indices;
  spec.runs = 20000;
  for (const char* name : {"x", "y", "z"})
    spec.variations.push_back({name, VariationKind::uniform, {}, -std::numbers::pi, std::numbers::pi});
  std::vector<std::vector<double>> outputs;
  for (const auto& x : study_points(spec))
    outputs.push_back(
        {std::sin(x[0]) + 7 * std::pow(std::sin(x[1]), 2) + 0.1 * std::pow(x[2], 4) * std::sin(x[0])});
  const auto indices = sobol_indices(outputs, {"f"}, {"x", "y", "z"}, 1);
  ASSERT_EQ(indices.size(), 3u);
  const std::vector<double> first{0.3139, 0.4424, 0}, total{0.5576, 0.4424, 0.2437};
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(indices[j].first, first[j], 0.03) << j;
    EXPECT_NEAR(indices[j].total, total[j], 0.03) << j;
    EXPECT_LE(indices[j].first95.low, indices[j].first) << j;
    EXPECT_GE(indices[j].total95.high, indices[j].total) << j;
    EXPECT_LT(indices[j].total95.high - indices[j].total95.low, 0.06) << j;
  }
}

TEST(StudyRuns, EveryRunIsTheSceneWithItsNumbersWhateverTheThreads) {
  const StudyRuns runs(written(kStudyScene + kTwo + design("random", 300, 9) + kOutputs));
  std::vector<std::size_t> all(runs.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<StudyRow> one, three;
  runs.run_all(all, 1, [&](const StudyRow& row) { one.push_back(row); });
  runs.run_all(all, 3, [&](const StudyRow& row) { three.push_back(row); });
  ASSERT_EQ(one.size(), 300u);
  ASSERT_EQ(three.size(), 300u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].run, i);
    EXPECT_EQ(one[i].failure, "");
    EXPECT_EQ(one[i].outputs, three[i].outputs);
    SceneSpec<double> spec = runs.spec().scene->spec();
    const auto names = entries(spec);
    const auto places = entry_places(spec);
    for (std::size_t k = 0; k < names.size(); ++k)
      for (std::size_t j = 0; j < runs.entries().size(); ++j)
        if (names[k].name() == runs.entries()[j]) *places[k] = one[i].values[j];
    const Scene<double> scene(spec);
    const Timeline<double> timeline = event_times(scene);
    EXPECT_EQ(one[i].outputs[0], *timeline.t0);
    EXPECT_EQ(one[i].outputs[1], *timeline.t_star);
    EXPECT_EQ(one[i].outputs[2], *timeline.interfaces[0].first);
    SolverRequest request;
    request.times = {0.5, 2};
    request.heights = {0.1, 0.7};
    EXPECT_EQ(one[i].outputs[3 + 1], solve(scene, Method(), request).phi(0, 1));
    EXPECT_EQ(one[i].outputs[3 + 4 + 2], solve(scene, Method(), request).M(1, 0));
  }
}

TEST(StudyRuns, AFailureIsARow) {
  const StudyRuns runs(
      written(kStudyScene + "[[vary]]\nentry = \"initial.breaks[0]\"\nlist = [0.5, 1.5]\n" + kOutputs));
  EXPECT_EQ(runs.run(0).failure, "");
  const StudyRow failed = runs.run(1);
  EXPECT_NE(failed.failure.find("initial.breaks[0] = 1.5; must be inside the domain"), std::string::npos)
      << failed.failure;
  EXPECT_TRUE(std::isnan(failed.outputs[0]));
}

/// Fits of fresh noise about the estimate scatter as the fit says, whatever the threads; what is asked of the scene is that
/// of the estimate of the row.
TEST(StudyRuns, ReplicatesScatterAsTheErrorBars) {
  const StudyRuns runs(
      written("fit = \"" SHEARFRONT_SOURCE_DIR "/datasets/paper-example-3/fit-bin-noise-0.01.toml\"\n" +
              design("replicates", 60, 3) + "[outputs]\nestimates = true\nevents = [\"t*\"]\n"));
  ASSERT_EQ(runs.size(), 60u);
  EXPECT_TRUE(runs.entries().empty());
  const auto& outputs = runs.spec().outputs;
  ASSERT_EQ(outputs.size(), 6u);
  EXPECT_EQ(outputs[0].name, "t*");
  EXPECT_EQ(outputs[3].name, "shear_rate.values[1]");
  EXPECT_EQ(outputs[4].name, "std_error(shear_rate.values[1])");
  EXPECT_EQ(outputs[5].name, "misfit");
  std::vector<std::size_t> all(runs.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<StudyRow> one, two;
  runs.run_all(all, 1, [&](const StudyRow& row) { one.push_back(row); });
  runs.run_all(all, 2, [&](const StudyRow& row) { two.push_back(row); });
  ASSERT_EQ(two.size(), 60u);
  double mean = 0, variance = 0, stated = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].failure, "");
    EXPECT_EQ(one[i].outputs, two[i].outputs) << i;
    // t* of two layers is 2 h / k1 (May et al. 2010).
    EXPECT_NEAR(one[i].outputs[0] * one[i].outputs[3], 2, 1e-9);
    mean += one[i].outputs[3] / 60;
    stated += one[i].outputs[4] / 60;
  }
  for (const StudyRow& row : one) variance += std::pow(row.outputs[3] - mean, 2) / 59;
  EXPECT_NEAR(std::sqrt(variance) / stated, 1, 0.35);  // 60 estimates know their scatter to 9 %
}

TEST(StudyRuns, ItEndsWhenItMayNotGoOn) {
  const StudyRuns runs(written(kStudyScene + kTwo + design("random", 5000, 9) + kOutputs));
  std::vector<std::size_t> all(runs.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::atomic<std::size_t> n = 0;
  runs.run_all(
      all, 3, [&](const StudyRow& row) { EXPECT_EQ(row.run, n++); }, [&] { return n < 200; });
  EXPECT_GE(n, 200u);
  EXPECT_LT(n, 1000u);
  EXPECT_THROW(runs.run_all(all, 3, [](const StudyRow&) { throw InputError("disk", "", "is full"); }),
               InputError);
}

TEST(StudyFile, RefusesWhatCannotBe) {
  const auto report = [](const std::string& text) {
    try {
      (void)written(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::vector<std::pair<std::string, std::string>> cases{
      {kTwo + kOutputs, "must be given, or fit, but not both"},
      {kStudyScene + kOutputs, "must be [[vary]] tables"},
      {kStudyScene + kTwo + kOutputs, "must be another than grid: shear_rate.values[0] has a distribution"},
      {kStudyScene + kTwo + "[design]\nkind = \"random\"\n" + kOutputs, "design.runs: missing"},
      {kStudyScene + kTwo + design("random", 3), "outputs: missing"},
      {kStudyScene + kTwo + design("random", 3) + "[outputs]\n",
       "must ask for events, quantities or estimates"},
      {kStudyScene + kTwo + design("random", 3) + "[outputs]\nevents = [\"t2\"]\n",
       "must be of: t_0, t_1, t*, t_c(1), t^_c(1)"},
      {kStudyScene + kTwo + design("random", 3) + "[outputs]\nquantities = [\"phi\"]\ntimes = [1]\n",
       "needs times, and phi and M also heights"},
      {kStudyScene + kTwo + design("random", 3) +
           "[outputs]\nquantities = [\"phi\"]\ntimes = [1]\nheights = [2]\n",
       "must be inside the domain"},
      {kStudyScene + "[[vary]]\nentry = \"shear_rate.value[0]\"\nlist = [1]\n" + kOutputs,
       "did you mean shear_rate.values[0]?"},
      {kStudyScene + "[[vary]]\nentry = \"shear_rate.scale\"\n" + kOutputs, "must have one of: list, range"},
      {kStudyScene + "[[vary]]\nentry = \"shear_rate.scale\"\nlist = [1]\nuniform = [1, 2]\n" + kOutputs,
       "must have one of: list, range"},
      {kStudyScene + "[[vary]]\nentry = \"shear_rate.scale\"\nlog-uniform = [0, 2]\n" + design("random", 3) +
           kOutputs,
       "must have a first number > 0"},
      {kStudyScene + "[[vary]]\nentry = \"shear_rate.scale\"\nnormal = [1, 0]\n" + design("random", 3) +
           kOutputs,
       "must have a second number > 0"},
      {kStudyScene + "[[vary]]\nentry = \"shear_rate.scale\"\nuniform = [2, 1]\n" + design("random", 3) +
           kOutputs,
       "must ascend"},
      {kStudyScene + kTwo + kTwo + design("random", 3) + kOutputs, "must not vary twice"},
      {kStudyScene + kTwo + design("fit", 3) + kOutputs, "must be fit or replicates for a fit file"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(report(text).find(expected), std::string::npos) << text << "gives\n" << report(text);
}

}  // namespace
}  // namespace shearfront::fit
