// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp, setenv
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "case_file.hpp"

namespace shearfront::cli_tests {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string with_datasets(const std::string& text) {
  return replaced(text, "{datasets}", SHEARFRONT_SOURCE_DIR "/datasets");
}

/// A new directory, removed at the end.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "shearfront-cli-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void redirect(int descriptor, const fs::path& to, int flags) {
  const int file = open(to.c_str(), flags, 0600);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(126);
}

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

Outcome run(const Case& c, const fs::path& folder, const fs::path& streams) {
  std::vector<std::string> words{SHEARFRONT_PROGRAM};
  for (std::string& word : split_arguments(with_datasets(c.text("args").value_or(""))))
    words.push_back(std::move(word));
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    fs::path out = streams / "out", in = "/dev/null";
    for (const Section& s : c.sections) {
      if (s.kind == "stdout-to") out = s.argument;
      if (s.kind == "stdin-from") in = folder / with_datasets(s.argument);
      const std::size_t equals = s.argument.find('=');
      if (s.kind == "env")
        setenv(s.argument.substr(0, equals).c_str(), s.argument.substr(equals + 1).c_str(), 1);
    }
    redirect(STDIN_FILENO, in, O_RDONLY);
    redirect(STDOUT_FILENO, out, O_WRONLY | O_CREAT);
    redirect(STDERR_FILENO, streams / "err", O_WRONLY | O_CREAT);
    if (chdir(folder.c_str()) != 0) _exit(126);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), content_of(streams / "out"),
          content_of(streams / "err")};
}

/// Every pattern matches a whole line, in order; other lines may lie between. None that is so long that std::regex, which calls itself for
/// every character, would run out of stack.
void expect_lines(const std::string& text, const std::string& patterns, const std::string& what) {
  const auto lines = lines_of(text);
  constexpr std::size_t kLongest = 4000;
  std::size_t i = 0;
  for (const std::string& pattern : lines_of(patterns)) {
    const std::regex expression(pattern);
    while (i < lines.size() && (lines[i].size() > kLongest || !std::regex_match(lines[i], expression))) ++i;
    ASSERT_LT(i, lines.size()) << what << " has no (further) line like\n  " << pattern << "\nin\n" << text;
    ++i;
  }
}

void expect_json(const std::string& text, const std::string& facts) {
  const auto document = nlohmann::json::parse(text, nullptr, false);
  ASSERT_FALSE(document.is_discarded()) << "not JSON:\n" << text;
  for (const std::string& line : lines_of(facts)) {
    std::istringstream words(line);
    std::string pointer, value, tolerance;
    words >> pointer >> std::ws;
    const std::string rest{std::istreambuf_iterator<char>(words), {}};
    const bool is_number = rest.find_first_of("0123456789") == 0 || rest[0] == '-';
    const nlohmann::json::json_pointer place(pointer);
    ASSERT_TRUE(document.contains(place)) << pointer << " is missing in\n" << text;
    const auto& actual = document.at(place);
    if (!is_number) {
      EXPECT_EQ(actual, nlohmann::json::parse(rest)) << pointer;
      continue;
    }
    std::istringstream numbers(rest);
    numbers >> value >> tolerance;
    ASSERT_TRUE(actual.is_number()) << pointer << " = " << actual;
    const double expected = std::stod(value), bound = tolerance.empty() ? 0 : std::stod(tolerance);
    EXPECT_LE(std::abs(actual.get<double>() - expected), bound * std::abs(expected))
        << pointer << " = " << actual << ", expected " << value;
  }
}

bool exists(const fs::path& folder, const std::string& name) {
  if (!name.ends_with('*')) return fs::exists(folder / name);
  const std::string prefix = name.substr(0, name.size() - 1);
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(prefix)) return true;
  return false;
}

class CliCase : public testing::Test {
 public:
  explicit CliCase(Case c) : case_(std::move(c)) {}

  void TestBody() override {
    const Folder folder, streams;
    for (const Section& s : case_.sections) {
      if (s.kind == "file") write(folder.path() / s.argument, with_datasets(s.text));
      if (s.kind == "raw-file") write(folder.path() / s.argument, unescaped(s.text));
      if (s.kind == "directory") fs::create_directory(folder.path() / s.argument);
    }
    const Outcome outcome = run(case_, folder.path(), streams.path());
    EXPECT_EQ(outcome.exit_code, std::stoi(case_.text("exit").value_or("0"))) << outcome.err;
    expect_stream(outcome.out, "stdout");
    expect_stream(outcome.err, "stderr");
    for (const Section& s : case_.sections) {
      const fs::path file = folder.path() / s.argument;
      if (s.kind == "json") {
        expect_json(outcome.out, s.text);
      } else if (s.kind == "expect-file") {
        EXPECT_EQ(content_of(file), s.text) << s.argument;
      } else if (s.kind == "expect-file-match") {
        expect_lines(content_of(file), s.text, s.argument);
      } else if (s.kind == "absent") {
        EXPECT_FALSE(exists(folder.path(), s.argument)) << s.argument;
      }
    }
  }

 private:
  void expect_stream(const std::string& text, const std::string& name) {
    if (const auto patterns = case_.text(name + "-match")) {
      expect_lines(text, with_datasets(*patterns), name);
    } else if (name != "stdout" || !case_.text("json")) {
      EXPECT_EQ(text, with_datasets(case_.text(name).value_or(""))) << name;
    }
  }

  Case case_;
};

}  // namespace
}  // namespace shearfront::cli_tests

namespace {

/// A name that a filter can select: there "-" begins what is left out, and a case with one in its name would not run, and pass.
std::string selectable(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace shearfront::cli_tests;
  testing::InitGoogleTest(&argc, argv);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(SHEARFRONT_CASES))
    if (entry.path().extension() == ".txt" && entry.path().filename() != "CMakeLists.txt")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    std::vector<Case> cases;
    try {
      cases = read_cases(file.string());
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
      return 1;
    }
    for (const Case& c : cases)
      testing::RegisterTest(selectable(file.stem().string()).c_str(), selectable(c.name).c_str(), nullptr,
                            nullptr, file.c_str(), 1, [c]() -> testing::Test* { return new CliCase(c); });
  }
  return RUN_ALL_TESTS();
}
