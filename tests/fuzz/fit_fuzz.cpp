// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <string>

#include "report.hpp"
#include "scene_folder.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/parameters.hpp"

/// Property of the reader of fit files: any bytes give a fit whose unknowns are good, or a FileError that can
/// be shown as it is.
using namespace shearfront;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::SceneFolder folder;
  try {
    const fit::FitFile fit =
        fit::parse_fit(std::string(reinterpret_cast<const char*>(data), size), folder.file());
    const fit::Parameters parameters(fit.spec.scene, fit.spec.unknown);
    fuzz::require(parameters.size() > 0, "an accepted fit has unknowns");
    fuzz::require(parameters.within_bounds(parameters.start()), "an accepted start keeps its bounds");
  } catch (const FileError& error) {
    // Complaints of the other files follow under their own names.
    const std::string report = error.what();
    if (report.starts_with(folder.file() + ":") && report.find("\n/") == std::string::npos)
      fuzz::check_report(error, folder.file());
    fuzz::require(!error.complaints().empty() && !report.empty(), "a report that says something");
  }
  return 0;
}
