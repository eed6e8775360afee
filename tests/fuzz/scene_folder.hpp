// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp

#include <filesystem>
#include <fstream>
#include <string>

namespace shearfront::fuzz {

/// A folder of its own with a good scene and good observations, so that what files say of each other is reached.
class SceneFolder {
 public:
  SceneFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "shearfront-fuzz-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
    std::ofstream(path_ / "scene.toml")
        << "[shear_rate]\nmodel = \"piecewise\"\nbreaks = [0.5]\nvalues = [2, 1]\n"
           "[initial]\nbreaks = [0.5]\nvalues = [0, 1]\n";
    std::ofstream(path_ / "data.csv") << "t,z,M\n0.2,0.25,0\n0.2,0.5,0.05\n0.4,0.5,0.1\n";
  }
  ~SceneFolder() { std::filesystem::remove_all(path_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;
  /// The file that is fuzzed; it need not be there.
  [[nodiscard]] std::string file() const { return (path_ / "fuzz.toml").string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace shearfront::fuzz
