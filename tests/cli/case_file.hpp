// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

/// Case files of the command line: text that gives arguments, files, and what must come out.
///
///     === name-of-the-case            a file holds any number of cases
///     --- file scene.toml             content of an input file, one final newline; {datasets} is replaced
///     --- file scene.toml = NAME      the content of fixtures/NAME, beside the file of cases
///     --- raw-file scene.toml         as file, with escapes \n \r \xNN and no final newline
///     --- directory d                 an empty directory
///     --- args                        arguments, separated by blanks; "..." keeps blanks; {datasets} is replaced
///     --- env NAME=VALUE              an environment variable
///     --- stdin-from PATH             what comes in through standard input, default nothing
///     --- stdout-to PATH              where standard output goes instead of being checked
///     --- exit                        exit code, default 0
///     --- stdout   --- stderr         exact text; default: empty
///     --- stdout-match, stderr-match  regular expressions that match one line each, in this order
///     --- expect-file F               exact content of an output file; expect-file-match F by lines
///     --- absent F                    this file must not exist (name ending in * for a prefix)
///     --- json                        lines `/pointer value [relative tolerance]` about standard output
///
/// Lines before the first case and before the first section of a case are comments.
namespace shearfront::cli_tests {

struct Section {
  std::string kind, argument, text;
};

struct Case {
  std::string name;
  std::vector<Section> sections;

  /// The text of the only section of this kind; nothing if there is none.
  [[nodiscard]] std::optional<std::string> text(const std::string& kind) const;
};

/// Errors: std::runtime_error that names file and line for a section or a fixture that does not exist.
[[nodiscard]] std::vector<Case> read_cases(const std::string& path);

[[nodiscard]] std::vector<std::string> split_arguments(const std::string& text);
[[nodiscard]] std::string unescaped(const std::string& text);
[[nodiscard]] std::string replaced(std::string text, const std::string& from, const std::string& to);
[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

}  // namespace shearfront::cli_tests
