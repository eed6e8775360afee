// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "cli/arguments.hpp"
#include "cli/method.hpp"
#include "plot/gnuplot.hpp"
#include "plot/pictures.hpp"
#include "plot/state_axis.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kHeights = 4001;  // finer than a picture can show
// Okabe and Ito's colours, told apart with every kind of colour vision.
constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#7f7f7f"};

/// "phi z" rows; those inside a piece of constant phi are left out.
std::string rows(const std::vector<double>& heights, const Sample* samples) {
  std::string all;
  for (std::size_t j = 0; j < heights.size(); ++j) {
    const bool is_inside = j > 0 && j + 1 < heights.size() && samples[j - 1].phi == samples[j].phi &&
                           samples[j].phi == samples[j + 1].phi;
    if (is_inside) continue;
    all += fmt::format("{:.7g} {:.7g}\n", samples[j].phi, heights[j]);
  }
  return all;
}

/// One block of data per time; the names are prefix0, prefix1, ...
void add_profiles(Gnuplot& plot, std::string_view prefix, const SolverRequest& request,
                  const SolverResult& result) {
  for (std::size_t i = 0; i < request.times.size(); ++i)
    plot.add_data(fmt::format("{}{}", prefix, i),
                  rows(request.heights, result.samples.data() + i * request.heights.size()));
}

void add_frame(Gnuplot& plot, const Scene<double>& scene) {
  plot.add("set title " + Gnuplot::text(scene.name()) + " noenhanced offset 0,0.2");
  plot.add(fmt::format("set xlabel 'concentration {}{{/:Italic φ}}' offset 0,0.3",
                       scene.is_plain() ? "of small grains " : ""));
  plot.add("set ylabel 'height {/:Italic z}' offset 0.5,0");
  const StateRange<double> states = states_of(scene);
  const double margin = 0.02 * (states.highest - states.lowest);
  plot.add(fmt::format("set xrange [{:.9g}:{:.9g}]", states.lowest - margin, states.highest + margin));
  plot.add(fmt::format("set yrange [{:.9g}:{:.9g}]", scene.bottom(), scene.top()));
  plot.add("set format '%g'\nset border 3 lw 0.8\nset tics nomirror out scale 0.6");
  if (scene.is_plain()) plot.add("set xtics 0.2");
  plot.add("set key outside right center Left reverse samplen 1.6 spacing 1.25 width -1");
  if (scene.is_layered())
    for (const double z : scene.knots())
      plot.add(
          fmt::format("set arrow from graph 0,first {0:.9g} to graph 1,first {0:.9g} nohead lw 0.8 dt (8,6) "
                      "lc rgb '#a0a0a0' back",
                      z));
}

}  // namespace

int draw_profiles(const std::string& path, const Scene<double>& scene, std::string_view method,
                  const std::vector<double>& times, const SolverOptions& options) {
  SolverRequest request;
  request.times = times;
  request.heights = equally_spaced(scene.bottom(), scene.top(), kHeights);
  const SolverResult result = shearfront::solve(scene, options.method, request, options.progress);
  const bool compare = !Method(method).guarantees().exact;
  const SolverResult exact = compare ? shearfront::solve(scene, Method(), request) : SolverResult{};

  Gnuplot plot(path, 560, 480);
  add_frame(plot, scene);
  add_profiles(plot, "profile", request, result);
  std::string curves;
  const bool many = times.size() > kColours.size();
  if (many) {
    const auto [least, most] = std::minmax_element(times.begin(), times.end());
    plot.add("set palette defined (0 '#0d0887', 0.25 '#6a00a8', 0.5 '#b12a90', 0.75 '#e16462', 1 '#f0a028')");
    plot.add(fmt::format("set cbrange [{:.9g}:{:.9g}]\nset cblabel 'time {{/:Italic t}}' offset 1.2,0",
                         *least, *most > *least ? *most : *least + 1));
    plot.add("set colorbox noborder");
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::string style =
        many ? fmt::format("lc palette cb {:.9g} notitle", times[i])
             : fmt::format("lc rgb '{}' title '{{/:Italic t}} = {:.5g}'", kColours[i], times[i]);
    curves +=
        fmt::format("{}$profile{} with lines lw {} {}", i == 0 ? "" : ", ", i, compare ? 2.4 : 2.0, style);
  }
  if (exact.summary.usable()) {
    add_profiles(plot, "exact", request, exact);
    for (std::size_t i = 0; i < times.size(); ++i)
      curves += fmt::format(", $exact{} with lines lw 0.8 lc rgb 'black' {}", i,
                            i == 0 ? "title 'exact'" : "notitle");
  }
  plot.add("plot " + curves);
  return plot.draw();
}

}  // namespace shearfront::tools
