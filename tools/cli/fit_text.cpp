// SPDX-License-Identifier: BSD-3-Clause
#include "cli/fit_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/table.hpp"
#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

/// Enough digits to see two of the standard error.
int digits_of(const fit::ParameterEstimate& p) {
  constexpr int kWithoutError = 6, kFewest = 4, kMost = 16;
  if (!p.std_error || !(*p.std_error > 0) || p.estimate == 0) return kWithoutError;
  const double places =
      std::floor(std::log10(std::abs(p.estimate))) - std::floor(std::log10(*p.std_error)) + 2;
  return static_cast<int>(std::clamp<double>(places, kFewest, kMost));
}

/// An open end is not invented: "> 1.7".
std::string interval_text(const std::optional<fit::Interval>& i, int digits) {
  if (!i) return "";
  if (std::isnan(i->high)) return fmt::format("> {:.{}g}", i->low, digits);
  if (std::isnan(i->low)) return fmt::format("< {:.{}g}", i->high, digits);
  return fmt::format("{:.{}g} to {:.{}g}", i->low, digits, i->high, digits);
}

/// "exponential, length 0.31 (0.24 to 0.4) in z, 2 in t"
std::string noise_text(const fit::NoiseEstimate& noise) {
  std::string text = noise.model;
  const auto add = [&](const char* before, double x, const std::optional<fit::Interval>& interval,
                       const char* after) {
    if (std::isnan(x)) return;
    text += fmt::format(", {}{:.3g}{}{}", before, x,
                        interval ? fmt::format(" ({})", interval_text(interval, 3)) : "", after);
  };
  add("tau ", noise.tau, noise.tau95, "");
  add("length ", noise.length_z, noise.length_z95, " in z");
  add("length ", noise.length_t, noise.length_t95, " in t");
  if (noise.independent > 0) add("independent part ", noise.independent, noise.independent95, "");
  return text;
}

std::string shown(const std::optional<double>& x, const char* format) {
  return x ? fmt::format(fmt::runtime(format), *x) : "none";
}

}  // namespace

std::string estimate_text(const fit::Estimate& estimate) {
  std::string text =
      fmt::format("{} ({}, {})\n\n", printable(estimate.name, 100), estimate.method, estimate.algorithm);
  TextTable table({"parameter", "start", "estimate", "std error", "95 % interval", "profile 95 %",
                   "bootstrap 95 %", "remark"});
  for (const fit::ParameterEstimate& p : estimate.parameters) {
    const int digits = digits_of(p);
    table.add({p.name, number_text(p.start), fmt::format("{:.{}g}", p.estimate, digits),
               p.std_error ? fmt::format("{:.2g}", *p.std_error) : "none", interval_text(p.ci95, digits),
               interval_text(p.profile95, digits), interval_text(p.bootstrap95, digits),
               p.at_bound                          ? "at bound"
               : p.held_by_shape                   ? "held by shape"
               : p.check && p.check->is_doubtful() ? "doubtful interval"
                                                   : ""});
  }
  text += table.text();
  if (estimate.scene && estimate.scene->spec().units.are_given()) {
    const SceneUnits& units = estimate.scene->spec().units;
    const auto shown_unit = [](const std::string& unit) { return unit.empty() ? "?" : printable(unit); };
    text += fmt::format("heights in {}, {} in {}, s a in {}/{}\n", shown_unit(units.z),
                        units.is_chute ? "distances" : "times", shown_unit(units.t), shown_unit(units.z),
                        shown_unit(units.t));
  }
  text += fmt::format("\nmisfit {:.6g} ({}, {}), residual norm {:.6g}, noise {}\n", estimate.misfit,
                      estimate.quantity, estimate.loss, estimate.residual_norm,
                      estimate.sigma_is_given      ? "as given by the data"
                      : std::isnan(estimate.sigma) ? "not known"
                                                   : fmt::format("{:.3g} (estimated)", estimate.sigma));
  if (estimate.noise) text += "correlated noise: " + noise_text(*estimate.noise) + "\n";
  if (estimate.order)
    text += fmt::format(
        "order of events: fixed within {:.2g} standard errors of {}, beyond that derivatives are those of "
        "another; "
        "changed by {} steps of the search\n",
        estimate.order->std_errors, estimate.order->parameter, estimate.order->changes);
  if (estimate.aic && estimate.bic)
    text += fmt::format("AIC {:.6g}, BIC {:.6g}\n", *estimate.aic, *estimate.bic);
  text += fmt::format("{} observations", estimate.observations);
  if (estimate.left_out > 0) text += fmt::format(" ({} more near shocks left out)", estimate.left_out);
  return text + fmt::format(", {} evaluations, {} iterations, {:.3g} s\n", estimate.evaluations,
                            estimate.iterations, estimate.wall_s);
}

