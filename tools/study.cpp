// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/fit_text.hpp"
#include "cli/progress.hpp"
#include "cli/scene_changes.hpp"
#include "shearfront/fit/study/sobol_indices.hpp"
#include "shearfront/fit/study/study_runs.hpp"
#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/output_file.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
namespace {

constexpr unsigned long long kMostShards = 1'000'000, kMostThreads = 1024;

struct StudyArguments {
  SceneChangesOption set;
  std::vector<std::string> files;
  std::string output, shard, threads, indices;
  bool resume = false, merge = false;
};

/// Run k of n, counted from 1: every n-th run from the k-th on.
struct Shard {
  std::size_t k = 1, n = 1;
};

Shard shard_of(const std::string& text) {
  if (text.empty()) return {};
  const auto parts = split(text, '/');
  const auto k = parts.size() == 2 ? parse_count(parts[0]) : std::nullopt;
  const auto n = parts.size() == 2 ? parse_count(parts[1]) : std::nullopt;
  if (!k || !n || *k < 1 || *n < 1 || *k > *n || *n > kMostShards)
    refuse("--shard", text, "must be k/n with 1 <= k <= n, such as 3/20");
  return {static_cast<std::size_t>(*k), static_cast<std::size_t>(*n)};
}

std::string unit_of_output(const fit::StudyOutput& output, const fit::StudySpec& spec) {
  using Kind = fit::StudyOutput::Kind;
  if (!spec.scene) return {};
  const SceneUnits& units = spec.scene->spec().units;
  switch (output.kind) {
    case Kind::t0:
    case Kind::t1:
    case Kind::t_star:
    case Kind::first:
    case Kind::last:
      return units.t;
    case Kind::M:
    case Kind::height:
      return units.z;
    default:
      return {};
  }
}

/// What makes the result, in comments: version, study and scene, seed; then the header. The same for the same study.
std::string head_of(const fit::StudyRuns& runs, const std::string& study_text, const Shard& shard) {
  const fit::StudySpec& spec = runs.spec();
  std::string head =
      fmt::format("# shearfront study {}: {} runs, seed {}\n", SHEARFRONT_VERSION, runs.size(), spec.seed);
  const auto quote = [&](std::string_view title, const std::string& text) {
    head += fmt::format("# {}:\n", title);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      head += end > begin ? "# | " + text.substr(begin, end - begin) + "\n" : "# |\n";
      begin = end + 1;
    }
  };
  quote("The study", study_text);
  quote(spec.fit_file ? "The fit" : "The scene", spec.scene_text);
  if (shard.n > 1) head += fmt::format("# shard {}/{}\n", shard.k, shard.n);
  head += "run";
  for (const std::string& name : runs.entries()) head += "," + detail::csv_field(name);
  for (const fit::StudyOutput& output : spec.outputs)
    head += "," + detail::csv_field(detail::heading_text(output.name, unit_of_output(output, spec)));
  return head + ",status\n";
}

/// An event that never comes is "never", a result that is missing empty.
std::string line_of(const fit::StudyRow& row) {
  std::string line = std::to_string(row.run);
  for (const double x : row.values) (line += ',') += number_text(x);
  for (const double x : row.outputs)
    (line += ',') += std::isinf(x) ? "never" : std::isnan(x) ? "" : number_text(x);
  return line + "," + (row.failure.empty() ? "ok" : detail::csv_field(printable(row.failure))) + "\n";
}

std::vector<std::size_t> runs_of(const Shard& shard, std::size_t n) {
  std::vector<std::size_t> which;
  for (std::size_t i = shard.k - 1; i < n; i += shard.n) which.push_back(i);
  return which;
}

