// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "plot/pictures.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kMapTimes = 241, kMapHeights = 321;  // finer than a picture can show
/// Steps of phi from one place of the grid to the next, in widths of the range, beyond which contours are left out: there
/// is a shock, or more of them than can be told apart.
constexpr double kSteep = 0.06;
/// Jumps drawn as lines, in the same width.
constexpr double kLeastShock = 0.03;

/// phi on the grid, one row after the other in time.
struct MapGrid {
  std::vector<double> times, heights, phi;
  std::vector<bool> is_steep;
  double low, width;

  [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * heights.size() + j; }
  /// `jumps`: heights where phi jumps at rest.
  void find_steep(const std::vector<double>& jumps) {
    is_steep.assign(phi.size(), false);
    const auto compare = [&](std::size_t a, std::size_t b) {
      if (std::abs(phi[a] - phi[b]) > kSteep * width) is_steep[a] = is_steep[b] = true;
    };
    for (std::size_t i = 0; i < times.size(); ++i)
      for (std::size_t j = 0; j < heights.size(); ++j) {
        if (j > 0) compare(at(i, j - 1), at(i, j));
        if (i > 0) compare(at(i - 1, j), at(i, j));
      }
    for (const double z : jumps) {
      const auto above = std::lower_bound(heights.begin(), heights.end(), z) - heights.begin();
      const auto j = static_cast<std::size_t>(above);
      for (std::size_t i = 0; i < times.size() && j > 0 && j < heights.size(); ++i)
        is_steep[at(i, j - 1)] = is_steep[at(i, j)] = true;
    }
  }
};

/// The smallest of 1, 2, 5, 10, ... times a power of ten that is >= x.
double round_number(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double m : {1.0, 2.0, 5.0})
    if (x <= 1.0001 * m * power) return m * power;
  return 10 * power;
}

std::vector<double> contour_states(const Contours& contours, const MapGrid& grid) {
  if (!contours.are_round) return contours.states;
  constexpr double kMost = 12;
  const double step = round_number(grid.width / kMost);
  std::vector<double> states;
  // Those of both ends are noise.
  for (double k = std::ceil(grid.low / step + 0.001); k * step < grid.low + grid.width - step / 1000; ++k)
    states.push_back(k * step);
  return states;
}

/// Where the state of each contour stands: on it, as far as may be from other labels, shocks and the edge.
std::string label_rows(const MapGrid& grid, const std::vector<double>& states) {
  struct Place {
    double t, z;  // of the axes, from 0 to 1
  };
  constexpr double kEdge = 0.05, kNear = 0.11;
  constexpr std::size_t kEvery = 4;
  std::vector<Place> taken;
  std::string rows;
  const auto part = [](const std::vector<double>& xs, double x) {
    return (x - xs.front()) / (xs.back() - xs.front());
  };
  const auto is_free = [&](std::size_t i, std::size_t j) {
    constexpr std::size_t kTimesNear = 8, kHeightsNear = 6;
    for (std::size_t k = i - std::min(i, kTimesNear); k <= std::min(i + kTimesNear, grid.times.size() - 1);
         ++k)
      for (std::size_t l = j - std::min(j, kHeightsNear);
           l <= std::min(j + kHeightsNear, grid.heights.size() - 1); ++l)
        if (grid.is_steep[grid.at(k, l)]) return false;
    return true;
  };
  for (const double state : states) {
    Place best{};
    double farthest = kNear;  // nearer to another they cannot be read
    for (std::size_t i = kEvery; i < grid.times.size(); i += kEvery)
      for (std::size_t j = 1; j < grid.heights.size(); ++j) {
        const double below = grid.phi[grid.at(i, j - 1)] - state, above = grid.phi[grid.at(i, j)] - state;
        if (!((below < 0) != (above < 0))) continue;
        const Place here{part(grid.times, grid.times[i]), part(grid.heights, grid.heights[j])};
        const double edge = std::min(std::min(here.t, 1 - here.t), std::min(here.z, 1 - here.z));
        if (edge < kEdge || !is_free(i, j)) continue;
        double distance = 1.5 * edge + 2 * kNear;
        for (const Place& other : taken)
          distance = std::min(distance, std::hypot(here.t - other.t, 1.5 * (here.z - other.z)));
        if (distance > farthest) farthest = distance, best = here;
      }
    if (!(farthest > kNear)) continue;
    taken.push_back(best);
    rows += fmt::format("{:.6g},{:.6g},{:.4g}\n", std::lerp(grid.times.front(), grid.times.back(), best.t),
                        std::lerp(grid.heights.front(), grid.heights.back(), best.z), state);
  }
  return rows.empty() ? "" : "t,z,label\n" + rows;
}

