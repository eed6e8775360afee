// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/observations_csv.hpp"

/// Which column of a header is which.
namespace shearfront::detail {

[[nodiscard]] constexpr std::string_view name_of(Column column) {
  return kColumnNames[static_cast<std::size_t>(column)];
}

/// Which columns a header has, by the names of the format and the usual ones; quietly, for the search for it.
struct HeaderMatch {
  std::array<std::vector<std::size_t>, kColumnNames.size()> fields;  ///< that can be each column

  [[nodiscard]] bool has(Column column) const { return !fields[static_cast<std::size_t>(column)].empty(); }
  /// Whether the columns make observations: a time, a place unless H, a value.
  [[nodiscard]] bool is_complete() const;
};
[[nodiscard]] HeaderMatch match(const std::vector<Heading>& headings, const ObservationFormat& format);

/// The place of a column of a wide table: its time or its height.
struct PlaceColumn {
  std::size_t field;
  double place;
};
/// The numbers in the names of all columns but the first ("3", "z = 3 mm", "phi_3mm"); nothing unless each has
/// exactly one. Takes their unit, if they all have the same.
[[nodiscard]] std::optional<std::vector<PlaceColumn>> places_in(const std::vector<Heading>& headings,
                                                                std::string& unit);

/// ASCII letters only.
[[nodiscard]] std::string lower_case(std::string_view text);

}  // namespace shearfront::detail
