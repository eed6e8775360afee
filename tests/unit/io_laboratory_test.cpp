// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"
#include "support/own_folder.hpp"

/// The same measurements as laboratories write them are read as the same numbers, and what was understood is said.
namespace shearfront {
namespace {

constexpr const char* kScene =
    "[shear_rate]\nmodel = \"exponential\"\namplitude = 0.2\ndecay = 20\n[initial]\nbreaks = [12.0]\n"
    "values = [0.0, 1.0]\n[domain]\ntop = 42\n[units]\nz = \"mm\"\nt = \"s\"\n";

const std::vector<Observation> kMeasured{{20, 1, 0.045}, {20, 3, 0.068}, {20, 5, -0.012},
                                         {60, 1, 0.342}, {60, 3, 0.71},  {60, 5, 1.042}};

std::string as_text(std::string_view characters, bool is_little) {
  std::string bytes(is_little ? "\xFF\xFE" : "\xFE\xFF");
  for (const char c : characters) (bytes += is_little ? c : '\0') += is_little ? '\0' : c;
  return bytes;
}

Observations read(const std::string& text, const ObservationFormat& format = {}) {
  const Scene<double> scene = parse_scene<double>(kScene, "scene.toml");
  static int n = 0;
  const std::string path = (support::own_folder() / ("laboratory-" + std::to_string(++n) + ".csv")).string();
  std::FILE* file = std::fopen(path.c_str(), "wb");
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
  return read_observations(path, scene, format);
}

std::string complaint(const std::string& text, const ObservationFormat& format = {}) {
  try {
    (void)read(text, format);
  } catch (const FileError& error) {
    const std::string what = error.what();
    return what.substr(what.find(".csv") + 5);
  }
  return "accepted";
}

void expect_measured(const Observations& data, const std::string& what) {
  ASSERT_EQ(data.rows.size(), kMeasured.size()) << what;
  for (std::size_t i = 0; i < kMeasured.size(); ++i) {
    EXPECT_DOUBLE_EQ(data.rows[i].t, kMeasured[i].t) << what << " row " << i;
    EXPECT_DOUBLE_EQ(data.rows[i].z, kMeasured[i].z) << what << " row " << i;
    EXPECT_NEAR(data.rows[i].value, kMeasured[i].value, 1e-15) << what << " row " << i;
  }
}

struct Variant {
  const char* name;
  std::string text;
  const char*
      understood;  ///< a part of what is said; empty: nothing is, the file is as this project writes it
  ObservationFormat format = {};
};

ObservationFormat names(std::string t, std::string z, std::string phi) {
  ObservationFormat format;
  format[Column::t].name = std::move(t);
  format[Column::z].name = std::move(z);
  format[Column::phi].name = std::move(phi);
  return format;
}

std::vector<Variant> variants() {
  const std::string plain =
      "t,z,phi\n20,1,0.045\n20,3,0.068\n20,5,-0.012\n60,1,0.342\n60,3,0.71\n60,5,1.042\n";
  const auto replaced = [&](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
      text.replace(i, from.size(), to);
    return text;
  };
  const std::string rows = plain.substr(plain.find('\n') + 1);
  const std::string german = replaced(replaced(rows, ",", ";"), ".", ",");
  const std::string percent = "20,1,4.5\n20,3,6.8\n20,5,-1.2\n60,1,34.2\n60,3,71\n60,5,104.2\n";
  ObservationFormat declared;
  declared[Column::phi].unit = "percent";
  ObservationFormat large;
  large[Column::phi_large].name = "phi_large";
  ObservationFormat own_word;
  own_word.missing = {"out"};
  ObservationFormat by_time;
  by_time.layout = TableLayout::times;
  return {
      {"plain", plain, ""},
      {"byte order mark and carriage returns", "\xEF\xBB\xBF" + replaced(plain, "\n", "\r\n"), ""},
      {"units in the header", "t [s],z [mm],phi\n" + rows, ""},
      {"centimetres",
       "t [s],z "
       "[cm],phi\n20,0.1,0.045\n20,0.3,0.068\n20,0.5,-0.012\n60,0.1,0.342\n60,0.3,0.71\n60,0.5,1.042\n",
       "z from \"z [cm]\" in cm, times 10 to mm"},
      {"minutes", "t (min),z,phi\n" + replaced(replaced(rows, "20,", "0.333333333333333333,"), "60,", "1,"),
       "t from \"t (min)\" in min, times 60 to s"},
      {"German spreadsheet", "t [s];z [mm];phi\n" + german, "separated by semicolons, decimal commas"},
      {"tabs", "t\tz\tphi\n" + replaced(rows, ",", "\t"), "separated by tabs"},
      {"tabs and decimal commas", "t\tz\tphi\n" + replaced(german, ";", "\t"),
       "separated by tabs, decimal commas"},
      {"quoted decimal commas",
       "t,z,phi\n20,1,\"0,045\"\n20,3,\"0,068\"\n20,5,\"-0,012\"\n60,1,\"0,342\"\n60,3,\"0,71\"\n60,5,\"1,"
       "042\"\n",
       "decimal commas"},
      {"empty columns of a spreadsheet", replaced(plain, "\n", ",,\r\n"), ""},
      {"names of its own", "time [s],height (mm),conc\n" + rows,
       "t from \"time [s]\" in s; z from \"height (mm)\" in mm; phi from \"conc\"",
       names("time [s]", "height (mm)", "conc")},
      {"names without their units", "time [s],height (mm),conc\n" + rows, "phi from \"conc\"",
       names("time", "height", "conc")},
      {"usual names", "Time [s],Height (mm),phi\n" + rows, "z from \"Height (mm)\" in mm"},
      {"percent in the header", "t,z,phi [%]\n" + percent, "phi from \"phi [%]\" in %, times 0.01"},
      {"percent in the format", "t,z,phi\n" + percent, "in percent, times 0.01", declared},
      {"a row of units", "t;z;phi\ns;mm;%\n" + replaced(percent, ",", ";"), "a row of units"},
      {"a row of units in brackets", "t,z,phi\n[s],[mm],[%]\n" + percent, "a row of units"},
      {"large grains",
       "t,z,phi_large\n20,1,0.955\n20,3,0.932\n20,5,1.012\n60,1,0.658\n60,3,0.29\n60,5,-0.042\n",
       "1 - phi from \"phi_large\"", large},
      {"lines before the header", "Messung vom 3. Mai\nKamera; 2, links\n\nt,z,phi\n" + rows,
       "2 lines before the header"},
      {"blank rows", replaced(plain, "\n", "\n\n"), ""},
      {"Windows-1252", "# H\xF6he\nt,z,phi\n" + rows, "Windows-1252 text"},
      {"UTF-16", as_text(replaced(plain, ",", "\t"), true), "UTF-16 text, separated by tabs"},
      {"UTF-16, the other way round", as_text(plain, false), "UTF-16 text"},
      {"missing values",
       replaced(plain, "60,1,",
                "20,7,NaN\n20,9,n/a\n20,11,-\n20,13,#N/A\n20,15,NA\n20,17,\n20,19,out\n60,1,"),
       "", own_word},
      {"a column per height", "t,1,3,5\n20,0.045,0.068,-0.012\n60,0.342,0.71,1.042\n",
       "z from the names of 3 columns, 1 to 5"},
      {"a column per height with names",
       "t [s]\\z [mm],phi_1mm,phi_3mm,phi_5mm\n20,0.045,0.068,-0.012\n60,0.342,0.71,1.042\n",
       "z from the names of 3 columns, 1 to 5 in mm"},
      {"a column per height in centimetres",
       "time (s);z = 0,1 cm;z = 0,3 cm;z = 0,5 cm\n20;0,045;0,068;-0,012\n60;0,342;0,71;1,042\n",
       "times 10 to mm"},
      {"standard deviations",
       "t,z,phi,std\n20,1,0.045,0.1\n20,3,0.068,0.1\n20,5,-0.012,0.1\n60,1,0.342,0.1\n60,3,0.71,0.1\n60,5,1."
       "042,0.1\n",
       "sigma from \"std\""},
  };
}

TEST(LaboratoryFiles, AreReadAsTheSameNumbers) {
  std::size_t n = 0;
  for (const Variant& variant : variants()) {
    const Observations data = read(variant.text, variant.format);
    expect_measured(data, variant.name);
    const bool is_said = !data.notes.empty() && data.notes.front() == data.understood;
    EXPECT_EQ(is_said, *variant.understood != '\0') << variant.name << ": " << data.understood;
    EXPECT_NE(data.understood.find(variant.understood), std::string::npos)
        << variant.name << ": " << data.understood;
    ++n;
  }
  EXPECT_GE(n, 23u);
}

/// Averages over chunks as the particle code LAMMPS documents them (fix ave/chunk).
TEST(LaboratoryFiles, AveragesOverChunks) {
  const std::string text =
      "# Chunk-averaged data for fix profile and group grains\n# Timestep Number-of-chunks Total-count\n"
      "# Chunk Coord1 Ncount v_small\n2000 3 300\n  1 1 100 0.045\n  2 3 100 0.068\n  3 5 100 -0.012\n"
      "6000 3 300\n  1 1 100 0.342\n  2 3 100 0.71\n  3 5 100 1.042\n";
  ObservationFormat format;
  format[Column::phi].name = "v_small";
  EXPECT_NE(complaint(text, format).find("needs time_step"), std::string::npos) << complaint(text, format);
  format.time_step = 0.01;
  const Observations data = read(text, format);
  expect_measured(data, "chunks");
  EXPECT_NE(data.understood.find(
                "averages over chunks; t from \"Timestep\"; z from \"Coord1\"; phi from \"v_small\""),
            std::string::npos)
      << data.understood;
  const std::string broken = text.substr(0, text.find("6000")) + "six 3\n";
  EXPECT_NE(complaint(broken, format).find("t"), std::string::npos);
  EXPECT_NE(
      complaint(text + "  4 7 100 0.5\n", format).find("must be a step, a number of chunks and their count"),
      std::string::npos)
      << complaint(text + "  4 7 100 0.5\n", format);
}

TEST(LaboratoryFiles, MeansOverBinsThatNoColumnTells) {
  ObservationFormat format;
  format.width = 0.2;
  for (const char* text : {"t,z [cm],phi\n20,0.1,0.5\n20,0.3,0.5\n", "t [s]\\z [cm],0.1,0.3\n20,0.5,0.5\n"}) {
    const Observations data = read(text, format);
    EXPECT_EQ(data.quantity, Quantity::bin) << text;
    ASSERT_EQ(data.rows.size(), 2u) << text;
    EXPECT_EQ(data.rows[1].width, 2) << text;
    EXPECT_NE(data.understood.find("means over bins of width 2"), std::string::npos) << data.understood;
  }
  EXPECT_NE(complaint("t,z [cm],phi\n20,0.05,0.5\n", format)
                .find("must leave its bin of width 2 inside the domain"),
            std::string::npos);
  EXPECT_NE(complaint("t,z,phi,width\n20,1,0.5,1\n", format).find("must not be given beside a column"),
            std::string::npos);
}

TEST(LaboratoryFiles, AColumnPerTime) {
  const Observations data = read("z,t = 20 s,t = 60 s\n1,0.045,0.342\n3,0.068,0.71\n5,-0.012,1.042\n");
  ASSERT_EQ(data.rows.size(), 6u);
  EXPECT_EQ(data.rows[1].t, 60);
  EXPECT_EQ(data.rows[1].z, 1);
  EXPECT_EQ(data.rows[1].value, 0.342);
}

/// sigma is the pooled spread over the root of the number of values: with deviations -+d of pairs about their means,
/// the spread is sqrt(2 d^2 n / n), of the mean of two d.
TEST(LaboratoryFiles, ReplicatesAreRefusedKeptOrAveraged) {
  const std::string text = "t,z,phi\n20,1,0.1\n20,1,0.3\n20,3,0.5\n20,3,0.7\n";
  EXPECT_NE(complaint(text).find("must differ from z of line 2"), std::string::npos);
  ObservationFormat format;
  format.replicates = Replicates::kept;
  EXPECT_EQ(read(text, format).rows.size(), 4u);
  format.replicates = Replicates::averaged;
  const Observations means = read(text, format);
  ASSERT_EQ(means.rows.size(), 2u);
  EXPECT_NEAR(means.rows[0].value, 0.2, 1e-15);
  EXPECT_NEAR(means.rows[1].value, 0.6, 1e-15);
  EXPECT_NEAR(means.rows[0].sigma, 0.1, 1e-15);
  EXPECT_NE(means.understood.find("means of 4 values at 2 places"), std::string::npos) << means.understood;
}

/// Units that measure something else, or nothing that is known, than the numbers they stand by.
TEST(LaboratoryFiles, UnitsThatContradictAreRefused) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"t [mm],z [mm],phi\n20,1,0.5\n",
       "column[0] = \"t [mm]\"; must be in a unit that can be converted to [s]"},
      {"t [s],z [s],phi\n20,1,0.5\n",
       "column[1] = \"z [s]\"; must be in a unit that can be converted to [mm]"},
      {"t [s],z [mm],phi [mm]\n20,1,0.5\n",
       "column[2] = \"phi [mm]\"; must be a fraction of 1 or in percent"},
      {"t [s],z [mm],phi [s]\n20,1,0.5\n", "column[2] = \"phi [s]\"; must be a fraction of 1 or in percent"},
      {"t [s],z [mm],phi [veh/km]\n20,1,0.5\n", "must be a fraction of 1 or in percent"},
      {"t [s],z [mm],M [s]\n20,1,0.5\n",
       "column[2] = \"M [s]\"; must be in a unit that can be converted to [mm]"},
      {"t [s],z [mm],M [%]\n20,1,0.5\n",
       "column[2] = \"M [%]\"; must be in a unit that can be converted to [mm]"},
      {"t [s],H [s]\n20,41\n", "column[1] = \"H [s]\"; must be in a unit that can be converted to [mm]"},
      {"t [s],H [kg]\n20,41\n", "column[1] = \"H [kg]\"; must be in a unit that can be converted to [mm]"},
      {"t [s],z [mm],phi [%],sigma [mm]\n20,1,50,1\n", "must have the unit of phi, [%]"},
      {"t [s],z [mm],phi,width [s]\n20,1,0.5,0.1\n", "must have the unit of z, [mm]"},
      {"t;z;phi\ns;mm;mm\n20;1;0.5\n", "must be a fraction of 1 or in percent"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(complaint(text).find(expected), std::string::npos) << text << "gives\n" << complaint(text);
  ObservationFormat said;  // what is said beats the header
  said[Column::phi].unit = "1";
  EXPECT_EQ(read("t [s],z [mm],phi [v/v]\n20,1,0.5\n", said).rows.size(), 1u);
  EXPECT_EQ(read("t [s],z [mm],M [cm]\n20,1,0.05\n", {}).rows[0].value, 0.5);
}

TEST(LaboratoryFiles, ContradictionsAreRefused) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"t [mm],z [mm],phi\n20,1,0.5\n", "must be in a unit that can be converted to [s]"},
      {"t [s],z [s],phi\n20,1,0.5\n", "must be in a unit that can be converted to [mm]"},
      {"t [frames],z [mm],phi\n20,1,0.5\n", "must be in a unit that can be converted to [s]"},
      {"t [s],z [px],phi\n20,1,0.5\n", "must be in a unit that can be converted to [mm]"},
      {"t [s],z [mm],phi,sigma [mm]\n20,1,0.5,0.1\n", "must have the unit of phi"},
      {"t [s],z [mm],phi,width [s]\n20,1,0.5,0.1\n", "must have the unit of z"},
      {"t [s],z [m],phi\n20,1,0.5\n", "must be inside the domain [0, 42]"},
      {"t,z,phi\n20,1,45\n", "phi[0] = 45; must be a fraction of 1; what is in percent must say so"},
      {"t,z,phi_large\n20,1,0.5\n", "is the concentration of the large grains if"},
      {"t;z;phi\n20;1;0,5\n20;3;0.6\n20;5;0,7\n", "must be a number"},
      {"t;z;phi\n20;1;0,5\n20;3;1.000,6\n", "must be a number"},
      {"t,z,conc\n20,1,0.5\n", "must have a column phi"},
      {"t,1,1.5.2,3\n20,0.5,0.5,0.5\n", "must have a column z"},
      {"t|z|phi\n20|1|0.5\n", "must have a column t"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(complaint(text).find(expected), std::string::npos) << text << "gives\n" << complaint(text);
  EXPECT_NE(complaint("t,z,phi\n20,1,0.5\n", names("", "", "conc"))
                .find("must have a column \"conc\", which is said to hold phi"),
            std::string::npos);
}

}  // namespace
}  // namespace shearfront