/// A file that grows by whole lines; after a crash its last line may be cut off.
class GrowingFile {
 public:
  /// Opens a new file with this head, or, to resume, one that begins with it: the lines that are complete are counted and
  /// what follows them is cut off. Errors: FileError, InputError if the file is that of another study, or is there and not
  /// to be resumed: hours of work may be in it.
  GrowingFile(const std::string& path, const std::string& head, bool resume) : path_(path) {
    const bool is_there = std::filesystem::is_regular_file(path) && std::filesystem::file_size(path) > 0;
    if (is_there && !resume)
      throw InputError(
          "-o", quoted_text(path),
          "is there already: --resume goes on with it; another name or no such file begins anew");
    if (is_there) {
      const std::string text = detail::TextSource::read(path).text();
      const std::size_t complete = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
      const bool is_whole_head = complete >= head.size();
      if (text.compare(0, std::min(complete, head.size()), head, 0, std::min(complete, head.size())) != 0)
        throw InputError("-o", quoted_text(path),
                         "must be a result of this study to be resumed: it begins otherwise");
      if (is_whole_head) {
        n_done_ =
            static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(head.size()),
                                                text.begin() + static_cast<std::ptrdiff_t>(complete), '\n'));
        std::filesystem::resize_file(path, complete);
        file_.reset(std::fopen(path.c_str(), "ab"));
        if (!file_) fail();
        return;
      }
    }
    file_.reset(std::fopen(path.c_str(), "wb"));
    if (!file_) fail();
    write(head);
  }
  void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
  }
  void flush() {
    if (std::fflush(file_.get()) != 0) fail();
  }
  [[nodiscard]] std::size_t n_done() const { return n_done_; }

 private:
  [[noreturn]] void fail() const {
    detail::throw_file_error(path_, "cannot be written: " + std::generic_category().message(errno));
  }
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::size_t n_done_ = 0;
};

void write_indices(const std::string& path, const std::vector<fit::SobolIndex>& indices) {
  OutputFile file(path);
  file.write("output,entry,first,first_lower,first_upper,total,total_lower,total_upper\n");
  for (const fit::SobolIndex& s : indices)
    file.write(detail::csv_field(s.output) + "," + detail::csv_field(s.entry) + "," +
               csv_row({s.first, s.first95.low, s.first95.high, s.total, s.total95.low, s.total95.high}));
  file.commit();
}

int run_study(const StudyArguments& arguments) {
  if (arguments.files.size() != 1)
    refuse("STUDY", arguments.files[1], "must be one study file; several need --merge");
  if (arguments.resume && arguments.output.empty())
    throw InputError("--resume", "", "needs -o, the file that is to go on");
  const Shard shard = shard_of(arguments.shard);
  const std::size_t threads =
      arguments.threads.empty() ? 0 : count_option("--threads", arguments.threads, 0, kMostThreads);
  check_outputs(arguments.files[0], {{"-o", arguments.output}, {"--indices", arguments.indices}});
  const std::string study_text = detail::TextSource::read(arguments.files[0]).text();
  fit::StudySpec spec = fit::read_study(arguments.files[0], arguments.set.changes());
  const bool has_indices = spec.design == fit::DesignKind::indices;
  if (!arguments.indices.empty() && (!has_indices || shard.n > 1))
    refuse("--indices", arguments.indices, "needs a whole study with design.kind = \"sobol-indices\"");
  if (!spec.fit_file) print_remarks(spec.scene->spec().remarks);
  const fit::StudyRuns runs(std::move(spec));
  const std::string head = head_of(runs, study_text, shard);
  std::vector<std::size_t> which = runs_of(shard, runs.size());
  const std::size_t n_all = which.size();

  std::optional<GrowingFile> file;
  OutputFile standard("-");
  const bool to_file = !arguments.output.empty() && arguments.output != "-";
  if (to_file) file.emplace(arguments.output, head, arguments.resume);
  const std::size_t n_done = std::min(to_file ? file->n_done() : 0, n_all);
  if (n_done > 0) note(fmt::format("resumed after {} of {} runs", n_done, n_all));
  if (!to_file) standard.write(head);
  if (has_indices && n_done > 0 && !arguments.indices.empty())
    refuse("--indices", arguments.indices, "needs a study that is not resumed");
  which.erase(which.begin(), which.begin() + static_cast<std::ptrdiff_t>(n_done));

  const InterruptGuard guard;
  ProgressLine progress;
  std::size_t n = n_done, n_failed = 0;
  std::vector<std::vector<double>> outputs;
  runs.run_all(
      which, threads,
      [&](const fit::StudyRow& row) {
        to_file ? file->write(line_of(row)) : standard.write(line_of(row));
        n_failed += row.failure.empty() ? 0 : 1;
        if (!arguments.indices.empty()) outputs.push_back(row.outputs);
        ++n;
        if (to_file && n % 64 == 0) file->flush();
        progress.show_part(n, n_all);
      },
      [] { return !InterruptGuard::is_interrupted(); });
  if (to_file)
    file->flush();
  else
    standard.commit();
  if (n_failed > 0)
    note(fmt::format("{} of {} runs have no result; the column status says why", n_failed, n_all - n_done));
  if (n < n_all) {
    note(fmt::format("interrupted after {} of {} runs{}", n, n_all, to_file ? "; --resume goes on" : ""));
    return kNoResult;
  }
  if (!arguments.indices.empty()) {
    std::vector<std::string> names;
    for (const fit::StudyOutput& output : runs.spec().outputs) names.push_back(output.name);
    write_indices(arguments.indices, fit::sobol_indices(outputs, names, runs.entries(), runs.spec().seed));
  }
  return kDone;
}

