// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp

#include <filesystem>
#include <string>

namespace shearfront::support {

/// A folder of this process alone, removed at its end: tests that run side by side must not write the same files.
inline const std::filesystem::path& own_folder() {
  class Folder {
   public:
    Folder() {
      std::string pattern = (std::filesystem::temp_directory_path() / "shearfront-test-XXXXXX").string();
      path = mkdtemp(pattern.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path path;
  };
  static const Folder folder;
  return folder.path;
}

}  // namespace shearfront::support