std::string csv_row(std::initializer_list<double> numbers) {
  std::string row;
  for (const double x : numbers) row += (std::isfinite(x) ? number_text(x) : "") + ",";
  row.back() = '\n';
  return row;
}

void write_residuals_csv(OutputFile& file, const Observations& observations, const fit::Estimate& estimate,
                         const SceneUnits& units) {
  const bool has_sigma = observations.has_sigma();
  const bool is_height =
      observations.quantity == Quantity::cumulative || observations.quantity == Quantity::bed_height;
  std::string header = csv_header({"t", "z"}, units);
  header.pop_back();
  for (const char* name : {"observed", "predicted", "residual", "sigma"})
    if (has_sigma || std::string_view(name) != "sigma")
      header += "," + detail::csv_field(detail::heading_text(name, is_height ? units.z : ""));
  file.write(header + "\n");
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const Observation& o = observations.rows[i];
    const double predicted = estimate.predicted[i], residual = o.value - predicted;
    file.write(has_sigma ? csv_row({o.t, o.z, o.value, predicted, residual, o.sigma})
                         : csv_row({o.t, o.z, o.value, predicted, residual}));
  }
}

std::string comparison_text(const std::vector<fit::ComparedModel>& models) {
  const bool are_searched =
      std::any_of(models.begin(), models.end(), [](const fit::ComparedModel& m) { return m.mbic != m.bic; });
  std::vector<std::string> heads{"model", "parameters", "misfit", "AIC", "dAIC", "weight", "BIC", "dBIC"};
  if (are_searched) heads.insert(heads.end(), {"mBIC", "dmBIC"});
  TextTable table(heads);
  for (const fit::ComparedModel& m : models) {
    std::vector<std::string> row{printable(m.model, 100),   std::to_string(m.parameters),
                                 shown(m.misfit, "{:.6g}"), shown(m.aic, "{:.2f}"),
                                 shown(m.daic, "{:.2f}"),   shown(m.aic_weight, "{:.3g}"),
                                 shown(m.bic, "{:.2f}"),    shown(m.dbic, "{:.2f}")};
    if (are_searched) row.insert(row.end(), {shown(m.mbic, "{:.2f}"), shown(m.dmbic, "{:.2f}")});
    table.add(std::move(row));
  }
  return table.text();
}

detail::Json comparison_json(const std::vector<fit::ComparedModel>& models) {
  using detail::json_or_null;
  detail::Json rows = detail::Json::array();
  for (const fit::ComparedModel& m : models)
    rows.push_back({{"model", m.model},
                    {"parameters", m.parameters},
                    {"misfit", json_or_null(m.misfit)},
                    {"aic", json_or_null(m.aic)},
                    {"daic", json_or_null(m.daic)},
                    {"aic_weight", json_or_null(m.aic_weight)},
                    {"bic", json_or_null(m.bic)},
                    {"dbic", json_or_null(m.dbic)},
                    {"mbic", json_or_null(m.mbic)},
                    {"dmbic", json_or_null(m.dmbic)}});
  return rows;
}

}  // namespace shearfront::tools