/// A shard as it was written: its head without the line that says which it is, and its rows by run.
struct ShardFile {
  std::string head;
  std::vector<std::pair<std::size_t, std::string>> rows;
};

ShardFile read_shard(const std::string& path) {
  const std::string text = detail::TextSource::read(path).text();
  ShardFile shard;
  bool has_header = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) detail::throw_file_error(path, "ends within a line: resume it first");
    const std::string line = text.substr(begin, end - begin + 1);
    begin = end + 1;
    if (!has_header) {
      has_header = !line.starts_with('#');
      if (!line.starts_with("# shard ")) shard.head += line;
      continue;
    }
    const auto run = parse_count(line.substr(0, line.find(',')));
    if (!run) detail::throw_file_error(path, "is no result of a study");
    shard.rows.emplace_back(static_cast<std::size_t>(*run), line);
  }
  return shard;
}

int merge_studies(const StudyArguments& arguments) {
  for (const auto& [option, value] :
       {std::pair("--shard", arguments.shard), std::pair("--indices", arguments.indices)})
    if (!value.empty()) refuse(option, value, "must not be given with --merge");
  std::vector<std::pair<std::size_t, std::string>> rows;
  std::string head;
  for (const std::string& path : arguments.files) {
    check_outputs(path, {{"-o", arguments.output}});
    ShardFile shard = read_shard(path);
    if (head.empty()) head = shard.head;
    if (head != shard.head)
      throw InputError(printable(path), "", "is of another study than " + printable(arguments.files[0]));
    rows.insert(rows.end(), shard.rows.begin(), shard.rows.end());
  }
  std::sort(rows.begin(), rows.end());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].first != i)
      throw InputError("--merge", "",
                       fmt::format("run {} is {}", std::min(i, rows[i].first),
                                   rows[i].first < i ? "there twice" : "missing"));
  const std::string count = fmt::format(": {} runs,", rows.size());
  if (head.substr(0, head.find('\n')).find(count) == std::string::npos)
    throw InputError("--merge", "", fmt::format("run {} is missing", rows.size()));
  OutputFile out(arguments.output.empty() ? "-" : arguments.output);
  out.write(head);
  for (const auto& [run, line] : rows) out.write(line);
  out.commit();
  return kDone;
}

}  // namespace

Command add_study(CLI::App& program) {
  const auto arguments = std::make_shared<StudyArguments>();
  CLI::App* app = program.add_subcommand("study", "The same scene many times with other numbers: one table");
  app->add_option("STUDY", arguments->files, "study file; with --merge results of its shards")
      ->type_name("")
      ->required();
  arguments->set.add_to(*app);
  app->add_option("-o", arguments->output, "result file, CSV, a row per run; default standard output")
      ->type_name("FILE");
  app->add_flag("--resume", arguments->resume, "go on with the result file where it ends");
  app->add_option("--shard", arguments->shard, "only every n-th run from the k-th on")->type_name("K/N");
  app->add_flag("--merge", arguments->merge, "put results of all shards together");
  app->add_option("--indices", arguments->indices,
                  "first and total Sobol indices as CSV (design sobol-indices)")
      ->type_name("FILE");
  app->add_option("--threads", arguments->threads, "default 0: all cores; the result does not depend on it")
      ->type_name("N");
  return {app, "STUDY",
          [arguments] { return arguments->merge ? merge_studies(*arguments) : run_study(*arguments); }};
}

}  // namespace shearfront::tools
