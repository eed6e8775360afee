// SPDX-License-Identifier: BSD-3-Clause
#include "case_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace shearfront::cli_tests {
namespace {

const std::vector<std::string> kKinds{"file",   "raw-file",    "directory",    "args",
                                      "env",    "stdin-from",  "stdout-to",    "exit",
                                      "stdout", "stderr",      "stdout-match", "stderr-match",
                                      "absent", "expect-file", "json",         "expect-file-match"};

}  // namespace

std::optional<std::string> Case::text(const std::string& kind) const {
  const auto it =
      std::find_if(sections.begin(), sections.end(), [&](const Section& s) { return s.kind == kind; });
  if (it == sections.end()) return std::nullopt;
  return it->text;
}

std::vector<Case> read_cases(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::vector<Case> cases;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.starts_with("=== ")) {
      cases.push_back({line.substr(4), {}});
    } else if (line.starts_with("--- ")) {
      std::istringstream words(line.substr(4));
      Section section;
      std::string equals, fixture;
      words >> section.kind >> section.argument >> equals >> fixture;
      const auto refuse = [&](const char* why) {
        throw std::runtime_error(path + ":" + std::to_string(number) + ": " + why + ": " + line);
      };
      if (cases.empty() || std::find(kKinds.begin(), kKinds.end(), section.kind) == kKinds.end())
        refuse("unknown section or no case");
      if (section.kind == "file" && equals == "=") {
        std::ifstream shared(std::filesystem::path(path).parent_path() / "fixtures" / fixture,
                             std::ios::binary);
        if (fixture.empty() || !shared) refuse("no such fixture");
        section.text.assign(std::istreambuf_iterator<char>(shared), {});
      }
      cases.back().sections.push_back(std::move(section));
    } else if (!cases.empty() && !cases.back().sections.empty()) {
      cases.back().sections.back().text += line + "\n";
    }
  }
  // A blank line before the next case or section is for the reader.
  for (Case& c : cases)
    for (Section& s : c.sections)
      if (s.text.ends_with("\n\n") || s.text == "\n") s.text.pop_back();
  return cases;
}

std::vector<std::string> split_arguments(const std::string& text) {
  std::vector<std::string> arguments;
  std::string word;
  bool in_word = false, quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
      in_word = true;
    } else if (!quoted && (c == ' ' || c == '\n')) {
      if (in_word) arguments.push_back(std::move(word));
      word.clear();
      in_word = false;
    } else {
      word += c;
      in_word = true;
    }
  }
  if (in_word) arguments.push_back(std::move(word));
  return arguments;
}

std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') continue;  // line breaks of the case file are not part of the text
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char next = text[++i];
    if (next == 'x') {
      out += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      out += next == 'n' ? '\n' : next == 'r' ? '\r' : next;
    }
  }
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
    text.replace(i, from.size(), to);
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace shearfront::cli_tests
