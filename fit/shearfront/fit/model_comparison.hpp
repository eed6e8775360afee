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

/// By which the best of several models is chosen; the least is the best. With p parameters, of which b are places that were looked
/// for among all there are, n data and their Gaussian likelihood L:
///
///     AIC = -2 log L + 2 p,   BIC = -2 log L + p log n,   mBIC = BIC + b log n.
///
/// A break that fits noise best of all places gains more than a parameter does, about as much as two. Source of mBIC: Zhang &
/// Siegmund (2007), Biometrics 63, 22-32, but for its term in the lengths of the segments, which has no meaning for layers.
enum class ModelCriterion { aic, bic, mbic };

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
