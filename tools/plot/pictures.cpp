// SPDX-License-Identifier: BSD-3-Clause
#include "plot/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

// Finer than a picture can show.
constexpr std::size_t kProfileHeights = 4001, kCourseTimes = 401;

/// The smallest jump drawn as a shock: more than a step of a fan, and in a staircase more than the jump with
/// which a wave turns round at the edge of a step, the square root of the relative change of a there.
double least_shock(const Scene<double>& scene, const std::vector<FrontSegment<double>>& fronts,
                   double resolution) {
  double least = 1.5 * resolution;
  if (scene.is_layered()) return least;
  std::size_t n = 1;
  for (const auto& f : fronts) n = std::max(n, f.layer + 1);
  const double step = (scene.top() - scene.bottom()) / static_cast<double>(n);
  for (std::size_t k = 1; k < n; ++k) {
    const double z = scene.bottom() + static_cast<double>(k) * step;
    const double change = scene.shear_rate_at(z) / scene.shear_rate_at(z - step) - 1;
    least = std::max(least, 1.3 * std::sqrt(std::abs(change)));
  }
  return std::min(least, 0.5);
}

/// Few fronts as they are. Of many all shocks, of the others those that some of 80 states lie between, wherever they go from
/// there: more of a fan are a moire or a solid area. The states are closer to each other at both ends, where a fan from a slow
/// layer ends up in a fast one.
std::vector<FrontSegment<double>> thinned(const Scene<double>& scene,
                                          const std::vector<FrontSegment<double>>& fronts, double least) {
  constexpr double kMostStates = 80, kSteps = 1e7;  // of fluxes, to be found again
  constexpr std::size_t kFewFronts = 600;
  if (fronts.size() <= kFewFronts) return fronts;
  const StateRange<double> states = states_of(scene);
  const auto state = [&](double phi) {
    const double part = std::clamp((phi - states.lowest) / (states.highest - states.lowest), 0.0, 1.0);
    return std::floor(std::asin(std::sqrt(part)) * 2 / std::numbers::pi * kMostStates);
  };
  double largest = 0;
  const auto fluxes = [&](const FrontSegment<double>& f) {
    const double z = std::isfinite(f.z_end) ? (f.z_begin + f.z_end) / 2 : f.z_begin;
    return std::minmax({flux_at(scene, z, f.phi_below), flux_at(scene, z, f.phi_above)});
  };
  for (const auto& f : fronts) largest = std::max(largest, std::abs(fluxes(f).first));
  const auto key = [&](const FrontSegment<double>& f) {
    const auto [low, high] = fluxes(f);
    return std::pair(std::llround(low / largest * kSteps), std::llround(high / largest * kSteps));
  };
  const auto is_shock = [&](const FrontSegment<double>& f) {
    return std::abs(f.phi_above - f.phi_below) > least;
  };
  std::set<std::pair<long long, long long>> shown;
  for (const auto& f : fronts)
    if (!is_shock(f) && state(f.phi_above) != state(f.phi_below)) shown.insert(key(f));
  std::vector<FrontSegment<double>> kept;
  for (const auto& f : fronts)
    if (is_shock(f) || shown.contains(key(f))) kept.push_back(f);
  return kept;
}

/// Latest time to show: a little after the steady state, else the end of the computed fronts.
double end_time(const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline) {
  double end = 0;
  for (const auto& f : fronts) end = std::max(end, std::isfinite(f.t_end) ? f.t_end : f.t_begin);
  if (timeline.t_star && *timeline.t_star > 0 && *timeline.t_star <= end * 1.05)
    return *timeline.t_star * 1.08;
  return end > 0 ? end : 1.0;
}

