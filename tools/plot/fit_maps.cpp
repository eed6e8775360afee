// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "plot/cell_axis.hpp"
#include "plot/fit_panels.hpp"

namespace shearfront::tools {
namespace {

constexpr double kGridShare = 0.5;  // data that fill less than this of times x heights are no grid
constexpr std::size_t kLeastHeights = 3;
constexpr double kColouredShare = 0.98;  // of the residuals inside the colour scale: a few may be far out
constexpr double kLeastResidualScale = 4e-3;  // of the range of phi or M: below this a fit is perfect
constexpr const char* kPhiPalette =
    "set palette defined (0 '#0d0887', 0.25 '#6a00a8', 0.5 '#b12a90', 0.75 '#e16462', 1 '#f0a028')";
constexpr const char* kResidualPalette =  // ColorBrewer's RdBu
    "set palette defined (0 '#2166ac', 0.25 '#67a9cf', 0.5 '#f7f7f7', 0.75 '#ef8a62', 1 '#b2182b')";

/// What is drawn of one cell or point.
struct Spot {
  double t = 0, z = 0, t_low = 0, t_high = 0, z_low = 0, z_high = 0;
  double observed = 0, fitted = 0, n = 0;
};

struct Spots {
  bool are_cells = false, have_gaps = false;
  double t_low = 0, t_high = 1;
  std::vector<Spot> all;
};

CellAxis time_axis(const Observations& observations) {
  std::vector<double> t;
  for (const Observation& o : observations.rows) t.push_back(o.t);
  return {std::move(t), 0, std::numeric_limits<double>::infinity()};
}

CellAxis height_axis(const fit::FitSpec& spec) {
  std::vector<double> z;
  for (const Observation& o : spec.observations.rows) z.push_back(o.z);
  return {std::move(z), spec.scene.bottom(), spec.scene.top()};
}

/// Means over the observations of each cell. A bin is not drawn beyond its edges.
Spots cells(const fit::FitSpec& spec, const fit::Estimate& estimate, const CellAxis& times,
            const CellAxis& heights) {
  std::vector<Spot> grid(times.size() * heights.size());
  for (std::size_t k = 0; k < spec.observations.rows.size(); ++k) {
    const Observation& o = spec.observations.rows[k];
    const std::size_t i = times.cell_of(o.t), j = heights.cell_of(o.z);
    Spot& spot = grid[i * heights.size() + j];
    const double reach = o.width > 0 ? o.width / 2 : std::numeric_limits<double>::infinity();
    const double low = std::max(heights.low(j), o.z - reach), high = std::min(heights.high(j), o.z + reach);
    spot.z_low = spot.n > 0 ? std::min(spot.z_low, low) : low;
    spot.z_high = spot.n > 0 ? std::max(spot.z_high, high) : high;
    spot.t_low = times.low(i);
    spot.t_high = times.high(i);
    spot.observed += o.value;
    spot.fitted += estimate.predicted[k];
    spot.n += 1;
  }
  Spots spots{true, false, times.low(0), times.high(times.size() - 1), {}};
  for (Spot& spot : grid) {
    spots.have_gaps = spots.have_gaps || !(spot.n > 0);
    if (!(spot.n > 0)) continue;
    spot.t = (spot.t_low + spot.t_high) / 2;
    spot.z = (spot.z_low + spot.z_high) / 2;
    spot.observed /= spot.n;
    spot.fitted /= spot.n;
    spots.all.push_back(spot);
  }
  return spots;
}

Spots points(const fit::FitSpec& spec, const fit::Estimate& estimate) {
  Spots spots{false, false, 0, 0, {}};
  for (std::size_t k = 0; k < spec.observations.rows.size(); ++k) {
    const Observation& o = spec.observations.rows[k];
    spots.all.push_back({o.t, o.z, o.t, o.t, o.z, o.z, o.value, estimate.predicted[k], 1});
    spots.t_high = std::max(spots.t_high, o.t);
  }
  spots.t_high *= 1.02;
  return spots;
}

Spots spots_of(const fit::FitSpec& spec, const fit::Estimate& estimate) {
  const CellAxis times = time_axis(spec.observations), heights = height_axis(spec);
  const auto n = static_cast<double>(times.n_distinct()) * static_cast<double>(heights.n_distinct());
  const bool is_grid = static_cast<double>(spec.observations.rows.size()) >= kGridShare * n;
  return is_grid && heights.n_distinct() >= kLeastHeights ? cells(spec, estimate, times, heights)
                                                          : points(spec, estimate);
}

/// Like round_up(), with narrower steps.
double round_limit_up(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (const double factor : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0})
    if (factor * power >= x * (1 - 1e-12)) return factor * power;
  return 10 * power;
}

/// The colour scale of the residuals is symmetric; those beyond it have the outermost colours.
struct ResidualScale {
  double limit = 0;
  bool is_exceeded = false;
};

ResidualScale residual_scale(const Spots& spots, const Measured& value) {
  std::vector<double> sizes;
  for (const Spot& spot : spots.all)
    if (const double r = std::abs(spot.observed - spot.fitted); std::isfinite(r)) sizes.push_back(r);
  const double least = kLeastResidualScale * (value.high - value.low);
  if (sizes.empty()) return {round_limit_up(least), false};
  std::sort(sizes.begin(), sizes.end());
  const double most = sizes[static_cast<std::size_t>(kColouredShare * static_cast<double>(sizes.size() - 1))];
  const double limit = round_limit_up(std::max(most, least));
  return {limit, sizes.back() > limit};
}

/// Settings of a colour scale; the bar stands to the right of a panel.
std::string colour_bar(const FitPanel& panel) {
  return fmt::format(
      "set colorbox vertical noborder user origin screen {:.5g},{:.5g} size screen 0.012,{:.5g}\n"
      "set cbtics scale 0 offset -0.8,0\n",
      panel.right + 0.01, panel.bottom, panel.top - panel.bottom);
}

std::string value_colours(const Measured& value) {
  return fmt::format("{}\nset cbrange [{:.9g}:{:.9g}]\nset cbtics {:.9g}\n", kPhiPalette, value.low,
                     value.high, round_up((value.high - value.low) / 5));
}

std::string residual_colours(const ResidualScale& scale) {
  const double x = scale.limit;
  return fmt::format(
      "{0}\nset cbrange [{1:.9g}:{2:.9g}]\n"
      "set cbtics ('{3}−{2:.4g}' {1:.9g}, '−{5:.4g}' {4:.9g}, '0' 0, '{5:.4g}' {5:.9g}, '{6}{2:.4g}' "
      "{2:.9g})\n",
      kResidualPalette, -x, x, scale.is_exceeded ? "≤" : "", -x / 2, x / 2, scale.is_exceeded ? "≥" : "");
}

/// One row per cell or point: t z, its edges, and the value drawn.
template <class Value>
std::string rows_of(const Spots& spots, const Scene<double>& scene, Value&& value) {
  // A cell reaches a little under its neighbours drawn later, else the page shines through between them.
  const double dt = 0.003 * (spots.t_high - spots.t_low), dz = 0.003 * (scene.top() - scene.bottom());
  std::string rows;
  for (const Spot& s : spots.all)
    if (const double v = value(s); std::isfinite(v))
      rows += fmt::format("{:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.7g} {:.5g}\n", s.t, s.z, s.t_low,
                          std::min(spots.t_high, s.t_high + dt), s.z_low, s.z_high + dz, v);
  return rows.empty() ? "NaN NaN NaN NaN NaN NaN NaN\n" : rows;
}

/// Axes of a map; only the first has numbers at its heights.
void begin_map(Gnuplot& plot, const FitPanel& panel, const fit::FitSpec& spec, const Spots& spots,
               bool is_first) {
  begin_panel(plot, panel);
  plot.add("set xlabel " + axis_label("time " + italic("t"), spec.observations.units.t) + " offset 0,0.3");
  const double t_low = spots.t_low < 0.2 * spots.t_high ? 0 : spots.t_low;
  set_x_axis(plot, panel, t_low, spots.t_high);
  set_height_axis(plot, spec, is_first);
  if (spots.have_gaps)
    plot.add("set object rectangle from graph 0,0 to graph 1,1 behind fs solid noborder fc rgb '#dcdcdc'");
  plot.add("unset colorbox");
}

/// Draws the rows in the colours of `settings`, which come last.
void finish_map(Gnuplot& plot, const std::string& title, const Spots& spots, const std::string& rows,
                const std::string& settings) {
  plot.add("set title " + title + " offset 0,-0.6");
  plot.add_data("map", rows);
  plot.add(settings);
  if (spots.are_cells) {
    plot.add("plot $map using 1:2:3:4:5:6:7 with boxxyerror fs solid noborder fc palette");
    return;
  }
  const double size = std::clamp(7 / std::sqrt(static_cast<double>(spots.all.size())), 0.15, 0.6);
  plot.add(
      fmt::format("plot $map using 1:2 with points pt 7 ps {:.3g} lc rgb '#909090', $map using "
                  "1:2:7 with points pt 7 ps {:.3g} lc palette",
                  size + 0.08, size));
}

}  // namespace

