// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/io/observations_csv.hpp"

/// What the reader of observations refuses. The exact messages are those of the command-line cases
/// (tests/cli/observations-*.txt); here is what a small file cannot show.
namespace shearfront {
namespace {

std::string report(const std::string& text, double bottom = 0, double top = 1) {
  try {
    (void)parse_observations(text, "data.csv", bottom, top);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

std::string rows(const std::string& row, std::size_t n) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text += row;
  return text;
}

TEST(ObservationRefusals, OneOfEachKind) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "header: missing"},
      {"t,z,phi\n", "rows: missing"},
      {"0,0.5,1\n", "header: missing"},
      {"t,z,phi,t\n0,0.5,1,0\n", "must not occur twice"},
      {"t,z,phi,M\n0,0.5,1,0\n", "must not stand beside phi"},
      {"t,z,M,phi\n0,0.5,1,0\n", "must not stand beside M"},
      {"t,z,M,width\n0,0.5,1,0.1\n", "must not stand beside M"},
      {"t,z,phi_small\n0,0.5,1\n", "rename phi_small if that is meant"},
      {"t,z,phi,widht\n0,0.5,1,0.1\n", "must be called width"},
      {"t,z,phi,sigma [mm]\n0,0.5,1,0.1\n", "must have the unit of phi"},
      {"t,z,phi\n0,0.5\n", "row[0] = (2 fields); must have 3"},
      {"t,z,phi\n0,0.5,x\n", "must be a number"},
      {"t,z,phi\n0,0.5,inf\n", "must be a finite number"},
      {"t,z,phi\n0,0.5,nan\n", "missing in every row (1)"},
      {"t,z,phi\n0,0.5,1e400\n", "must be 0 or between"},
      {"t,z,phi\n-1,0.5,1\n", "t[0] = -1; must be >= 0"},
      {"t,z,phi\n0,1.5,1\n", "must be inside the domain [0, 1]"},
      {"t,z,phi,width\n0,0.5,1,1.5\n", "must leave the bin"},
      {"t,z,phi,width\n0,0.5,1,0\n", "width[0] = 0; must be > 0"},
      {"t,z,phi,sigma\n0,0.5,1,0\n", "sigma[0] = 0; must be > 0"},
      {"t,z,phi,sigma\n0,0.5,1,1\n0,0.6,1,\n", "sigma[1]: missing"},
      {"t,z,phi\n0,0.5,1\n0,0.5,1\n", "must differ from z of line 2"},
      {"t,z,phi\n0,0.5,\n", "missing in every row (1)"},
      {std::string("t,z,phi\n0,0.5,\0", 15), "NUL byte"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(report(text).find(expected), std::string::npos) << text << "gives\n" << report(text);
}

TEST(ObservationRefusals, OnlyTheFirstProblemsAreShown) {
  const std::string text = "t,z,phi\n" + rows("0,0.5,x\n", kMostComplaints);
  EXPECT_EQ(report(text).find(" more "), std::string::npos);
  EXPECT_TRUE(report(text + "0,0.5,x\n").ends_with("\ndata.csv: and 1 more problem"));
  const std::string many = report("t,z,phi\n" + rows("0,0.5,x\n", 12345));
  EXPECT_TRUE(
      many.ends_with("phi[19] = \"x\"; must be a number, or empty or NA if it is missing\n"
                     "data.csv: and 12325 more problems"))
      << many;
  EXPECT_EQ(static_cast<std::size_t>(std::count(many.begin(), many.end(), '\n')), kMostComplaints);
}

/// Complaints between rows are found last and belong further up.
TEST(ObservationRefusals, ProblemsBetweenRowsCountInTheOrderOfTheFile) {
  const std::string twice = report("t,z,phi\n" + rows("0,0.5,1\n", 2) + rows("0,0.5,x\n", 30));
  EXPECT_TRUE(
      twice.starts_with("data.csv:3:3: z[1] = 0.5; must differ from z of line 2, which has the same t; or be "
                        "kept or averaged by "
                        "replicates = \"keep\" or \"mean\"\ndata.csv:4:7: phi[2] = \"x\""))
      << twice;
  EXPECT_TRUE(twice.ends_with("\ndata.csv: and 11 more problems"));
}

TEST(ObservationRefusals, SamePlaceFarApartIsFound) {
  std::string text = "t,z,phi\n";
  for (int i = 1000; i > 0; --i) text += std::to_string(i) + ",0.5,1\n";
  EXPECT_EQ(
      report(text + "500.0,5e-1,1\n"),
      "data.csv:1002:7: z[1000] = 0.5; must differ from z of line 502, which has the same t; or be kept or "
      "averaged by replicates = \"keep\" or \"mean\"");
}

TEST(ObservationRefusals, DomainOfTheScene) {
  const std::string text = "t,z,phi\n0,-2,0\n0,30,1\n";
  EXPECT_EQ(report(text, -2, 30), "accepted");
  EXPECT_EQ(report(text, -1, 30), "data.csv:2:3: z[0] = -2; must be inside the domain [-1, 30]");
}

TEST(ObservationRefusals, TooManyColumns) {
  EXPECT_EQ(report("t,z,phi" + std::string(998, ',') + "\n"),
            "data.csv:1:1: header = (1001 columns); must have at most 1000");
}

TEST(ObservationRefusals, BinsWithoutADomainHaveFiniteEdges) {
  EXPECT_NE(report("t,z,phi,width\n0,1.7e308,1,1.7e308\n", -INFINITY, INFINITY).find("must leave the bin"),
            std::string::npos);
}

/// As fast as a good file: nothing is quadratic in the number of problems.
TEST(SlowObservationRefusals, AMillionProblems) {
  const std::string bad = "t,z,phi\n" + rows("0,0.5,x\n", 1'000'000),
                    same = "t,z,phi\n" + rows("0,0.5,1\n", 1'000'000);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(report(bad).ends_with("and 999980 more problems"));
  EXPECT_TRUE(report(same).ends_with("and 999979 more problems"));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 20);
}

}  // namespace
}  // namespace shearfront
