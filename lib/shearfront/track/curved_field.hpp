// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "shearfront/solution/field.hpp"
#include "shearfront/track/curved_scene.hpp"
#include "shearfront/track/curved_snapshot.hpp"

namespace shearfront {

/// What a curved tracker runs in; it never changes.
struct CurvedBed {
  CurvedScene scene;
  LevelCurves grid;
  std::vector<bool> is_plateau;
  double resolution;

  CurvedBed(CurvedScene curved, LevelPlan plan, double largest_step)
      : scene(std::move(curved)),
        grid(scene.problem.pieces, std::move(plan.capacities), plan.known),
        is_plateau(std::move(plan.is_plateau)),
        resolution(largest_step) {}
};

/// The steady states between curved fronts at one time: phi and M to rounding, with the snapshot they are of.
class CurvedField final : public Field {
 public:
  CurvedField(std::shared_ptr<const CurvedBed> bed, CurvedSnapshot snapshot)
      : bed_(std::move(bed)), snapshot_(std::move(snapshot)) {}

  [[nodiscard]] Sample at(double z) const override;
  using Field::at;
  /// By adaptive quadrature of each level, cut where it turns or meets a kink: relative error about 1e-10, 1e-6 where g has a
  /// singularity of its slope.
  [[nodiscard]] double integral(const ShareFunction& g) const override;
  /// Lines no farther from the levels than a thousandth of the resolution; M at all fronts is exact.
  [[nodiscard]] std::optional<Profile<double>> profile() const override;

 private:
  std::shared_ptr<const CurvedBed> bed_;
  CurvedSnapshot snapshot_;
};

}  // namespace shearfront
