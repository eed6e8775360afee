// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/model_choice.hpp"
#include "shearfront/fit/prediction.hpp"
#include "shearfront/fit/rate_band.hpp"
#include "shearfront/io/output_file.hpp"

namespace shearfront::tools {

/// Scenes behind a band: its ends are then right to about a twentieth of its width.
inline constexpr std::size_t kPredictionDraws = 1000;

/// A fit file that was fitted: what commands use as a scene, with the uncertainty of its unknowns.
struct Fitted {
  fit::FitFile file;
  fit::Estimate estimate;
  fit::DrawnScenes draws;
};

/// Whether a file is a fit file. Errors: FileError if it cannot be read or is no TOML.
[[nodiscard]] bool is_fit_file(const std::string& path);

/// Reads a fit file, its scene with changes, fits it, says on standard error what there is to say, and draws scenes from the estimate.
/// Errors: FileError; InputError if the fit has no usable estimate.
[[nodiscard]] Fitted fitted(const std::string& path, const SceneChanges& changes = {});

/// One fit with the line of its progress; Ctrl-C ends the search with what it has. Errors: FileError.
[[nodiscard]] fit::Estimate run_fit(const fit::FitSpec& spec, const std::string& path);

/// The models of [compare]; `best` has the smallest AIC, or without one the smallest misfit; nothing if none is usable.
struct FittedModels {
  fit::ChosenModels all;
  std::optional<std::size_t> best;  ///< by the criterion of the file
  fit::ModelCriterion criterion = fit::ModelCriterion::aic;
  std::vector<std::size_t> n_searched = {};  ///< of each model
};
/// The same for every model of a file. Precondition: file.choice. Errors: FileError.
[[nodiscard]] FittedModels run_models(const fit::FitFile& file, const std::string& path);

/// Header z,a,lower,upper,lower_all,upper_all: s a(z) with its 95 % bands, of each height and of all at once; layers have a row
/// at each end.
void write_band_csv(OutputFile& file, const fit::RateBand& band, const SceneUnits& units);
/// Says which band is which, and of what.
void note_rate_band(const fit::RateBand& band);

/// Says by what the bands of `n` numbers are, `n_by_draws` of them by draws.
void note_bands(const fit::DrawnScenes& draws, std::size_t n_by_draws, std::size_t n);
/// Says what keeps a prediction from having bands, or that some draws had no solution.
void note_draws(const fit::DrawnScenes& draws, std::size_t n_failed);

}  // namespace shearfront::tools
