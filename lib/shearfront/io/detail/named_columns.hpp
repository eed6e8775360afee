// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/detail/text_source.hpp"

namespace shearfront::detail {

/// Columns of a text table, asked for by their names: what a scene takes its tables of numbers from. Commas, semicolons,
/// tabs or blanks between them, decimal points or commas, lines before the header, a row of units below it and comments
/// (#) are found out as in files of observations.
class NamedColumns {
 public:
  struct Column {
    Heading heading;  ///< its unit from the header, or else from the row of units
    Position position;
    std::vector<std::string_view> cells;  ///< of every row
  };

  /// The columns in the order of the names; "height (mm)" is found by the whole heading or by "height". Complaints go to
  /// report(): no header with these names, rows of another length, no rows; columns() are then empty.
  NamedColumns(TextSource source, const std::vector<std::string>& names);
  NamedColumns(const NamedColumns&) = delete;
  NamedColumns& operator=(const NamedColumns&) = delete;

  [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
  /// Where the number of a column in a row stands.
  [[nodiscard]] Position position(std::size_t column, std::size_t row) const;
  [[nodiscard]] std::string_view name() const { return source_.name(); }
  [[nodiscard]] char decimal() const { return decimal_; }
  [[nodiscard]] ComplaintReport& report() { return report_; }
  [[nodiscard]] const ComplaintReport& report() const { return report_; }
  /// "12 rows", ", separated by semicolons, decimal commas" where that was found out.
  [[nodiscard]] std::string understood() const;
  /// Whether nothing had to be found out.
  [[nodiscard]] bool is_plain() const;

 private:
  [[nodiscard]] std::optional<std::size_t> find_header(const std::vector<std::string>& names);
  void refuse_header(const std::vector<std::string>& names);
  void read_rows(std::size_t from);

  TextSource source_;
  ComplaintReport report_;
  char separator_ = ',', decimal_ = '.';
  bool has_units_row_ = false;
  std::size_t n_fields_ = 0;
  std::vector<std::size_t> fields_;  ///< of the columns
  std::vector<std::size_t> rows_;    ///< their offsets
  std::vector<Column> columns_;
};

}  // namespace shearfront::detail
