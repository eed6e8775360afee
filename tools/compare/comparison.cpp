// SPDX-License-Identifier: BSD-3-Clause
#include "compare/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cli/arguments.hpp"
#include "cli/progress.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

using Clock = std::chrono::steady_clock;

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

std::optional<double> order_of(const ComparedRun& a, const ComparedRun& b) {
  constexpr double kRounding = 1e-14;  // no order to be seen below it
  if (a.l1_error < kRounding) return std::nullopt;
  const double order = std::log(a.l1_error / b.l1_error) / std::abs(std::log(b.resolution / a.resolution));
  return std::isfinite(order) ? std::optional(order) : std::nullopt;
}

}  // namespace

std::vector<ComparedMethod> compared_methods() {
  std::vector<ComparedMethod> all;
  for (const std::string& name : Method::names()) {
    const Method method(name);
    const Guarantees g = method.guarantees();
    if ((!g.exact && !g.has_profiles) || g.diffusion) continue;  // errors are those against exact
    all.push_back({name, method});
    const auto add = [&](std::string_view variant, std::string_view option, const OptionValue& value) {
      all.push_back({fmt::format("{}:{}", name, variant), method});
      all.back().method.set(option, value);
    };
    for (const Option& o : method.options()) {
      if (o.info.leaves_samples) continue;
      if (std::holds_alternative<bool>(o.value)) add(o.info.name, o.info.name, true);
      const auto* choice = std::get_if<OptionChoice>(&o.value);
      for (std::size_t i = 0; choice && i < o.info.names.size(); ++i)
        if (i != choice->index) add(o.info.names[i], o.info.name, OptionChoice{i});
    }
  }
  return all;
}

std::vector<ComparedMethod> compared_methods(std::string_view option,
                                             const std::optional<std::string>& list) {
  constexpr std::string_view kWorthIt = "front-tracking:linear";
  const std::vector<ComparedMethod> all = compared_methods();
  std::vector<std::string> names;
  std::vector<ComparedMethod> chosen;
  for (const ComparedMethod& m : all) {
    names.push_back(m.name);
    const bool is_sound = m.method.guarantees().bounded;  // what overshoots runs only when it is named
    if (!list && is_sound && (m.name == m.method.name() || m.name == kWorthIt)) chosen.push_back(m);
  }
  if (!list) return chosen;
  for (const std::string_view name : split(*list, ',')) {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end()) {
      const auto meant = nearest_name(std::string(name), names);
      refuse(option, name,
             fmt::format("must be one of: {}{}", fmt::join(names, ", "),
                         meant ? fmt::format(" (did you mean {}?)", *meant) : ""));
    }
    if (std::none_of(chosen.begin(), chosen.end(), [&](const ComparedMethod& m) { return m.name == name; }))
      chosen.push_back(all[static_cast<std::size_t>(it - names.begin())]);
  }
  return chosen;
}

Course compare_method(const Scene<double>& scene, const ExactSolution<double>& exact, double t,
                      const ComparedMethod& method, std::vector<double> resolutions,
                      const ComparisonLimits& limits) {
  constexpr std::size_t kHeights = 1000;
  const bool is_exact = method.method.guarantees().exact;
  SolverRequest request;
  request.times = {t};
  request.profiles = !is_exact;
  if (is_exact) resolutions = {kHeights};
  for (std::size_t i = 0; is_exact && i < kHeights; ++i)
    request.heights.push_back(
        std::lerp(scene.bottom(), scene.top(), (static_cast<double>(i) + 0.5) / kHeights));
  Course course{method, t, {}, {}};
  double last = 0, before = 0, spent = 0;  // seconds
  for (const double resolution : resolutions) {
    if (InterruptGuard::is_interrupted()) {
      course.ended = "interrupted";
      break;
    }
    // A guess of the next run's time: cells and time steps double, if nothing else is known.
    const double growth = before > 0 ? std::clamp(last / before, 2.0, 30.0) : 4.0;
    if (!course.runs.empty() && spent + growth * last > limits.budget_s) {
      course.ended = kBudgetSpent;
      break;
    }
    Method finer = method.method;
    if (finer.has_option("resolution")) finer.set("resolution", resolution);
    if (finer.has_option("cells")) finer.set("cells", static_cast<std::uint64_t>(resolution));
    SolverResult result;
    const auto run = [&] {
      const auto begin = Clock::now();
      result = solve(scene, finer, request, [&](double at, std::uint64_t work) {
        return (!limits.progress || limits.progress(at, work)) && !InterruptGuard::is_interrupted();
      });
      spent += seconds_since(begin);
      return result.summary.usable();
    };
    before = std::exchange(last, median_time(run, limits.repeats));
    const Summary& summary = result.summary;
    if (!summary.usable()) {
      course.ended = summary.status == Status::interrupted ? "interrupted" : summary.message;
      break;
    }
    ComparedRun done{
        resolution, 0, {}, last, is_exact ? kHeights : summary.collisions + summary.cell_updates};
    if (!is_exact)
      done.l1_error = errors_against(exact, result.profiles.front(), t).l1 / (scene.top() - scene.bottom());
    if (!course.runs.empty()) done.order = order_of(course.runs.back(), done);
    course.runs.push_back(done);
  }
  return course;
}

}  // namespace shearfront::tools
