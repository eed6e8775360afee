// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/header_match.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/observations_csv.hpp"

namespace shearfront::detail {

/// What the header of a file of observations says.
class ObservationColumns {
 public:
  struct Target {
    std::string z, t;       ///< units of the scene; empty if it does not say
    bool are_parts = true;  ///< whether the states of the flux are fractions of 1
  };
  /// Complaints go into the report; with any, the result must not be used. `offset` is that of the line; `units` is the
  /// row below it, or empty.
  ObservationColumns(const TextSource& source, std::size_t offset, const std::vector<CsvField>& fields,
                     const std::vector<CsvField>& units, const ObservationFormat& format, TableLayout layout,
                     const Target& target, ComplaintReport& report);

  [[nodiscard]] bool has(Column column) const { return at_[index(column)].has_value(); }
  /// The number of the field. Precondition: has(column), and it is no column of places of a wide table.
  [[nodiscard]] std::size_t field(Column column) const { return *at_[index(column)]; }
  [[nodiscard]] std::size_t n_fields() const { return headings_.size(); }
  /// Whether a column x stands for t.
  [[nodiscard]] bool is_distance() const { return has(Column::t) && headings_[field(Column::t)].name == "x"; }
  /// phi, phi_large, M or H.
  [[nodiscard]] Column value() const;
  [[nodiscard]] Quantity quantity() const;
  [[nodiscard]] TableLayout layout() const { return layout_; }
  [[nodiscard]] const std::vector<PlaceColumn>& places() const { return places_; }  ///< of a wide table
  /// By what a number of the column is multiplied.
  [[nodiscard]] double factor(Column column) const { return factors_[index(column)]; }
  /// Of the numbers after that.
  [[nodiscard]] const ObservationUnits& units() const { return units_; }
  /// One line per column that is not used.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// The names of all columns for messages.
  [[nodiscard]] std::string names() const;
  /// Where a column stands in the header.
  [[nodiscard]] Position position(Column column) const { return positions_[field(column)]; }
  /// `t from "time [s]" in s; z from "height (mm)" in mm; phi from "conc" in percent`
  [[nodiscard]] std::string understood() const;
  /// Whether the header is this project's own: every column by its own name, nothing converted.
  [[nodiscard]] bool is_plain() const;

 private:
  static std::size_t index(Column column) { return static_cast<std::size_t>(column); }
  void read_wide(const ObservationFormat& format);
  void read_known(const HeaderMatch& found, const ObservationFormat& format);
  void read_unknown();
  void find_missing();
  void check_units(const Target& target);
  void convert(Column column, const std::string& to);
  [[nodiscard]] const std::string& unit(Column column) const { return column_units_[index(column)]; }
  [[nodiscard]] std::string unused_names() const;
  [[nodiscard]] std::optional<std::string> misspelt(Column column) const;
  void refuse(std::size_t i, std::string constraint);
  void refuse_header(std::string constraint);

  std::string file_;
  ComplaintReport* report_;
  TableLayout layout_;
  std::vector<Heading> headings_;
  std::vector<Position> positions_;
  std::array<std::optional<std::size_t>, kColumnNames.size()> at_;
  std::array<std::string, kColumnNames.size()> column_units_;
  std::array<double, kColumnNames.size()> factors_;
  std::vector<PlaceColumn> places_;
  ObservationUnits units_;
  std::vector<std::string> notes_;
};

}  // namespace shearfront::detail
