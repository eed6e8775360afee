// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/summary.hpp"
#include "shearfront/solver/method.hpp"

namespace CLI {
class App;
}

namespace shearfront::tools {

inline constexpr int kDone = 0;
inline constexpr int kNoResult = 1;
inline constexpr int kBadInput = 2;

/// A subcommand of the program: its options, and what to do once they are parsed. run() returns the exit code
/// and throws InputError for bad input.
struct Command {
  CLI::App* app = nullptr;
  std::string_view argument;  ///< what the command works on, for its usage; empty if nothing
  std::function<int()> run;

  [[nodiscard]] std::string usage() const;
};

[[nodiscard]] Command add_events(CLI::App& program);
[[nodiscard]] Command add_solve(CLI::App& program);
[[nodiscard]] Command add_observe(CLI::App& program);
[[nodiscard]] Command add_fit(CLI::App& program);
[[nodiscard]] Command add_compare(CLI::App& program);
[[nodiscard]] Command add_check(CLI::App& program);
[[nodiscard]] Command add_import(CLI::App& program);
[[nodiscard]] Command add_study(CLI::App& program);
[[nodiscard]] Command add_design(CLI::App& program);
[[nodiscard]] Command add_sample(CLI::App& program);
[[nodiscard]] Command add_list(CLI::App& program);

/// Refuses two outputs to the same place and an output over the input. Empty names are outputs not asked for.
struct Output {
  std::string_view option, path;
};
void check_outputs(const std::string& input, const std::vector<Output>& outputs);

/// Says on standard error why there is no result.
int report_unusable(const Summary& summary);
/// A remark on standard error.
void note(std::string_view text);
/// The remark of a usable result, if there is one, on standard error.
void note_remark(const Summary& summary);
/// What stands for the scene where an exact method is not exact, and how far it may be off.
void note_approximation(const Method& method, const Summary& summary);
/// What readers have to say about their files, on standard error.
void print_remarks(const std::vector<std::string>& remarks);
/// The scene as it is, its remarks printed.
[[nodiscard]] Scene<double> with_remarks(Scene<double> scene);

}  // namespace shearfront::tools
