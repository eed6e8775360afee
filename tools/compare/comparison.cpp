// SPDX-License-Identifier: BSD-3-Clause
#include "compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cli/arguments.hpp"
#include "cli/method.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// solver:option. `by_default` variants take part when no methods are named.
struct Variant {
  std::string_view solver, option;
  bool by_default;
  void (*set)(SolverOptions&);
};

void align(SolverOptions& o) { o.align_cells = true; }
void step_locally(SolverOptions& o) { o.local_steps = true; }

constexpr Variant kVariants[] = {
    {"front-tracking", "linear", true, [](SolverOptions& o) { o.reconstruct = Reconstruction::linear; }},
    {"front-tracking", "singular-mapping", false,
     [](SolverOptions& o) { o.grid = GridKind::singular_mapping; }},
    {"engquist-osher", "align-cells", false, align},
    {"engquist-osher", "local-steps", false, step_locally},
    {"engquist-osher", "face-value", false,
     [](SolverOptions& o) { o.face_coefficient = FaceCoefficient::value; }},
    {"godunov", "align-cells", false, align},
    {"godunov", "local-steps", false, step_locally},
    {"muscl", "minmod", false, [](SolverOptions& o) { o.limiter = Limiter::minmod; }},
    {"muscl", "van-leer", false, [](SolverOptions& o) { o.limiter = Limiter::van_leer; }},
    {"muscl", "align-cells", false, align},
    {"muscl", "local-steps", false, step_locally},
};

Refinement refinement_of(const Guarantees& g) {
  if (g.exact) return Refinement::points;
  return g.has_fronts ? Refinement::resolution : Refinement::cells;
}

