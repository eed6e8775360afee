// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/path.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::exact {

/// Adds the final amount at z minus the initial amount below the start of a path, in twice the digits: both are made of data
/// only, and their difference may be small beside them.
template <Real Scalar>
void add_final_less_initial(const Cells<Scalar>& cells, const Path<Scalar>& path, const Scalar& z,
                            FinalAmount amount, CompensatedSum<Scalar>& sum) {
  if (amount == FinalAmount::full_below || (amount == FinalAmount::both && path.upward)) {
    sum += z;
    sum += -cells.x.front();
  } else {
    sum += cells.M.back();
    sum += cells.M_low.back();
  }
  sum += -cells.M[path.source];
  sum += -cells.M_low[path.source];
  if (path.kind != PathKind::constant && !path.is_state) return;
  if (cells.is_curved(path.source)) {
    sum += -cells.inside(path.source, path.foot);
    return;
  }
  const TwoSum<Scalar> inside(path.foot, Scalar(-cells.x[path.source]));
  const TwoProduct<Scalar> initial(inside.high, cells.phi[path.source]);
  sum += -initial.high;
  sum += -(initial.low + inside.low * cells.phi[path.source]);
}

}  // namespace shearfront::exact