/// Whether phi of the grid jumps with a front all along it, within so many of its heights, by half as much at least: steps by
/// which a tracker stands for what varies smoothly do not, nor does one that comes near a shock of several times its jump.
bool is_seen(const MapGrid& grid, const FrontSegment<double>& front, std::size_t reach) {
  const auto nearest = [](const std::vector<double>& xs, double x) {
    const double part = (x - xs.front()) / (xs.back() - xs.front());
    return static_cast<std::size_t>(
        std::llround(std::clamp(part, 0.0, 1.0) * static_cast<double>(xs.size() - 1)));
  };
  const double t_end =
                   std::isfinite(front.t_end) ? std::min(front.t_end, grid.times.back()) : grid.times.back(),
               z_end = std::isfinite(front.z_end) ? front.z_end : front.z_begin;
  const std::size_t last = grid.heights.size() - 1;
  // A front may cross many heights of the grid between two of its times.
  const double crossed = std::abs(z_end - front.z_begin) / (t_end - front.t_begin) *
                         (grid.times[1] - grid.times[0]) / (grid.heights[1] - grid.heights[0]);
  if (crossed > 0) reach += static_cast<std::size_t>(std::min(std::ceil(crossed), static_cast<double>(last)));
  const double jump = front.phi_above - front.phi_below;
  const auto is_seen_at = [&](double part, double most) {
    const std::size_t i = nearest(grid.times, std::lerp(front.t_begin, t_end, part)),
                      j = nearest(grid.heights, std::lerp(front.z_begin, z_end, part));
    const double seen =
        grid.phi[grid.at(i, std::min(j + reach, last))] - grid.phi[grid.at(i, j - std::min(j, reach))];
    return seen * jump > 0.5 * jump * jump && seen * jump < most * jump * jump;
  };
  return is_seen_at(0.5, 4) && (is_seen_at(0.1, HUGE_VAL) || is_seen_at(0.9, HUGE_VAL));
}

/// Shocks, by the first solver that has fronts; none where it does not solve the bed.
std::vector<FrontSegment<double>> shocks_of(const Scene<double>& scene, double t_end, double least,
                                            const MapGrid& grid, std::size_t reach) {
  const Method method(Method::names(&Guarantees::has_fronts).front());
  if (!method.refusal(scene).empty()) return {};
  SolverRequest request;
  request.times = {t_end};
  request.fronts = true;
  std::vector<FrontSegment<double>> shocks;
  for (const auto& f : solve(scene, method, request).fronts)
    if (std::abs(f.phi_above - f.phi_below) > least && !is_of_fan(scene, f) && is_seen(grid, f, reach))
      shocks.push_back(f);
  return shocks;
}

}  // namespace

int draw_map(const std::string& path, const Scene<double>& scene, const Method& method, double t_end,
             const Contours& contours) {
  SolverRequest request;
  request.times = equally_spaced(0, t_end, kMapTimes);
  request.heights = equally_spaced(scene.bottom(), scene.top(), kMapHeights);
  const SolverResult result = solve(scene, method, request);
  if (!result.summary.usable()) return report_unusable(result.summary);
  const StateRange<double> range = states_of(scene);
  MapGrid grid{request.times, request.heights, {}, {}, range.lowest, range.highest - range.lowest};
  for (const Sample& s : result.samples) grid.phi.push_back(s.phi);
  std::vector<double> jumps;
  for (const double z : scene.knots())
    if (scene.jumps_at(z)) jumps.push_back(z);
  grid.find_steep(jumps);
  const std::vector<double> states = contour_states(contours, grid);
  Picture picture(path, "map");
  set_scene(picture, scene, described(method, scene));
  picture.set("t_end", t_end);
  picture.set("contours", states);
  picture.add_file("map.csv", [&](OutputFile& file) {
    std::string rows = "t,z,phi,smooth\n";
    for (std::size_t i = 0; i < kMapTimes; ++i) {
      for (std::size_t j = 0; j < kMapHeights; ++j) {
        const std::size_t k = grid.at(i, j);
        rows += fmt::format("{:.6g},{:.6g},{:.4g},{}\n", grid.times[i], grid.heights[j], grid.phi[k],
                            grid.is_steep[k] ? "NaN" : fmt::format("{:.5g}", grid.phi[k]));
      }
      rows += '\n';
    }
    file.write(rows);
  });
  const std::string labels = label_rows(grid, states);
  picture.set("has_labels", !labels.empty());
  picture.add_file("labels.csv", [&](OutputFile& file) { file.write(labels); });
  // Schemes spread a shock over some cells.
  constexpr double kSpread = 4;
  const double cells = method.has_option("cells") ? number_of(method, "cells") : HUGE_VAL;
  const auto reach = static_cast<std::size_t>(std::max(2.0, std::ceil(kSpread * kMapHeights / cells)));
  const auto shocks = shocks_of(scene, t_end, kLeastShock * grid.width, grid, reach);
  picture.set("has_shocks", !shocks.empty());
  picture.add_file("shocks.csv", [&](OutputFile& file) { write_fronts_csv(file, shocks); });
  return picture.draw();
}

}  // namespace shearfront::tools
