// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

namespace shearfront::tools {

/// A picture drawn by the program gnuplot: collects a script with its data, runs it, and writes the picture
/// complete or not at all. The ending of the file name (.svg, .png, .pdf) chooses the format.
class Gnuplot {
 public:
  /// Size in points of 1/72 inch at which a font of 12 points looks right; a PNG has twice as many pixels.
  Gnuplot(std::string path, int width, int height);

  /// Adds a line of script.
  void add(std::string_view line);
  /// Adds an inline data block that plots refer to as $name; `rows` are lines of numbers, each with its
  /// newline.
  void add_data(std::string_view name, std::string_view rows);
  /// Runs gnuplot. Returns an exit code: without gnuplot one line on standard error and kDone.
  /// Errors: FileError if the picture cannot be written.
  [[nodiscard]] int draw() const;

  /// A text as a gnuplot string, in quotes.
  [[nodiscard]] static std::string text(std::string_view s);

 private:
  std::string path_, script_;
};

}  // namespace shearfront::tools
