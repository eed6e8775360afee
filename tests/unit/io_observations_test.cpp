// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/observations_csv.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>

#include "shearfront/io/output_file.hpp"
#include "support/own_folder.hpp"

namespace shearfront {
namespace {

Observations parse(const std::string& text) { return parse_observations(text, "data.csv", 0, 1); }

TEST(Observations, Points) {
  const Observations data = parse("# made up\nt,z,phi\n0,0.25,0\n\n  # between\n0.5,1,0.75\n");
  EXPECT_EQ(data.quantity, Quantity::point);
  ASSERT_EQ(data.rows.size(), 2u);
  EXPECT_EQ(data.rows[1].t, 0.5);
  EXPECT_EQ(data.rows[1].z, 1);
  EXPECT_EQ(data.rows[1].value, 0.75);
  EXPECT_EQ(data.rows[1].width, 0);
  EXPECT_TRUE(std::isnan(data.rows[1].sigma));
  EXPECT_FALSE(data.has_sigma());
  EXPECT_EQ(data.comments, (std::vector<std::string>{"made up", "between"}));
  EXPECT_EQ(data.n_missing, 0u);
  EXPECT_TRUE(data.notes.empty());
}

TEST(Observations, ColumnsInAnyOrder) {
  const Observations bins = parse("sigma,phi,width,z,t\n0.02,0.5,0.1,0.25,3\n");
  EXPECT_EQ(bins.quantity, Quantity::bin);
  EXPECT_EQ(bins.rows[0].t, 3);
  EXPECT_EQ(bins.rows[0].z, 0.25);
  EXPECT_EQ(bins.rows[0].width, 0.1);
  EXPECT_EQ(bins.rows[0].value, 0.5);
  EXPECT_EQ(bins.rows[0].sigma, 0.02);
  EXPECT_TRUE(bins.has_sigma());
  EXPECT_EQ(parse("z,M,t\n0.25,0.125,3\n").quantity, Quantity::cumulative);
}

TEST(Observations, UnitsAreKept) {
  for (const char* header :
       {"t [s],z [mm],phi,width [mm]", "t (s), z(mm) ,phi,width", "\"t [s]\",\"z [mm]\",phi,width"}) {
    const Observations data = parse(std::string(header) + "\n1,0.5,0.5,0.1\n");
    EXPECT_EQ(data.units, (ObservationUnits{"s", "mm", ""})) << header;
    EXPECT_EQ(observations_text(data), "t [s],z [mm],phi,width [mm]\n1,0.5,0.5,0.1\n") << header;
  }
}

TEST(Observations, MissingValuesAreCounted) {
  const Observations data = parse("t,z,phi,sigma\n0,0.1,,\n0,0.2,NA,0.1\n0,0.3,0.5,0.1\n0,0.4, ,NA\n");
  EXPECT_EQ(data.n_missing, 3u);
  ASSERT_EQ(data.rows.size(), 1u);
  EXPECT_EQ(data.rows[0].z, 0.3);
}

TEST(Observations, SigmaColumnMayBeEmpty) {
  EXPECT_FALSE(parse("t,z,phi,sigma\n0,0.1,1,\n0,0.2,1,NA\n").has_sigma());
}

TEST(Observations, NoiseMayLeadOutOfTheRangeOfPhi) {
  const Observations data = parse("t,z,phi\n0,0,-0.03\n0,1,1.04\n");
  EXPECT_EQ(data.rows[0].value, -0.03);
  EXPECT_TRUE(data.notes.empty());
}

TEST(Observations, PercentIsNoticed) {
  EXPECT_EQ(
      parse("t,z,phi\n0,0,0\n0,1,45\n").notes,
      (std::vector<std::string>{"data.csv: phi goes up to 45; it must be a fraction unless the flux of its "
                                "scene has other states (is it in percent?)"}));
}

TEST(Observations, OtherColumnsAreNotUsed) {
  const Observations data = parse(",t,z,phi,\"solid, loose\",phi_small\n1,0,0.5,1,\"0,6\",0.3\n");
  EXPECT_EQ(data.rows[0].value, 1);
  EXPECT_EQ(data.notes, (std::vector<std::string>{"data.csv:1:1: column without a name is not used",
                                                  "data.csv:1:10: column \"solid, loose\" is not used",
                                                  "data.csv:1:25: column \"phi_small\" is not used"}));
}

TEST(Observations, LineEndsQuotesBlanksAndByteOrderMark) {
  const Observations data = parse("\xEF\xBB\xBF# c \r\n\r\n \"t\" , z ,\tphi \r\n \"1\" , +5e-1 , .25 \r\n");
  ASSERT_EQ(data.rows.size(), 1u);
  EXPECT_EQ(data.rows[0].t, 1);
  EXPECT_EQ(data.rows[0].z, 0.5);
  EXPECT_EQ(data.rows[0].value, 0.25);
  EXPECT_EQ(data.comments, std::vector<std::string>{"c"});
}

TEST(Observations, LastLineNeedsNoEnd) { EXPECT_EQ(parse("t,z,phi\n0,0,1").rows.size(), 1u); }

/// Bins that fill a domain whose ends and widths are no doubles touch the ends, whatever is rounded.
TEST(Observations, BinsMayPassTheEndsByRounding) {
  for (int n = 1; n <= 200; ++n) {
    const double bottom = 0.1, top = 0.7, width = (top - bottom) / n;
    std::string text = "t,z,phi,width\n";
    for (int i = 0; i < n; ++i) text += "0," + std::to_string(i) + ",0,1\n";
    Observations data = parse_observations(text, "data.csv");
    for (int i = 0; i < n; ++i) {
      Observation& o = data.rows[static_cast<std::size_t>(i)];
      o.z = bottom + width * (i + 0.5);
      o.width = width;
    }
    const Observations again = parse_observations(observations_text(data), "data.csv", bottom, top);
    EXPECT_EQ(again.rows.size(), static_cast<std::size_t>(n));
    const BinEdges edges = bin_edges(again.rows.back().z, width, bottom, top);
    EXPECT_LE(edges.above, top);
    EXPECT_NEAR(edges.width(), width, 1e-15);
  }
  EXPECT_THROW((void)parse("t,z,phi,width\n0,0.95,1,0.1000000001\n"), FileError);
}

// The spread of n values about their mean over n - 1, over the root of n; and where squares are beyond doubles, as found by
// mutations of files.
TEST(Observations, MeansOfReplicatesHaveTheSpreadOfTheirValues) {
  ObservationFormat format;
  format.replicates = Replicates::averaged;
  const auto read = [&](const std::string& rows) {
    return parse_observations("t,z,phi\n" + rows, "data.csv", 0, 1, format);
  };
  const Observations pair = read("0,0.5,0.25\n0,0.5,0.75\n1,0.5,0.5\n");
  ASSERT_EQ(pair.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(pair.rows[0].value, 0.5);
  EXPECT_DOUBLE_EQ(pair.rows[0].sigma, 0.25);                   // sqrt(0.125 / 1 / 2)
  EXPECT_DOUBLE_EQ(pair.rows[1].sigma, 0.25 * std::sqrt(2.0));  // one value
  // Three of 0.1 / 3 are not 0.1: the sum of thirds must not pass for a spread.
  const Observations same = read("0,0.5,0.1\n0,0.5,0.1\n0,0.5,0.1\n");
  ASSERT_EQ(same.rows.size(), 1u);
  EXPECT_EQ(same.rows[0].value, 0.1);
  EXPECT_TRUE(std::isnan(same.rows[0].sigma));
  EXPECT_DOUBLE_EQ(read("0,0.5,1e300\n0,0.5,3e300\n").rows[0].sigma, 1e300);
  EXPECT_DOUBLE_EQ(read("0,0.5,1e-200\n0,0.5,3e-200\n").rows[0].sigma, 1e-200);
  EXPECT_THROW(static_cast<void>(read("0,0.5,-1.7e308\n0,0.5,1.7e308\n")), FileError);
}

TEST(Observations, WithoutADomainEveryHeightIsAllowed) {
  EXPECT_EQ(parse_observations("t,z,phi\n0,-5,1\n0,1e308,1\n", "data.csv").rows.size(), 2u);
}

TEST(Observations, TextReadsBackToTheBit) {
  Observations data;
  data.quantity = Quantity::bin;
  data.units = {"a, \"b\"", "mm]", "-"};
  data.comments = {"", " two blanks", "several\nlines", "#"};
  data.rows = {
      {0.1, 1.0 / 3, -1e-300, 0.1, 5e-324}, {1e308, 0.5, 1.0 / 7, 0.3, 1}, {0.1, 1.0 / 3, 2, 0.2, 2}};
  const std::string text = observations_text(data);
  const Observations again = parse(text);
  EXPECT_EQ(observations_text(again), text);
  EXPECT_EQ(again.units, data.units);
  EXPECT_EQ(again.comments, (std::vector<std::string>{"", " two blanks", "several", "lines", "#"}));
  ASSERT_EQ(again.rows.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.rows[i].t, data.rows[i].t);
    EXPECT_EQ(again.rows[i].z, data.rows[i].z);
    EXPECT_EQ(again.rows[i].value, data.rows[i].value);
    EXPECT_EQ(again.rows[i].width, data.rows[i].width);
    EXPECT_EQ(again.rows[i].sigma, data.rows[i].sigma);
  }
}

// Found by mutations of files: comments copied from averages over chunks made a table one of these.
TEST(Observations, CommentsOfChunksAboveATableAreComments) {
  const std::string text =
      "# Chunk-averaged data for fix profile\n# Timestep Number-of-chunks Total-count\n"
      "# Chunk Coord1 Ncount c_phi\nt,z,phi\n0,0.5,0.25\n";
  const Observations data = parse(text);
  ASSERT_EQ(data.rows.size(), 1u);
  EXPECT_EQ(data.rows[0].value, 0.25);
  EXPECT_EQ(observations_text(data), text);
}

TEST(Observations, FileIsReadAndWritten) {
  const std::string path = (support::own_folder() / "observations.csv").string();
  OutputFile file(path);
  write_observations(file, parse("t,z,M\n0,1,0.5\n"));
  file.commit();
  EXPECT_EQ(read_observations(path, 0, 1).rows[0].value, 0.5);
}

/// A million rows, in order and shuffled; the limit leaves room for slow machines and sanitizers.
TEST(SlowObservations, MillionRows) {
  for (const std::size_t stride : {std::size_t{1}, std::size_t{617}}) {
    Observations data;
    constexpr std::size_t kRows = 1'000'000;
    for (std::size_t i = 0; i < kRows; ++i) {
      const std::size_t k = i * stride % kRows;
      data.rows.push_back(
          {0.01 * static_cast<double>(k / 1000), 0.001 * static_cast<double>(k % 1000), 1.0 / 3});
    }
    const std::string text = observations_text(data);
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(parse_observations(text, "data.csv", 0, 1).rows.size(), kRows);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    RecordProperty("seconds", std::to_string(took.count()));
    std::printf("stride %zu: %.3f s\n", stride, took.count());
    EXPECT_LT(took.count(), 8);
  }
}

}  // namespace
}  // namespace shearfront
