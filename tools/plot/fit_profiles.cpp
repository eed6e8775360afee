// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/arguments.hpp"
#include "cli/method.hpp"
#include "plot/fit_panels.hpp"
#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kHeights = 2001;  // finer than a panel can show
constexpr const char* kGrey = "#404040";
constexpr double kSigmas95 = 1.96;          // of a normal distribution
constexpr std::size_t kMostErrorBars = 40;  // more of them hide the points

/// "value z" of the estimate at a time, by the forward method of the fit; empty if that fails.
std::string fitted_rows(const fit::FitSpec& spec, const fit::Estimate& estimate, double t) {
  SolverRequest request;
  request.times = {t};
  request.heights = equally_spaced(spec.scene.bottom(), spec.scene.top(), kHeights);
  const SolverResult result = shearfront::solve(*estimate.scene, spec.forward.method, request);
  if (!result.summary.usable()) return "";
  std::string rows;
  for (std::size_t j = 0; j < kHeights; ++j) {
    const auto value = [&](std::size_t i) {
      return spec.observations.quantity == Quantity::cumulative ? result.samples[i].M : result.samples[i].phi;
    };
    const bool is_inside = j > 0 && j + 1 < kHeights && value(j - 1) == value(j) && value(j) == value(j + 1);
    if (!is_inside) rows += fmt::format("{:.6g} {:.6g}\n", value(j), request.heights[j]);
  }
  return rows;
}

std::string observed_rows(const fit::FitSpec& spec, const fit::MeasuredProfile& profile) {
  std::string rows;
  for (const std::size_t k : profile.rows) {
    const Observation& o = spec.observations.rows[k];
    rows += fmt::format("{:.6g} {:.6g} {:.4g}\n", o.value, o.z, o.sigma > 0 ? kSigmas95 * o.sigma : 0);
  }
  return rows;
}

/// phi or M: its range and all that was measured.
void set_value_axis(Gnuplot& plot, const FitPanel& panel, const Measured& value,
                    const Observations& observations) {
  double low = value.low, high = value.high;
  for (const Observation& o : observations.rows) {
    const double error = observations.has_sigma() ? kSigmas95 * o.sigma : 0;
    low = std::min(low, o.value - error);
    high = std::max(high, o.value + error);
  }
  const double margin = 0.03 * (high - low);
  set_x_axis(plot, panel, low - margin, high + margin);
}

/// The panel of one time; the data blocks "observed" and "fitted" are there.
void plot_profile(Gnuplot& plot, bool has_bars, std::size_t count) {
  plot.add(
      fmt::format("plot $observed using 1:2{} pt 6 ps {} lc rgb '{}', $fitted with lines lw 2 lc rgb '{}'",
                  has_bars ? ":3 with xerrorbars" : " with points", count > 50 ? 0.3 : 0.45, kGrey, kBlue));
}

/// One line above all panels; gnuplot's own legend would stand in two.
void add_legend(Gnuplot& plot, bool has_bars) {
  constexpr double kHeight = 0.93;
  const double first = has_bars ? 0.36 : 0.4, second = has_bars ? 0.58 : 0.54;
  plot.add(fmt::format("set label '' at screen {},{} point pt 6 ps 0.45 lc rgb '{}'", first, kHeight, kGrey));
  if (has_bars)
    plot.add(
        fmt::format("set arrow from screen {},{} to screen {},{} heads size screen 0.005,90 lw 1 lc rgb '{}'",
                    first - 0.015, kHeight, first + 0.015, kHeight, kGrey));
  plot.add(fmt::format("set label 'observed{}' at screen {},{} left", has_bars ? " (95 %)" : "",
                       first + (has_bars ? 0.025 : 0.015), kHeight));
  plot.add(fmt::format("set arrow from screen {},{} to screen {},{} nohead lw 2 lc rgb '{}'", second, kHeight,
                       second + 0.035, kHeight, kBlue));
  plot.add(fmt::format("set label 'fitted' at screen {},{} left", second + 0.045, kHeight));
}

}  // namespace

void add_profiles(Gnuplot& plot, const FitPanel& place, const fit::FitSpec& spec,
                  const fit::Estimate& estimate) {
  const auto profiles = fit::measured_profiles(spec.observations);
  const Measured value = measured(spec, estimate);
  constexpr double kGap = 0.022, kWidest = 0.45;
  const auto n = static_cast<double>(profiles.size());
  const double width = std::min(kWidest, (place.right - place.left + kGap) / n - kGap);
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const double left = place.left + static_cast<double>(i) * (width + kGap);
    const FitPanel panel{left, left + width, place.bottom, place.top};
    const std::size_t count = profiles[i].rows.size();
    begin_panel(plot, panel);
    plot.add_data("observed", observed_rows(spec, profiles[i]));
    const std::string line = fitted_rows(spec, estimate, profiles[i].t);
    plot.add_data("fitted", line.empty() ? "NaN NaN\n" : line);
    const std::string unit = spec.observations.units.t.empty() ? "" : " " + plain(spec.observations.units.t);
    plot.add(fmt::format("set title '{} = {:.5g}{}' offset 0,-0.6", italic("t"), profiles[i].t, unit));
    plot.add("set xlabel " + value.label + " offset 0,0.3");
    set_value_axis(plot, panel, value, spec.observations);
    set_height_axis(plot, spec, i == 0);
    const bool has_bars = spec.observations.has_sigma() && count <= kMostErrorBars;
    if (i == 0) add_legend(plot, has_bars);
    plot_profile(plot, has_bars, count);
  }
}

}  // namespace shearfront::tools
