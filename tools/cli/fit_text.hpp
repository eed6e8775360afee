// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <initializer_list>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/model_comparison.hpp"
#include "shearfront/io/detail/json.hpp"
#include "shearfront/io/output_file.hpp"

/// Estimates for people and spreadsheets.
namespace shearfront::tools {

/// Table of the parameters and lines about the whole fit. Estimates have the digits that their standard
/// errors leave, the errors two.
[[nodiscard]] std::string estimate_text(const fit::Estimate& estimate);

/// Header t,z,observed,predicted,residual, with sigma if the data have it, and units: residual = observed - predicted in
/// the unit of the data. One row per observation in the order of the data; empty without prediction.
void write_residuals_csv(OutputFile& file, const Observations& observations, const fit::Estimate& estimate,
                         const SceneUnits& units = {});

[[nodiscard]] std::string comparison_text(const std::vector<fit::ComparedModel>& models);
/// [{"model","parameters","misfit","aic","daic","aic_weight","bic","dbic","mbic","dmbic"}]
[[nodiscard]] detail::Json comparison_json(const std::vector<fit::ComparedModel>& models);

/// A row of CSV; what is not finite is left empty.
[[nodiscard]] std::string csv_row(std::initializer_list<double> numbers);

}  // namespace shearfront::tools
