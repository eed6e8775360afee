// SPDX-License-Identifier: BSD-3-Clause
// Fits of beds whose fronts are narrower than equal cells. The kind of fault: what the forward method had to say was lost on
// the way to the user; a default chosen before what the file says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "shearfront/fit.hpp"
#include "support/fit_scenes.hpp"

namespace shearfront::fit {
namespace {

namespace fs = std::filesystem;

SceneSpec<double> narrow_fronts() {
  SceneSpec<double> scene = support::small_above_large({}, {1});
  scene.diffusion = Diffusion<double>{1e-4, {}, false};
  return scene;
}

TEST(FitNarrowFronts, RepeatsWhatTheMethodRemarks) {
  const Scene<double> scene(narrow_fronts());
  const ObservationPlan plan{{0.4}, {0.3, 0.4, 0.5, 0.6, 0.7}, Quantity::point, 0};
  for (const std::uint64_t cells : {50U, 8000U}) {
    const CrankNicolsonSolver::Options options{.cells = cells, .tolerance = 1e-3};
    Observations data =
        observe(plan, scene, solve<CrankNicolsonSolver>(scene, request_of(plan, scene), options));
    FitSpec spec = support::fit_of(narrow_fronts(), std::move(data), {"shear_rate.values"}, {1.01});
    spec.forward.method = Method::of<CrankNicolsonSolver>(options);
    const Estimate estimate = fit(spec);
    ASSERT_TRUE(estimate.usable()) << estimate.message;
    const bool is_said =
        std::any_of(estimate.warnings.begin(), estimate.warnings.end(), [](const std::string& warning) {
          return warning.starts_with("crank-nicolson: ") && warning.find("D is raised") != std::string::npos;
        });
    EXPECT_EQ(is_said, cells == 50) << cells;
  }
}

std::uint64_t cells_of_file(const std::string& forward) {
  std::string pattern = (fs::temp_directory_path() / "shearfront-narrow-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("scene.toml",
        "[shear_rate]\nmodel = \"piecewise\"\nbreaks = []\nvalues = [1]\n"
        "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n[diffusion]\nD = 1e-4\n");
  write("data.csv", "t,z,phi\n0.2,0.25,0\n");
  write(
      "fit.toml",
      "scene = \"scene.toml\"\nobservations = \"data.csv\"\n[unknown]\nparameters = [\"shear_rate.values\"]\n"
      "[forward]\nmethod = \"crank-nicolson\"\n" +
          forward);
  const FitSpec spec = read_fit((folder / "fit.toml").string());
  fs::remove_all(folder);
  for (const Option& option : spec.forward.method.options())
    if (option.info.name == "cells") return std::get<std::uint64_t>(option.value);
  return 1;
}

TEST(FitNarrowFronts, ChoosesCellsBesideWhatTheFileSays) {
  EXPECT_EQ(cells_of_file(""), 1600U);
  EXPECT_EQ(cells_of_file("cells = 300\n"), 300U);
  EXPECT_EQ(cells_of_file("cell_tolerance = 0.01\n"), 0U);  // as without a fit: 400, and halved where needed
}

}  // namespace
}  // namespace shearfront::fit
