// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cli/fitted.hpp"
#include "cli/scene_changes.hpp"
#include "shearfront/io/scene_file.hpp"

namespace CLI {
class App;
}

namespace shearfront::tools {

/// The scene a command works on: SCENE, a file or "-" for standard input, and --set for numbers in it. A fit file
/// stands for the scene with its estimates in place. With error bars, of a fit or of [uncertain], results have bands.
class SceneArgument {
 public:
  void add_to(CLI::App& app);

  [[nodiscard]] const std::string& file() const { return file_; }
  /// Reads the file, once, and prints the remarks on it; a fit file is fitted. Errors: FileError, InputError.
  [[nodiscard]] Scene<double> read();
  /// Scenes that the fit behind it or its [uncertain] leave possible; none for a scene that is certain. Precondition: read().
  [[nodiscard]] const fit::DrawnScenes* draws() const { return draws_ ? &*draws_ : nullptr; }
  /// What was read. Precondition: read().
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::vector<std::string>& set() const { return set_.words(); }
  [[nodiscard]] SceneChanges changes() const { return set_.changes(); }

 private:
  std::string file_, text_;
  SceneChangesOption set_;
  std::optional<fit::DrawnScenes> draws_;
};

}  // namespace shearfront::tools
