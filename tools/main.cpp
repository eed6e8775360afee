// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/text.hpp"

namespace {

using namespace shearfront;
using tools::Command;

std::vector<std::string> names_of(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const Command& command : commands) names.push_back(command.app->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

void print(const std::string& text) {
  OutputFile out("-");
  out.write(text);
  out.commit();
}

[[noreturn]] void refuse_unknown(std::string_view kind, const std::string& name,
                                 const std::vector<std::string>& known) {
  std::string constraint = fmt::format("unknown {}; must be one of: {}", kind, fmt::join(known, ", "));
  if (const auto meant = nearest_name(name, known)) constraint += fmt::format(" (did you mean {}?)", *meant);
  throw InputError(printable(name, 60), "", constraint);
}

/// What CLI11 could not place: unknown options first, then surplus arguments.
void check_leftovers(const CLI::App& app, const std::vector<std::string>& known) {
  const auto left = app.remaining();
  const auto option = std::find_if(left.begin(), left.end(),
                                   [](const std::string& s) { return s.size() > 1 && s[0] == '-'; });
  if (option != left.end()) refuse_unknown("option", option->substr(0, option->find('=')), option_names(app));
  if (left.empty()) return;
  if (!known.empty()) refuse_unknown("command", left.front(), known);
  throw InputError(quoted_text(left.front()), "",
                   "unexpected argument; " + app.get_name() + " takes no more");
}

/// CLI11's own message in the form of ours.
std::string reshaped(const CLI::ParseError& error, const std::vector<Command>& commands) {
  std::string text = printable(error.what());
  const std::string name = text.substr(0, text.find(':'));
  if (error.get_name() == "RequiredError") {
    for (const Command& command : commands)
      if (command.app->parsed())
        return fmt::format("{}: missing; usage: shearfront {}", command.argument, command.usage());
  }
  if (error.get_name() == "ConversionError") {  // only flags are converted by CLI11
    const std::size_t begin = text.find("--"), end = text.find(' ', begin);
    return text.substr(begin, end - begin) + ": takes no value";
  }
  if (error.get_name() != "ArgumentMismatch") return text;
  const bool is_twice =
      text.find("At Most") != std::string::npos || text.find("At most") != std::string::npos;
  return name + (is_twice ? ": must not be given more than once" : ": needs a value");
}

int run(int argc, char** argv) {
  CLI::App program("Mixing and segregation of sheared granular beds: exact solution and front tracking.");
  program.name("shearfront");
  program.set_version_flag("--version", "shearfront " SHEARFRONT_VERSION, "Print the version and exit");
  program.require_subcommand(0, 1);
  program.allow_extras();
  const std::vector<Command> commands{
      tools::add_events(program), tools::add_solve(program),   tools::add_observe(program),
      tools::add_fit(program),    tools::add_compare(program), tools::add_check(program),
      tools::add_list(program),   tools::add_import(program),  tools::add_study(program),
      tools::add_design(program), tools::add_sample(program)};
  std::string verbose;
  for (const Command& command : commands) {
    command.app->add_flag("--verbose{60}", verbose,
                          "a line per minute on standard error where it is no terminal; --verbose=S: every S "
                          "seconds");
    command.app->allow_extras();
    command.app->get_formatter()->label("REQUIRED", "");
  }
  program.footer(
      "Results go to standard output, messages to standard error. Exit code: 0 done, 1 no usable\n"
      "result, 2 usage or input error. `shearfront COMMAND --help` explains a command.");
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(program.help());
    return tools::kDone;
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + "\n");
    return tools::kDone;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "{}\n", reshaped(error, commands));
    return tools::kBadInput;
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    check_leftovers(*command.app, {});
    if (!verbose.empty())
      tools::ProgressLine::set_verbose(
          tools::number_option("--verbose", verbose, {0.1, 86400}, "a number of seconds from 0.1 to 86400"));
    tools::say_when_interrupted();
    return command.run();
  }
  check_leftovers(program, names_of(commands));
  throw InputError("COMMAND", "",
                   fmt::format("missing; must be one of: {}", fmt::join(names_of(commands), ", ")));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return tools::kBadInput;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "shearfront: no result: not enough memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "shearfront: no result, a bug of shearfront: {}\n", error.what());
  }
  return tools::kNoResult;
}