/// Rows t,z,kind of a grid: 1 where there are small grains only, -1 large ones only, 0 both. Empty without a solution.
std::string pure_rows(const Scene<double>& scene, const Method& method, double t_end) {
  constexpr std::size_t kTimes = 301, kHeights = 241;
  constexpr double kPure = 1e-9;
  SolverRequest request;
  for (std::size_t i = 0; i < kTimes; ++i)
    request.times.push_back(t_end * (static_cast<double>(i) + 0.5) / kTimes);
  for (std::size_t j = 0; j < kHeights; ++j)
    request.heights.push_back(
        std::lerp(scene.bottom(), scene.top(), (static_cast<double>(j) + 0.5) / kHeights));
  const SolverResult result = solve(scene, method, request);
  if (!result.summary.usable()) return {};
  std::string rows = "t,z,kind\n";
  for (std::size_t i = 0; i < kTimes; ++i)
    for (std::size_t j = 0; j < kHeights; ++j) {
      const StateRange<double> range = scene.range_at(request.heights[j]);
      const double share = (result.phi(i, j) - range.lowest) / (range.highest - range.lowest);
      const int kind = share < kPure ? -1 : share > 1 - kPure ? 1 : 0;
      rows += fmt::format("{:.7g},{:.7g},{}\n", request.times[i], request.heights[j], kind);
    }
  return rows;
}

/// Interfaces whose events are labelled: in the width of a column there is no room between the labels of several.
std::size_t most_labels() { return picture_is_narrow() ? 1 : 4; }

/// Rows t,z,label,side,is_first of the events. Labels stand where no front is: before a first wave, after a last one,
/// and outside the walls. Events at more than most_labels() interfaces have none, but a place in the legend by their kind.
std::string event_rows(const Scene<double>& scene, const Timeline<double>& timeline, double t_end) {
  std::string rows = "t,z,label,side,is_first\n";
  const std::string along = scene.spec().units.symbol();
  const auto mark = [&](const std::optional<double>& t, double z, std::string_view symbol,
                        std::string_view index, std::string_view side, bool is_first = false) {
    if (!t || *t > t_end) return;
    const std::string label = symbol.empty() ? "" : fmt::format("\"{{/:Italic {}}}{}\"", symbol, index);
    rows += fmt::format("{},{},{},{},{:d}\n", number_text(*t), number_text(z), label, side, is_first);
  };
  const std::size_t n = timeline.interfaces.size(), most = most_labels();
  const double z_jump = scene.initial_breaks().empty() ? scene.top() : scene.initial_breaks().front();
  for (std::size_t i = 0; i < n; ++i) {
    const auto& at = timeline.interfaces[i];
    const std::string index = n == 1 ? "_{c}" : fmt::format("_{{c}}({})", i + 1);  // as in tables
    const bool has_room = at.first && *at.first > 0.07 * t_end;
    mark(at.first, at.z, n <= most && has_room ? along : "", index,
         at.z < z_jump ? "left-below" : "left-above", n > most);
    mark(at.last, at.z, n <= most ? along + "\u0302" : "", index,
         at.z < timeline.steady_height ? "right-below" : "right-above");
  }
  mark(timeline.t0, scene.bottom(), along, "_0", "below");
  mark(timeline.t1, scene.top(), along, "_1", "above");
  mark(timeline.t_star, timeline.steady_height, along, "*", "right");
  return rows;
}

/// Rows z,c of the solid fraction, with both values where it jumps.
std::string bound_rows(const Scene<double>& scene) {
  constexpr std::size_t kHeights = 400;
  std::vector<double> heights = equally_spaced(scene.bottom(), scene.top(), kHeights);
  for (const double z : scene.knots()) {
    heights.push_back(z);
    heights.push_back(std::nextafter(z, scene.bottom()));
  }
  std::sort(heights.begin(), heights.end());
  std::string rows = "z,c\n";
  for (const double z : heights)
    rows += fmt::format("{},{}\n", number_text(z), number_text(scene.solid_fraction_at(z)));
  return rows;
}

}  // namespace

