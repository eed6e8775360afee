// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <string>

#include "shearfront/io/file_error.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/observation.hpp"

/// Files of observations (CSV; the format is described in docs/formats).
namespace shearfront {

class OutputFile;

/// Complaints of a file that are printed; of the others only the number is.
inline constexpr std::size_t kMostComplaints = 20;

/// Reads observations: columns t, z and phi (with width: means over bins) or M (cumulative), optional sigma,
/// in any order. z and the bins must lie in [bottom, top], which may be infinite.
///
/// Guaranteed of the result:
///   (1) at least one row; every t >= 0, z in the domain, all numbers finite;
///   (2) bins: width > 0, is_bin_inside() and is_bin_resolved(); otherwise width = 0;
///   (3) no two rows with the same t, z and width;
///   (4) sigma > 0 in every row or NaN in every row.
/// phi need not lie between 0 and 1: measured values scatter beyond. Rows without a value (empty or NA) are
/// counted in n_missing. Columns that are not known are not used; a note says so.
/// Errors: FileError with one line per complaint, all of them up to kMostComplaints and then their number:
///     data.csv:7:3: z[5] = 1.5; must be inside the domain [0, 1]
/// where 5 is the row, counted from 0 without header, comments and blank lines.
/// Cost: O(n) for files in ascending order of t, then z; otherwise O(n log n). 1e6 rows take half a second.
[[nodiscard]] Observations read_observations(const std::string& path,
                                             double bottom = -std::numeric_limits<double>::infinity(),
                                             double top = std::numeric_limits<double>::infinity());

/// The same for measurements of a scene, whose fluxes say which phi are possible. A note says so where some are
/// beyond them by the width of their range; in one that is a thousand times wider every value must lie (M and H
/// likewise, by the height of the bed): what is beyond is a mistake, and would drown all others in a fit.
[[nodiscard]] Observations read_observations(const std::string& path, const Scene<double>& scene);

/// The same from a text; `file` is the name used in messages.
[[nodiscard]] Observations parse_observations(std::string text, const std::string& file,
                                              double bottom = -std::numeric_limits<double>::infinity(),
                                              double top = std::numeric_limits<double>::infinity());

/// The text of a file that reads back to the same rows, units and comments, to the bit: comments, header,
/// rows. What is not kept: the missing rows, columns that were not used, and the places of the comments.
/// Precondition: rows as guaranteed above; comments may have several lines.
[[nodiscard]] std::string observations_text(const Observations& observations);

/// Errors: FileError from the file.
void write_observations(OutputFile& file, const Observations& observations);

}  // namespace shearfront
