// SPDX-License-Identifier: BSD-3-Clause
// Whether error bars hold when noise is correlated: coverage of the 95 % intervals of fits to bins whose noise is AR(1) with
// correlation 0.9 from bin to bin and from time to time (and independent, for comparison), by noise model of the fit, as a table
// in Markdown. Usage: shearfront_noise_table [REPLICATES [EXAMPLE [NOISE]]], NOISE the correlation
#include <Eigen/Core>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit.hpp"
#include "shearfront/fit/parameters.hpp"
#include "support/identification.hpp"

namespace {

using namespace shearfront;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kSigma = 0.02;

/// Stationary AR(1) along both axes, heights running fastest, of variance 1: by its recursion.
MatrixXd autoregressive(Index n_heights, Index n_times, double rho, boost::random::mt19937_64& engine) {
  boost::random::normal_distribution<double> normal;
  MatrixXd e(n_heights, n_times);
  for (double& x : e.reshaped()) x = normal(engine);
  for (Index j = 1; j < n_heights; ++j) e.row(j) = rho * e.row(j - 1) + std::sqrt(1 - rho * rho) * e.row(j);
  for (Index i = 1; i < n_times; ++i) e.col(i) = rho * e.col(i - 1) + std::sqrt(1 - rho * rho) * e.col(i);
  return e;
}

struct Model {
  const char* name;
  fit::NoiseSpec noise;
};

std::vector<Model> models() {
  fit::NoiseSpec independent, exponential, discrepancy;
  exponential.model = fit::NoiseModel::exponential;
  discrepancy.model = fit::NoiseModel::discrepancy;
  fit::NoiseSpec with_part = exponential;
  with_part.independent.reset();
  return {{"independent", independent},
          {"exponential", exponential},
          {"exponential, independent = \"estimated\"", with_part},
          {"discrepancy", discrepancy}};
}

/// What the fits of one model said of one unknown.
struct Count {
  double n = 0, covered = 0, squares = 0, stated = 0;
};

void run(const support::Identification& problem, double rho, std::size_t n) {
  const Observations exact = exact_data(problem, Quantity::bin);
  const fit::Parameters truth(Scene<double>(problem.truth),
                              {problem.parameters, {}, {}, {}, fit::Shape::none});
  for (const Model& model : models()) {
    std::vector<Count> counts(truth.size());
    double length = 0, n_lengths = 0, structured = 0;
    for (std::size_t b = 0; b < n; ++b) {
      boost::random::mt19937_64 engine(20261130 + b);
      Observations data = exact;
      const MatrixXd noise = autoregressive(static_cast<Index>(problem.heights.size()),
                                            static_cast<Index>(problem.times.size()), rho, engine);
      for (std::size_t k = 0; k < data.rows.size(); ++k)
        data.rows[k].value += kSigma * noise.reshaped()[static_cast<Index>(k)];
      fit::FitSpec spec = support::fit_of(problem, std::move(data));
      spec.noise = model.noise;
      const fit::Estimate found = fit::fit(spec);
      if (!found.usable()) continue;
      if (found.noise) length += std::log(found.noise->length_z), n_lengths += 1;
      structured += found.structure && found.structure->is_structured ? 1 : 0;
      for (std::size_t i = 0; i < counts.size(); ++i) {
        const fit::ParameterEstimate& p = found.parameters[i];
        if (!p.ci95) continue;
        const double value = truth[i].start;
        counts[i].n += 1;
        counts[i].covered += p.ci95->low <= value && value <= p.ci95->high ? 1 : 0;
        counts[i].squares += std::pow(std::log(p.estimate / value), 2);
        counts[i].stated += std::pow(*p.std_error / p.estimate, 2);
      }
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const Count& c = counts[i];
      std::printf("| %s | %g | %s | %s | %.1f | %.3f | %.2f | %.0f | %.1f | %.3f |\n", problem.name.c_str(),
                  rho, model.name, truth[i].name().c_str(), 100 * c.covered / c.n, std::sqrt(c.squares / c.n),
                  std::sqrt(c.stated / c.squares), static_cast<double>(n) - c.n,
                  100 * structured / static_cast<double>(n),
                  n_lengths > 0 ? std::exp(length / n_lengths) : 0.0);
    }
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t n = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 500;
  std::printf("%zu sets of bins, noise %g; errors are those of the logarithm of an unknown.\n\n", n, kSigma);
  std::printf(
      "| example | correlation | noise.model | unknown | covered %% | rmse | stated / rmse | without "
      "interval | structured %% | mean "
      "length_z |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  for (support::Identification problem : {support::example_3(), support::example_4()}) {
    if (argc > 2 && problem.name != std::string_view(argv[2])) continue;
    problem.heights = support::decimals(0.03, 0.97, 0.05);
    for (double& z : problem.heights) z -= 0.005;  // 20 bins from 0 to 1
    for (const double rho : {0.9, 0.0}) {
      if (argc > 3 && std::strtod(argv[3], nullptr) != rho) continue;
      run(problem, rho, n);
    }
  }
}
