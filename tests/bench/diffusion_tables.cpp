// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of the diffusive engine: orders, errors and times.
//   shearfront_diffusion_tables [kink|uniform|burgers|chute|cells|multigrid]     all without an argument
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "bench/multigrid_cycle.hpp"
#include "shearfront/diffusion/cole_hopf_uniform.hpp"
#include "shearfront/diffusion/tridiagonal.hpp"
#include "shearfront/numeric/sum.hpp"
#include "support/diffusion_problems.hpp"

namespace shearfront::diffusion {
namespace {

using support::Errors;
using Numbers = std::vector<double>;

/// Seconds of the fastest of `n` runs: the machine may be busy with something else.
double fastest_of(int n, const std::function<void()>& run) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

double order(double coarse, double fine) { return coarse > 0 ? std::log2(coarse / fine) : NAN; }

void print_errors(const std::string& name, const Errors& e, const Errors& last) {
  std::printf("| %s | %.3e | %.3e | %.3e | %.3f | %.3f | %.3f |\n", name.c_str(), e.max, e.l2, e.h1,
              order(last.max, e.max), order(last.l2, e.l2), order(last.h1, e.h1));
}

void print_kink() {
  for (const double half : {0.5, 1.0}) {
    std::printf(
        "\nKink on [-%g, %g], t = 2, dt = dy\n\n| dy | max | L2 | H1 | order | order | order |\n"
        "|---|---|---|---|---|---|---|\n",
        half, half);
    Errors last, first;
    for (std::size_t n = 50; n <= 6400; n *= 2) {
      const double width = 1.0 / static_cast<double>(n);
      const Errors e = support::kink_errors(n, width, half);
      print_errors(std::to_string(width), e, last);
      if (n == 50) first = e;
      last = e;
    }
    std::printf("| mean order | | | | %.3f | %.3f | %.3f |\n", order(first.max, last.max) / 7,
                order(first.l2, last.l2) / 7, order(first.h1, last.h1) / 7);
  }
}

void print_burgers() {
  std::printf(
      "\nPeriodic Burgers from sin x, t = 2, dt = 2 / N\n\n| mu, N | max | L2 | H1 | order | order | order "
      "|\n"
      "|---|---|---|---|---|---|---|\n");
  for (const double mu : {1.0, 0.1, 0.01}) {
    Errors last;
    for (std::size_t n = 128; n <= 8192; n *= 2) {
      const Errors e = support::burgers_errors(n, 2.0 / static_cast<double>(n), mu, 2);
      print_errors(std::to_string(mu) + ", " + std::to_string(n), e, last);
      last = e;
    }
  }
}

/// The same run again and again: time, steps, solutions of linear systems.
struct Cost {
  double seconds;
  std::uint64_t steps, iterations;
};

Cost cost_of(const Problem& problem, const Options& options, double t, int runs) {
  Cost cost{};
  cost.seconds = fastest_of(runs, [&] {
    CrankNicolson run(problem, options);
    run.advance_to(t);
    cost.steps = run.n_steps();
    cost.iterations = run.n_iterations();
  });
  return cost;
}

std::vector<std::pair<std::string, Options>> kinds(double dt, const Numbers& tolerances) {
  std::vector<std::pair<std::string, Options>> all(2);
  for (auto& [name, options] : all) options.dt = dt;
  all[0].first = "newton";
  all[1].first = "fitted";
  all[1].second.scheme = Scheme::fitted;
  for (const double tolerance : tolerances) {
    all.emplace_back("tolerance " + std::to_string(tolerance), Options{});
    all.back().second.tolerance = tolerance;
  }
  return all;
}

/// Columns: largest difference from `exact` at each time; mass; states beyond [0, 1]; time.
void print_runs(const Problem& problem, double dt, const Numbers& tolerances, const Numbers& times,
                const std::function<Numbers(double)>& exact) {
  for (const auto& [name, options] : kinds(dt, tolerances)) {
    CrankNicolson run(problem, options);
    double mass_error = 0, beyond = 0;
    std::printf("| %zu | %s |", problem.n_cells, name.c_str());
    for (const double t : times) {
      run.advance_to(t);
      CompensatedSum<double> change;
      for (std::size_t j = 0; j < problem.n_cells; ++j) {
        const double phi = run.states()[j];
        change += (phi - problem.initial[j]) / static_cast<double>(problem.n_cells);
        beyond = std::max({beyond, -phi, phi - 1});
      }
      mass_error = std::max(mass_error, std::abs(change.value()));
      std::printf(" %.1e |", Errors(run.states(), exact(t), problem.width()).max);
    }
    const Cost cost = cost_of(problem, options, times.back(), 5);
    std::printf(" %.1e | %.1e | %llu | %.2f | %.1f |\n", mass_error, beyond,
                static_cast<unsigned long long>(cost.steps),
                static_cast<double>(cost.iterations) / static_cast<double>(cost.steps), 1e3 * cost.seconds);
    std::fflush(stdout);
  }
}

void print_uniform() {
  std::printf("\nUniform start 0.55 between walls, largest error of cell means, dt = 0.2 / cells\n");
  for (const double d : {0.5, 0.1, 0.02, 0.002}) {
    std::printf(
        "\nD = %g\n\n| cells | steps by | t = 0.1 | 0.5 | 1 | 2 | mass | beyond [0, 1] | steps | systems a "
        "step |"
        " ms |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        d);
    for (std::size_t n = 500; n <= (d < 0.01 ? 4000 : 500); n *= 2) {
      const Problem problem = support::uniform_problem(1, n, 1, d, 0.55);
      print_runs(problem, 0.2 / static_cast<double>(n), {1e-2, 1e-3, 1e-4, 1e-5}, {0.1, 0.5, 1, 2},
                 [&](double t) { return support::uniform_start_means(problem, t); });
    }
  }
}

Problem chute(std::size_t n) {
  Problem p = support::uniform_problem(0.044, n, 0, 5e-8, 0.5);
  for (std::size_t i = 0; i <= n; ++i) {
    const double y = (static_cast<double>(i) / static_cast<double>(n) - 0.5) * 0.044;
    const double sign = 2 * i < n ? -1 : 2 * i > n ? 1 : 0;
    p.rate[i] = -sign * 2.5e-3 / 2500 * 8.21e-4 * 280 * std::exp(280 * std::abs(y));
  }
  return p;
}

/// Means over groups of cells.
Numbers coarsened(std::span<const double> fine, std::size_t n) {
  const std::size_t share = fine.size() / n;
  Numbers all(n);
  for (std::size_t i = 0; i < fine.size(); ++i) all[i / share] += fine[i] / static_cast<double>(share);
  return all;
}

void print_chute() {
  std::printf(
      "\nChute, against 20000 cells and tolerance 1e-7\n\n| cells | steps by | 1 s | 10 s | 100 s | 1000 s |"
      " mass | beyond [0, 1] | steps | systems a step | ms "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const Numbers times{1, 10, 100, 1000};
  Options fine;
  fine.tolerance = 1e-7;
  CrankNicolson run(chute(20000), fine);
  std::vector<Numbers> states;
  for (const double t : times) {
    run.advance_to(t);
    states.emplace_back(run.states().begin(), run.states().end());
  }
  for (const std::size_t n : {std::size_t{500}, std::size_t{5000}})
    print_runs(chute(n), 0.5, {1e-2, 1e-3, 1e-4, 1e-5}, times, [&](double t) {
      const auto i = static_cast<std::size_t>(std::find(times.begin(), times.end(), t) - times.begin());
      return coarsened(states[i], n);
    });
}

void print_cells() {
  std::printf("\nTime of a step and cell, D = 0.1\n\n| cells | systems a step | ns |\n|---|---|---|\n");
  for (const std::size_t n : {100u, 1000u, 10000u, 100000u, 1000000u}) {
    const Problem problem = support::uniform_problem(1, n, 1, 0.1, 0.55);
    Options options;
    options.dt = 1e-4;
    options.smoothed_steps = 0;
    const auto steps = static_cast<double>(std::max<std::size_t>(10000000 / n, 20));
    const Cost cost = cost_of(problem, options, 1e-4 * steps, 5);
    const double all = static_cast<double>(cost.steps);
    std::printf("| %zu | %.2f | %.2f |\n", n, static_cast<double>(cost.iterations) / all,
                1e9 * cost.seconds / all / static_cast<double>(n));
  }
}

/// The system of a step of Burgers with mu: lower - upper = 2 mu tau / dx^2, tau = dt / 2, dt = 2 / n.
void print_multigrid() {
  std::printf(
      "\nOne periodic system of a step of Burgers\n\n| mu, N | direct, us | residual | V-cycles, us | cycles "
      "|"
      " residual | ratio |\n|---|---|---|---|---|---|---|\n");
  const double pi = std::acos(-1.0);
  for (const double mu : {1.0, 0.1, 0.01})
    for (const std::size_t n : {128u, 1024u, 8192u}) {
      const double dx = 2 * pi / static_cast<double>(n), tau = 1 / static_cast<double>(n);
      Numbers lower(n), upper(n), right(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double x = dx * static_cast<double>(i);
        // Upwinded where the cell Peclet number is above 2, so that relaxation converges.
        const double d = std::max(mu / (dx * dx), 0.5 * std::abs(std::sin(x)) / dx);
        lower[i] = tau * (0.5 * std::sin(x) / dx + d);
        upper[i] = tau * (0.5 * std::sin(x) / dx - d);
        right[i] = std::cos(3 * x) + std::cos(static_cast<double>(i * i % 97));
      }
      Tridiagonal direct(n, true);
      bench::MultigridCycle multigrid(lower, upper);
      Numbers x, y;
      const auto residual = [&](const Numbers& z) {
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
          const double down = z[(i + n - 1) % n], up = z[(i + 1) % n];
          const double rest = right[i] - (1 + lower[i] - upper[i]) * z[i] + lower[i] * down - upper[i] * up;
          largest = std::max(largest, std::abs(rest));
        }
        return largest / 2;
      };
      const double direct_time = fastest_of(200, [&] {
        x = right;
        direct.solve(1, lower, upper, x);
      });
      int cycles = 0;
      const double time = fastest_of(50, [&] { cycles = multigrid.solve(right, 1e-12, y); });
      std::printf("| %g, %zu | %.2f | %.0e | %.2f | %d | %.0e | %.0f |\n", mu, n, 1e6 * direct_time,
                  residual(x), 1e6 * time, cycles, residual(y), time / direct_time);
    }
}

}  // namespace
}  // namespace shearfront::diffusion

int main(int argc, char** argv) {
  using namespace shearfront::diffusion;
  const auto wanted = [&](const char* name) { return argc < 2 || std::strcmp(argv[1], name) == 0; };
  if (wanted("kink")) print_kink();
  if (wanted("uniform")) print_uniform();
  if (wanted("burgers")) print_burgers();
  if (wanted("chute")) print_chute();
  if (wanted("cells")) print_cells();
  if (wanted("multigrid")) print_multigrid();
}
