// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "cli/command.hpp"
#include "plot/fit_panels.hpp"
#include "plot/pictures.hpp"
#include "shearfront/fit/residual_rows.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

constexpr int kFitWidth = 720, kFitHeight = 560;

}  // namespace

void begin_panel(Gnuplot& plot, const FitPanel& panel) {
  plot.add("reset\nset border 3 lw 0.8\nset tics nomirror out scale 0.6\nset format '%g'\nset key off");
  plot.add(fmt::format(
      "set lmargin at screen {:.5g}\nset rmargin at screen {:.5g}\nset bmargin at screen {:.5g}\nset tmargin "
      "at screen {:.5g}",
      panel.left, panel.right, panel.bottom, panel.top));
}

double round_up(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= x * (1 - 1e-12)) return factor * power;
  return 10 * power;
}

void set_x_axis(Gnuplot& plot, const FitPanel& panel, double low, double high) {
  constexpr double kCharacter = 8;  // points, in the widest of the formats
  const double room = (panel.right - panel.left) * kFitWidth / kCharacter;
  double step = round_up((high - low) / 10);
  const auto fits = [&] {
    const double first = std::ceil(low / step), last = std::floor(high / step);
    const std::size_t longest =
        std::max(fmt::format("{:.6g}", step).size(), fmt::format("{:.6g}", last * step).size());
    return last - first < 2 || (last - first + 1) * (static_cast<double>(longest) + 1) <= room;
  };
  while (!fits()) step = round_up(1.5 * step);
  plot.add(fmt::format("set xrange [{:.9g}:{:.9g}]\nset xtics {:.9g}", low, high, step));
}

void set_height_axis(Gnuplot& plot, const fit::FitSpec& spec, bool has_labels) {
  const double low = spec.scene.bottom(), high = spec.scene.top();
  plot.add(
      fmt::format("set yrange [{:.9g}:{:.9g}]\nset ytics {:.9g}", low, high, round_up((high - low) / 6)));
  if (has_labels)
    plot.add("set ylabel " + axis_label("height " + italic("z"), spec.observations.units.z) +
             " offset 0.8,0");
  else
    plot.add("set format y ''");
}

std::string italic(std::string_view symbol) { return fmt::format("{{/:Italic {}}}", symbol); }

std::string plain(std::string_view text) {
  std::string marked;
  for (const char c : printable(text, 30)) {
    if (std::string_view("{}^_@&~\\").find(c) != std::string_view::npos) marked += '\\';
    marked += c == '\'' ? std::string("''") : std::string(1, c);
  }
  return marked;
}

std::string axis_label(const std::string& name, std::string_view unit) {
  return unit.empty() ? "'" + name + "'" : fmt::format("'{} ({})'", name, plain(unit));
}

Measured measured(const fit::FitSpec& spec, const fit::Estimate& estimate) {
  const bool is_cumulative = spec.observations.quantity == Quantity::cumulative;
  Measured result{italic(is_cumulative ? "M" : "φ"), "", 0, 1};
  result.label = axis_label(result.symbol, spec.observations.units.value);
  if (is_cumulative) {
    result.high = std::max(estimate.scene->mass(), 1e-300);
  } else {
    std::vector<double> heights = spec.scene.knots();
    heights.push_back(spec.scene.bottom()), heights.push_back(spec.scene.top());
    const auto range_at = [&](double z) { return spec.scene.range_at(z); };
    result.low = range_at(heights.back()).lowest, result.high = range_at(heights.back()).highest;
    for (const double z : heights) {
      result.low = std::min(result.low, range_at(z).lowest);
      result.high = std::max(result.high, range_at(z).highest);
    }
  }
  return result;
}

int draw_fit(const std::string& path, const fit::FitSpec& spec, const fit::Estimate& estimate) {
  if (!estimate.usable()) {
    note(fmt::format("no picture {}: the fit has no usable estimate", printable(path)));
    return kNoResult;
  }
  Gnuplot plot(path, kFitWidth, kFitHeight);
  plot.add("set multiplot title " + Gnuplot::text(spec.name) + " noenhanced");
  if (spec.observations.quantity == Quantity::bed_height)
    add_bed_heights(plot, {0.13, 0.82, 0.56, 0.9}, spec, estimate);
  else if (fit::measured_profiles(spec.observations).size() <= kMostProfiles)
    add_profiles(plot, {0.08, 0.97, 0.56, 0.855}, spec, estimate);
  else
    add_maps(plot, {0.08, 0.895, 0.56, 0.885}, spec, estimate);
  add_rate(plot, {0.08, 0.42, 0.095, 0.4}, spec, estimate);
  add_search(plot, {0.72, 0.97, 0.095, 0.4}, estimate);
  plot.add("unset multiplot");
  return plot.draw();
}

}  // namespace shearfront::tools
