// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/fit_panels.hpp"
#include "plot/rate_band.hpp"

namespace shearfront::tools {
namespace {

constexpr double kMostLinear = 20;  // a that varies by more gets a logarithmic axis
constexpr double kWidestBand = 4;   // a band that goes on beyond so many times the curve is cut off

/// The axis of s a: from the smallest to the largest of start and estimate, and the band as far as it is not
/// far away.
struct RateAxis {
  double low = HUGE_VAL, high = 0;
  bool is_logarithmic = false;
  [[nodiscard]] double clamped(double rate) const { return std::clamp(rate, low, high); }
};

RateAxis rate_axis(const RateBand& band) {
  RateAxis axis;
  const auto include = [&](double low, double high) {
    axis.low = std::min(axis.low, low);
    axis.high = std::max(axis.high, high);
  };
  if (band.is_unknown())
    for (const double rate : band.start().rate) include(rate, rate);
  for (const RatePiece& piece : band.pieces())
    for (const double rate : piece.rate) include(rate, rate);
  axis.is_logarithmic = axis.high > kMostLinear * axis.low;
  const double low = axis.low / kWidestBand, high = axis.high * (axis.is_logarithmic ? kWidestBand : 2);
  for (const RatePiece& piece : band.pieces())
    for (std::size_t i = 0; i < piece.z.size(); ++i)
      include(std::max(piece.low[i], low), std::min(piece.high[i], high));
  axis.low = axis.is_logarithmic ? axis.low / 1.15 : 0;
  axis.high *= axis.is_logarithmic ? 1.15 : 1.05;
  return axis;
}

void set_rate_axis(Gnuplot& plot, const FitPanel& panel, const RateAxis& axis) {
  if (!axis.is_logarithmic) return set_x_axis(plot, panel, axis.low, axis.high);
  const bool is_wide = axis.high > 1e4 * axis.low;
  plot.add(fmt::format("set logscale x\nset xrange [{:.9g}:{:.9g}]\nset format x '{}'\nset mxtics {}",
                       axis.low, axis.high, is_wide ? "10^{%T}" : "%g", is_wide ? 1 : 10));
}

/// "rate z" of the pieces of a kind, one block for neighbouring ones: layers are joined by steps.
std::string curve_rows(const RateBand& band, RateKind kind) {
  std::string rows;
  RateKind before = kind;
  for (const RatePiece& piece : band.pieces()) {
    if (piece.kind != kind && before == kind && !rows.empty()) rows += "\n";
    before = piece.kind;
    for (std::size_t i = 0; piece.kind == kind && i < piece.z.size(); ++i)
      rows += fmt::format("{:.6g} {:.6g}\n", piece.rate[i], piece.z[i]);
  }
  return rows;
}

/// The steps between layers of different kinds.
std::string step_rows(const RateBand& band) {
  std::string rows;
  const auto& pieces = band.pieces();
  for (std::size_t i = 1; band.is_layered() && i < pieces.size(); ++i)
    if (pieces[i].kind != pieces[i - 1].kind)
      rows += fmt::format("{:.6g} {:.6g}\n{:.6g} {:.6g}\n\n", pieces[i - 1].rate[0], pieces[i].z[0],
                          pieces[i].rate[0], pieces[i].z[0]);
  return rows;
}

/// Polygons: up along the lower edge, down along the upper one.
std::string band_rows(const RateBand& band, const RateAxis& axis) {
  std::string rows;
  const auto corner = [&](double rate, double z) {
    rows += fmt::format("{:.6g} {:.6g}\n", axis.clamped(rate), z);
  };
  for (const RatePiece& piece : band.pieces()) {
    if (piece.kind != RateKind::banded) continue;
    for (std::size_t i = 0; i < piece.z.size(); ++i) corner(piece.low[i], piece.z[i]);
    for (std::size_t i = piece.z.size(); i-- > 0;) corner(piece.high[i], piece.z[i]);
    rows += "\n";
  }
  for (const BreakBand& at : band.breaks()) {
    const RatePiece &below = band.pieces()[at.index], &above = band.pieces()[at.index + 1];
    const double low = std::min(below.low[0], above.low[0]), high = std::max(below.high[0], above.high[0]);
    corner(low, at.interval.low);
    corner(low, at.interval.high);
    corner(high, at.interval.high);
    corner(high, at.interval.low);
    rows += "\n";
  }
  return rows;
}

/// The parts of the plot command, each with its data; only what there is gets a line in the legend.
std::string curves(Gnuplot& plot, const RateBand& band, const RateAxis& axis) {
  std::string all;
  const auto add = [&](const char* name, const std::string& rows, const std::string& style) {
    if (rows.empty()) return;
    plot.add_data(name, rows);
    all += fmt::format("{}${} using 1:2 {}", all.empty() ? "" : ", ", name, style);
  };
  add("band", band_rows(band, axis),
      "with filledcurves closed fs solid noborder lc rgb '#b3d4e8' title '95 % band'");
  std::string start;
  for (std::size_t i = 0; band.is_unknown() && i < band.start().z.size(); ++i)
    start += fmt::format("{:.6g} {:.6g}\n", band.start().rate[i], band.start().z[i]);
  add("start", start, "with lines lw 1.3 lc rgb '#8c8c8c' title 'start'");
  // Where only the heights of the interfaces were unknown, the whole curve is the estimate all the same.
  const bool is_given = !band.is_unknown() || band.has(RateKind::banded) || band.has(RateKind::open);
  add("steps", step_rows(band), fmt::format("with lines lw 1.3 lc rgb '{}' notitle", kBlue));
  add("banded", curve_rows(band, RateKind::banded),
      fmt::format("with lines lw 2.4 lc rgb '{}' title 'estimate'", kBlue));
  add("open", curve_rows(band, RateKind::open),
      fmt::format("with lines lw 2.4 dt (4,2) lc rgb '{}' title 'no error bar'", kBlue));
  add("known", curve_rows(band, RateKind::known),
      fmt::format("with lines lw 2.4 lc rgb '{}' title '{}'", is_given ? "black" : kBlue,
                  is_given ? "given" : "estimate"));
  return all;
}

}  // namespace

void add_rate(Gnuplot& plot, const FitPanel& panel, const fit::FitSpec& spec, const fit::Estimate& estimate) {
  const RateBand band(spec, estimate);
  const RateAxis axis = rate_axis(band);
  const ObservationUnits& units = spec.observations.units;
  const bool is_scaled = estimate.scene->scale() != 1 || spec.scene.scale() != 1;
  const std::string symbol = (is_scaled ? italic("s") + " " : "") + italic("a") + "(" + italic("z") + ")";
  begin_panel(plot, panel);
  plot.add(
      "set xlabel " +
      axis_label("shear rate " + symbol, units.z.empty() || units.t.empty() ? "" : units.z + "/" + units.t) +
      " offset 0,0.3");
  plot.add(
      fmt::format("set key at screen {:.5g},{:.5g} left top vertical Left reverse samplen 1.8 spacing 1.2",
                  panel.right + 0.012, panel.top));
  set_height_axis(plot, spec, true);
  set_rate_axis(plot, panel, axis);
  const std::string all = curves(plot, band, axis);
  plot.add("plot " + all);
}

}  // namespace shearfront::tools
