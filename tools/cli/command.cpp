// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>

#include "cli/arguments.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

namespace fs = std::filesystem;

bool is_same_file(std::string_view a, std::string_view b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return fs::is_regular_file(a, error);
  return fs::weakly_canonical(fs::absolute(a, error), error) ==
         fs::weakly_canonical(fs::absolute(b, error), error);
}

bool is_same_output(std::string_view a, std::string_view b) {
  if (a == "-" || b == "-") return a == b;
  return is_same_file(a, b);
}

}  // namespace

std::string Command::usage() const {
  return app->get_name() + (argument.empty() ? "" : " " + std::string(argument)) + " [options]";
}

void check_outputs(const std::string& input, const std::vector<Output>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].path.empty()) continue;
    if (input != "-" && is_same_file(input, outputs[i].path))  // "-" comes in and goes out by different doors
      refuse(outputs[i].option, outputs[i].path, "must not be the input file");
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[j].path.empty() && is_same_output(outputs[i].path, outputs[j].path))
        refuse(
            outputs[i].option, outputs[i].path,
            fmt::format("must differ from {}",
                        outputs[j].option.empty() ? "standard output, which is taken" : outputs[j].option));
  }
}

int report_unusable(const Summary& summary) {
  fmt::print(stderr, "shearfront: no result ({}): {}\n", name_of(summary.status), printable(summary.message));
  return kNoResult;
}

void note(std::string_view text) { fmt::print(stderr, "shearfront: {}\n", text); }

void note_remark(const Summary& summary) {
  if (!summary.remark.empty()) note(summary.remark);
}

void note_approximation(const Method& method, const Summary& summary) {
  if (method.guarantees().exact && summary.message.starts_with("exact for ")) note(summary.message);
}

void print_remarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) fmt::print(stderr, "{}\n", remark);
}

Scene<double> with_remarks(Scene<double> scene) {
  print_remarks(scene.spec().remarks);
  return scene;
}

}  // namespace shearfront::tools
