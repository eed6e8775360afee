// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"

/// Several models for the same observations.
namespace shearfront::fit {

/// Why misfits and information criteria of two fits mean different things: other observations (place, value,
/// width or sigma), another quantity, another loss; what b has instead of a. Empty if they mean the same.
[[nodiscard]] std::string incomparable(const FitSpec& a, const FitSpec& b);

/// One model among several, with the weight exp(-dAIC/2) / sum exp(-dAIC/2) (Burnham & Anderson, Model
/// selection and multimodel inference, 2002, section 2.9). Empty: the fit gave no criterion.
struct ComparedModel {
  std::string model;
  std::size_t parameters = 0;
  std::optional<double> misfit, aic, daic, aic_weight, bic, dbic;
};

/// Best AIC, or BIC, first, then those without.
[[nodiscard]] std::vector<ComparedModel> compare_models(const std::vector<std::string>& names,
                                                        const std::vector<Estimate>& estimates,
                                                        bool is_by_bic = false);

}  // namespace shearfront::fit
