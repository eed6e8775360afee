// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/diffusion/cole_hopf_solver.hpp"
#include "shearfront/diffusion/crank_nicolson_solver.hpp"
#include "shearfront/exact/solver.hpp"
#include "shearfront/fv/classical_godunov_solver.hpp"
#include "shearfront/fv/engquist_osher_solver.hpp"
#include "shearfront/fv/godunov_solver.hpp"
#include "shearfront/fv/muscl_solver.hpp"
#include "shearfront/fv/upwind_solver.hpp"
#include "shearfront/numeric/type_list.hpp"
#include "shearfront/slab/solver.hpp"
#include "shearfront/solver/solver.hpp"
#include "shearfront/track/solver.hpp"

namespace shearfront {

/// Every solver. To add one: copy solver/skeleton.hpp into its module, include it here, and name it in the
/// list.
using SolverList =
    TypeList<ExactSolver, FrontTrackingSolver, EngquistOsherSolver, GodunovSolver, MusclSolver,
             ClassicalGodunovSolver, UpwindSolver, CrankNicolsonSolver, ColeHopfSolver, SlabSolver>;

}  // namespace shearfront
