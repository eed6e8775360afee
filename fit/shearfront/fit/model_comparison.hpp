// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/fit_spec.hpp"

/// Several models for the same observations.
namespace shearfront::fit {

/// Why misfits and information criteria of two fits mean different things: other observations (place, value,
/// width or sigma), another quantity, another loss; what b has instead of a. Empty if they mean the same.
[[nodiscard]] std::string incomparable(const FitSpec& a, const FitSpec& b);

/// Nothing if the fit has none.
[[nodiscard]] std::optional<double> value_of(ModelCriterion criterion, const Estimate& estimate,
                                             std::size_t n_searched);

/// One model among several, with the weight exp(-dAIC/2) / sum exp(-dAIC/2) (Burnham & Anderson, Model
/// selection and multimodel inference, 2002, section 2.9). Empty: the fit gave no criterion.
struct ComparedModel {
  std::string model;
  std::size_t parameters = 0;
  std::optional<double> misfit, aic, daic, aic_weight, bic, dbic, mbic, dmbic;
};

/// The best by the criterion first, then those without. `n_searched`: of each model; empty: none.
[[nodiscard]] std::vector<ComparedModel> compare_models(const std::vector<std::string>& names,
                                                        const std::vector<Estimate>& estimates,
                                                        ModelCriterion criterion = ModelCriterion::aic,
                                                        const std::vector<std::size_t>& n_searched = {});

}  // namespace shearfront::fit
