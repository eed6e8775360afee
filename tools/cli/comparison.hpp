// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/io/detail/json.hpp"

/// Several models for the same observations.
namespace shearfront::tools {

/// Refuses fits whose misfits and information criteria mean different things: other observations (place,
/// value, width or sigma), another quantity, another loss. Errors: FileError that names both files.
void check_comparable(const std::vector<std::string>& files, const std::vector<fit::FitSpec>& specs);

/// One model among several, with the weight exp(-dAIC/2) / sum exp(-dAIC/2) (Burnham & Anderson, Model
/// selection and multimodel inference, 2002, section 2.9). Empty: the fit gave no criterion.
struct ComparedModel {
  std::string model;
  std::size_t parameters = 0;
  std::optional<double> misfit, aic, daic, aic_weight, bic, dbic;
};

/// Best AIC first, then those without.
[[nodiscard]] std::vector<ComparedModel> compare_models(const std::vector<std::string>& names,
                                                        const std::vector<fit::Estimate>& estimates);
[[nodiscard]] std::string comparison_text(const std::vector<ComparedModel>& models);
/// [{"model","parameters","misfit","aic","daic","aic_weight","bic","dbic"}]
[[nodiscard]] detail::Json comparison_json(const std::vector<ComparedModel>& models);

}  // namespace shearfront::tools
