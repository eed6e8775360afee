// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/csv.hpp"

/// What files of separated values have in common, whatever their columns hold.
namespace shearfront::detail {

/// The line that begins at `offset`, without its end.
[[nodiscard]] std::string_view line_at(std::string_view text, std::size_t offset);

/// The first 200 lines with content that are no comments, by their offsets.
[[nodiscard]] std::vector<std::size_t> lines_of_content(std::string_view text, std::size_t from = 0);

/// A field of a header: "z [mm]" and "z (mm)" are z in mm.
struct Heading {
  std::string name, unit;
  std::string text;  ///< as it stands in the file
};
/// "mm" of "[mm]" and "(mm)".
[[nodiscard]] std::string_view without_brackets(std::string_view text);
[[nodiscard]] Heading heading_of(std::string_view field);
/// The other way round: "z [mm]", "z" without a unit.
[[nodiscard]] std::string heading_text(std::string_view name, std::string_view unit);

[[nodiscard]] std::vector<Heading> headings_of(const std::vector<CsvField>& fields);

/// Whether the fields are names of units, with or without brackets, and at least one.
[[nodiscard]] bool is_units_row(const std::vector<CsvField>& fields);

/// ',' if numbers in the lines from there on have commas and none a point.
[[nodiscard]] char decimal_below(std::string_view text, std::size_t from, char separator);

/// A number with this decimal mark; nothing for anything else.
[[nodiscard]] std::optional<double> number_with_mark(std::string_view text, char decimal);

}  // namespace shearfront::detail
