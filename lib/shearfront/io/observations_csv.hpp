// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/file_error.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/observation.hpp"

/// Files of observations (CSV; the format is described in docs/reference/formats).
namespace shearfront {

class OutputFile;

/// Complaints of a file that are printed; of the others only the number is.
inline constexpr std::size_t kMostComplaints = 20;

/// What a column of a file of observations can hold; phi_large is 1 - phi, the concentration of the large grains.
enum class Column { t, z, phi, M, H, width, sigma, phi_large };
inline constexpr std::array<std::string_view, 8> kColumnNames{"t", "z",     "phi",   "M",
                                                              "H", "width", "sigma", "phi_large"};

/// How the places of the numbers stand in a file.
enum class TableLayout {
  rows,     ///< a row per observation
  heights,  ///< a column per height: the first holds t, the names of the others hold the heights
  times     ///< a column per time: the first holds z, the names of the others hold the times
};
inline constexpr std::array<std::string_view, 3> kTableLayoutNames{"rows", "heights", "times"};

/// What becomes of several values at one place (the same t, z and width).
enum class Replicates {
  refused,
  kept,  ///< observations of their own
  averaged  ///< their mean; sigma is the spread of all values about their means over the root of how many one has
};
inline constexpr std::array<std::string_view, 3> kReplicatesNames{"refuse", "keep", "mean"};

/// How a laboratory wrote its file, as far as one says it. What is left open is found in the file, and
/// Observations::understood tells what was found.
struct ObservationFormat {
  struct ColumnFormat {
    std::string name;  ///< as in the header, with or without the unit behind it; empty: the usual names
    std::string unit;  ///< instead of what the header says
  };
  std::array<ColumnFormat, kColumnNames.size()> columns;
  std::optional<char> separator;     ///< comma, semicolon or tab
  std::optional<char> decimal;       ///< '.' or ','
  std::vector<std::string> missing;  ///< words for a value that is missing, beside the usual ones
  std::optional<TableLayout> layout;
  Replicates replicates = Replicates::refused;
  std::optional<double> width;  ///< of the bins phi is a mean over, in the unit of z, where no column says it
  std::optional<double> time_step;  ///< of a particle simulation, whose files count steps
  bool is_chute =
      false;  ///< may be of a steady chute: a column x stands for t, if there is none (set by the reader)

  [[nodiscard]] ColumnFormat& operator[](Column column) { return columns[static_cast<std::size_t>(column)]; }
  [[nodiscard]] const ColumnFormat& operator[](Column column) const {
    return columns[static_cast<std::size_t>(column)];
  }
};

/// Reads observations: columns t, z and phi (with width: means over bins) or M (cumulative), or H, optional sigma, in
/// any order; as a laboratory writes them:
///   * UTF-8, UTF-16 or Windows-1252 text; separated by commas, semicolons or tabs; decimal points or commas; lines
///     before the header, a row of units below it; rows, or a table with a column per height or per time;
///   * missing values are empty, NA, N/A, n/a, NaN, nan, #N/A, NULL, - or a word of the format;
///   * columns "time", "height", and for sigma "std", "sd", "stderr" are found; other names the format gives;
///   * averages over chunks of the particle code LAMMPS (fix ave/chunk): t from the step, z from Coord1;
///   * coarse-grained .stat files of the particle code MercuryDPM, of both kinds: phi is the volume fraction;
///   * percent become parts of 1, lengths and times those of the scene, if both units are known.
/// z and the bins must lie in [bottom, top], which may be infinite.
///
/// Guaranteed of the result:
///   (1) at least one row; every t >= 0, z in the domain, all numbers finite;
///   (2) bins: width > 0, is_bin_inside() and is_bin_resolved(); otherwise width = 0;
///   (3) no two rows with the same t, z and width, unless replicates are kept;
///   (4) sigma > 0 in every row or NaN in every row.
/// phi need not lie between 0 and 1: measured values scatter beyond. Rows without a value are
/// counted in n_missing. Columns that are not known are not used; a note says so.
/// Errors: FileError with one line per complaint, all of them up to kMostComplaints and then their number:
///     data.csv:7:3: z[5] = 1.5; must be inside the domain [0, 1]
/// where 5 is the row, counted from 0 without header, comments and blank lines.
/// Cost: O(n) for files in ascending order of t, then z; otherwise O(n log n). 1e6 rows take half a second.
[[nodiscard]] Observations read_observations(const std::string& path,
                                             double bottom = -std::numeric_limits<double>::infinity(),
                                             double top = std::numeric_limits<double>::infinity(),
                                             const ObservationFormat& format = {});

/// The same for measurements of a scene, whose fluxes say which phi are possible. Where these are fractions, phi beyond
/// 2 is refused (percent that nobody declared). Elsewhere a note says so where some are beyond the states by the width of
/// their range; in one that is a thousand times wider every value must lie (M and H likewise, by the height of the bed):
/// what is beyond is a mistake, and would drown all others in a fit.
[[nodiscard]] Observations read_observations(const std::string& path, const Scene<double>& scene,
                                             const ObservationFormat& format = {});

/// The same from a text; `file` is the name used in messages.
[[nodiscard]] Observations parse_observations(std::string text, const std::string& file,
                                              double bottom = -std::numeric_limits<double>::infinity(),
                                              double top = std::numeric_limits<double>::infinity(),
                                              const ObservationFormat& format = {});
[[nodiscard]] Observations parse_observations(std::string text, const std::string& file,
                                              const Scene<double>& scene,
                                              const ObservationFormat& format = {});

/// The text of a file that reads back to the same rows, units and comments, to the bit: comments, header,
/// rows. What is not kept: the missing rows, columns that were not used, and the places of the comments.
/// Precondition: rows as guaranteed above; comments may have several lines.
[[nodiscard]] std::string observations_text(const Observations& observations);

/// Errors: FileError from the file.
void write_observations(OutputFile& file, const Observations& observations);

}  // namespace shearfront
