// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/fit/loss/cauchy.hpp"
#include "shearfront/fit/loss/huber.hpp"
#include "shearfront/fit/loss/loss.hpp"
#include "shearfront/fit/loss/squared.hpp"
#include "shearfront/numeric/type_list.hpp"

namespace shearfront::fit {

/// Every loss. To add one: copy skeleton.hpp, include it here, and name it in the list.
using LossList = TypeList<SquaredLoss, HuberLoss, CauchyLoss>;

}  // namespace shearfront::fit
