// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/method.hpp"
#include "plot/gnuplot.hpp"
#include "plot/pictures.hpp"
#include "plot/state_axis.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kTimes = 241, kHeights = 321;  // finer than contours can show
constexpr int kContours = 20;

}  // namespace

int draw_map(const std::string& path, const Scene<double>& scene, std::string_view, double t_end,
             const SolverOptions& options) {
  SolverRequest request;
  request.times = equally_spaced(0, t_end, kTimes);
  request.heights = equally_spaced(scene.bottom(), scene.top(), kHeights);
  const SolverResult result = shearfront::solve(scene, options.method, request, options.progress);
  if (!result.summary.usable()) return report_unusable(result.summary);
  std::string rows;
  for (std::size_t i = 0; i < kTimes; ++i) {
    for (std::size_t j = 0; j < kHeights; ++j)
      rows += fmt::format("{:.6g} {:.6g} {:.4g}\n", request.times[i], request.heights[j],
                          result.samples[i * kHeights + j].phi);
    rows += '\n';
  }
  const StateRange<double> states = states_of(scene);
  Gnuplot plot(path, 560, 440);
  plot.add_data("map", rows);
  // Contours first, into a block of their own: they are drawn on top of the colours.
  const double step = (states.highest - states.lowest) / (kContours - 1);  // those of both ends are noise
  plot.add(fmt::format("set contour base\nset cntrparam levels incremental {:.9g},{:.9g},{:.9g}",
                       states.lowest + step, step, states.highest - step / 2));
  plot.add(
      "unset surface\nset table $contours\nsplot $map using 1:2:3\nunset table\nunset contour\nset surface");
  plot.add("set title " + Gnuplot::text(scene.name()) + " noenhanced offset 0,0.2");
  plot.add("set xlabel 'time {/:Italic t}' offset 0,0.3\nset ylabel 'height {/:Italic z}' offset 0.5,0");
  plot.add(fmt::format("set xrange [0:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\nset cbrange [{:.9g}:{:.9g}]",
                       t_end, scene.bottom(), scene.top(), states.lowest, states.highest));
  plot.add("set cblabel 'concentration {/:Italic φ}' offset 0.8,0\nset colorbox noborder\nset key off");
  plot.add("set format '%g'\nset border 3 lw 0.8 front\nset tics nomirror out scale 0.6 front");
  plot.add("set palette defined (0 '#0d0887', 0.25 '#6a00a8', 0.5 '#b12a90', 0.75 '#e16462', 1 '#f0a028')");
  plot.add("plot $map using 1:2:3 with image, $contours using 1:2 with lines lw 0.6 lc rgb '#60ffffff'");
  return plot.draw();
}

}  // namespace shearfront::tools
