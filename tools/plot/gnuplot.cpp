// SPDX-License-Identifier: BSD-3-Clause
#include "plot/gnuplot.hpp"

#include <fmt/format.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "plot/pictures.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kCommandNotFound = 127;  // exit code of the shell

/// A new directory for the script, removed with everything in it at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "shearfront-XXXXXX").string();
    if (mkdtemp(pattern.data())) path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] std::string file(std::string_view name) const { return path_ + "/" + std::string(name); }
  [[nodiscard]] bool exists() const { return !path_.empty(); }

 private:
  std::string path_;
};

/// A word of a shell command.
std::string shell_word(std::string_view s) {
  std::string word = "'";
  for (const char c : s) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string ending_of(const std::string& path) { return fs::path(path).extension().string(); }

std::string terminal(const std::string& ending, int width, int height) {
  if (ending == ".png")
    return fmt::format(
        "set terminal pngcairo enhanced size {},{} font 'Sans,12' fontscale 1.8 linewidth 2 pointscale 2",
        2 * width, 2 * height);
  if (ending == ".pdf")
    return fmt::format("set terminal pdfcairo enhanced size {:.3f}in,{:.3f}in font 'Sans,11' linewidth 1.3",
                       width / 72.0, height / 72.0);
  return fmt::format("set terminal svg enhanced size {},{} font 'sans-serif,11' background rgb 'white'",
                     width, height);
}

/// gnuplot's SVG leaves blanks between words of different fonts to the viewer, and viewers drop them.
void keep_blanks(std::string& svg) {
  constexpr std::string_view kText = "<text>", kKeeping = "<text xml:space=\"preserve\">";
  for (std::size_t i = svg.find(kText); i != std::string::npos; i = svg.find(kText, i + kKeeping.size()))
    svg.replace(i, kText.size(), kKeeping);
}

}  // namespace

void check_picture_name(std::string_view option, const std::string& path) {
  const std::string ending = ending_of(path);
  if (!path.empty() && ending != ".svg" && ending != ".png" && ending != ".pdf")
    refuse(option, path, "must end in .svg, .png or .pdf");
}

void check_picture_target(const std::string& path) {
  if (!path.empty()) OutputFile{path};
}

Gnuplot::Gnuplot(std::string path, int width, int height) : path_(std::move(path)) {
  add("set encoding utf8");
  add(terminal(ending_of(path_), width, height));
}

void Gnuplot::add(std::string_view line) { (script_ += line) += '\n'; }

void Gnuplot::add_data(std::string_view name, std::string_view rows) {
  script_ += fmt::format("${} << END_OF_DATA\n{}END_OF_DATA\n", name, rows);
}

std::string Gnuplot::text(std::string_view s) {
  std::string quoted = "'";
  for (const char c : printable(s, 120)) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

int Gnuplot::draw() const {
  const ScratchFolder folder;
  if (!folder.exists()) {
    note("no picture: no folder for temporary files");
    return kNoResult;
  }
  std::ofstream(folder.file("script")) << script_;
  const std::string command =
      fmt::format("gnuplot {} 2>{}", shell_word(folder.file("script")), shell_word(folder.file("errors")));
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string picture;
  std::array<char, 1 << 16> block;
  while (pipe) {
    const std::size_t n = std::fread(block.data(), 1, block.size(), pipe);
    if (n == 0) break;
    picture.append(block.data(), n);
  }
  const int status = pipe ? pclose(pipe) : -1;
  if (pipe && WIFEXITED(status) && WEXITSTATUS(status) == kCommandNotFound) {
    note(fmt::format("no picture {}: gnuplot is not installed", printable(path_)));
    return kDone;
  }
  if (status != 0 || picture.empty()) {
    std::string reason((std::istreambuf_iterator<char>(std::ifstream(folder.file("errors")).rdbuf())), {});
    note(fmt::format("no picture {}: gnuplot failed: {}", printable(path_), printable(reason)));
    return kNoResult;
  }
  if (ending_of(path_) == ".svg") keep_blanks(picture);
  OutputFile file(path_);
  file.write(picture);
  file.commit();
  return kDone;
}

}  // namespace shearfront::tools
