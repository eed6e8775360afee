// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/fv/face_flux.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// Second order: v is linear in every cell (v: FluxShape). |half rise| <= both differences, so the states at the
/// edges lie between those of the neighbours.
///
/// Beyond a jump of the rate the state of the own layer with the neighbour's flux stands for the neighbour (the
/// singular mapping): it would follow here if the flux went on unchanged. In time-dependent flow the flux changes
/// with height as 1 / wave speed, so half of the distance, that in the other layer, counts with the ratio of the
/// speeds. The half rise is no larger than the difference itself: the bounds of phi hold.
class Muscl {
 public:
  /// `rates`: of the cells; empty where a is continuous.
  Muscl(Limiter limiter, std::vector<double> rates);

  /// Half the rise of v across every cell, rises[0 .. n-1]; v[-1] and v[n] are read.
  void half_rises(const FluxShape& flux, const double* v, double* rises, std::size_t n) const;

 private:
  [[nodiscard]] double half_rise_at_jump(const FluxShape& flux, const double* v, std::size_t j) const;

  Limiter limiter_;
  std::vector<double> rates_;
  std::vector<std::size_t> jumps_;  ///< cells with a neighbour of another rate
};

}  // namespace shearfront::fv
