// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>
#include <variant>

#include "cli/command.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

std::string counted(std::size_t n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string layers_text(const Scene<double>& scene) {
  if (!scene.is_layered()) return "smooth shear rate";
  const auto n = std::visit([](const auto& a) { return a.knots().size(); }, scene.shear_rate());
  return counted(n + 1, "layer");
}

int check(const std::vector<std::string>& files) {
  OutputFile out("-");
  bool all_good = true;
  for (const std::string& file : files) {
    try {
      const auto scene = read_scene<double>(file);
      out.write(fmt::format("{}: ok: {}, {}, {}, mass {}\n", printable(file), quoted_text(scene.name(), 80),
                            layers_text(scene), counted(scene.initial_breaks().size(), "jump"),
                            number_text(scene.mass())));
    } catch (const FileError& error) {
      fmt::print(stderr, "{}\n", error.what());
      all_good = false;
    }
  }
  out.commit();
  return all_good ? kDone : kBadInput;
}

}  // namespace

Command add_check(CLI::App& program) {
  const auto files = std::make_shared<std::vector<std::string>>();
  CLI::App* app = program.add_subcommand("check", "Validate scene files and report every problem");
  app->add_option("FILE", *files, "scene files")->type_name("")->required();
  return {app, "FILE...", [files] { return check(*files); }};
}

}  // namespace shearfront::tools
