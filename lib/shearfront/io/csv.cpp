// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/csv.hpp"

#include <algorithm>

namespace shearfront::detail {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::size_t skip_blanks(std::string_view line, std::size_t i, std::string_view blanks = kBlanks) {
  return std::min(line.find_first_not_of(blanks, i), line.size());
}

void split_at_blanks(std::string_view line, std::vector<CsvField>& fields) {
  for (std::size_t i = skip_blanks(line, 0); i < line.size();) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, i), line.size());
    fields.push_back({line.substr(i, end - i), i});
    i = skip_blanks(line, end);
  }
  if (fields.empty()) fields.push_back({line.substr(0, 0), 0});
}

/// Where the quotes that open at `open` close; npos if they do not.
std::size_t closing_quote(std::string_view line, std::size_t open) {
  for (std::size_t i = line.find('"', open + 1);; i = line.find('"', i + 2))
    if (i == std::string_view::npos || i + 1 >= line.size() || line[i + 1] != '"') return i;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = skip_blanks(text, 0);
  const std::size_t last = text.find_last_not_of(kBlanks);
  return last == std::string_view::npos ? std::string_view() : text.substr(begin, last + 1 - begin);
}

std::optional<std::size_t> split_csv(std::string_view line, std::vector<CsvField>& fields, char separator) {
  fields.clear();
  if (separator == ' ') {
    split_at_blanks(line, fields);
    return std::nullopt;
  }
  const std::string_view blanks = separator == '\t' ? std::string_view(" \r") : kBlanks;
  for (std::size_t i = 0;;) {
    std::size_t begin = skip_blanks(line, i, blanks), end = 0;
    if (begin < line.size() && line[begin] == '"') {
      const std::size_t close = closing_quote(line, begin);
      if (close == std::string_view::npos) return begin;
      end = skip_blanks(line, close + 1, blanks);
      if (end < line.size() && line[end] != separator) return begin;
      fields.push_back({line.substr(begin + 1, close - begin - 1), begin});
    } else {
      end = std::min(line.find(separator, i), line.size());
      begin = std::min(begin, end);
      fields.push_back({trimmed(line.substr(begin, end - begin)), begin});
    }
    if (end == line.size()) return std::nullopt;
    i = end + 1;
  }
}

std::string without_doubled_quotes(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    out += text[i];
    if (text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') ++i;
  }
  return out;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"") == std::string_view::npos && trimmed(text) == text) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace shearfront::detail
