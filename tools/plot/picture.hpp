// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/output_file.hpp"

namespace CLI {
class App;
}

namespace shearfront::tools {

/// --size and --dpi: of all pictures of the run.
class PictureOptions {
 public:
  void add_to(CLI::App& app);
  /// Errors: InputError for what is no size.
  void apply() const;

 private:
  std::string size_, dpi_;
};

/// Whether pictures are as wide as a column of a page.
[[nodiscard]] bool picture_is_narrow();

/// Refuses a picture whose name does not end in .svg, .png or .pdf. An empty name is no picture.
void check_picture_name(std::string_view option, const std::string& path);
/// Refuses a picture that cannot be written. Errors: FileError.
void check_picture_target(const std::string& path);

/// A picture that gnuplot draws by a template, KIND.gp in the folder plot beside this file (installed in
/// share/shearfront/plot; the environment variable SHEARFRONT_PLOT_FOLDER names another one). A template says
/// at its top which CSV files it reads and which variables it takes; both go into a folder that lives as long
/// as this object. The picture is written complete or not at all.
class Picture {
 public:
  Picture(std::string path, std::string_view kind);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  void set(std::string_view variable, std::string_view text);
  void set(std::string_view variable, const char* text) { set(variable, std::string_view(text)); }
  void set(std::string_view variable, double number);
  void set(std::string_view variable, bool holds);
  /// Numbers as words of a text.
  void set(std::string_view variable, const std::vector<double>& numbers);

  /// A file for the template: `write` gets it as an OutputFile.
  template <class Write>
  void add_file(std::string_view name, Write&& write) const {
    OutputFile file(folder_ + "/" + std::string(name));
    write(file);
    file.commit();
  }

  /// Runs gnuplot. Returns an exit code: without gnuplot one line on standard error and kDone.
  /// Errors: FileError if the picture cannot be written.
  [[nodiscard]] int draw() const;

 private:
  std::string path_, kind_, folder_, variables_;
};

/// A text in which gnuplot finds no markup.
[[nodiscard]] std::string without_markup(std::string_view text);

}  // namespace shearfront::tools
