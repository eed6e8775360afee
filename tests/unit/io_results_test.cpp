// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/digits/real110.hpp"
#include "shearfront/io/results.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "shearfront/io/file_error.hpp"
#include "support/own_folder.hpp"

namespace shearfront {
namespace {

namespace fs = std::filesystem;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Results : public testing::Test {
 protected:
  Results() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = support::own_folder() / test->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Results() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::size_t n_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }

  template <class Write>
  std::string written(Write&& write) {
    OutputFile file(path("out"));
    write(file);
    file.commit();
    return content_of(path("out"));
  }

 private:
  fs::path folder_;
};

TEST_F(Results, SamplesAsCsv) {
  EXPECT_EQ(
      written([](OutputFile& f) {
        write_samples_csv(f, {0.1, kInfinity}, {0, 1e-300}, {{1, 0}, {0.1 + 0.2, -0.0}, {0.5, 2}, {1, 3}});
      }),
      "t,z,phi,M\n0.1,0,1,0\n0.1,1e-300,0.30000000000000004,-0\n,0,0.5,2\n,1e-300,1,3\n");
}

TEST_F(Results, FrontsAsCsv) {
  EXPECT_EQ(
      written([](OutputFile& f) {
        write_fronts_csv(f, {{1, 0, 0.5, 2, 0.29, 0, 0.05}, {0, 2, 0.29, kInfinity, 0, 1, 0}});
      }),
      "layer,t_begin,z_begin,t_end,z_end,phi_below,phi_above\n1,0,0.5,2,0.29,0,0.05\n0,2,0.29,,0,1,0\n");
}

TEST_F(Results, EventsAsJson) {
  Timeline<double> timeline;
  timeline.t0 = 0.5;
  timeline.t_star = kInfinity;
  timeline.interfaces = {{0.29, 0.25, std::nullopt}};
  timeline.mass = 0.5;
  Summary summary;
  summary.status = Status::steady;
  summary.message = "a \"quoted\" \\ message\n";
  summary.collisions = 18446744073709551615U;
  EXPECT_EQ(
      written([&](OutputFile& f) { write_events_json(f, "s\xff", "exact", text_of(timeline, 0), summary); }),
      "{\n  \"scene\": \"s\xEF\xBF\xBD\",\n  \"method\": \"exact\",\n  \"mass\": 0.5,\n  "
      "\"steady_height\": 0,\n"
      "  \"t0\": 0.5,\n  \"t1\": null,\n  \"t_star\": null,\n  \"interfaces\": [\n"
      "    {\"z\": 0.29, \"first\": 0.25, \"last\": null}\n  ],\n"
      "  \"summary\": {\"collisions\": 18446744073709551615, \"fronts_max\": 0, \"levels\": 0, "
      "\"cell_updates\": 0, "
      "\"wall_s\": 0, "
      "\"status\": \"steady\", \"message\": \"a \\\"quoted\\\" \\\\ message\\n\"}\n}\n");
}

TEST_F(Results, EventsWithManyDigits) {
  Timeline<Real110> timeline;
  timeline.t0 = Real110(2) / Real110(3);
  timeline.t1 = Real110("123456789012345678901234567890");
  const std::string text =
      written([&](OutputFile& f) { write_events_json(f, "s", "exact", text_of(timeline, 30), {}); });
  EXPECT_NE(text.find("\"t0\": 0.666666666666666666666666666667,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"t1\": 123456789012345678901234567890,"), std::string::npos) << text;
}

TEST_F(Results, OldFileStaysUntilTheNewOneIsComplete) {
  std::ofstream(path("out")) << "old";
  {
    OutputFile file(path("out"));
    file.write("half");
    EXPECT_EQ(content_of(path("out")), "old");
  }
  EXPECT_EQ(content_of(path("out")), "old");
  EXPECT_EQ(n_files(), 1U);
  OutputFile file(path("out"));
  file.write("new");
  file.commit();
  EXPECT_EQ(content_of(path("out")), "new");
  EXPECT_EQ(n_files(), 1U);
}

TEST_F(Results, LinksAndPermissionsAreKept) {
  std::ofstream(path("target")) << "old";
  fs::permissions(path("target"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target", path("link"));
  OutputFile file(path("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content_of(path("target")), "new");
  EXPECT_EQ(fs::status(path("target")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Results, FailuresAreReported) {
  EXPECT_THROW(OutputFile(path("missing/out")), FileError);
  EXPECT_THROW(OutputFile{path("")}, FileError);
  EXPECT_THROW(OutputFile{""}, FileError);
  OutputFile full("/dev/full");
  EXPECT_THROW(
      {
        full.write("text");
        full.commit();
      },
      FileError);
  EXPECT_EQ(n_files(), 0U);
}

}  // namespace
}  // namespace shearfront
