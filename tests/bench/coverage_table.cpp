// SPDX-License-Identifier: BSD-3-Clause
// Whether the error bars of a fit hold: coverage of the 95 % intervals and error over the Cramer-Rao bound,
// as a table in Markdown. Noise is drawn anew for every replicate; half of them are fitted with the column
// sigma, half without. Cumulative data, where the misfit is far from a parabola, also with profile
// likelihood. Usage: shearfront_coverage_table [REPLICATES [THREADS [EXAMPLE [QUANTITY [SIGMA]]]]]
#include <Eigen/Cholesky>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/solution/observe.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/table_bed.hpp"

namespace {

using namespace shearfront;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Example {
  const char* name;
  SceneSpec<double> truth;
  std::vector<std::string> parameters;
  std::vector<double> start, times, depths;
  fit::ForwardSpec forward{};
};

std::vector<double> grid(double first, double step, int n) {
  std::vector<double> x;
  for (int i = 0; i < n; ++i) x.push_back(std::round((first + i * step) * 1e6) / 1e6);
  return x;
}

/// The bed of 42 mm with its height as the unit, twelve rates of a table unknown.
Example table_example() {
  SceneSpec<double> scene = support::bed_of_42_mm();
  const double height = scene.top;
  auto& table = std::get<Table<double>>(scene.shear_rate);
  Example example{"table", {}, {"shear_rate.values"}, {}, {}, {}};
  for (std::size_t i = 0; i < table.z.size(); ++i) {
    example.start.push_back(0.4 / height * std::exp(-table.z[i] / 16));
    table.z[i] /= height;
    table.values[i] /= height;
  }
  for (double& z : scene.initial_breaks) z /= height;
  scene.top = 1;
  example.truth = scene;
  for (int i = 0; i < 40; ++i) example.times.push_back(20 * std::pow(1.12, i));
  for (int i = 0; i < 42; ++i) example.depths.push_back((0.5 + i) / height);
  return example;
}

/// A bed sheared under a light lid (kinetic.hpp), and one whose rate is a law of the shear rate without a lid (scaling.hpp), in 20 bins.
Example rheology_example(const char* name, DepthFunction<double> rate, std::vector<std::string> parameters,
                         std::vector<double> start, double first) {
  SceneSpec<double> scene;
  scene.shear_rate = std::move(rate);
  scene.initial_breaks = {0.5};
  scene.initial_values = {0, 1};
  Example example{name, scene, std::move(parameters), std::move(start), {}, {}};
  for (int i = 0; i < 16; ++i) example.times.push_back(first * std::pow(1.4, i));
  example.depths = grid(0.025, 0.05, 20);
  example.forward = {Method::of<ExactSolver>({.tolerance = 1e-4})};
  return example;
}
Example kinetic_example() {
  Kinetic<double> a;
  a.length = 0.2;
  a.load = 0.3;
  a.lid = 1;
  return rheology_example("kinetic", a, {"shear_rate.amplitude", "shear_rate.length", "shear_rate.load"},
                          {0.8, 0.25, 0.4}, 0.2);
}
Example scaling_example() {
  Scaling<Exponential<double>> a;
  a.shear = {20, 0.5};
  a.small_diameter = 0.05;
  a.size_ratio = 2;
  a.pressure = 0;
  a.lid = 1;
  return rheology_example("scaling", a, {"shear_rate.B", "shear_rate.C"}, {0.3, 0.4}, 0.2);
}

std::vector<Example> examples() {
  SceneSpec<double> scene;
  scene.initial_breaks = {0.5};
  scene.initial_values = {0, 1};
  const auto with = [&](auto rate) {
    SceneSpec<double> s = scene;
    s.shear_rate = rate;
    return s;
  };
  SceneSpec<double> diffusing = with(Piecewise<double>{{0.29}, {2.4, 0.31}});
  diffusing.diffusion = Diffusion<double>{1e-2, {}, false};
  // Cumulative data set no upper bound on the fast layer: the model must have a solution for any rate there.
  const fit::ForwardSpec crank_nicolson{
      Method::of<CrankNicolsonSolver>({.cells = 100, .time_step = 0.02, .monotone = true})};
  const std::vector<double> fine_t = grid(0.5, 0.5, 20), fine_z = grid(0.01, 0.01, 99);
  return {
      {"3", with(Piecewise<double>{{0.29}, {3.15, 0.5}}), {"shear_rate.values"}, {2.5, 0.7}, fine_t, fine_z},
      {"4",
       with(Piecewise<double>{{0.2, 0.4, 0.6, 0.8}, {3.25, 2.32, 1.63, 1.05, 0.53}}),
       {"shear_rate.values"},
       {3.3, 2.5, 1.7, 1.1, 0.5},
       fine_t,
       fine_z},
      {"5",
       with(Exponential<double>{0.87 / 0.205, 0.205}),
       {"shear_rate.amplitude", "shear_rate.decay"},
       {5, 0.2},
       grid(1, 1, 10),
       grid(0.05, 0.05, 19)},
      {"diffusion",
       diffusing,
       {"diffusion.D", "shear_rate.values"},
       {0.03, 1.5, 0.5},
       {0.25, 0.5, 1, 1.5, 2, 3, 4, 6},
       grid(0.025, 0.05, 20),
       crank_nicolson},
      table_example(),
      kinetic_example(),
      scaling_example()};
}

Observations without_noise(const Example& example, Quantity quantity) {
  ObservationPlan plan{example.times, example.depths, quantity, 0};
  if (quantity == Quantity::bin) plan.width = example.depths[1] - example.depths[0];
  const Scene<double> scene(example.truth);
  return observe(plan, scene, solve(scene, example.forward.method, request_of(plan, scene)));
}

/// Standard deviations of the logarithms of the parameters by the Cramer-Rao bound, for sigma = 1: from the
/// analytic Jacobian of the observations at the truth. For point data it counts how phi varies between the
/// shocks only; what the places of the shocks tell has no Fisher information (the likelihood jumps).
VectorXd cramer_rao(const Example& example, const Observations& observations) {
  const Scene<double> scene(example.truth);
  const fit::Parameters parameters(scene, {example.parameters, {}, {}, {}, fit::Shape::none});
  const fit::Coordinates coordinates(parameters);
  fit::ResidualRows rows;
  fit::MisfitList::for_each([&]<class M>() {
    if (name_of(observations.quantity) == M::kName) rows = M::rows(observations, scene.bottom(), scene.top());
  });
  fit::RunControl control(1);
  const fit::Objective objective(parameters, coordinates, example.forward, rows, fit::find_loss("squared", 0),
                                 control);
  const MatrixXd j = objective.inspect(coordinates.coordinates(parameters.start()), true).jacobian;
  const MatrixXd information = j.transpose() * j;
  return information.ldlt().solve(MatrixXd::Identity(j.cols(), j.cols())).diagonal().cwiseSqrt();
}

struct Outcome {
  bool is_usable = false;
  VectorXd error;    ///< log(estimate / truth)
  VectorXd covered;  ///< 1, 0; NaN without interval
  VectorXd profile_covered;
  VectorXd doubtful;
  VectorXd stated;  ///< standard error / estimate
  bool structured = false;
};

Outcome run(const fit::FitSpec& spec, const VectorXd& truth) {
  const fit::Estimate estimate = fit::fit(spec);
  Outcome outcome;
  outcome.is_usable = estimate.usable() && estimate.status == Status::ok;
  outcome.error.resize(truth.size());
  outcome.covered = outcome.stated = outcome.profile_covered = outcome.doubtful =
      VectorXd::Constant(truth.size(), std::nan(""));
  outcome.structured = estimate.structure && estimate.structure->is_structured;
  for (Index i = 0; i < truth.size(); ++i) {
    const fit::ParameterEstimate& p = estimate.parameters[static_cast<std::size_t>(i)];
    outcome.error[i] = std::log(p.estimate / truth[i]);
    // An open end covers all beyond.
    if (p.profile95)
      outcome.profile_covered[i] = !(p.profile95->low > truth[i]) && !(p.profile95->high < truth[i]) ? 1 : 0;
    if (p.check) outcome.doubtful[i] = p.check->is_doubtful() ? 1 : 0;
    // What is to be believed of what is printed: beside a bound, and where the plain one is not good enough, the profile interval.
    const bool is_profile = p.profile95 && (!spec.uncertainty.profile || !p.ci95);
    const auto& printed = is_profile ? p.profile95 : p.ci95;
    if (printed) outcome.covered[i] = !(printed->low > truth[i]) && !(printed->high < truth[i]) ? 1 : 0;
    if (p.std_error) outcome.stated[i] = *p.std_error / p.estimate;
  }
  return outcome;
}

std::vector<Outcome> replicate(const fit::FitSpec& spec, const VectorXd& truth, double sigma, std::size_t n,
                               std::size_t n_threads) {
  std::vector<Outcome> outcomes(n);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t b = next++; b < n; b = next++) {
      fit::FitSpec mine = spec;
      add_noise(mine.observations, sigma, 20100504, b);
      if (b % 2 == 1)
        for (Observation& o : mine.observations.rows) o.sigma = std::nan("");
      outcomes[b] = run(mine, truth);
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < n_threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return outcomes;
}

/// In percent of the fits that have it: "-" if none has. parity: 0 and 1 for those with and without sigma.
std::string share(const std::vector<Outcome>& outcomes, VectorXd Outcome::*which, Index i,
                  std::size_t parity = 2) {
  double sum = 0, n = 0;
  for (std::size_t b = 0; b < outcomes.size(); ++b) {
    if (!outcomes[b].is_usable || (parity < 2 && b % 2 != parity)) continue;
    const double x = (outcomes[b].*which)[i];
    if (std::isnan(x)) continue;
    sum += x;
    n += 1;
  }
  char text[16] = "-";
  if (n > 0) std::snprintf(text, sizeof text, "%.1f", 100 * sum / n);
  return text;
}

void print(const Example& example, Quantity quantity, double sigma, const std::vector<std::string>& names,
           const VectorXd& bound, const std::vector<Outcome>& outcomes) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto k = static_cast<Index>(i);
    double squares = 0, bias = 0, stated = 0;
    std::size_t n = 0, without = 0, n_stated = 0, structured = 0;
    for (const Outcome& outcome : outcomes) {
      if (!outcome.is_usable) continue;
      ++n;
      squares += outcome.error[k] * outcome.error[k];
      bias += outcome.error[k];
      structured += outcome.structured ? 1 : 0;
      without += std::isnan(outcome.covered[k]) ? 1 : 0;
      if (std::isnan(outcome.stated[k])) continue;
      ++n_stated;
      stated += outcome.stated[k] * outcome.stated[k];
    }
    const auto count = static_cast<double>(n);
    const double rmse = std::sqrt(squares / count);
    const auto covered = [&](std::size_t parity) { return share(outcomes, &Outcome::covered, k, parity); };
    std::printf(
        "| %s | %s | %g | %s | %s | %s | %s | %s | %s | %.2e | %.2f | %+.2f | %.2f | %zu | %zu | %zu |\n",
        example.name, std::string(name_of(quantity)).c_str(), sigma, names[i].c_str(), covered(2).c_str(),
        covered(0).c_str(), covered(1).c_str(), share(outcomes, &Outcome::profile_covered, k).c_str(),
        share(outcomes, &Outcome::doubtful, k).c_str(), rmse, rmse / (sigma * bound[k]), bias / count / rmse,
        std::sqrt(stated / static_cast<double>(n_stated)) / rmse, outcomes.size() - n, without, structured);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, const char* otherwise) { return i < argc ? argv[i] : otherwise; };
  const std::size_t n = std::strtoul(argument(1, "500"), nullptr, 10);
  const std::size_t n_threads = std::strtoul(argument(2, "2"), nullptr, 10);
  std::printf("%zu replicates; intervals of 95 %%; errors are those of the logarithm of a parameter.\n\n", n);
  std::printf(
      "| example | data | sigma | parameter | covered %% | sigma known | unknown | profile | doubtful %% | "
      "rmse | rmse / bound | "
      "bias / rmse | stated / rmse | failed | no interval | structured |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Example& example : examples()) {
    if (argc > 3 && std::string_view(argv[3]) != example.name) continue;
    for (const Quantity quantity : {Quantity::bin, Quantity::cumulative, Quantity::point}) {
      if (argc > 4 && name_of(quantity) != argv[4]) continue;
      fit::FitSpec spec{"",
                        Scene<double>(example.truth),
                        without_noise(example, quantity),
                        {example.parameters, {}, {}, {}, fit::Shape::none},
                        example.forward,
                        {},
                        {},
                        {}};
      const fit::Parameters parameters(spec.scene, spec.unknown);
      std::vector<std::string> names;
      for (const fit::Parameter& p : parameters) names.push_back(p.name());
      spec.unknown.start = example.start;
      constexpr std::size_t kMostProfiled = 5;  // each takes some fits per parameter
      spec.uncertainty.profile = quantity == Quantity::cumulative && names.size() <= kMostProfiled;
      const VectorXd bound = cramer_rao(example, spec.observations);
      for (const double sigma : {0.01, 0.05}) {
        if (argc > 5 && std::strtod(argv[5], nullptr) != sigma) continue;
        print(example, quantity, sigma, names, bound,
              replicate(spec, parameters.start(), sigma, n, n_threads));
      }
    }
  }
}
