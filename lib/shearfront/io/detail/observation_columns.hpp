// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/solution/observation.hpp"

namespace shearfront::detail {

enum class Column { t, z, phi, M, H, width, sigma };
inline constexpr std::array<std::string_view, 7> kColumnNames{"t", "z", "phi", "M", "H", "width", "sigma"};

[[nodiscard]] constexpr std::string_view name_of(Column column) {
  return kColumnNames[static_cast<std::size_t>(column)];
}

/// A field of a header: "z [mm]" and "z (mm)" are z in mm.
struct Heading {
  std::string name, unit;
};
[[nodiscard]] Heading heading_of(std::string_view field);
/// The other way round: "z [mm]", "z" without a unit.
[[nodiscard]] std::string heading_text(std::string_view name, std::string_view unit);

/// What the header of a file of observations says.
class ObservationColumns {
 public:
  /// Complaints go into the report; with any, the result must not be used. `offset` is that of the line.
  ObservationColumns(const TextSource& source, std::size_t offset, const std::vector<CsvField>& fields,
                     ComplaintReport& report);

  [[nodiscard]] bool has(Column column) const { return at_[index(column)].has_value(); }
  /// The number of the field. Precondition: has(column).
  [[nodiscard]] std::size_t field(Column column) const { return *at_[index(column)]; }
  [[nodiscard]] std::size_t n_fields() const { return headings_.size(); }
  [[nodiscard]] Column value() const {
    return has(Column::H) ? Column::H : has(Column::M) ? Column::M : Column::phi;
  }
  [[nodiscard]] Quantity quantity() const;
  [[nodiscard]] ObservationUnits units() const;
  /// One line per column that is not used.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// The names of all columns for messages.
  [[nodiscard]] std::string names() const;
  /// Where a column stands in the header.
  [[nodiscard]] Position position(Column column) const { return positions_[field(column)]; }

 private:
  static std::size_t index(Column column) { return static_cast<std::size_t>(column); }
  void read_known();
  void read_unknown();
  void find_missing();
  void check_units();
  [[nodiscard]] std::string unit(Column column) const;
  [[nodiscard]] std::optional<std::string> misspelt(Column column) const;
  void refuse(std::size_t i, std::string constraint);
  void refuse_header(std::string constraint);

  std::string file_;
  ComplaintReport* report_;
  std::vector<Heading> headings_;
  std::vector<Position> positions_;
  std::array<std::optional<std::size_t>, kColumnNames.size()> at_;
  std::vector<std::string> notes_;
};

}  // namespace shearfront::detail
