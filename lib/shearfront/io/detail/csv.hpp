// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Lines of separated values (RFC 4180, except that a field does not go beyond its line).
namespace shearfront::detail {

struct CsvField {
  std::string_view text;   ///< without blanks around it and without the quotes around it
  std::size_t offset = 0;  ///< in the line, of the first character that is no blank
};

/// Text without blanks, tabs and carriage returns at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Takes a line apart into `fields`, whose memory is used again. The separator ' ' stands for any number of blanks and
/// tabs. Returns the offset of a field whose quotes are not closed, or that goes on after them; then the fields are not
/// to be used. Doubled quotes inside quotes stay doubled: see without_doubled_quotes().
[[nodiscard]] std::optional<std::size_t> split_csv(std::string_view line, std::vector<CsvField>& fields,
                                                   char separator = ',');

[[nodiscard]] std::string without_doubled_quotes(std::string_view text);

/// The text as a field: in quotes if it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

}  // namespace shearfront::detail
