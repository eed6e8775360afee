// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "plot/gnuplot.hpp"
#include "plot/pictures.hpp"
#include "plot/state_axis.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kWidths = 12;  // widths of lines, from a front of a fan to a shock from 1 to 0
constexpr double kWidest = 3.6;
constexpr std::size_t kMostLabels = 4;  // more interfaces than this get marks without names

/// 0 for a front of a fan, else the more the larger the jump. Characteristics run into a shock and out of the
/// fronts of a fan. A shock smaller than `least` looks like a front of a fan.
std::size_t width_of(const FrontSegment<double>& front, const Scene<double>& scene, double least) {
  const double jump = std::abs(front.phi_above - front.phi_below);
  const double z = front.z_begin + (front.z_end - front.z_begin) / 2, c = scene.solid_fraction_at(z);
  const bool is_shock = std::visit(
      [&](const auto& f) { return f.derivative(front.phi_below / c) > f.derivative(front.phi_above / c); },
      scene.flux_at(z));
  if (!is_shock || jump <= least) return 0;
  const double share = std::min(1.0, (jump - least) / (1 - least));
  return std::min(kWidths - 1, static_cast<std::size_t>(share * kWidths));
}

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

/// Latest time to show: a little after the steady state, else the end of the computed fronts.
double end_time(const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline) {
  double end = 0;
  for (const auto& f : fronts) end = std::max(end, std::isfinite(f.t_end) ? f.t_end : f.t_begin);
  if (timeline.t_star && *timeline.t_star <= end * 1.05) return *timeline.t_star * 1.08;
  return end > 0 ? end : 1.0;
}

/// "t z phi" of each front, by width.
std::array<std::string, kWidths> rows_of(const std::vector<FrontSegment<double>>& fronts,
                                         const Scene<double>& scene, double least, double t_end) {
  std::array<std::string, kWidths> rows;
  for (const auto& f : fronts) {
    const double phi = (f.phi_below + f.phi_above) / 2;
    const double end = std::isfinite(f.t_end) ? f.t_end : t_end;
    rows[width_of(f, scene, least)] += fmt::format("{:.7g} {:.7g} {:.4g}\n{:.7g} {:.7g} {:.4g}\n\n",
                                                   f.t_begin, f.z_begin, phi, end, f.z_end, phi);
  }
  return rows;
}

/// Points and names of the events. Names stand where no front is: before a first wave, after a last one, and
/// outside the walls.
class EventMarks {
 public:
  EventMarks(const Scene<double>& scene, const Timeline<double>& timeline, double t_end) : t_end_(t_end) {
    const std::size_t n = timeline.interfaces.size();
    const double z_jump = scene.initial_breaks().empty() ? scene.top() : scene.initial_breaks().front();
    for (std::size_t i = 0; i < n; ++i) {
      const auto& at = timeline.interfaces[i];
      const std::string index = n == 1 ? "" : fmt::format(",{}", i + 1);
      const bool named = n <= kMostLabels;
      const bool has_room = at.first && *at.first > 0.07 * t_end;
      const bool comes_down = at.z < z_jump;
      mark(at.first, at.z, named && has_room ? "t_{c" + index + "}" : "",
           comes_down ? "right offset -0.6,-0.75" : "right offset -0.6,0.75");
      mark(at.last, at.z, named ? "t\u0302_{c" + index + "}" : "",
           at.z < timeline.steady_height ? "left offset 0.7,-0.75" : "left offset 0.7,0.75");
    }
    mark(timeline.t0, scene.bottom(), "t_0", "center offset 0,-0.85");
    mark(timeline.t1, scene.top(), "t_1", "center offset 0,0.8");
    mark(timeline.t_star, timeline.steady_height, "t*", "left offset 0.9,0");
  }
  [[nodiscard]] const std::string& points() const { return points_; }
  [[nodiscard]] const std::string& labels() const { return labels_; }

