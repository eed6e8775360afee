// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

#include "plot/gnuplot.hpp"
#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"

/// The panels of the picture of a fit; every add_ function appends to a figure in gnuplot's multiplot mode.
namespace shearfront::tools {

/// Where the axes of a panel stand, in fractions of the figure; labels lie outside.
struct FitPanel {
  double left = 0, right = 1, bottom = 0, top = 1;
};

/// More times than this are shown as maps.
inline constexpr std::size_t kMostProfiles = 6;
inline constexpr const char* kBlue = "#0072b2";  // of Okabe and Ito's colours

/// Default settings, and axes at this place.
void begin_panel(Gnuplot& plot, const FitPanel& panel);
/// Range of the axis "x", with as many tics at round numbers as their labels have room for.
void set_x_axis(Gnuplot& plot, const FitPanel& panel, double low, double high);
/// The height z from wall to wall.
void set_height_axis(Gnuplot& plot, const fit::FitSpec& spec, bool has_labels);
/// Symbol in italics.
[[nodiscard]] std::string italic(std::string_view symbol);
/// A text in which gnuplot finds no markup and no end of a string.
[[nodiscard]] std::string plain(std::string_view text);
/// "height {/:Italic z} (mm)"; no brackets without a unit.
[[nodiscard]] std::string axis_label(const std::string& name, std::string_view unit);
/// The smallest of 1, 2, 5, 10, ... times a power of ten that is >= x; x > 0.
[[nodiscard]] double round_up(double x);

/// phi, or M if the data are cumulative, with its symbol and the range of its axis.
struct Measured {
  std::string symbol, label;
  double low = 0, high = 1;
};
[[nodiscard]] Measured measured(const fit::FitSpec& spec, const fit::Estimate& estimate);

/// Observed points and fitted lines, one panel per time, in this part of the figure.
void add_profiles(Gnuplot& plot, const FitPanel& place, const fit::FitSpec& spec, const fit::Estimate& estimate);
/// Observed and fitted heights of the bed against time; the legend stands to the right of the panel.
void add_bed_heights(Gnuplot& plot, const FitPanel& panel, const fit::FitSpec& spec,
                     const fit::Estimate& estimate);
/// Observed, fitted and residual over t and z: cells where the data lie on a grid, points elsewhere.
void add_maps(Gnuplot& plot, const FitPanel& place, const fit::FitSpec& spec, const fit::Estimate& estimate);
/// s a(z) of the start and of the estimate with its 95 % band; the legend stands to the right of the panel.
void add_rate(Gnuplot& plot, const FitPanel& panel, const fit::FitSpec& spec, const fit::Estimate& estimate);
/// The smallest misfit after so many evaluations; stages minimise different misfits and stand apart.
void add_search(Gnuplot& plot, const FitPanel& panel, const fit::Estimate& estimate);

}  // namespace shearfront::tools
