// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "report.hpp"
#include "scene_folder.hpp"
#include "shearfront/fit/study/study_design.hpp"
#include "shearfront/fit/study/study_spec.hpp"

/// Property of the reader of study files: any bytes give a study whose points are numbers, or a FileError that can be shown
/// as it is.
namespace {

using namespace shearfront;

constexpr std::size_t kMostPoints = 10'000;

void check_points(const fit::StudySpec& study) {
  fuzz::require(!study.outputs.empty(), "an accepted study has outputs");
  const std::size_t n = fit::n_runs(study);
  fuzz::require(n > 0, "an accepted study has runs");
  if (study.design == fit::DesignKind::fit || n > kMostPoints) return;
  const auto points = fit::study_points(study);
  fuzz::require(points.size() == n, "a point for every run");
  for (const auto& point : points) {
    fuzz::require(point.size() == study.variations.size(), "a value for every variation");
    for (const double x : point) fuzz::require(std::isfinite(x), "values that are numbers");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::SceneFolder folder;
  std::ofstream(folder.file(), std::ios::binary)
      << std::string(reinterpret_cast<const char*>(data), size) << std::flush;
  try {
    check_points(fit::read_study(folder.file()));
  } catch (const FileError& error) {
    const std::string report = error.what();
    if (report.starts_with(folder.file() + ":") && report.find("\n/") == std::string::npos)
      fuzz::check_report(error, folder.file());
    fuzz::require(!error.complaints().empty() && !report.empty(), "a report that says something");
  }
  return 0;
}
