// SPDX-License-Identifier: BSD-3-Clause
#include "plot/error_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "cli/command.hpp"
#include "plot/gnuplot.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

constexpr double kRounding = 1e-13;  // what is below is drawn in one line, below the least error above it
constexpr int kMostTimes = 5, kMostErrors = 6;  // decades with a tic each
constexpr int kPanelWidth = 330, kPanelHeight = 310, kTitleHeight = 26, kLegendRow = 24;
constexpr std::size_t kMostColumns = 3;

// Okabe and Ito's colours, told apart with every kind of colour vision, and shapes for print without colour.
constexpr std::array<const char*, 8> kColours{"#000000", "#0072b2", "#56b4e9", "#d55e00",
                                              "#e69f00", "#009e73", "#cc79a7", "#7f7f7f"};
constexpr std::array<int, 8> kShapes{2, 7, 6, 5, 4, 9, 11, 13};

/// Whole powers of ten around some positive numbers.
struct Decades {
  int first = 1000, last = -1000;
  void include(double x) {
    first = std::min(first, static_cast<int>(std::floor(std::log10(x))));
    last = std::max(last, static_cast<int>(std::ceil(std::log10(x))));
  }
  [[nodiscard]] std::string range() const {
    return fmt::format("[9.9e{}:1.01e{}]", first - 1, std::max(last, first + 1));
  }
  [[nodiscard]] std::string tics(int most) const {
    const int step = (last - first + most - 1) / most;
    std::string all;
    for (int k = first; k <= last; ++k) {
      if ((k - first) % std::max(step, 1) == 0)
        all += fmt::format("{}'10^{{{}}}' 1e{}", all.empty() ? "" : ", ", k, k);
      else
        all += fmt::format(", '' 1e{} 1", k);
    }
    return all;
  }
};

/// The axis of errors.
struct ErrorAxis {
  Decades decades;
  bool has_rounding = false;

  explicit ErrorAxis(const std::vector<Panel>& panels) {
    for (const Panel& panel : panels)
      for (const Course& course : panel.courses)
        for (const Rung& rung : course.rungs) {
          if (rung.l1_error < kRounding)
            has_rounding = true;
          else
            decades.include(rung.l1_error);
        }
    if (decades.first > decades.last) decades.include(1e-2);
    if (decades.first == decades.last) ++decades.last;
  }
  [[nodiscard]] double place(double error) const {
    return error < kRounding ? std::pow(10.0, decades.first - 1) : error;
  }
  [[nodiscard]] std::string range() const {
    return fmt::format("[{}e{}:1.01e{}]", has_rounding ? "5" : "9.9", decades.first - (has_rounding ? 2 : 1),
                       decades.last);
  }
  [[nodiscard]] std::string tics() const {
    return decades.tics(kMostErrors) +
           (has_rounding ? fmt::format(", 'rounding' 1e{}", decades.first - 1) : "");
  }
};

/// "seconds error" of one course.
std::string rows(const Course& course, const ErrorAxis& axis) {
  std::string all;
  for (const Rung& rung : course.rungs)
    all += fmt::format("{:.6g} {:.6g}\n", rung.wall_s, axis.place(rung.l1_error));
  return all;
}

std::vector<std::string> methods_of(const std::vector<Panel>& panels) {
  std::vector<std::string> names;
  for (const Course& course : panels.front().courses)
    if (std::any_of(panels.begin(), panels.end(), [&](const Panel& p) {
          return std::any_of(p.courses.begin(), p.courses.end(), [&](const Course& c) {
            return c.contestant.name == course.contestant.name && !c.rungs.empty();
          });
        }))
      names.push_back(course.contestant.name);
  return names;
}

std::string style(std::size_t i) {
  return fmt::format("lc rgb '{}' lw 1.6 pt {} ps 0.7", kColours[i % kColours.size()],
                     kShapes[i % kShapes.size()]);
}

