// SPDX-License-Identifier: BSD-3-Clause
// Prints, for Examples 3 to 6 of Buerger, Martinez, Villada (2023), the errors of identification and its
// cost, beside those of the paper (front tracking or Engquist-Osher with patternsearch). Arguments: the
// examples wanted (3 4 4-convex 5 6); none: all.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/io/method_text.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/identification.hpp"

namespace shearfront::fit {
namespace {

using support::Identification;

constexpr double kBox = 10;

struct Published {
  double error = 0, seconds = 0;  ///< 0: not legible
};

struct Case {
  const char* name;
  Identification problem;
  Shape shape;
  Published tracked[3];  ///< resolutions 0.01, 0.005, 0.0025
  Published schemes[3];  ///< as many cells: 100, 200, 400
};

std::vector<Case> cases() {
  return {{"3",
           support::example_3(),
           Shape::none,
           {{3.63e-1, 0}, {9.38e-3, 38.8}, {1.72e-2, 0}},
           {{1.63e-1, 0}, {1.59e-1, 277.3}, {1.55e-1, 0}}},
          {"4",
           support::example_4(),
           Shape::decreasing,
           {{6.55e-1, 60.1}, {6.51e-1, 75.7}, {6.65e-1, 112.9}},
           {{6.56e-1, 279.7}, {5.11e-1, 1116.6}, {2.04e-1, 3650.1}}},
          {"4-convex",
           support::example_4(),
           Shape::convex,
           {{4.21e-1, 47.9}, {4.87e-1, 70.8}, {4.87e-1, 109.9}},
           {{5.68e-1, 98.2}, {4.53e-1, 482.2}, {2.39e-1, 3148.5}}},
          {"5",
           support::example_5(),
           Shape::none,
           {{1.00e-2, 12.3}, {1.00e-2, 18.3}, {7.81e-3, 88.6}},
           {{2.34e-2, 249.7}, {2.34e-2, 988.3}, {2.34e-2, 3658.0}}},
          {"6",
           support::example_6(),
           Shape::none,
           {{1.1872, 396.9}, {1.2893, 461.4}, {1.3030, 582.6}},
           {{}, {}, {}}}};
}

/// Point values of an Engquist-Osher solution with 10^4 cells: the data of the paper.
Observations scheme_data(const Identification& problem) {
  EngquistOsherSolver::Options options;
  options.cells = 10'000;
  const SolverResult result =
      solve<EngquistOsherSolver>(Scene<double>(problem.truth), {problem.times, problem.heights}, options);
  Observations data = support::exact_data(problem, Quantity::point);
  for (std::size_t i = 0; i < data.rows.size(); ++i) data.rows[i].value = result.samples[i].phi;
  return data;
}

struct Model {
  const char* method;
  double resolution;
  std::size_t cells;
  int column;  ///< among the paper's three
};

void row(const Case& example, const char* data_name, const Observations& data, const Model& model,
         const char* algorithm) {
  FitSpec spec = support::fit_of(example.problem, data);
  spec.unknown.shape = example.shape;
  for (const double start : spec.unknown.start) {
    spec.unknown.lower.push_back(start / kBox);
    spec.unknown.upper.push_back(start * kBox);
  }
  Method& method = spec.forward.method = Method(model.method);
  method.prefer_smooth(spec.scene);
  if (model.resolution > 0) set_option(method, "resolution", number_text(model.resolution), "resolution");
  if (model.cells > 0) set_option(method, "cells", std::to_string(model.cells), "cells");
  spec.search.algorithm = algorithm;
  const Estimate estimate = fit(spec);
  const std::string setting = model.resolution > 0 ? " " + std::to_string(model.resolution).substr(0, 6)
                              : model.cells > 0    ? " " + std::to_string(model.cells)
                                                   : "";
  std::printf("| %s | %s | %s%s | %s | %.1e | %zu | %.3f |", example.name, data_name, model.method,
              setting.c_str(), algorithm, example.problem.error(estimate), estimate.evaluations,
              estimate.wall_s);
  const Published* published = model.resolution > 0 ? &example.tracked[model.column]
                               : model.cells > 0    ? &example.schemes[model.column]
                                                    : nullptr;
  if (published && published->error > 0)
    std::printf(" %.1e |", published->error);
  else
    std::printf(" |");
  if (published && published->seconds > 0)
    std::printf(" %.1f |\n", published->seconds);
  else
    std::printf(" |\n");
  std::fflush(stdout);
}

void table(const Case& example) {
  const Model exact{"exact", 0, 0, 0};
  const Model others[] = {{"front-tracking", 0.01, 0, 0},   {"front-tracking", 0.005, 0, 1},
                          {"front-tracking", 0.0025, 0, 2}, {"engquist-osher", 0, 100, 0},
                          {"engquist-osher", 0, 200, 1},    {"engquist-osher", 0, 400, 2}};
  const std::pair<const char*, Observations> data[] = {
      {"exact M", support::exact_data(example.problem, Quantity::cumulative)},
      {"exact phi", support::exact_data(example.problem, Quantity::point)},
      {"scheme phi", scheme_data(example.problem)}};
  for (const auto& [name, observations] : data) {
    for (const char* algorithm : {"ceres", "global", "nlopt:sbplx", "nlopt:cobyla", "nlopt:nelder-mead",
                                  "nlopt:bobyqa", "nlopt:direct-l", "nlopt:crs2", "nlopt:isres"})
      row(example, name, observations, exact, algorithm);
    for (const Model& model : others)
      for (const char* algorithm : {"ceres", "nlopt:sbplx"})
        row(example, name, observations, model, algorithm);
  }
}

}  // namespace
}  // namespace shearfront::fit

int main(int argc, char** argv) {
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  std::printf(
      "| example | data | model | algorithm | error | evaluations | seconds | paper: error | seconds |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& example : shearfront::fit::cases())
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), example.name) != wanted.end())
      shearfront::fit::table(example);
}
