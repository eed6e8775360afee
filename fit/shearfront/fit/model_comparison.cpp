// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/model_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fit.hpp"

namespace shearfront::fit {
namespace {

using ModelColumn = std::optional<double> ComparedModel::*;

bool is_same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Fills the differences from the smallest.
void set_differences(std::vector<ComparedModel>& models, ModelColumn criterion, ModelColumn difference) {
  std::optional<double> least;
  for (const ComparedModel& m : models)
    if (m.*criterion) least = std::min(*(m.*criterion), least.value_or(HUGE_VAL));
  for (ComparedModel& m : models)
    if (m.*criterion) m.*difference = *(m.*criterion) - *least;
}

}  // namespace

std::string incomparable(const FitSpec& a, const FitSpec& b) {
  const auto other = [](const char* what, const auto& x, const auto& y) {
    return fmt::format("{} ({} instead of {})", what, y, x);
  };
  const std::vector<Observation>&rows = a.observations.rows, &others = b.observations.rows;
  if (a.observations.quantity != b.observations.quantity)
    return other("its observations are of another quantity", name_of(a.observations.quantity),
                 name_of(b.observations.quantity));
  if (rows.size() != others.size())
    return fmt::format("it has {} observations instead of {}", others.size(), rows.size());
  constexpr std::pair<const char*, double Observation::*> kFields[] = {{"t", &Observation::t},
                                                                       {"z", &Observation::z},
                                                                       {"value", &Observation::value},
                                                                       {"width", &Observation::width},
                                                                       {"sigma", &Observation::sigma}};
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const auto& [name, member] : kFields)
      if (const double x = rows[i].*member, y = others[i].*member; !is_same_number(x, y))
        return fmt::format("its observation {} differs ({} {} instead of {})", i, name, y, x);
  if (quantity_of(a) != quantity_of(b))
    return other("its misfit is of another quantity", quantity_of(a), quantity_of(b));
  if (loss_of(a) != loss_of(b)) return other("its loss differs", loss_of(a), loss_of(b));
  return a.misfit.loss_scale != b.misfit.loss_scale ? "its loss_scale differs" : "";
}

std::optional<double> value_of(ModelCriterion criterion, const Estimate& estimate, std::size_t n_searched) {
  if (criterion == ModelCriterion::aic) return estimate.aic;
  if (criterion == ModelCriterion::bic || !estimate.bic) return estimate.bic;
  return *estimate.bic +
         static_cast<double>(n_searched) * std::log(static_cast<double>(estimate.predicted.size()));
}

std::vector<ComparedModel> compare_models(const std::vector<std::string>& names,
                                          const std::vector<Estimate>& estimates, ModelCriterion criterion,
                                          const std::vector<std::size_t>& n_searched) {
  std::vector<ComparedModel> models;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& e = estimates[i];
    ComparedModel& model = models.emplace_back();
    model.model = names[i];
    model.parameters = e.parameters.size();
    if (!e.usable()) continue;
    model.misfit = e.misfit;
    model.aic = e.aic;
    model.bic = e.bic;
    model.mbic = value_of(ModelCriterion::mbic, e, n_searched.empty() ? 0 : n_searched[i]);
  }
  set_differences(models, &ComparedModel::aic, &ComparedModel::daic);
  set_differences(models, &ComparedModel::bic, &ComparedModel::dbic);
  set_differences(models, &ComparedModel::mbic, &ComparedModel::dmbic);
  double sum = 0;
  for (ComparedModel& m : models)
    if (m.daic) sum += *(m.aic_weight = std::exp(-*m.daic / 2));
  for (ComparedModel& m : models)
    if (m.aic_weight) *m.aic_weight /= sum;
  constexpr ModelColumn kColumns[] = {&ComparedModel::aic, &ComparedModel::bic, &ComparedModel::mbic};
  const ModelColumn column = kColumns[static_cast<std::size_t>(criterion)];
  std::stable_sort(models.begin(), models.end(), [&](const ComparedModel& a, const ComparedModel& b) {
    return (a.*column).value_or(HUGE_VAL) < (b.*column).value_or(HUGE_VAL);
  });
  return models;
}

}  // namespace shearfront::fit
