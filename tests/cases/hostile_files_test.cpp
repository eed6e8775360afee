// SPDX-License-Identifier: BSD-3-Clause
// Files that are deep or long: refused in a line, not by a stack that overflows or a message of megabytes.
#include <gtest/gtest.h>

#include <string>

#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"

namespace shearfront {
namespace {

std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

std::string complaint_about(const std::string& toml) {
  try {
    (void)parse_scene<double>(toml, "scene.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

const std::string kGood =
    "[shear_rate]\nmodel = \"piecewise\"\nbreaks = []\nvalues = [1]\n[initial]\nbreaks = []\nvalues = "
    "[0.5]\n";

// Kind of fault: recursion as deep as the input says. 50,000 names overflowed the stack.
TEST(HostileFiles, DeepKeysAreRefusedBeforeTheyAreParsed) {
  const std::string too_deep = "key: must have at most 32 names";
  for (const int n : {33, 1000, 50'000, 1'000'000}) {
    const std::string more = repeated(".a", n - 1), quoted = repeated(" . \"a\"", n - 1);
    for (const std::string& text :
         {"[a" + more + "]\n", "[[a" + more + "]]\n", "a" + more + " = 1\n", "'a'" + quoted + " = 1\n",
          "x = { a" + more + " = 1 }\n", "[b]\n[a" + more}) {
      const std::string why = complaint_about(kGood + text);
      EXPECT_NE(why.find(too_deep), std::string::npos) << n << why.substr(0, 200);
      EXPECT_TRUE(why.starts_with("scene.toml:")) << why.substr(0, 200);
    }
  }
}

TEST(HostileFiles, ValuesAndRemarksAreNoKeys) {
  const std::string words = repeated("a.", 100);
  EXPECT_EQ(complaint_about("name = \"" + words + "\" # " + words + "\n" + kGood), "none");
  EXPECT_EQ(complaint_about("# " + words + " '\n" + kGood), "none");
  EXPECT_EQ(complaint_about("name = '" + words + "'\n" + kGood + "# \"\"\" " + words), "none");
  const std::string many =
      kGood + "[packing]\nmodel = \"table\"\nz = [" + repeated("0.5, 0.25,\n", 200) + "]\n";
  EXPECT_EQ(complaint_about(many).find("names"), std::string::npos);
}

TEST(HostileFiles, NestedValuesAndLongLinesAreRefusedInALine) {
  for (const int n : {300, 100'000}) {
    for (const std::string& text :
         {"x = " + repeated("[", n), "x = " + repeated("{a=", n), "x = " + repeated("{a.a.a.a.a.a.a.a = ", n),
          "x = \"" + repeated("\\\"", n), repeated("[", n), "x = " + repeated("'", n), repeated("=", n),
          std::string(100'000, 'a') + " = 1\n" + kGood, "x = " + std::string(100'000, '1') + "\n" + kGood}) {
      const std::string why = complaint_about(text);
      EXPECT_LT(why.size(), 1000) << text.substr(0, 20);
      EXPECT_TRUE(why.starts_with("scene.toml:")) << why.substr(0, 200);
    }
  }
}

// The states of a start were looked at though nobody had checked its points, for there was no domain to check them in: a crash,
// found by mutations of files. The kind: a look at values that only a check before it makes safe.
TEST(HostileFiles, EmptyTablesInADomainThatIsNoneAreComplaints) {
  for (const char* table : {"[initial]\nmodel = \"table\"\nz = []\nvalues = []\n", "[initial]\nvalues = []\n",
                            "[initial]\nmodel = \"table\"\nz = [0]\nvalues = []\n"}) {
    const std::string why = complaint_about(
        std::string("[shear_rate]\nmodel = \"table\"\nz = []\nvalues = []\n[solid_fraction]\nmodel = "
                    "\"table\"\nz = []\n"
                    "values = []\n[diffusion]\nD = 1\nmodel = \"table\"\nz = []\nvalues = []\n") +
        table + "[domain]\nbottom = 1\ntop = 1\n");
    EXPECT_NE(why.find("domain.top = 1; must be greater than domain.bottom (1)"), std::string::npos) << why;
  }
}

TEST(HostileFiles, ManyComplaintsAreCounted) {
  const std::string why = complaint_about(
      "[shear_rate]\nmodel = \"piecewise\"\nbreaks = []\nvalues = [1]\n[initial]\nbreaks = []\nvalues = [" +
      repeated("7,", 20'000) + "]\n");
  EXPECT_LT(why.size(), 200'000);
  EXPECT_NE(why.find("more problems"), std::string::npos);
}

TEST(HostileFiles, LongRowsOfObservationsAreRefusedInALine) {
  for (const std::string& text :
       {"t,z,phi\n" + repeated(",", 1'000'000), repeated(",", 1'000'000),
        "t,z,phi\n1,1," + std::string(1'000'000, '1'), "t,z,phi\n\"" + repeated("\"\"", 500'000),
        "t,z," + std::string(1'000'000, 'x') + "\n1,1,1\n"}) {
    try {
      (void)parse_observations(text, "data.csv");
      ADD_FAILURE() << text.substr(0, 40);
    } catch (const InputError& error) {
      EXPECT_LT(std::string(error.what()).size(), 1000);
    }
  }
}

}  // namespace
}  // namespace shearfront
