// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/fit_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "shearfront/fit.hpp"
#include "shearfront/io/method_text.hpp"

namespace shearfront::fit {
namespace {

namespace fs = std::filesystem;

const std::string kFittedScene =
    "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.5]\nvalues = [2, 1]\n"
    "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n";
const std::string kData = "t,z,M\n0.2,0.25,0\n0.2,0.5,0.05\n0.4,0.5,0.1\n";
const std::string kFit =
    "scene = \"scene.toml\"\nobservations = \"data.csv\"\n[unknown]\nparameters = [\"shear_rate.values\"]\n";

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

/// A folder with a scene and observations.
class FitFiles : public testing::Test {
 protected:
  FitFiles() {
    std::string pattern = (fs::temp_directory_path() / "shearfront-fit-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    write(folder_ / "scene.toml", kFittedScene);
    write(folder_ / "data.csv", kData);
  }
  ~FitFiles() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string file() const { return (folder_ / "fit.toml").string(); }
  [[nodiscard]] FitSpec parse(const std::string& text) const { return parse_fit(text, file()).spec; }
  /// The report without the folder.
  [[nodiscard]] std::string report(const std::string& text) const {
    try {
      (void)parse_fit(text, file());
    } catch (const FileError& error) {
      std::string all = error.what();
      const std::string prefix = folder_.string() + "/";
      for (std::size_t i = all.find(prefix); i != std::string::npos; i = all.find(prefix))
        all.erase(i, prefix.size());
      EXPECT_EQ(static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n')) + 1,
                error.complaints().size());
      return all;
    }
    return "accepted";
  }

  fs::path folder_;
};

TEST_F(FitFiles, OfASceneAndObservationsInMemoryIsThatOfTheFiles) {
  const Scene<double> scene = parse_scene<double>(kFittedScene, "scene");
  const std::string settings = kFit.substr(kFit.find("[unknown]"));
  const FitFile memory = parse_fit(settings, "fit", scene, parse_observations(kData, "data", scene));
  const Estimate expected = fit(parse(kFit)), found = fit(memory.spec);
  ASSERT_TRUE(found.usable());
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(found.parameters.at(i).estimate, expected.parameters.at(i).estimate);
  EXPECT_EQ(memory.scene + memory.observations, "");
  // Names of files have no place beside them.
  EXPECT_THROW((void)parse_fit(kFit, "fit", scene, parse_observations(kData, "data", scene)), FileError);
}

TEST_F(FitFiles, DefaultsAreThoseOfTheSpecification) {
  const FitSpec spec = parse(kFit);
  EXPECT_EQ(spec.name, "fit");
  EXPECT_EQ(spec.scene.name(), "scene");
  EXPECT_EQ(spec.observations.rows.size(), 3U);
  EXPECT_EQ(spec.unknown.parameters, std::vector<std::string>{"shear_rate.values"});
  EXPECT_TRUE(spec.unknown.start.empty() && spec.unknown.lower.empty() && spec.unknown.upper.empty());
  EXPECT_EQ(spec.unknown.shape, Shape::none);
  EXPECT_EQ(settings(spec.forward.method), settings(Method()));
  EXPECT_FALSE(spec.misfit.loss_scale.has_value() || spec.misfit.two_stage.has_value());
  EXPECT_EQ(spec.search.algorithm, SearchSpec{}.algorithm);
  EXPECT_EQ(spec.search.tolerance, SearchSpec{}.tolerance);
  EXPECT_EQ(quantity_of(spec), "cumulative");
  EXPECT_EQ(loss_of(spec), "squared");
}

TEST_F(FitFiles, EveryEntryIsTaken) {
  const FitSpec spec =
      parse("name = \"both rates\"\n" + kFit +
            "start = [2.5, 0.7]\nlower = [0.01, 1e-2]\nupper = [20, inf]\nshape = \"convex\"\n"
            "[forward]\nmethod = \"front-tracking\"\nresolution = 0.02\nmax_collisions = 1_000\ncfl = "
            "0.9\nlayers = 50\n"
            "grid = \"singular-mapping\"\nreconstruct = \"linear\"\n"
            "[misfit]\nquantity = \"bin\"\nloss = \"cauchy\"\nloss_scale = 3\ntwo_stage = false\n"
            "[search]\nalgorithm = \"ceres\"\nstarts = 0x10\nseed = 9007199254740991\nmax_evaluations = 1e4\n"
            "tolerance = 1e-6\n"
            "[uncertainty]\nprofile = true\nbootstrap = 200\nseed = 0\nthreads = 1\n");
  EXPECT_EQ(spec.name, "both rates");
  EXPECT_EQ(spec.unknown.start, (std::vector<double>{2.5, 0.7}));
  EXPECT_EQ(spec.unknown.lower, (std::vector<double>{0.01, 0.01}));
  EXPECT_EQ(spec.unknown.upper, (std::vector<double>{20, std::numeric_limits<double>::infinity()}));
  EXPECT_EQ(spec.unknown.shape, Shape::convex);
  EXPECT_EQ(settings(spec.forward.method),
            "--method front-tracking --resolution 0.02 --grid singular-mapping --reconstruct linear "
            "--max-collisions 1000");
  EXPECT_EQ(quantity_of(spec), "bin");
  EXPECT_EQ(loss_of(spec), "cauchy");
  EXPECT_EQ(spec.misfit.loss_scale, 3);
  EXPECT_EQ(spec.misfit.two_stage, false);
  EXPECT_EQ(spec.search.starts, 16U);
  EXPECT_EQ(spec.search.seed, 9007199254740991U);
  EXPECT_EQ(spec.search.max_evaluations, 10000U);
  EXPECT_EQ(spec.search.tolerance, 1e-6);
  EXPECT_TRUE(spec.uncertainty.profile);
  EXPECT_EQ(spec.uncertainty.bootstrap, 200U);
  EXPECT_EQ(spec.uncertainty.seed, 0U);
  EXPECT_EQ(spec.uncertainty.threads, 1U);
}

TEST_F(FitFiles, PaperSettingsAreAStoppingRuleThatOtherEntriesOverrule) {
  EXPECT_EQ(parse(kFit + "[search]\nsettings = \"paper\"\n").search.tolerance, 1e-3);
  EXPECT_EQ(parse(kFit + "[search]\nsettings = \"default\"\n").search.tolerance, SearchSpec{}.tolerance);
  const SearchSpec search = parse(kFit + "[search]\ntolerance = 1e-4\nsettings = \"paper\"\n").search;
  EXPECT_EQ(search.tolerance, 1e-4);
  EXPECT_EQ(search.max_evaluations, 2000U);
}

TEST_F(FitFiles, NamesAreRelativeToTheFile) {
  fs::create_directory(folder_ / "fits");
  std::string text = kFit;
  text.replace(text.find("scene.toml"), 10, "../scene.toml");
  text.replace(text.find("data.csv"), 8, (folder_ / "data.csv").string());
  write(folder_ / "fits" / "a.toml", text);
  const FitFile fit = read_fit_file((folder_ / "fits" / "a.toml").string());
  EXPECT_EQ(fit.spec.name, "a");
  EXPECT_EQ(fit.scene, (folder_ / "fits" / "../scene.toml").string());
  EXPECT_EQ(fit.observations, (folder_ / "data.csv").string());
}

TEST_F(FitFiles, ProblemsOfAllFilesComeTogetherEachWithItsOwnPlace) {
  write(folder_ / "scene.toml", kFittedScene + "[domain]\ntop = -1\n");
  write(folder_ / "data.csv", kData + "-1,0.5,0.1\n");
  EXPECT_EQ(report(kFit + "start = [2, 0]\n[search]\nstarts = 0\n"),
            "fit.toml:7:10: search.starts = 0; must be a whole number from 1 to 1000000\n"
            "scene.toml:9:7: domain.top = -1; must be greater than domain.bottom (0)\n"
            "data.csv:5:1: t[3] = -1; must be >= 0");
}

TEST_F(FitFiles, WrongNumbersHideOnlyWhatFollowsFromThem) {
  std::string text = kFit + "start = [2, \"x\", 1]\nlower = [3, nan]\n";
  text.replace(text.find("values"), 6, "valus");
  const std::string all = report(text);
  EXPECT_TRUE(all.starts_with("fit.toml:4:14: unknown.parameters[0] = \"shear_rate.valus\"; must be one of"));
  EXPECT_TRUE(
      all.ends_with("fit.toml:5:9: unknown.start[1] = \"x\"; must be a number\n"
                    "fit.toml:6:9: unknown.lower[1] = nan; must be a number or inf"))
      << all;
}

TEST_F(FitFiles, AFitAndASceneAreToldApart) {
  write(folder_ / "fit.toml", kFit);
  EXPECT_TRUE(std::holds_alternative<FitFile>(read_scene_or_fit(file())));
  EXPECT_TRUE(std::holds_alternative<Scene<double>>(read_scene_or_fit((folder_ / "scene.toml").string())));
  write(folder_ / "fit.toml", "");
  EXPECT_THROW((void)read_scene_or_fit(file()), FileError);
}

TEST_F(FitFiles, ARefusalOfTheFitIsLocatedInItsFile) {
  write(folder_ / "fit.toml", kFit + "start = [3,\n  4]\n");
  const FileError error = located(InputError(Complaints{{"unknown.start[1]", "4", "must be less"},
                                                        {"search.algorithm", "\"x\"", "must be y"}}),
                                  file());
  EXPECT_EQ(std::string(error.what()), file() + ":1:1: search.algorithm = \"x\"; must be y\n" + file() +
                                           ":6:3: unknown.start[1] = 4; must be less");
}

}  // namespace
}  // namespace shearfront::fit
