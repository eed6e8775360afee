// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/scene_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "shearfront/io/scene_file.hpp"
#include "shearfront/scene/entries.hpp"

/// Scenes that are written read back as the same scenes, and numbers set from outside take the place of those read.
namespace shearfront {
namespace {

std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SHEARFRONT_SOURCE_DIR "/datasets")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("scene") && name.ends_with(".toml")) files.push_back(entry.path().string());
  }
  return files;
}

void expect_same(SceneSpec<double> a, SceneSpec<double> b, const std::string& what) {
  EXPECT_EQ(a.name, b.name) << what;
  EXPECT_EQ(a.units, b.units) << what;
  EXPECT_EQ(a.is_neumann, b.is_neumann) << what;
  EXPECT_EQ(a.is_periodic, b.is_periodic) << what;
  const auto names = entries(a), again = entries(b);
  const auto places = entry_places(a), others = entry_places(b);
  ASSERT_EQ(names.size(), again.size()) << what;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(names[i].name(), again[i].name()) << what;
    EXPECT_EQ(*places[i], *others[i]) << what << ": " << names[i].name();
  }
}

TEST(SceneText, EveryDataSetReadsBack) {
  std::size_t n = 0;
  for (const std::string& file : scene_files()) {
    const Scene<double> scene = read_scene<double>(file);
    const std::string text = scene_text(scene.spec());
    const Scene<double> again = parse_scene<double>(text, file);
    expect_same(scene.spec(), again.spec(), file);
    EXPECT_EQ(scene_text(again.spec()), text) << file;
    ++n;
  }
  EXPECT_GE(n, 20u);
}

TEST(SceneText, EveryKindOfEntryReadsBack) {
  const std::string text =
      "name = \"a \\\"bed\\\" of \\\\ \\u0007\"\n"
      "[[flux]]\nmodel = \"cubic\"\nscaling = \"quadratic-extremum\"\ngamma = 0.1\n"
      "[[flux]]\nmodel = \"quadratic\"\nabove = 0.3\n"
      "[shear_rate]\nmodel = \"table\"\nz = [0, 0.5, 0.5, 1]\nvalues = [1, 2, 3, 0.1]\nscale = 0.7\n"
      "[solid_fraction]\nmodel = \"table\"\nz = [0, 1]\nvalues = [0.6, 0.5]\n"
      "[initial]\nbreaks = [0.25]\nvalues = [0, 0.9]\n"
      "[boundary.bottom]\nbreaks = [1, 2]\nvalues = [0, 0.5, 1]\n"
      "[units]\nz = \"mm\"\nt = \"s\"\n";
  const Scene<double> scene = parse_scene<double>(text, "scene.toml");
  const Scene<double> again = parse_scene<double>(scene_text(scene.spec()), "scene.toml");
  expect_same(scene.spec(), again.spec(), "made up");
  EXPECT_EQ(scene_text(scene.spec()), scene_text(again.spec()));
}

TEST(SceneChanges, TakeThePlaceOfNumbers) {
  const std::string text =
      "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.3]\nvalues = [2, 1]\n[initial]\nbreaks = "
      "[0.5]\nvalues = [0, 1]\n";
  const auto changed = [&](const SceneChanges& changes) {
    return parse_scene<double>(text, "scene.toml", changes);
  };
  EXPECT_EQ(changed({{"shear_rate.values[1]", "0.4"}}).shear_rate_at(0.9), 0.4);
  EXPECT_EQ(changed({{"shear_rate.scale", "3"}}).scale(), 3);
  EXPECT_EQ(changed({{"domain.top", "2"}, {"initial.breaks[0]", "1.5"}}).top(), 2);
  const auto refusal = [&](const std::string& key, const std::string& value) {
    try {
      (void)changed({{key, value}});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal("shear_rate.values[1]", "-1"), "--set shear_rate.values[1] = -1; must be > 0");
  EXPECT_NE(refusal("shear_rate.values[2]", "1").find("shear_rate.values[0] to shear_rate.values[1]"),
            std::string::npos);
  EXPECT_NE(refusal("shear_rate.values", "1").find("must name one of its numbers"), std::string::npos);
  EXPECT_NE(refusal("shear_rate.scale[0]", "1").find("the entry is one number"), std::string::npos);
  EXPECT_NE(refusal("shear_rate.value[0]", "1").find("did you mean shear_rate.values?"), std::string::npos);
  EXPECT_NE(refusal("shear_rate.scale", "x").find("must be a number"), std::string::npos);
}

}  // namespace
}  // namespace shearfront
