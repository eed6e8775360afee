// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cli/arguments.hpp"
#include "plot/gnuplot.hpp"
#include "plot/pictures.hpp"

namespace shearfront::tools {

int draw_bed_course(const std::string& path, const Scene<double>& scene, std::string_view method,
                    const BedCourse& course, const SolverOptions& options) {
  constexpr std::size_t kTimes = 401;  // finer than a picture can show
  double t_end = 0;
  for (const double t : course.table.times)
    if (std::isfinite(t)) t_end = std::max(t_end, t);
  if (!(t_end > 0)) t_end = 1;
  const BedCourse fine =
      bed_course(course.quantity, method, scene, equally_spaced(0, t_end, kTimes), options);
  const auto block = [](const TimeTable& c) {
    std::string rows;
    for (std::size_t i = 0; i < c.rows.size(); ++i)
      if (std::isfinite(c.times[i])) rows += fmt::format("{:.9g} {:.9g}\n", c.times[i], c.rows[i].back());
    return rows;
  };
  const bool is_height = course.quantity == SolvedQuantity::bed_height;
  Gnuplot plot(path, 560, 380);
  plot.add_data("curve", block(fine.table));
  plot.add_data("asked", block(course.table));
  plot.add("set title " + Gnuplot::text(scene.name()) + " noenhanced offset 0,0.2");
  plot.add("set xlabel 'time {/:Italic t}' offset 0,0.3");
  plot.add(is_height ? "set ylabel 'height of the bed {/:Italic H}' offset 0.5,0"
                     : "set ylabel 'mixing parameter Ψ' offset 0.5,0");
  plot.add(fmt::format("set xrange [0:{:.9g}]", t_end));
  plot.add(is_height ? "set offsets 0,0,graph 0.03,graph 0.12" : "set yrange [-0.02:1.02]");
  plot.add("set format '%g'\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\nset key off");
  if (course.lowest && course.lowest->t > 0) {
    plot.add(fmt::format(
        "set arrow from {0:.9g},graph 0 to {0:.9g},{1:.9g} nohead lw 0.8 dt (8,6) lc rgb '#7f7f7f' back",
        course.lowest->t, course.lowest->height));
    plot.add(fmt::format(
        "set label 'lowest, {{/:Italic t}} = {:.5g}' at {:.9g},graph 0.05 offset 0.8,0 tc rgb '#505050'",
        course.lowest->t, course.lowest->t));
  }
  std::string curves = "$curve with lines lw 2 lc rgb '#0072b2'";
  constexpr std::size_t kMostPoints = 60;
  if (course.table.times.size() <= kMostPoints) curves += ", $asked with points pt 7 ps 0.5 lc rgb '#0072b2'";
  plot.add("plot " + curves);
  return plot.draw();
}

}  // namespace shearfront::tools
