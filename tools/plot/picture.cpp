// SPDX-License-Identifier: BSD-3-Clause
#include "plot/picture.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp
#include <sys/wait.h>
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <thread>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

namespace fs = std::filesystem;

/// Text between single quotes, for gnuplot ('') or a shell ('\'').
std::string quoted(std::string_view text, std::string_view quote) {
  std::string all = "'";
  for (const char c : text) all += c == '\'' ? std::string(quote) : std::string(1, c);
  return all + "'";
}

std::string ending_of(const std::string& path) { return fs::path(path).extension().string(); }

/// The same place relative to the program in the build tree and where it is installed.
fs::path template_folder() {
  if (const char* folder = std::getenv("SHEARFRONT_PLOT_FOLDER"); folder && *folder)
    return fs::absolute(folder);
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "share/shearfront/plot";
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// gnuplot's SVG leaves blanks between words of different fonts to the viewer, and viewers drop them.
void keep_blanks(std::string& svg) {
  constexpr std::string_view kText = "<text>", kKeeping = "<text xml:space=\"preserve\">";
  for (std::size_t i = svg.find(kText); i != std::string::npos; i = svg.find(kText, i + kKeeping.size()))
    svg.replace(i, kText.size(), kKeeping);
}

/// What the templates are told about the size; of the one run this program makes.
std::string size_settings;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
bool is_narrow = false;     // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// The status of a line of the shell as waitpid() gives it; nothing if Ctrl-C ended it. system() would not let Ctrl-C through.
std::optional<int> status_of_shell(std::string line) {
  constexpr std::chrono::milliseconds kBetweenLooks{2};
  constexpr int kNotStarted = 127 << 8;
  const InterruptGuard guard;
  std::string shell = "sh", option = "-c";
  const std::array<char*, 4> words{shell.data(), option.data(), line.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, "sh", nullptr, nullptr, words.data(), environ) != 0) return kNotStarted;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (InterruptGuard::is_interrupted()) (void)kill(child, SIGKILL);
    std::this_thread::sleep_for(kBetweenLooks);
  }
  if (InterruptGuard::is_interrupted()) return std::nullopt;
  return status;
}

/// What a template printed about itself.
void repeat_remarks(const std::string& errors) {
  constexpr std::string_view kMark = "shearfront: ";
  for (const std::string_view line : split(errors, '\n'))
    if (line.starts_with(kMark)) note(printable(line.substr(kMark.size())));
}

}  // namespace

void PictureOptions::add_to(CLI::App& app) {
  app.add_option("--size", size_, "width of pictures in cm, or WIDTHxHEIGHT: 9, 18x12")->type_name("CM");
  app.add_option("--dpi", dpi_, "pixels per inch of a .png, default 144")->type_name("N");
}

bool picture_is_narrow() { return is_narrow; }

void PictureOptions::apply() const {
  constexpr Bounds kCentimetres{2, 200}, kDots{20, 2400};
  constexpr double kColumn = 13;  // in cm; as in the templates
  size_settings.clear();
  if (!size_.empty()) {
    const auto parts = split(size_, 'x');
    if (parts.size() > 2) refuse("--size", size_, "must be a width in cm, or WIDTHxHEIGHT");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double size = number_option("--size", parts[i], kCentimetres, "from 2 to 200");
      size_settings += fmt::format("{} = real('{}')\n", i == 0 ? "width_cm" : "height_cm", number_text(size));
      if (i == 0) is_narrow = size < kColumn;
    }
  }
  if (!dpi_.empty())
    size_settings +=
        fmt::format("dpi = {}\n", number_text(number_option("--dpi", dpi_, kDots, "from 20 to 2400")));
}

void check_picture_name(std::string_view option, const std::string& path) {
  const std::string ending = ending_of(path);
  if (!path.empty() && ending != ".svg" && ending != ".png" && ending != ".pdf")
    refuse(option, path, "must end in .svg, .png or .pdf");
}

void check_picture_target(const std::string& path) {
  if (!path.empty()) OutputFile{path};
}

Picture::Picture(std::string path, std::string_view kind) : path_(std::move(path)), kind_(kind) {
  std::error_code error;
  folder_ = (fs::temp_directory_path(error) / "shearfront-XXXXXX").string();
  if (error || !mkdtemp(folder_.data()))
    throw InputError("TMPDIR", "", "must name a folder in which temporary files can be made");
  set("picture", "picture" + ending_of(path_));
}

Picture::~Picture() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Picture::set(std::string_view variable, std::string_view text) {
  variables_ += fmt::format("{} = {}\n", variable, quoted(printable(text, 10'000'000), "''"));
}

void Picture::set(std::string_view variable, double number) {
  // "2" would be an integer for gnuplot, and 2 / 4 = 0.
  variables_ += fmt::format("{} = real('{}')\n", variable, number_text(number));
}

void Picture::set(std::string_view variable, bool holds) {
  variables_ += fmt::format("{} = {:d}\n", variable, holds);
}

void Picture::set(std::string_view variable, const std::vector<double>& numbers) {
  std::string words;
  for (const double x : numbers) words += (words.empty() ? "" : " ") + number_text(x);
  set(variable, words);
}

int Picture::draw() const {
  const fs::path templates = template_folder();
  if (!fs::exists(templates / (kind_ + ".gp"))) {
    note(fmt::format("no picture {}: {}.gp not found in {} (SHEARFRONT_PLOT_FOLDER names another folder)",
                     printable(path_), kind_, printable(templates.string())));
    return kNoResult;
  }
  add_file("run.gp", [&](OutputFile& file) {
    file.write(size_settings + variables_);
    file.write(fmt::format("set loadpath {}\nload '{}.gp'\n", quoted(templates.string(), "''"), kind_));
  });
  const std::string command =
      fmt::format("cd {} && exec gnuplot run.gp >output 2>errors", quoted(folder_, "'\\''"));
  constexpr int kCommandNotFound = 127;  // exit code of the shell
  const std::optional<int> drawn = status_of_shell(command);
  if (!drawn) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    (void)std::raise(SIGINT);
    return kNoResult;
  }
  const int status = *drawn;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kCommandNotFound) {
    note(fmt::format("no picture {}: gnuplot is not installed", printable(path_)));
    return kDone;
  }
  std::string picture = content(folder_ + "/picture" + ending_of(path_));
  if (status != 0 || picture.empty()) {
    const std::string errors = content(folder_ + "/errors");  // after any number of warnings
    constexpr std::size_t kLongest = 150;
    note(fmt::format("no picture {}: gnuplot failed: {}", printable(path_),
                     printable(errors.substr(errors.size() - std::min(errors.size(), kLongest)))));
    return kNoResult;
  }
  repeat_remarks(content(folder_ + "/errors"));
  if (ending_of(path_) == ".svg") keep_blanks(picture);
  OutputFile file(path_);
  file.write(picture);
  file.commit();
  return kDone;
}

std::string without_markup(std::string_view text) {
  std::string marked;
  for (const char c : printable(text, 30)) {
    if (std::string_view("{}^_@&~\\").find(c) != std::string_view::npos) marked += '\\';
    marked += c;
  }
  return marked;
}

}  // namespace shearfront::tools