 private:
  void mark(const std::optional<double>& t, double z, const std::string& name, std::string_view place) {
    if (!t || *t > t_end_) return;
    points_ += fmt::format("{:.9g} {:.9g}\n", *t, z);
    if (name.empty()) return;
    const std::size_t base = name.find_first_of("_*");
    labels_ += fmt::format("set label {} at {:.9g},{:.9g} {} front\n",
                           Gnuplot::text("{/:Italic " + name.substr(0, base) + "}" + name.substr(base)), *t,
                           z, place);
  }
  double t_end_;
  std::string points_, labels_;
};

void add_frame(Gnuplot& plot, const Scene<double>& scene, double t_end) {
  plot.add("set xlabel 'time {/:Italic t}' offset 0,-0.2");
  plot.add("set ylabel 'height {/:Italic z}' offset 1,0");
  plot.add(fmt::format("set xrange [0:{:.9g}]", t_end));
  plot.add(fmt::format("set yrange [{:.9g}:{:.9g}]", scene.bottom(), scene.top()));
  plot.add(
      "set format '%g'\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\nset xtics offset 0,-0.7\nset "
      "key off\nset clip "
      "two");
  const StateRange<double> states = states_of(scene);
  plot.add(fmt::format(
      "set cbrange [{:.9g}:{:.9g}]\nset cblabel '{{/:Italic φ}}, mean of both sides' offset 0.3,0",
      states.lowest, states.highest));
  if (scene.is_plain()) plot.add("set cbtics 0.25");
  plot.add("set colorbox noborder user origin screen 0.855,0.25 size screen 0.018,0.5");
  // Plasma without its light end: even steps in lightness, readable on white, safe for colour-blind readers.
  plot.add("set palette defined (0 '#0d0887', 0.25 '#6a00a8', 0.5 '#b12a90', 0.75 '#e16462', 1 '#f0a028')");
  const auto draw_wall = [&](double z) {
    plot.add(fmt::format("set arrow from 0,{0:.9g} to {1:.9g},{0:.9g} nohead lw 2.5 lc rgb 'black' front", z,
                         t_end));
  };
  if (!scene.spec().is_periodic && !scene.spec().outside_bottom) draw_wall(scene.bottom());
  if (!scene.spec().is_periodic && !scene.spec().outside_top) draw_wall(scene.top());
}

}  // namespace

int draw_fronts(const std::string& path, const Scene<double>& scene,
                const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline,
                double resolution) {
  const double t_end = end_time(fronts, timeline);
  const EventMarks marks(scene, timeline, t_end);
  Gnuplot plot(path, 640, 440);
  plot.add("set title " + Gnuplot::text(scene.name()) + " noenhanced offset 0,0.9");
  plot.add(
      "set lmargin screen 0.105\nset rmargin screen 0.825\nset bmargin screen 0.17\nset tmargin screen 0.86");
  add_frame(plot, scene, t_end);
  if (scene.is_layered())
    for (const double z : scene.knots())
      plot.add(fmt::format(
          "set arrow from 0,{0:.9g} to {1:.9g},{0:.9g} nohead lw 0.8 dt (8,6) lc rgb '#606060' front", z,
          t_end));
  plot.add(marks.labels());
  const auto rows = rows_of(fronts, scene, least_shock(scene, fronts, resolution), t_end);
  const double fan_width = scene.is_layered() ? 0.7 : 0.4;  // a staircase has many more fronts
  std::string curves;
  for (std::size_t i = 0; i < kWidths; ++i) {
    if (rows[i].empty()) continue;
    plot.add_data(fmt::format("fronts{}", i), rows[i]);
    curves += fmt::format("$fronts{} using 1:2:3 with lines lw {:.2f} lc palette z, ", i,
                          fan_width + (kWidest - fan_width) * static_cast<double>(i) / (kWidths - 1));
  }
  plot.add_data("events", marks.points().empty() ? "NaN NaN\n" : marks.points());
  plot.add(
      "plot " + curves +
      "$events with points pt 7 ps 0.75 lc rgb 'white', $events with points pt 7 ps 0.55 lc rgb 'black'");
  return plot.draw();
}

}  // namespace shearfront::tools
