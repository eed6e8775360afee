// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>

#include "shearfront/scene/chute.hpp"
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// The run of any solver on the bed of a steady chute, with its results where they belong in the chute: heights z, what
/// passes for amounts (M, mass, integrals times U), and of straight fronts as many pieces as show how they bend.
/// `start` starts the solver on a bed, which outlives the run.
[[nodiscard]] std::unique_ptr<Run> start_chute(
    const Scene<double>& scene, const std::function<std::unique_ptr<Run>(const Scene<double>& bed)>& start);

}  // namespace shearfront
