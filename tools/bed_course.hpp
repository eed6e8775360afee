// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/results.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/lowest_bed.hpp"
#include "shearfront/solver/solver.hpp"

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

/// Why a scene has no such numbers; empty if it has.
[[nodiscard]] std::string refusal_of_course(const Scene<double>& scene);

/// The course of mixing or bed height. The lowest bed is looked for up to the last finite time. If the
/// summary is not usable() there are no rows.
[[nodiscard]] BedCourse bed_course(SolvedQuantity quantity, std::string_view method,
                                   const Scene<double>& scene, const std::vector<double>& times,
                                   const SolverOptions& options);

}  // namespace shearfront::tools
