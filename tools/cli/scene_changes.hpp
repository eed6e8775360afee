// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "shearfront/io/scene_file.hpp"

namespace CLI {
class App;
}

namespace shearfront::tools {

/// --set KEY=VALUE, for numbers in the scene that a command works on.
class SceneChangesOption {
 public:
  void add_to(CLI::App& app);
  [[nodiscard]] const std::vector<std::string>& words() const { return words_; }
  /// Errors: InputError for one without "=".
  [[nodiscard]] SceneChanges changes() const;

 private:
  std::vector<std::string> words_;
};

}  // namespace shearfront::tools