void set_scene(Picture& picture, const Scene<double>& scene, const std::string& subtitle) {
  const StateRange<double> states = states_of(scene);
  picture.set("title", scene.name());
  picture.set("subtitle", subtitle);
  picture.set("along", scene.spec().units.symbol());
  picture.set("unit_t", without_markup(scene.spec().units.t));
  picture.set("unit_z", without_markup(scene.spec().units.z));
  picture.set("z_low", scene.bottom());
  picture.set("z_high", scene.top());
  picture.set("phi_low", states.lowest);
  picture.set("phi_high", states.highest);
  picture.set("interfaces", scene.is_layered() ? scene.knots() : std::vector<double>{});
}

double flux_at(const Scene<double>& scene, double z, double phi) {
  const SceneSpec<double>& spec = scene.spec();
  const auto i =
      std::upper_bound(spec.flux_breaks.begin(), spec.flux_breaks.end(), z) - spec.flux_breaks.begin();
  const double c = scene.solid_fraction_at(z);
  return c * scene.rate_at(z) * spec.fluxes[static_cast<std::size_t>(i)].value(phi / c);
}

bool is_of_fan(const Scene<double>& scene, const FrontSegment<double>& front) {
  const double z = std::isfinite(front.z_end) ? (front.z_begin + front.z_end) / 2 : front.z_begin;
  const double c = scene.solid_fraction_at(z);
  const Flux<double>& flux = scene.flux_at(z);
  return flux.derivative(front.phi_below / c) < flux.derivative(front.phi_above / c);
}

std::string described(const Method& method, const Scene<double>& scene) {
  std::string text(method.name());
  if (method.has_option("resolution")) text += ", resolution " + number_text(number_of(method, "resolution"));
  if (method.has_option("cell-tolerance") && number_of(method, "cell-tolerance") > 0)
    return text + ", cells to " + number_text(number_of(method, "cell-tolerance"));
  if (!method.has_option("cells")) return text;
  double cells = number_of(method, "cells");
  if (cells == 0) {  // its own choice
    SolverRequest request;
    request.times = {0};
    request.profiles = true;
    const SolverResult start = solve(scene, method, request);
    if (!start.profiles.empty()) cells = static_cast<double>(start.profiles.front().below().size());
  }
  return cells > 0 ? text + ", " + number_text(cells) + " cells" : text;
}

StateRange<double> states_of(const Scene<double>& scene) {
  std::vector<double> heights = scene.knots();
  heights.push_back(scene.top());
  StateRange<double> all = scene.range_at(scene.bottom());
  double below = scene.bottom();
  for (const double z : heights) {
    for (const double at : {below + (z - below) / 2, z}) {  // the value at a knot is that above it
      const StateRange<double> range = scene.range_at(at);
      all = {std::min(all.lowest, range.lowest), std::max(all.highest, range.highest)};
    }
    below = z;
  }
  return all;
}

int draw_fronts(const std::string& path, const Scene<double>& scene, const Method& method,
                const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline) {
  const double t_end = end_time(fronts, timeline), resolution = number_of(method, "resolution");
  Picture picture(path, "fronts");
  set_scene(picture, scene, fmt::format("fronts tracked with resolution {}", number_text(resolution)));
  picture.set("t_end", t_end);
  picture.set("wall_low", !scene.spec().is_periodic && !scene.spec().outside_bottom);
  picture.set("wall_high", !scene.spec().is_periodic && !scene.spec().outside_top);
  picture.set("least_shock", least_shock(scene, fronts, resolution));
  picture.set("fan_width", scene.is_layered() ? 0.7 : 0.4);  // a staircase has many more fronts
  auto shown = thinned(scene, fronts, least_shock(scene, fronts, resolution));
  for (auto& f : shown)  // in the colour of a fan, however wide its steps are
    if (is_of_fan(scene, f)) f.phi_below = f.phi_above = (f.phi_below + f.phi_above) / 2;
  picture.add_file("fronts.csv", [&](OutputFile& file) { write_fronts_csv(file, shown); });
  picture.add_file("events.csv", [&](OutputFile& file) { file.write(event_rows(scene, timeline, t_end)); });
  const std::size_t n_interfaces = timeline.interfaces.size();
  picture.set("n_listed", n_interfaces > most_labels() ? static_cast<double>(n_interfaces) : 0.0);
  const std::string pure = pure_rows(scene, method, t_end);
  picture.set("has_pure", !pure.empty());
  picture.add_file("pure.csv", [&](OutputFile& file) { file.write(pure); });
  return picture.draw();
}

