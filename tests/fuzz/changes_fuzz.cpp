// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "report.hpp"
#include "shearfront/io/scene_file.hpp"

/// Property of --set: any lines KEY=VALUE give a valid scene, or one printable line that says what is wrong.
namespace {

using namespace shearfront;

constexpr const char* kScenes[] = {
    "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.5]\nvalues = [2, 1]\n"
    "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n",
    "[flux]\nmodel = \"cubic\"\ngamma = 0.5\n"
    "[shear_rate]\nmodel = \"table\"\nz = [-1, 0, 2]\nvalues = [1, 2, 3]\n"
    "[initial]\nmodel = \"sine\"\nmean = 0.5\namplitude = 0.1\nwavelength = 0.5\n"
    "[domain]\nbottom = -1\ntop = 2\n[diffusion]\nD = 0.1\n",
    "[shear_rate]\nmodel = \"exponential\"\namplitude = 1\ndecay = 0.1\n"
    "[initial]\nvalues = [0.5]\n[boundary]\nbottom = { breaks = [1], values = [0, 1] }\n",
};

void check(const char* scene, const SceneChanges& changes) {
  try {
    const Scene<double> changed = parse_scene<double>(scene, "fuzz.toml", changes);
    fuzz::require(find_complaints(changed.spec()).empty(), "an accepted scene is valid");
  } catch (const FileError& error) {
    fuzz::check_report(error, "fuzz.toml");
  } catch (const InputError& error) {
    const std::string report = error.what();
    fuzz::require(report.starts_with("--set "), "a line that says where the number came from");
    for (const char c : report)
      fuzz::require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F, "a printable line");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  SceneChanges changes;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || equals == 0) continue;
    changes.push_back({line.substr(0, equals), line.substr(equals + 1)});
  }
  for (const char* scene : kScenes) check(scene, changes);
  return 0;
}
