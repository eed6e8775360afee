// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/simulation_table.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/observations_csv.hpp"

namespace shearfront::detail {

/// How a file of observations is written: what the format says, and the rest as found.
struct Dialect {
  char separator = ',', decimal = '.';
  TableLayout layout = TableLayout::rows;
  std::size_t header = 0;  ///< offset of the header line; of the first line of content if none is found
  std::optional<std::size_t> units;  ///< offset of the row of units below it
  SimulationCode code = SimulationCode::none;
  [[nodiscard]] bool is_simulated() const { return code != SimulationCode::none; }

  /// "separated by semicolons, decimal commas"; empty for commas and points.
  [[nodiscard]] std::string text() const;
  /// All that is to be said of it, with the encoding and the lines before the header: "UTF-16 text", text(), ...
  [[nodiscard]] std::vector<std::string> remarks(std::string_view encoding, std::size_t n_preamble) const;
  /// "comma", for messages.
  [[nodiscard]] std::string_view separator_name() const {
    return separator == ';' ? "semicolon" : separator == '\t' ? "tab" : "comma";
  }
};

/// The header is the first line, split at the separator of the format or else at commas, semicolons or tabs, that has
/// the columns of observations; failing that, the first whose first field is t or z and whose others have one number
/// each (a wide table). The decimal mark is a comma if numbers below have commas and none a point.
/// Cost: O(length of the first 200 lines).
[[nodiscard]] Dialect dialect_of(const TextSource& source, const ObservationFormat& format);

}  // namespace shearfront::detail
