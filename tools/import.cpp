// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

struct ImportArguments {
  std::string file, scene, columns, units, separator, decimal, missing, layout, replicates, width, time_step,
      output;
};

/// "t=time [s],phi=conc": what each column is given; `set` takes it.
template <class Set>
void read_pairs(std::string_view option, const std::string& text, Set&& set) {
  if (text.empty()) return;
  const std::vector<std::string> names(kColumnNames.begin(), kColumnNames.end());
  for (const std::string_view item : split(text, ',')) {
    const std::size_t sign = item.find('=');
    if (sign == std::string_view::npos || sign + 1 == item.size())
      refuse(option, text, "must be a list such as t=time,z=height,phi=conc");
    set(choice_option(option, item.substr(0, sign), names), std::string(item.substr(sign + 1)));
  }
}

ObservationFormat format_of(const ImportArguments& arguments) {
  ObservationFormat format;
  read_pairs("--columns", arguments.columns,
             [&](std::size_t c, std::string name) { format.columns[c].name = std::move(name); });
  read_pairs("--units", arguments.units,
             [&](std::size_t c, std::string unit) { format.columns[c].unit = std::move(unit); });
  if (!arguments.separator.empty())
    format.separator = ",;\t"[choice_option("--separator", arguments.separator, {",", ";", "tab"})];
  if (!arguments.decimal.empty())
    format.decimal = ".,"[choice_option("--decimal", arguments.decimal, {".", ","})];
  if (!arguments.missing.empty())
    for (const std::string_view word : split(arguments.missing, ',')) format.missing.emplace_back(word);
  if (!arguments.layout.empty())
    format.layout = static_cast<TableLayout>(
        choice_option("--layout", arguments.layout, {kTableLayoutNames.begin(), kTableLayoutNames.end()}));
  if (!arguments.width.empty())
    format.width = number_option("--width", arguments.width, {0, HUGE_VAL, true}, "> 0");
  if (!arguments.time_step.empty())
    format.time_step = number_option("--time-step", arguments.time_step, {0, HUGE_VAL, true}, "> 0");
  if (!arguments.replicates.empty())
    format.replicates = static_cast<Replicates>(choice_option(
        "--replicates", arguments.replicates, {kReplicatesNames.begin(), kReplicatesNames.end()}));
  return format;
}

int import_file(const ImportArguments& arguments) {
  const ObservationFormat format = format_of(arguments);
  for (const std::string& input : {arguments.file, arguments.scene})
    if (!input.empty()) check_outputs(input, {{arguments.output.empty() ? "" : "-o", arguments.output}});
  std::optional<Scene<double>> scene;
  if (!arguments.scene.empty()) scene = with_remarks(read_scene<double>(arguments.scene));
  Observations data = scene ? read_observations(arguments.file, *scene, format)
                            : read_observations(arguments.file, -HUGE_VAL, HUGE_VAL, format);
  OutputFile output(arguments.output.empty() ? "-" : arguments.output);
  // The line on what was understood is among the notes if there is anything to it.
  if (std::find(data.notes.begin(), data.notes.end(), data.understood) == data.notes.end())
    fmt::print(stderr, "{}\n", data.understood);
  print_remarks(data.notes);
  data.comments.insert(data.comments.begin(), "shearfront import: " + data.understood);
  write_observations(output, data);
  output.commit();
  return kDone;
}

}  // namespace

Command add_import(CLI::App& program) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* app = program.add_subcommand("import", "A laboratory's file of measurements as observations");
  app->add_option("FILE", arguments->file, "text with separated columns; - for standard input")
      ->type_name("")
      ->required();
  app->add_option("--scene", arguments->scene, "the scene they belong to: its domain, states and units")
      ->type_name("SCENE");
  app->add_option(
         "--columns", arguments->columns,
         fmt::format("names of columns: t=time,z=height,phi=conc; of {}", fmt::join(kColumnNames, ", ")))
      ->type_name("LIST");
  app->add_option("--units", arguments->units,
                  "units of columns, before those of the header: z=mm,phi=percent")
      ->type_name("LIST");
  app->add_option("--separator", arguments->separator, "between columns; default as found")
      ->type_name(",|;|tab");
  app->add_option("--decimal", arguments->decimal, "mark of decimals; default as found")->type_name(".|,");
  app->add_option("--missing", arguments->missing, "further words for a missing value")->type_name("LIST");
  app->add_option("--layout", arguments->layout,
                  "a row per observation, or a wide table with a column per height or time; default as found")
      ->type_name(fmt::format("{}", fmt::join(kTableLayoutNames, "|")));
  app->add_option("--replicates", arguments->replicates,
                  "several values at one place; mean gives their spread as sigma; default refuse")
      ->type_name(fmt::format("{}", fmt::join(kReplicatesNames, "|")));
  app->add_option("--width", arguments->width, "of the bins that phi is a mean over, in the unit of z")
      ->type_name("W");
  app->add_option("--time-step", arguments->time_step, "of a particle simulation whose file counts steps")
      ->type_name("DT");
  app->add_option("-o", arguments->output, "observations, CSV; default standard output")->type_name("FILE");
  return {app, "FILE", [arguments] { return import_file(*arguments); }};
}

}  // namespace shearfront::tools
