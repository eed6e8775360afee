// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/dialect.hpp"
#include "shearfront/io/detail/observation_columns.hpp"
#include "shearfront/io/detail/simulation_table.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/observations_csv.hpp"

namespace shearfront::detail {

/// The rows of a file of observations, of which the columns are known: each becomes observations or complaints.
class ObservationRows {
 public:
  ObservationRows(const TextSource& source, double bottom, double top, const ObservationFormat& format);

 protected:
  /// A number of the result: where it came from.
  struct Origin {
    std::size_t row, offset, field;
  };

  /// The fields of a line, with the time that stands above it.
  std::optional<std::size_t> take_apart(std::size_t offset, std::string_view line,
                                        std::vector<CsvField>& fields) const;
  /// The fields that are there, of a line that begins at `offset`.
  void read_row(std::size_t offset);

  /// Where a field of a row of the result stands.
  [[nodiscard]] Position position_of(const Origin& origin, Column column);

  const TextSource& source_;
  Dialect dialect_;
  ObservationFormat format_;
  SimulationRows simulation_;
  ComplaintReport report_;
  double bottom_, top_;
  std::optional<ObservationColumns> columns_;
  std::vector<CsvField> fields_;  ///< of the line that is being read
  std::size_t n_rows_ = 0;        ///< read so far; the number of the row that is being read
  double width_ = 0;              ///< of every bin, from the format; 0: from a column or none
  Observations result_;
  std::vector<Origin> origins_;  ///< of result_.rows

 private:
  bool read_time(std::size_t offset, Observation& o);
  /// The value of an observation whose place is read; `is_good`: and is right.
  void read_value(std::size_t offset, std::size_t field, Observation o, bool is_good);
  bool read_place(std::size_t offset, Observation& o);
  /// The width that the format gives to all bins.
  bool set_width(std::size_t offset, Observation& o);
  bool read_sigma(std::size_t offset, Observation& o);
  bool read_number(std::size_t offset, Column column, double& x);
  bool read_number(std::size_t offset, Column column, std::size_t field, double& x,
                   std::string_view alternative);
  /// Notes what is wrong with a field of the row that is being read; false for convenience.
  bool refuse(std::size_t offset, Column column, std::string constraint);
  bool refuse(std::size_t offset, Column column, std::size_t at, std::string constraint);
  /// The same for a place that stands in the header of a wide table.
  bool refuse_place(std::size_t field, Column column, double place, std::string constraint);
  void add(std::size_t offset, const std::string& key, std::string value, std::string constraint);
  [[nodiscard]] std::string domain() const;
  [[nodiscard]] Position position_in(std::size_t line, std::size_t field) const;
};

}  // namespace shearfront::detail
