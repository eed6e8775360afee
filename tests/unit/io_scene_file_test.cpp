// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/digits/real110.hpp"
#include "shearfront/io/scene_file.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <variant>

namespace shearfront {
namespace {

const std::string kInitial = "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n";

std::string piecewise(const std::string& breaks, const std::string& values) {
  return "[shear_rate]\nmodel = \"piecewise\"\nbreaks = " + breaks + "\nvalues = " + values + "\n";
}

template <Real S>
S first_value(const std::string& literal) {
  const auto scene = parse_scene<S>(piecewise("[]", "[" + literal + "]") + kInitial, "scene.toml");
  return std::get<Piecewise<S>>(scene.shear_rate()).values.at(0);
}

std::string report(const std::string& text) {
  try {
    (void)parse_scene<double>(text, "scene.toml");
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneFile, DoubleIsTheNearestToTheText) {
  for (const char* literal : {"0.31", "2.4", "1e-300", "4.9e-324", "1.7976931348623157e308", "6_0.2_5"}) {
    std::string plain;
    for (const char* c = literal; *c != '\0'; ++c)
      if (*c != '_') plain += *c;
    EXPECT_EQ(first_value<double>(literal), std::strtod(plain.c_str(), nullptr)) << literal;
  }
  EXPECT_EQ(first_value<double>("+3"), 3.0);
  EXPECT_EQ(first_value<double>("0x10"), 16.0);
  EXPECT_EQ(first_value<double>("12345678901234567890123"), 12345678901234567890123.0);
}

TEST(SceneFile, MultiprecisionTakesTheDecimalAndNotItsDouble) {
  EXPECT_EQ(first_value<Real110>("0.31"), Real110("0.31"));
  EXPECT_NE(first_value<Real110>("0.31"), Real110(0.31));
  EXPECT_EQ(first_value<Real110>("31_00.00e-4"), Real110("0.31"));
  const std::string digits =
      "4.2439024390243902439024390243902439024390243902439024390243902439024390243902439024390";
  EXPECT_EQ(first_value<Real110>(digits), Real110(digits));
  const std::string many = "0." + std::string(300, '3');  // longer than what the TOML parser itself accepts
  EXPECT_EQ(first_value<Real110>(many), Real110(many));
  EXPECT_EQ(first_value<Real110>("0.00" + std::string(250, '0') + "1e255"), Real110("100"));
}

TEST(SceneFile, RepeatsWhatTheFileSays) {
  const auto scene = parse_scene<double>("name = \"bed\"\n" + piecewise("[0.29]", "[2.4, 0.31]") +
                                             "scale = 13.6\n" + kInitial + "[domain]\nbottom = -1\ntop = 2\n",
                                         "scene.toml");
  EXPECT_EQ(scene.name(), "bed");
  EXPECT_EQ(scene.scale(), 13.6);
  EXPECT_EQ(scene.bottom(), -1);
  EXPECT_EQ(scene.top(), 2);
  EXPECT_EQ(scene.initial_breaks(), std::vector<double>{0.5});
  EXPECT_EQ(scene.initial_values(), (std::vector<double>{0, 1}));
}

TEST(SceneFile, DefaultsAreUnitDomainScaleOneAndTheNameOfTheFile) {
  const auto scene = parse_scene<double>(piecewise("[]", "[1]") + kInitial, "some/where/bed.toml");
  EXPECT_EQ(scene.name(), "bed");
  EXPECT_EQ(scene.scale(), 1);
  EXPECT_EQ(scene.bottom(), 0);
  EXPECT_EQ(scene.top(), 1);
  EXPECT_TRUE(scene.is_plain());
}

TEST(SceneFile, EveryModelOfTheListCanBeWritten) {
  DepthFunctionList<double>::for_each([]<class Model>() {
    const Model sample = Model::samples().front();
    std::string text = "[shear_rate]\nmodel = \"" + std::string(Model::kName) + "\"\n";
    Model::fields(sample, [&](const FieldInfo& info, const auto& member) {
      text += std::string(info.key) + " = ";
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>) {
        text += number_text(member);
      } else {
        text += "[";
        for (const double x : member) text += number_text(x) + ", ";
        text += "]";
      }
      text += "\n";
    });
    const auto scene = parse_scene<double>(text + kInitial, "scene.toml");
    for (const double z : {0.0, 0.3, 0.7, 1.0}) EXPECT_EQ(scene.shear_rate_at(z), sample.value(z)) << text;
  });
}

TEST(SceneFile, ProblemsComeInTheOrderOfTheFile) {
  EXPECT_EQ(
      report("[initial]\nbreaks = [0.5]\nvalues = [0, 7]\n" + piecewise("[2]", "[1, 0]") + "scale = \"s\"\n"),
      "scene.toml:3:10: initial.values[1] = 7; must be between 0 and 1\n"
      "scene.toml:6:10: shear_rate.breaks[0] = 2; must be inside the domain (0, 1)\n"
      "scene.toml:7:10: shear_rate.values[1] = 0; must be > 0\n"
      "scene.toml:8:9: shear_rate.scale = \"s\"; must be a number");
}

TEST(SceneFile, WhatFollowsFromAProblemIsNotReportedAgain) {
  EXPECT_EQ(report(piecewise("\"none\"", "[1, 2, 3]") + kInitial),
            "scene.toml:3:10: shear_rate.breaks = \"none\"; must be an array of numbers");
  EXPECT_EQ(report(piecewise("[0.5]", "[1, 2]") + kInitial + "[domain]\ntop = true\n"),
            "scene.toml:9:7: domain.top = true; must be a number");
}

TEST(SceneFile, ElementsOnLinesOfTheirOwnAreReportedThere) {
  EXPECT_EQ(report(piecewise("[0.5]", "[\n  1, # é\n  -2,\n]") + kInitial),
            "scene.toml:6:3: shear_rate.values[1] = -2; must be > 0");
}

TEST(SceneFile, ColumnsCountCharacters) {
  EXPECT_EQ(report("name = \"é€𝄞\\t\" ; x\n"),
            "scene.toml:1:16: syntax error: in key-value pair: expected a comment or "
            "whitespace, saw ';'");
}

TEST(SceneFile, ReportCarriesEveryProblem) {
  try {
    (void)parse_scene<double>(piecewise("[0.5]", "[0, -1]") + kInitial, "scene.toml");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.complaints().size(), 2U);
    EXPECT_EQ(error.complaints()[1].key, "shear_rate.values[1]");
    EXPECT_EQ(error.complaints()[1].value, "-1");
    EXPECT_EQ(error.complaints()[1].constraint, "must be > 0");
  }
}

TEST(SceneFile, ValidityDoesNotDependOnTheScalar) {
  for (const char* literal : {"1e400", "1e-400", "1e999999999999999999999", "-1", "nan", "inf", "0"}) {
    EXPECT_THROW(first_value<double>(literal), FileError) << literal;
    EXPECT_THROW(first_value<Real110>(literal), FileError) << literal;
  }
}

TEST(SceneFile, ManyEntriesAreReadFast) {
  std::string breaks = "[", values = "[";
  constexpr int kEntries = 100000;  // a tenth, for instrumented builds
  for (int i = 1; i <= kEntries; ++i) {
    breaks += std::to_string(i) + "e-6, ";
    values += "1.5, ";
  }
  const auto scene =
      parse_scene<double>("# é\n" + piecewise(breaks + "]", values + "2]") + kInitial, "scene.toml");
  EXPECT_EQ(scene.shear_rate_at(0.9), 2);
}

TEST(SceneFile, FilesThatCannotBeReadSaySo) {
  EXPECT_THROW((void)read_scene<double>("/nonexistent/scene.toml"), FileError);
  EXPECT_THROW((void)read_scene<double>("/"), FileError);
}

}  // namespace
}  // namespace shearfront