void add_maps(Gnuplot& plot, const FitPanel& place, const fit::FitSpec& spec, const fit::Estimate& estimate) {
  const Measured value = measured(spec, estimate);
  const Spots spots = spots_of(spec, estimate);
  const double width = (place.right - place.left - 0.125) / 3;
  const auto at = [&](double left) { return FitPanel{left, left + width, place.bottom, place.top}; };
  const FitPanel first = at(place.left), second = at(first.right + 0.045), third = at(place.right - width);
  const std::string colours = value_colours(value);

  begin_map(plot, first, spec, spots, true);
  finish_map(plot, axis_label("observed " + value.symbol, spec.observations.units.value), spots,
             rows_of(spots, spec.scene, [](const Spot& s) { return s.observed; }), colours);
  begin_map(plot, second, spec, spots, false);
  finish_map(plot, axis_label("fitted " + value.symbol, spec.observations.units.value), spots,
             rows_of(spots, spec.scene, [](const Spot& s) { return s.fitted; }),
             colours + colour_bar(second));
  begin_map(plot, third, spec, spots, false);
  finish_map(plot, "'observed − fitted'", spots,
             rows_of(spots, spec.scene, [](const Spot& s) { return s.observed - s.fitted; }),
             residual_colours(residual_scale(spots, value)) + colour_bar(third));
}

}  // namespace shearfront::tools
