// SPDX-License-Identifier: BSD-3-Clause
// What handles complaints sees their kind and never searches their text; a scene is checked once.
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "shearfront/io/scene_file.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront {
namespace {

using Kind = Complaint::Kind;

Complaints complaints_of(const std::string& text) {
  try {
    (void)parse_scene<double>(text, "scene.toml");
  } catch (const InputError& error) {
    return error.complaints();
  }
  return {};
}

std::vector<std::pair<std::string, Kind>> kinds_of(const std::string& text) {
  std::vector<std::pair<std::string, Kind>> all;
  for (const Complaint& complaint : complaints_of(text)) all.emplace_back(complaint.key, complaint.kind);
  return all;
}

const std::string kRate = "[shear_rate]\nmodel = \"piecewise\"\nbreaks = []\nvalues = [1]\n";

TEST(Complaints, OfASceneFileHaveAKind) {
  using Kinds = std::vector<std::pair<std::string, Kind>>;
  const std::string initial = "[initial]\nbreaks = [0.5]\nvalues = ";
  EXPECT_EQ(kinds_of(kRate + initial + "[0, 1]"), Kinds{});
  EXPECT_EQ(kinds_of(kRate + initial + "[0, 2]"), (Kinds{{"initial.values[1]", Kind::out_of_range}}));
  EXPECT_EQ(kinds_of(kRate + initial + "[0]"), (Kinds{{"initial.values", Kind::wrong_length}}));
  EXPECT_EQ(kinds_of(kRate + initial + "true"), (Kinds{{"initial.values", Kind::wrong_type}}));
  EXPECT_EQ(kinds_of(kRate), (Kinds{{"initial", Kind::missing}}));
  EXPECT_EQ(kinds_of("nam = 1\n" + kRate + initial + "[0, 1]"), (Kinds{{"nam", Kind::unknown}}));
  EXPECT_EQ(kinds_of(kRate + "["), (Kinds{{"syntax error", Kind::syntax}}));
  try {
    (void)read_scene<double>("/nowhere/scene.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaints().at(0).kind, Kind::unreadable);
  }
}

TEST(Complaints, OfASpecificationAreReturnedOrThrown) {
  SceneSpec<double> spec;
  spec.shear_rate = Piecewise<double>{{}, {1}};
  spec.initial_values = {0.5};
  EXPECT_EQ(std::get<Scene<double>>(Scene<double>::make(spec)).mass(), 0.5);
  spec.initial_values = {0.5, 2};
  const auto made = Scene<double>::make(spec);
  const auto& complaints = std::get<Complaints>(made);
  ASSERT_EQ(complaints.size(), 2u);
  EXPECT_EQ(complaints[0].kind, Kind::wrong_length);
  EXPECT_EQ(complaints[1].kind, Kind::out_of_range);
  EXPECT_THROW(Scene<double>{spec}, InputError);
}

TEST(OldNames, AreReadAndRemarkedOn) {
  const std::string rest = kRate + "[initial]\nbreaks = []\nvalues = [0.5]\n";
  const auto scene_of = [&](const std::string& first) {
    return parse_scene<double>(first + rest, "scene.toml");
  };
  const auto small = scene_of("[flux]\nmodel = \"packed\"\n");
  EXPECT_TRUE(small.fluxes()[0].as<Quadratic<double>>());
  EXPECT_FALSE(small.counts_rising_grains());
  const auto large = scene_of(
      "[flux]\nmodel = \"packed\"\ngrains = \"large\"\n[packing]\nmodel = \"piecewise\"\n"
      "breaks = []\nvalues = [0.6]\n");
  EXPECT_TRUE(large.fluxes()[0].as<Lwr<double>>());
  EXPECT_TRUE(large.counts_rising_grains());
  EXPECT_EQ(large.solid_fraction_at(0.5), 0.6);
  EXPECT_EQ(large.spec().remarks,
            (std::vector<std::string>{"scene.toml: flux.model = \"packed\" is the old name of \"lwr\"",
                                      "scene.toml: [packing] is the old name of [solid_fraction]"}));
  EXPECT_TRUE(scene_of("").spec().remarks.empty());
}

}  // namespace
}  // namespace shearfront
