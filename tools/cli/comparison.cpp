// SPDX-License-Identifier: BSD-3-Clause
#include "cli/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/table.hpp"
#include "shearfront/fit/fit.hpp"
#include "shearfront/io/file_error.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// What tells two sets of observations apart; empty if nothing does.
std::string difference(const Observations& a, const Observations& b) {
  if (a.quantity != b.quantity)
    return fmt::format("its observations are of another quantity ({} instead of {})", name_of(b.quantity),
                       name_of(a.quantity));
  if (a.rows.size() != b.rows.size())
    return fmt::format("it has {} observations instead of {}", b.rows.size(), a.rows.size());
  struct Field {
    const char* name;
    double Observation::*member;
  };
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    for (const Field& field :
         {Field{"t", &Observation::t}, Field{"z", &Observation::z}, Field{"value", &Observation::value},
          Field{"width", &Observation::width}, Field{"sigma", &Observation::sigma}})
      if (const double x = a.rows[i].*field.member, y = b.rows[i].*field.member; !is_same(x, y))
        return fmt::format("its observation {} differs ({} {} instead of {})", i, field.name, y, x);
  return "";
}

std::string difference(const fit::FitSpec& a, const fit::FitSpec& b) {
  if (std::string text = difference(a.observations, b.observations); !text.empty()) return text;
  if (fit::quantity_of(a) != fit::quantity_of(b))
    return fmt::format("its misfit is of another quantity ({} instead of {})", fit::quantity_of(b),
                       fit::quantity_of(a));
  if (fit::loss_of(a) != fit::loss_of(b))
    return fmt::format("its loss differs ({} instead of {})", fit::loss_of(b), fit::loss_of(a));
  if (a.misfit.loss_scale != b.misfit.loss_scale) return "its loss_scale differs";
  return "";
}

std::string shown(const std::optional<double>& x, const char* format) {
  return x ? fmt::format(fmt::runtime(format), *x) : "none";
}

std::optional<double> least(const std::vector<ComparedModel>& models,
                            std::optional<double> ComparedModel::*criterion) {
  std::optional<double> best;
  for (const ComparedModel& m : models)
    if (m.*criterion && (!best || *(m.*criterion) < *best)) best = m.*criterion;
  return best;
}

}  // namespace

void check_comparable(const std::vector<std::string>& files, const std::vector<fit::FitSpec>& specs) {
  Complaints complaints;
  std::string report;
  for (std::size_t i = 1; i < specs.size(); ++i) {
    const std::string why = difference(specs.front(), specs[i]);
    if (why.empty()) continue;
    const std::string file = printable(files[i]);
    const std::string text = fmt::format("cannot be compared with {}: {}", printable(files[0]), why);
    complaints.push_back({file, "", text});
    report += fmt::format("{}{}: {}", report.empty() ? "" : "\n", file, text);
  }
  if (!complaints.empty()) throw FileError(std::move(complaints), std::move(report));
}

std::vector<ComparedModel> compare_models(const std::vector<std::string>& names,
                                          const std::vector<fit::Estimate>& estimates) {
  std::vector<ComparedModel> models;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const fit::Estimate& e = estimates[i];
    ComparedModel& model = models.emplace_back();
    model.model = names[i];
    model.parameters = e.parameters.size();
    if (!e.usable()) continue;
    model.misfit = e.misfit;
    model.aic = e.aic;
    model.bic = e.bic;
  }
  const auto aic = least(models, &ComparedModel::aic), bic = least(models, &ComparedModel::bic);
  double sum = 0;
  for (ComparedModel& m : models) {
    if (m.aic) m.daic = *m.aic - *aic;
    if (m.bic) m.dbic = *m.bic - *bic;
    if (m.aic) sum += *(m.aic_weight = std::exp(-*m.daic / 2));
  }
  for (ComparedModel& m : models)
    if (m.aic_weight) *m.aic_weight /= sum;
  const auto rank = [](const ComparedModel& m) {
    return m.aic.value_or(std::numeric_limits<double>::infinity());
  };
  std::stable_sort(models.begin(), models.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return models;
}

std::string comparison_text(const std::vector<ComparedModel>& models) {
  TextTable table({"model", "parameters", "misfit", "AIC", "dAIC", "weight", "BIC", "dBIC"});
  for (const ComparedModel& m : models)
    table.add({printable(m.model, 100), std::to_string(m.parameters), shown(m.misfit, "{:.6g}"),
               shown(m.aic, "{:.2f}"), shown(m.daic, "{:.2f}"), shown(m.aic_weight, "{:.3g}"),
               shown(m.bic, "{:.2f}"), shown(m.dbic, "{:.2f}")});
  return table.text();
}

detail::Json comparison_json(const std::vector<ComparedModel>& models) {
  using detail::json_or_null;
  detail::Json all = detail::Json::array();
  for (const ComparedModel& m : models)
    all.push_back({{"model", m.model},
                   {"parameters", m.parameters},
                   {"misfit", json_or_null(m.misfit)},
                   {"aic", json_or_null(m.aic)},
                   {"daic", json_or_null(m.daic)},
                   {"aic_weight", json_or_null(m.aic_weight)},
                   {"bic", json_or_null(m.bic)},
                   {"dbic", json_or_null(m.dbic)}});
  return all;
}

}  // namespace shearfront::tools
