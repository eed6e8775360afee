// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <string>

#include "report.hpp"
#include "scene_folder.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/model_choice.hpp"
#include "shearfront/fit/parameters.hpp"

/// Property of the reader of fit files: any bytes give a fit whose unknowns are good, that of each model of [compare], or a
/// FileError that can be shown as it is.
using namespace shearfront;

namespace {

void check_unknowns(const fit::FitSpec& spec) {
  const fit::Parameters parameters(spec.scene, spec.unknown);
  fuzz::require(parameters.size() > 0, "an accepted fit has unknowns");
  fuzz::require(parameters.within_bounds(parameters.start()), "an accepted start keeps its bounds");
}

void check_models(const fit::FitFile& fit) {
  constexpr std::size_t kMost = 50;  // pieces: the start of each costs a search
  for (const fit::ModelChoice::Model& model : fit.choice->models) {
    if (model.n > kMost) continue;
    try {
      check_unknowns(with_model(fit.spec, *fit.choice, model, Scene<double>(fit.spec.scene)));
    } catch (const InputError&) {
      // What does not go with the rest of the scene is reported when it is fitted.
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::SceneFolder folder;
  try {
    const fit::FitFile fit =
        fit::parse_fit(std::string(reinterpret_cast<const char*>(data), size), folder.file());
    fit.choice ? check_models(fit) : check_unknowns(fit.spec);
  } catch (const FileError& error) {
    // Complaints of the other files follow under their own names.
    const std::string report = error.what();
    if (report.starts_with(folder.file() + ":") && report.find("\n/") == std::string::npos)
      fuzz::check_report(error, folder.file());
    fuzz::require(!error.complaints().empty() && !report.empty(), "a report that says something");
  }
  return 0;
}
