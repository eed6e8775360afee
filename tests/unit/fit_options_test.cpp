// SPDX-License-Identifier: BSD-3-Clause
// Fit files take the options of all solvers, as the command line does: both derive from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "shearfront/fit/fit_file.hpp"
#include "shearfront/io/method_text.hpp"
#include "support/checked.hpp"

namespace shearfront::fit {
namespace {

namespace fs = std::filesystem;

/// A folder with a scene that every solver but those of diffusion takes, and one datum.
class FitOptions : public testing::Test {
 protected:
  FitOptions() {
    std::string pattern = (fs::temp_directory_path() / "shearfront-fit-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    std::ofstream(folder_ / "scene.toml")
        << "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.5]\nvalues = [2, 1]\n"
           "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n";
    std::ofstream(folder_ / "data.csv") << "t,z,M\n0.2,0.5,0.05\n";
  }
  ~FitOptions() override { fs::remove_all(folder_); }

  [[nodiscard]] Method method(const std::string& forward) const {
    const std::string text =
        "scene = \"scene.toml\"\nobservations = \"data.csv\"\n[unknown]\nparameters = "
        "[\"shear_rate.scale\"]\n"
        "[forward]\n" +
        forward;
    return parse_fit(text, (folder_ / "fit.toml").string()).spec.forward.method;
  }
  [[nodiscard]] std::string refusal(const std::string& forward) const {
    try {
      (void)method(forward);
    } catch (const FileError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder_;
};

std::string key_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// An allowed text of an option on the command line, and what it is in a file.
struct Texts {
  std::string command_line, file;
};
Texts allowed_texts(const OptionText& option, const std::string& solver) {
  if (option.kind.empty()) return {"true", "true"};
  if (const std::size_t bar = option.kind.rfind('|'); bar != std::string::npos) {
    const std::string name = option.kind.substr(bar + 1);
    return {name, '"' + name + '"'};
  }
  for (const char* number : {"77", "0.0625"}) {
    Method method(solver);
    try {
      set_option(method, option.name, number, option.name);
      return {number, number};
    } catch (const InputError&) {
    }
  }
  ADD_FAILURE() << option.name;
  return {};
}

TEST_F(FitOptions, AreThoseOfTheCommandLine) {
  support::Checked checked({"cell-tolerance", "max-collisions"});  // fit files once lacked these
  for (const OptionText& option : all_options())
    for (const std::string& solver : option.solvers()) {
      SCOPED_TRACE(solver + " --" + option.name);
      const Texts texts = allowed_texts(option, solver);
      const std::string choice = "method = \"" + solver + "\"\n";
      Method expected = method(choice);
      set_option(expected, option.name, texts.command_line, option.name);
      EXPECT_EQ(settings(method(choice + key_of(option.name) + " = " + texts.file + "\n")),
                settings(expected));
      EXPECT_NE(settings(expected).find("--" + option.name), std::string::npos);
      checked.count(option.name);
    }
}

TEST_F(FitOptions, OfOtherSolversAreCheckedAndChangeNothing) {
  EXPECT_EQ(settings(method("method = \"exact\"\ncells = 50\n")), settings(method("method = \"exact\"\n")));
  EXPECT_NE(
      refusal("method = \"exact\"\ncells = 0\n").find("forward.cells = 0; must be a whole number from 1 to"),
      std::string::npos);
}

TEST_F(FitOptions, ThatNoSolverHasAreUnknown) {
  const std::string why = refusal("method = \"exact\"\nresolutoin = 0.1\n");
  EXPECT_NE(why.find("forward.resolutoin: unknown key"), std::string::npos) << why;
  for (const OptionText& option : all_options())
    EXPECT_NE(why.find(key_of(option.name)), std::string::npos) << why;
}

}  // namespace
}  // namespace shearfront::fit
