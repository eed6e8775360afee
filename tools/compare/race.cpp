// SPDX-License-Identifier: BSD-3-Clause
#include "compare/race.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cli/arguments.hpp"
#include "cli/method.hpp"
#include "shearfront/exact/l1_error.hpp"

namespace shearfront::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLeastRuns = 3, kMostRuns = 200;
constexpr double kEnoughSeconds = 0.02, kLongRun = 1;
constexpr double kRounding = 1e-14;  // no order to be seen below it
constexpr double kMostCells = 1e8, kFinestResolution = 1e-8;
constexpr double kMostSeconds = 1000 * 365.25 * 24 * 3600;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<double> heights(const Scene<double>& scene, double n) {
  std::vector<double> z;
  const double height = scene.top() - scene.bottom();
  for (double i = 0; i < n; ++i) z.push_back(scene.bottom() + height * ((i + 0.5) / n));
  return z;
}

SolverRequest request_of(const Scene<double>& scene, const Contestant& contestant, double t, double rung) {
  SolverRequest request;
  request.times = {t};
  if (contestant.kind == LadderKind::points)
    request.heights = heights(scene, rung);
  else
    request.profiles = true;
  return request;
}

class Climb {
 public:
  Climb(const Scene<double>& scene, const ExactSolution<double>& exact, double t, const RaceLimits& limits)
      : scene_(scene), exact_(exact), t_(t), limits_(limits) {}

  Course run(const Contestant& contestant, const std::vector<double>& ladder) {
    Course course{contestant, {}, {}};
    last_run_ = before_ = spent_ = 0;
    for (const double rung : ladder) {
      if (limits_.is_stopped && limits_.is_stopped()) {
        course.ended = "interrupted";
        break;
      }
      if (!course.rungs.empty() && spent_ + expected() > limits_.budget_s) {
        course.ended = kBudgetSpent;
        break;
      }
      if (!add_rung(course, rung)) break;
    }
    return course;
  }

 private:
  /// A guess of the next run's time: cells and time steps double, if nothing else is known.
  [[nodiscard]] double expected() const {
    const double growth = before_ > 0 ? std::clamp(last_run_ / before_, 2.0, 30.0) : 4.0;
    return growth * last_run_;
  }

  bool add_rung(Course& course, double rung) {
    const Contestant& contestant = course.contestant;
    SolverOptions options = contestant.options(rung);
    options.progress = limits_.progress;
    const SolverRequest request = request_of(scene_, contestant, t_, rung);
    SolverResult result;
    const double wall = median_time(
        [&] {
          const auto begin = Clock::now();
          result = shearfront::solve(scene_, options.method, request, options.progress);
          spent_ += seconds_since(begin);
          return result.summary.usable();
        },
        limits_.repeats);
    before_ = last_run_;
    last_run_ = wall;
    const Summary& summary = result.summary;
    if (!summary.usable()) {
      course.ended = summary.status == Status::interrupted ? "interrupted" : summary.message;
      return false;
    }
    Rung done{rung, 0, wall, summary.collisions + summary.cell_updates};
    if (contestant.kind == LadderKind::points) {
      done.work = request.heights.size();
    } else {
      done.l1_error = errors_against(exact_, result.profiles.front(), t_).l1;
    }
    course.rungs.push_back(done);
    return true;
  }

  const Scene<double>& scene_;
  const ExactSolution<double>& exact_;
  double t_;
  const RaceLimits& limits_;
  double last_run_ = 0, before_ = 0, spent_ = 0;  // seconds
};

/// How many times finer b is than a.
double refinement(LadderKind kind, const Rung& a, const Rung& b) {
  return kind == LadderKind::resolution ? a.resolution / b.resolution : b.resolution / a.resolution;
}

}  // namespace

std::optional<double> Course::order(std::size_t rung) const {
  if (rung == 0 || contestant.kind == LadderKind::points) return std::nullopt;
  const Rung& a = rungs[rung - 1];
  const Rung& b = rungs[rung];
  if (a.l1_error < kRounding) return std::nullopt;
  const double order = std::log(a.l1_error / b.l1_error) / std::log(refinement(contestant.kind, a, b));
  return std::isfinite(order) ? std::optional(order) : std::nullopt;
}

double median_time(const std::function<bool()>& run, std::size_t repeats) {
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

Panel race(const Scene<double>& scene, const ExactSolution<double>& exact, double t,
           const std::vector<Contestant>& contestants, const Ladders& ladders, const RaceLimits& limits) {
  Panel panel{t, {}};
  Climb climb(scene, exact, t, limits);
  for (const Contestant& contestant : contestants)
    panel.courses.push_back(climb.run(contestant, ladders.of(contestant.kind)));
  return panel;
}

TimeToError time_to_error(const Course& course, double error) {
  using Kind = TimeToError::Kind;
  const auto& rungs = course.rungs;
  const auto at = [&](const Rung& a, const Rung& b) {  // on the line through both, log-log
    const double part = std::log(a.l1_error / error) / std::log(a.l1_error / b.l1_error);
    return a.wall_s * std::pow(b.wall_s / a.wall_s, part);
  };
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    if (rungs[i].l1_error > error) continue;
    if (i == 0) return {Kind::within_first, rungs[0].wall_s};
    return {Kind::interpolated, rungs[i].l1_error > 0 ? at(rungs[i - 1], rungs[i]) : rungs[i].wall_s};
  }
  if (rungs.size() < 2) return {};
  const Rung& a = rungs[rungs.size() - 2];
  const Rung& b = rungs.back();
  const auto order = course.order(rungs.size() - 1);
  if (!order || !(*order > 0) || !(b.wall_s > a.wall_s)) return {};
  const double finer = std::pow(b.l1_error / error, 1 / *order);
  const bool is_cells = course.contestant.kind == LadderKind::cells;
  if (is_cells ? b.resolution * finer > kMostCells : b.resolution / finer < kFinestResolution) return {};
  const double wall = at(a, b);
  if (!(wall < kMostSeconds)) return {};
  return {Kind::extrapolated, wall};
}

}  // namespace shearfront::tools
