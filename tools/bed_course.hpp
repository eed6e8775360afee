// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "shearfront/io/results.hpp"
#include "shearfront/solution/lowest_bed.hpp"
#include "shearfront/solver/solve.hpp"

/// Numbers that belong to a whole bed, as functions of time.
namespace shearfront::tools {

/// What `solve --quantity` gives; the first one at times and depths.
enum class SolvedQuantity { concentration, mixing, bed_height };
inline constexpr std::array<std::string_view, 3> kSolvedQuantityNames{"concentration", "mixing",
                                                                      "bed-height"};

struct BedCourse {
  SolvedQuantity quantity = SolvedQuantity::mixing;
  TimeTable table;                  ///< columns "E" and "Psi", or "H"; t* stands for the steady state
  std::optional<LowestBed> lowest;  ///< of a bed height
  Summary summary;
};

/// The course of mixing or bed height. The lowest bed is looked for up to the last finite time. If the
/// summary is not usable() there are no rows. Precondition: BedHeight::refusal(scene) is empty.
[[nodiscard]] BedCourse bed_course(SolvedQuantity quantity, const Scene<double>& scene, const Method& method,
                                   const std::vector<double>& times, const Progress& progress = {});

/// When what was computed had come to rest, as far as the method says.
[[nodiscard]] std::optional<double> steady_time_of(const SolverResult& result);

/// The last of the finite times, 0 if there is none.
[[nodiscard]] double last_time(const std::vector<double>& times);

}  // namespace shearfront::tools
