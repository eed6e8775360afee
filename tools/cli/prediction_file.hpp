// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "cli/fitted.hpp"
#include "shearfront/io/results.hpp"

/// What follows from an estimate, with 95 % bands, as files.
namespace shearfront::tools {

/// Where a prediction is wanted.
struct PredictionPlan {
  std::vector<double> times, heights;
};

/// Header quantity,t,z,value,lower,upper,std_error,unit and a row for each number: phi and M at times and heights, the height
/// H of the bed at times, where the scene has one, and the event times (names as in studies) where a method knows them. Empty:
/// what a number has not; std_error where the band is by derivatives. "never": an event that does not come.
/// Says on standard error what the bands are and what is left out. Errors: InputError if the method has no solution there.
void write_predictions_csv(OutputFile& file, const PredictionPlan& plan, const Scene<double>& estimated,
                           const fit::DrawnScenes& draws, const Method& method);

/// Header t,z,phi,lower,upper,M,M_lower,M_upper: 95 % bands, empty without error bars. One row per time and height.
void write_sample_bands_csv(OutputFile& file, const std::vector<double>& times,
                            const std::vector<double>& heights, const fit::PredictedSamples& samples,
                            const SceneUnits& units);

/// The bands as result files take them.
[[nodiscard]] ResultBand result_band(const fit::PredictedNumber& number);
[[nodiscard]] SampleBands sample_bands(const fit::PredictedSamples& samples);

}  // namespace shearfront::tools