int draw_profiles(const std::string& path, const Scene<double>& scene, const Method& method,
                  const std::vector<double>& times, const std::vector<Method>& others) {
  SolverRequest request;
  request.times = times;
  request.heights = equally_spaced(scene.bottom(), scene.top(), kProfileHeights);
  const auto write = [&](const SolverResult& result) {
    return [&](OutputFile& file) { write_samples_csv(file, times, request.heights, result.samples); };
  };
  Picture picture(path, "profiles");
  set_scene(picture, scene, described(method, scene));
  picture.set("times", times);
  picture.set("symbol", scene.is_plain() ? "of small grains " : "");
  picture.set("has_bound", scene.spec().solid_fraction.has_value());
  if (scene.spec().solid_fraction)
    picture.add_file("bound.csv", [&](OutputFile& file) { file.write(bound_rows(scene)); });
  picture.add_file("profiles.csv", write(solve(scene, method, request)));
  std::string names;
  for (const Method& other : others) {
    const SolverResult result = solve(scene, other, request);
    if (!result.summary.usable()) return report_unusable(result.summary);
    names += (names.empty() ? "" : " ") + std::string(other.name());
    picture.add_file(fmt::format("other{}.csv", 1 + std::count(names.begin(), names.end(), ' ')),
                     write(result));
  }
  picture.set("others", names);
  const bool compare = !method.guarantees().exact && others.empty();
  const SolverResult exact = compare ? solve(scene, Method(), request) : SolverResult{};
  picture.set("has_exact", exact.summary.usable());
  if (exact.summary.usable()) picture.add_file("exact.csv", write(exact));
  return picture.draw();
}

int draw_slab(const std::string& path, const Scene<double>& scene, const Method& method,
              const SlabSamples& frames) {
  Picture picture(path, "slab");
  set_scene(picture, scene, described(method, scene));
  picture.set("times", frames.times);
  picture.set("x_high", scene.spec().slab->length);
  picture.add_file("slab.csv", [&](OutputFile& file) {
    for (std::size_t i = 0; i < frames.times.size(); ++i) {
      std::string rows = i == 0 ? "x,z,phi\n" : "\n\nx,z,phi\n";
      for (std::size_t k = 0; k < frames.x.size(); ++k)
        for (std::size_t j = 0; j < frames.z.size(); ++j)
          rows += fmt::format("{:.6g},{:.6g},{:.4g}\n", frames.x[k], frames.z[j],
                              frames.phi[i][k * frames.z.size() + j]);
      file.write(rows);
    }
  });
  return picture.draw();
}

int draw_bed_course(const std::string& path, const Scene<double>& scene, const Method& method,
                    const BedCourse& course) {
  constexpr std::size_t kMostPoints = 60;
  double t_end = last_time(course.table.times);
  if (!(t_end > 0)) t_end = 1;
  const BedCourse fine = bed_course(course.quantity, scene, method, equally_spaced(0, t_end, kCourseTimes));
  Picture picture(path, "bed");
  set_scene(picture, scene, described(method, scene));
  picture.set("quantity", course.table.columns.back());
  picture.set("t_end", t_end);
  picture.set("has_points", course.table.times.size() <= kMostPoints);
  picture.set("t_lowest", course.lowest ? course.lowest->t : 0);
  picture.set("h_lowest", course.lowest ? course.lowest->height : 0);
  picture.add_file("course.csv", [&](OutputFile& file) { write_time_table_csv(file, fine.table); });
  picture.add_file("times.csv", [&](OutputFile& file) { write_time_table_csv(file, course.table); });
  return picture.draw();
}

}  // namespace shearfront::tools