bool is_by_default(const ComparedMethod& method) {
  return std::none_of(std::begin(kVariants), std::end(kVariants), [&](const Variant& v) {
    return !v.by_default && method.name == fmt::format("{}:{}", v.solver, v.option);
  });
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Median wall time of runs of `run`, which returns whether to go on.
template <class Run>
double median_time(const Run& run, std::size_t repeats) {
  constexpr std::size_t kLeastRuns = 3, kMostRuns = 200;
  constexpr double kEnoughSeconds = 0.02, kLongRun = 1;
  std::vector<double> seconds;
  double all = 0;
  const auto is_enough = [&] {
    if (repeats > 0) return seconds.size() >= repeats;
    if (all >= kLongRun || seconds.size() >= kMostRuns) return true;
    return seconds.size() >= kLeastRuns && all >= kEnoughSeconds;
  };
  while (!is_enough()) {
    const auto begin = Clock::now();
    const bool goes_on = run();
    seconds.push_back(seconds_since(begin));
    all += seconds.back();
    if (!goes_on) break;
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

SolverRequest request_of(const Scene<double>& scene, Refinement refinement, double t, double resolution) {
  SolverRequest request;
  request.times = {t};
  request.profiles = refinement != Refinement::points;
  const double height = scene.top() - scene.bottom();
  for (double i = 0; refinement == Refinement::points && i < resolution; ++i)
    request.heights.push_back(scene.bottom() + height * ((i + 0.5) / resolution));
  return request;
}

}  // namespace

const std::vector<ComparedMethod>& compared_methods() {
  static const std::vector<ComparedMethod> methods = [] {
    std::vector<ComparedMethod> all;
    SolverList::for_each([&]<class S>() {
      const Guarantees g = S::guarantees();
      if ((!g.exact && !g.has_profiles) || g.scope.diffusion) return;  // errors are those against exact
      all.push_back({std::string(S::kName), S::kName, refinement_of(g), nullptr});
      for (const Variant& v : kVariants)
        if (v.solver == S::kName)
          all.push_back({fmt::format("{}:{}", v.solver, v.option), S::kName, refinement_of(g), v.set});
    });
    return all;
  }();
  return methods;
}

std::vector<ComparedMethod> compared_methods(std::string_view option,
                                             const std::optional<std::string>& list) {
  std::vector<std::string> names;
  std::vector<ComparedMethod> chosen;
  for (const ComparedMethod& m : compared_methods()) {
    names.push_back(m.name);
    if (!list && is_by_default(m)) chosen.push_back(m);
  }
  if (!list) return chosen;
  for (const std::string_view part : split(*list, ',')) {
    const std::string name(part);
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end()) {
      const auto meant = nearest_name(name, names);
      refuse(option, name,
             fmt::format("must be one of: {}{}", fmt::join(names, ", "),
                         meant ? fmt::format(" (did you mean {}?)", *meant) : ""));
    }
    if (std::none_of(chosen.begin(), chosen.end(), [&](const ComparedMethod& m) { return m.name == name; }))
      chosen.push_back(compared_methods()[static_cast<std::size_t>(it - names.begin())]);
  }
  return chosen;
}

const std::vector<double>& Resolutions::of(Refinement refinement) const {
  if (refinement == Refinement::cells) return cells;
  return refinement == Refinement::resolution ? resolutions : points;
}

Resolutions default_resolutions(bool longest) {
  Resolutions all;
  for (double n = 100; n <= (longest ? 2e6 : 3200); n *= 2) all.cells.push_back(n);
  all.resolutions = {0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5};
  if (longest) all.resolutions.insert(all.resolutions.end(), {3e-6, 1e-6});
  all.points = {1000};
  return all;
}

std::optional<double> Course::order(std::size_t run) const {
  constexpr double kRounding = 1e-14;  // no order to be seen below it
  if (run == 0 || method.refinement == Refinement::points) return std::nullopt;
  const ComparedRun &a = runs[run - 1], &b = runs[run];
  if (a.l1_error < kRounding) return std::nullopt;
  const double ratio = b.resolution / a.resolution;
  const double finer = method.refinement == Refinement::resolution ? 1 / ratio : ratio;
  const double order = std::log(a.l1_error / b.l1_error) / std::log(finer);
  return std::isfinite(order) ? std::optional(order) : std::nullopt;
}

Course compare_method(const Scene<double>& scene, const ExactSolution<double>& exact, double t,
                      const ComparedMethod& method, const std::vector<double>& resolutions,
                      const ComparisonLimits& limits) {
  Course course{method, t, {}, {}};
  double last = 0, before = 0, spent = 0;  // seconds
  for (const double resolution : resolutions) {
    if (limits.is_stopped && limits.is_stopped()) {
      course.ended = "interrupted";
      break;
    }
    // A guess of the next run's time: cells and time steps double, if nothing else is known.
    const double growth = before > 0 ? std::clamp(last / before, 2.0, 30.0) : 4.0;
    if (!course.runs.empty() && spent + growth * last > limits.budget_s) {
      course.ended = kBudgetSpent;
      break;
    }
    SolverOptions options;
    if (method.refinement == Refinement::cells) options.cells = static_cast<std::size_t>(resolution);
    if (method.refinement == Refinement::resolution) options.resolution = resolution;
    if (method.set) method.set(options);
    options.progress = limits.progress;
    const SolverRequest request = request_of(scene, method.refinement, t, resolution);
    SolverResult result;
    const auto run = [&] {
      const auto begin = Clock::now();
      result = solve_with(method.solver, scene, request, options);
      spent += seconds_since(begin);
      return result.summary.usable();
    };
    before = std::exchange(last, median_time(run, limits.repeats));
    const Summary& summary = result.summary;
    if (!summary.usable()) {
      course.ended = summary.status == Status::interrupted ? "interrupted" : summary.message;
      break;
    }
    const bool is_exact = method.refinement == Refinement::points;
    course.runs.push_back({resolution, is_exact ? 0 : errors_against(exact, result.profiles.front(), t).l1,
                           last,
                           is_exact ? request.heights.size() : summary.collisions + summary.cell_updates});
  }
  return course;
}

}  // namespace shearfront::tools
