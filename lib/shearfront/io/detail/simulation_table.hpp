// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/observations_csv.hpp"

/// Averages over space that particle codes write: columns between blanks, and the time above the rows it belongs to.
namespace shearfront::detail {

/// Which code wrote a file.
enum class SimulationCode {
  none,
  /// LAMMPS, fix ave/chunk: three comments, of which the third names the columns; for each time a line "step
  /// number-of-chunks count" and as many rows. The step is the column Timestep.
  lammps,
  /// MercuryDPM, coarse graining (MercuryCG): a line "CG ..."; a line of names "time z 3:volumeFraction 4:density
  /// 5-7:momentum", where 5-7 are as many columns; rows.
  mercury_cg,
  /// MercuryDPM, fstatistics: a line of names of what follows x y z in each row; a line "w ..."; for each time a line with it,
  /// or its beginning and end, and rows. The middle of that is the column time.
  mercury_statistics
};

struct SimulationHeader {
  SimulationCode code = SimulationCode::none;
  std::size_t offset = 0;  ///< of the line that names the columns
};
[[nodiscard]] SimulationHeader simulation_header(std::string_view text);

/// What the format says of such a file unless it says otherwise: t is Timestep or time, z is Coord1 or z, phi is the
/// volume fraction of MercuryDPM.
[[nodiscard]] ObservationFormat format_of(SimulationCode code, ObservationFormat format);

/// "averages over chunks", "coarse-grained averages".
[[nodiscard]] std::string_view text_of(SimulationCode code);

/// Its lines as those of a table, one after the other.
class SimulationRows {
 public:
  explicit SimulationRows(SimulationCode code) : code_(code) {}

  /// What a line behind the header is; a line of a time is remembered.
  enum class Line { row, not_a_row, bad };
  [[nodiscard]] Line take(std::string_view line);
  /// What a bad line must be.
  [[nodiscard]] std::string_view constraint() const;
  /// Puts the column of the time before the others where it is none of them, and gives every column of the header a field.
  /// Valid until the next take().
  void complete(std::vector<CsvField>& fields, bool is_header) const;

 private:
  SimulationCode code_;
  std::string time_;
  unsigned long long n_left_ = 0;  ///< rows of the chunks that are being read
};

}  // namespace shearfront::detail
