// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_file.hpp"

/// Several shear rates for the same observations, from one fit file.
namespace shearfront::fit {

/// Why a model cannot be chosen: its name is none of the depth functions, or it has arrays and no number of them, or the
/// other way round. Empty if it can.
[[nodiscard]] std::string refusal(const ModelChoice::Model& model);

/// The depth function that consists of layers.
[[nodiscard]] std::string layered_name();

/// Breaks of a model that are looked for wherever the data may want them.
[[nodiscard]] std::size_t n_searched(const ModelChoice& choice, const ModelChoice::Model& model);

/// The fit with this shear rate in place of the scene's, which it resembles at the start: layers have its harmonic means,
/// a table its values, entries that are single numbers those that come closest in log a(z). Layers are equally thick if their breaks are not known, the
/// points of a table equally far from each other. With a shape the start is constant, which has every shape. `first_breaks`: where unknown
/// breaks start; empty: equally far from each other.
/// Precondition: refusal() is empty. Errors: InputError if the scene is invalid with it.
[[nodiscard]] FitSpec with_model(const FitSpec& base, const ModelChoice& choice,
                                 const ModelChoice::Model& model, const Scene<double>& resembled,
                                 const std::vector<double>& first_breaks = {});

struct ChosenModels {
  std::vector<FitSpec> specs;
  std::vector<Estimate> estimates;
};

/// Fits every model from the scene, and again from the best found so far, of which it keeps the better: a model with more
/// entries starts no worse than one with fewer. Layers with unknown breaks are built from the data (layer_path.hpp) where the forward model
/// has exact derivatives. Ends with the model that `progress` interrupts. Errors: as fit(). Cost: two fits a model.
[[nodiscard]] ChosenModels fit_models(const FitSpec& base, const ModelChoice& choice,
                                      const Progress& progress = {});

}  // namespace shearfront::fit
