// SPDX-License-Identifier: BSD-3-Clause
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "report.hpp"
#include "shearfront/fit/fit_file.hpp"
#include "shearfront/fit/parameters.hpp"

/// Property of the reader of fit files: any bytes give a fit whose unknowns are good, or a FileError that can
/// be shown as it is.
namespace {

using namespace shearfront;

/// A folder with a good scene and good observations, so that the checks between the files are reached.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "shearfront-fuzz-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
    std::ofstream(path_ / "scene.toml")
        << "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.5]\nvalues = [2, 1]\n"
           "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n";
    std::ofstream(path_ / "data.csv") << "t,z,M\n0.2,0.25,0\n0.2,0.5,0.05\n0.4,0.5,0.1\n";
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string file() const { return (path_ / "fuzz.toml").string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
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
