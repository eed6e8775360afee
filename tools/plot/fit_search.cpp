// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/fit_panels.hpp"

namespace shearfront::tools {
namespace {

constexpr double kLeastMisfit = 1e-30;  // stands for zero on the logarithmic axis
constexpr int kMostDecades = 5;         // with a tic each

/// Tics at every `step`-th power of ten, small ones between neighbours.
std::string decade_tics(int first, int last, int step) {
  std::string tics;
  for (int k = first; k <= last; k += step) {
    tics += fmt::format("{}'10^{{{}}}' 1e{}", tics.empty() ? "" : ", ", k, k);
    for (int m = 2; step == 1 && k < last && m < 10; ++m) tics += fmt::format(", '' {}e{} 1", m, k);
  }
  return tics;
}

/// The logarithmic axis from power of ten to power of ten.
void set_misfit_axis(Gnuplot& plot, const std::vector<fit::SearchStep>& steps) {
  double low = HUGE_VAL, high = 0;
  for (const auto& step : steps) {
    low = std::min(low, std::max(step.misfit, kLeastMisfit));
    high = std::max(high, std::max(step.misfit, kLeastMisfit));
  }
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = std::max(static_cast<int>(std::ceil(std::log10(high))), first + 1);
  const int step = (last - first + kMostDecades - 1) / kMostDecades;
  // A little wider, else rounding takes the tics at the ends away.
  plot.add(fmt::format("set logscale y\nset yrange [9.99e{}:1.001e{}]\nset ytics ({})", first - 1, last,
                       decade_tics(first, last, step)));
}

/// "evaluations misfit", one block per stage; the last goes on to the end of the search.
std::string stage_rows(const std::vector<fit::SearchStep>& steps, std::size_t last) {
  std::string rows;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double y = std::max(steps[i].misfit, kLeastMisfit);
    const bool ends = i + 1 == steps.size() || steps[i + 1].stage != steps[i].stage;
    rows += fmt::format("{} {:.6g}\n", steps[i].evaluations, y);
    if (!ends) continue;
    const std::size_t end = i + 1 == steps.size() ? last : steps[i + 1].evaluations - 1;
    if (end > steps[i].evaluations) rows += fmt::format("{} {:.6g}\n", end, y);
    rows += "\n";
  }
  return rows;
}

/// "x y" of vertical lines where a stage begins; lines too close to the one before are left out.
std::string stage_lines(const std::vector<fit::SearchStep>& steps, double end) {
  std::string rows;
  double before = -HUGE_VAL;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double x = static_cast<double>(steps[i].evaluations) - 0.5;
    if (steps[i].stage == steps[i - 1].stage || x - before < 0.015 * end) continue;
    rows += fmt::format("{0:.6g} 0\n{0:.6g} 1\n\n", x);
    before = x;
  }
  return rows;
}

}  // namespace

void add_search(Gnuplot& plot, const FitPanel& panel, const fit::Estimate& estimate) {
  if (estimate.steps.empty()) return;
  const std::size_t last = std::max(estimate.evaluations, estimate.steps.back().evaluations);
  const double end = static_cast<double>(last) + 0.5;
  begin_panel(plot, panel);
  plot.add("set xlabel 'evaluations' offset 0,0.3\nset ylabel 'smallest misfit' offset 0.8,0");
  set_x_axis(plot, panel, 0, std::max(end, 2.0));
  set_misfit_axis(plot, estimate.steps);
  const std::string lines = stage_lines(estimate.steps, end);
  std::string curves;
  if (!lines.empty()) {
    plot.add_data("stages", lines);
    plot.add("set y2range [0:1]");
    plot.add(fmt::format("set key at screen {:.5g},{:.5g} right bottom Left reverse samplen 1.8", panel.right,
                         panel.top + 0.01));
    curves = "$stages using 1:2 axes x1y2 with lines lw 1 dt (4,3) lc rgb '#8c8c8c' title 'new stage', ";
  }
  plot.add_data("search", stage_rows(estimate.steps, last));
  plot.add(
      fmt::format("plot {0}$search with steps lw 2 lc rgb '{1}' notitle, $search with points pt 7 ps {2} lc "
                  "rgb '{1}' notitle",
                  curves, kBlue, estimate.steps.size() > 60 ? 0.15 : 0.35));
}

}  // namespace shearfront::tools
