// SPDX-License-Identifier: BSD-3-Clause
#include "compare/observed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/arguments.hpp"
#include "cli/method.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/solution/observed_events.hpp"

namespace shearfront::tools {
namespace {

using Times = std::vector<std::optional<double>>;

constexpr std::size_t kFirstTimes = 65, kMoreTimes = 16;
constexpr int kPasses = 3;
constexpr double kHorizon = 1.25;  // times t*

Times times_of(const Timeline<double>& timeline) {
  Times times;
  for (const auto& at : timeline.interfaces) times.push_back(at.first);
  times.push_back(timeline.t0);
  times.push_back(timeline.t1);
  for (const auto& at : timeline.interfaces) times.push_back(at.last);
  times.push_back(timeline.t_star);
  return times;
}

std::vector<std::string> names_of(std::size_t n_interfaces) {
  std::vector<std::string> names;
  const auto number = [&](std::size_t i) {
    return n_interfaces == 1 ? std::string() : fmt::format("({})", i + 1);
  };
  for (std::size_t i = 0; i < n_interfaces; ++i) names.push_back("t_c" + number(i));
  names.insert(names.end(), {"t_0", "t_1"});
  for (std::size_t i = 0; i < n_interfaces; ++i) names.push_back("t^_c" + number(i));
  names.push_back("t*");
  return names;
}

/// More times in the intervals that hold an event.
std::vector<double> refined(const std::vector<double>& times, const Times& events) {
  std::vector<double> all = times;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const bool is_hit = std::any_of(events.begin(), events.end(),
                                    [&](const auto& t) { return t && *t >= times[i] && *t <= times[i + 1]; });
    if (!is_hit) continue;
    const auto more = equally_spaced(times[i], times[i + 1], kMoreTimes + 2);
    all.insert(all.end(), more.begin() + 1, more.end() - 1);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::optional<Times> times_by(const Scene<double>& scene, const Contestant& contestant, double rung,
                              double horizon, const RaceLimits& limits) {
  SolverOptions options = contestant.options(rung);
  options.progress = limits.progress;
  SolverRequest request;
  if (options.method.guarantees().has_timeline) {
    request.timeline = true;
    const SolverResult result = shearfront::solve(scene, options.method, request, options.progress);
    if (!result.summary.usable()) return std::nullopt;
    return times_of(*result.timeline);
  }
  request.times = equally_spaced(0, horizon, kFirstTimes);
  request.profiles = true;
  Times events;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (pass > 0) request.times = refined(request.times, events);
    SolverResult result = shearfront::solve(scene, options.method, request, options.progress);
    if (!result.summary.usable()) return std::nullopt;
    events = times_of(observed_events(scene, {request.times, std::move(result.profiles)}));
  }
  return events;
}

}  // namespace

ObservedEvents observe_events(const Scene<double>& scene, const std::vector<Contestant>& contestants,
                              const Ladders& ladders, const RaceLimits& limits) {
  using Clock = std::chrono::steady_clock;
  const Timeline<double> exact = exact_timeline(scene);
  ObservedEvents events{names_of(exact.interfaces.size()), times_of(exact), {}};
  const double horizon = kHorizon * exact.t_star.value_or(0);
  if (!(horizon > 0)) return events;
  for (const Contestant& contestant : contestants) {
    if (contestant.kind == LadderKind::points || contestant.is_drawing) continue;
    const auto begin = Clock::now();
    double last = 0;
    for (const double rung : ladders.of(contestant.kind)) {
      const auto begin_of_rung = Clock::now();
      const double spent = std::chrono::duration<double>(begin_of_rung - begin).count();
      if ((limits.is_stopped && limits.is_stopped()) || (last > 0 && spent + 4 * last > limits.budget_s))
        break;
      const auto times = times_by(scene, contestant, rung, horizon, limits);
      if (!times) break;
      events.rows.push_back({contestant.name, rung, *times});
      last = std::chrono::duration<double>(Clock::now() - begin_of_rung).count();
    }
  }
  return events;
}

}  // namespace shearfront::tools