void add_panel(Gnuplot& plot, const Panel& panel, std::size_t number, const std::vector<std::string>& methods,
               const ErrorAxis& axis) {
  std::string curves;
  for (std::size_t i = methods.size(); i-- > 0;)  // the first on top
    for (std::size_t j = 0; j < panel.courses.size(); ++j) {
      const Course& course = panel.courses[j];
      if (course.contestant.name != methods[i] || course.rungs.empty()) continue;
      const std::string name = fmt::format("panel{}course{}", number, j);
      plot.add_data(name, rows(course, axis));
      curves += fmt::format("{}${} with linespoints {} notitle", curves.empty() ? "" : ", ", name, style(i));
    }
  plot.add(fmt::format("set title '{{/:Italic t}} = {}' offset 0,-0.6", number_text(panel.t)));
  plot.add("plot " + (curves.empty() ? "NaN notitle" : curves));
}

}  // namespace

int draw_error_time(const std::string& path, std::string_view scene, const std::vector<Panel>& panels) {
  const std::vector<std::string> methods = panels.empty() ? std::vector<std::string>{} : methods_of(panels);
  if (methods.empty()) {
    note("no picture: there is nothing to draw");
    return kNoResult;
  }
  const ErrorAxis errors(panels);
  Decades seconds;
  for (const Panel& panel : panels)
    for (const Course& course : panel.courses)
      for (const Rung& rung : course.rungs) seconds.include(rung.wall_s);
  const std::size_t n_columns = std::min(panels.size(), kMostColumns);
  const std::size_t n_rows = (panels.size() + n_columns - 1) / n_columns;
  const int width = std::max(2, static_cast<int>(n_columns)) * kPanelWidth;
  const int legend_columns = width / 210;
  const int legend_rows = (static_cast<int>(methods.size()) + legend_columns - 1) / legend_columns;
  const int legend = kLegendRow * legend_rows + 14;
  const int body = static_cast<int>(n_rows) * kPanelHeight, height = kTitleHeight + body + legend;
  Gnuplot plot(path, width, height);
  plot.add("set multiplot");
  plot.add(fmt::format("set label 1 {} noenhanced at screen 0.5,{:.4f} center font ',13'",
                       Gnuplot::text(scene), 1 - 0.5 * kTitleHeight / height));
  plot.add(fmt::format("set logscale xy\nset xrange {}\nset yrange {}", seconds.range(), errors.range()));
  plot.add(fmt::format("set xtics ({})\nset ytics ({})", seconds.tics(kMostTimes), errors.tics()));
  plot.add(
      "set border 3 lw 0.8\nset tics nomirror out scale 0.6\nset grid xtics ytics lc rgb '#e4e4e4' lw 0.6");
  plot.add("set xlabel 'wall time [s]' offset 0,0.4");
  plot.add("set ylabel '{/:Italic L}^1 error of φ' offset 0.8,0\nset key off\nset tmargin 2.4");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto column = static_cast<double>(i % n_columns), row = static_cast<double>(i / n_columns);
    const double w = 1.0 / static_cast<double>(n_columns), h = static_cast<double>(kPanelHeight) / height;
    plot.add(fmt::format("set origin {:.4f},{:.4f}\nset size {:.4f},{:.4f}", column * w,
                         static_cast<double>(legend + body) / height - (row + 1) * h, w, h));
    add_panel(plot, panels[i], i, methods, errors);
    if (i == 0) plot.add("unset label 1");
  }
  // The legend is a panel of its own, without axes.
  plot.add("unset border\nunset tics\nunset grid\nunset title\nunset xlabel\nunset ylabel\nunset logscale");
  plot.add("set xrange [0:1]\nset yrange [0:1]\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0");
  plot.add(fmt::format("set origin 0,0\nset size 1,{:.4f}", static_cast<double>(legend) / height));
  plot.add(
      fmt::format("set key at graph 0.5,1 center top horizontal Left reverse maxcols {} samplen 2 spacing "
                  "1.2 width 1",
                  legend_columns));
  std::string keys;
  for (std::size_t i = 0; i < methods.size(); ++i)
    keys += fmt::format("{}NaN with linespoints {} title {}", i == 0 ? "" : ", ", style(i),
                        Gnuplot::text(methods[i]));
  plot.add("plot " + keys + "\nunset multiplot");
  return plot.draw();
}

}  // namespace shearfront::tools
