// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cli/arguments.hpp"
#include "plot/fit_panels.hpp"
#include "solve/bed_course.hpp"

namespace shearfront::tools {

void add_bed_heights(Gnuplot& plot, const FitPanel& panel, const fit::FitSpec& spec,
                     const fit::Estimate& estimate) {
  constexpr std::size_t kTimes = 401;  // finer than a panel can show
  constexpr double kSigmas95 = 1.96;   // of a normal distribution
  const std::vector<Observation>& rows = spec.observations.rows;
  double t_end = 0;
  std::string observed;
  for (const Observation& o : rows) {
    t_end = std::max(t_end, o.t);
    observed += fmt::format("{:.9g} {:.9g} {:.4g}\n", o.t, o.value, o.sigma > 0 ? kSigmas95 * o.sigma : 0);
  }
  if (!(t_end > 0)) t_end = 1;
  const BedCourse course = bed_course(SolvedQuantity::bed_height, spec.forward.method.name(), *estimate.scene,
                                      equally_spaced(0, t_end, kTimes), {spec.forward.method, {}});
  std::string fitted;
  for (std::size_t i = 0; i < course.table.rows.size(); ++i)
    fitted += fmt::format("{:.9g} {:.9g}\n", course.table.times[i], course.table.rows[i][0]);
  begin_panel(plot, panel);
  plot.add_data("observed", observed);
  plot.add_data("fitted", fitted.empty() ? "NaN NaN\n" : fitted);
  plot.add("set xlabel " + axis_label("time " + italic("t"), spec.observations.units.t) + " offset 0,0.3");
  plot.add("set ylabel " + axis_label("height of the bed " + italic("H"), spec.observations.units.value) +
           " offset 0.5,0");
  set_x_axis(plot, panel, 0, t_end);
  plot.add("set ytics auto\nset offsets 0,0,graph 0.03,graph 0.03");
  plot.add("set key outside right center Left reverse samplen 1.6 spacing 1.25");
  constexpr std::size_t kMostErrorBars = 60;  // more of them hide the points
  const bool has_bars = spec.observations.has_sigma() && rows.size() <= kMostErrorBars;
  plot.add(
      fmt::format("plot $observed using 1:2{} pt 6 ps {} lc rgb '#404040' title 'observed{}', $fitted "
                  "with lines lw 2 lc rgb '{}' title 'fitted'",
                  has_bars ? ":3 with yerrorbars" : " with points", rows.size() > 50 ? 0.3 : 0.45,
                  has_bars ? " (95 %)" : "", kBlue));
}

}  // namespace shearfront::tools
