// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <variant>

#include "shearfront/io/scene_file.hpp"
#include "support/own_folder.hpp"

/// Tables of a scene from other files are the same scene as with the numbers in it.
namespace shearfront {
namespace {

/// A folder of its own with these files.
class Folder {
 public:
  explicit Folder(const std::string& name) : path_((support::own_folder() / (name + "-")).string()) {}
  Folder& with(const std::string& file, const std::string& text) {
    std::FILE* out = std::fopen((path_ + file).c_str(), "wb");
    std::fwrite(text.data(), 1, text.size(), out);
    std::fclose(out);
    return *this;
  }
  /// Files named by the scene begin with what the path of the folder ends in.
  [[nodiscard]] Scene<double> scene(std::string text) const {
    const std::string prefix = path_.substr(path_.rfind('/') + 1);
    for (std::size_t at = text.find("@"); at != std::string::npos; at = text.find("@"))
      text.replace(at, 1, prefix);
    return parse_scene<double>(text, path_ + "scene.toml");
  }

 private:
  std::string path_;
};

Scene<double> in_one_file(const std::string& text) { return parse_scene<double>(text, "scene.toml"); }

constexpr const char* kRestOfScene =
    "[initial]\nbreaks = [21]\nvalues = [0, 1]\n[domain]\ntop = 42\n[units]\nz = \"mm\"\nt = \"s\"\n";

void expect_same_rate(const Scene<double>& a, const Scene<double>& b) {
  for (const double z : {0.5, 7.0, 20.0, 31.0, 41.0})
    EXPECT_NEAR(a.mean_rate(z, z + 0.5), b.mean_rate(z, z + 0.5), 1e-14) << z;
}

TEST(SceneColumns, ATableIsThatOfTheFile) {
  const auto inside =
      in_one_file("[shear_rate]\nmodel = \"table\"\nz = [0, 21, 42]\nvalues = [2.5, 1.25, 0.5]\n" +
                  std::string(kRestOfScene));
  const std::string scene =
      "[shear_rate]\nmodel = \"table\"\nfile = \"@a.csv\"\nz = \"height\"\nvalues = \"rate\"\n";
  // In mm, in cm with rates in cm per minute, with decimal commas, between blanks, with more columns.
  for (const char* csv :
       {"height,rate\n0,2.5\n21,1.25\n42,0.5\n", "height [cm],rate [cm/min]\n0,15\n2.1,7.5\n4.2,3\n",
        "height (cm);rate\n0;2,5\n2,1;1,25\n4,2;,5\n", "height rate\n 0   2.5\n21 1.25\n42 .5\n",
        "# by laser\nrun 7\nx,rate,height\n,mm/s,mm\n1,2.5,0\n,1.25,21\n\n2,0.5,42\n,,\n"}) {
    SCOPED_TRACE(csv);
    expect_same_rate(Folder("table").with("a.csv", csv).scene(scene + kRestOfScene), inside);
  }
}

TEST(SceneColumns, PiecesBeginWhereTheirRowsSay) {
  const auto inside =
      in_one_file("[shear_rate]\nmodel = \"piecewise\"\nbreaks = [12, 30]\nvalues = [3, 2, 1]\n" +
                  std::string(kRestOfScene));
  const std::string scene = "[shear_rate]\nmodel = \"piecewise\"\nfile = \"@b.csv\"\nbreaks = \"from\"\n";
  for (const char* csv : {"from,values\n0,3\n12,2\n30,1\n", "from,values\n,3\n12,2\n30,1\n"}) {
    const auto outside = Folder("pieces").with("b.csv", csv).scene(scene + kRestOfScene);
    expect_same_rate(outside, inside);
    EXPECT_EQ(outside.knots(), inside.knots());
  }
}

TEST(SceneColumns, StatesInPercentAndTimesInMinutes) {
  const std::string rate = "[shear_rate]\nmodel = \"piecewise\"\nbreaks = []\nvalues = [1]\n";
  const auto scene = Folder("states")
                         .with("start.csv", "z,phi [%]\n0,10\n42,90\n")
                         .with("inflow.csv", "t [min],phi\n0,0.25\n1,0.75\n")
                         .scene(rate +
                                "[initial]\nmodel = \"table\"\nfile = \"@start.csv\"\nvalues = \"phi\"\n"
                                "[domain]\ntop = 42\n[units]\nz = \"mm\"\nt = \"s\"\n"
                                "[boundary.top]\nfile = \"@inflow.csv\"\nbreaks = \"t\"\nvalues = \"phi\"\n");
  EXPECT_NEAR(scene.mass(), 21, 1e-12);
  ASSERT_TRUE(scene.spec().outside_top);
  EXPECT_EQ(scene.spec().outside_top->breaks, std::vector<double>{60});
  EXPECT_EQ(scene.spec().outside_top->values, (std::vector<double>{0.25, 0.75}));
}

TEST(SceneColumns, NumbersBesideAFileAndWithoutOneStayWhatTheyWere) {
  const auto scene = Folder("mixed")
                         .with("c.csv", "values\n3\n2\n")
                         .scene("[shear_rate]\nmodel = \"table\"\nfile = \"@c.csv\"\nz = [0, 42]\n" +
                                std::string(kRestOfScene));
  EXPECT_GT(scene.mean_rate(0.0, 1.0), 2.9);
  EXPECT_LT(scene.mean_rate(0.0, 1.0), 3);
  EXPECT_THROW((void)in_one_file("[shear_rate]\nmodel = \"table\"\nz = \"height\"\nvalues = [1, 2]\n" +
                                 std::string(kRestOfScene)),
               InputError);
}

}  // namespace
}  // namespace shearfront
