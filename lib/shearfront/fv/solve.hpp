// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "shearfront/fv/face_rule.hpp"
#include "shearfront/fv/grid.hpp"
#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/fv/output.hpp"
#include "shearfront/fv/unimodal_flux.hpp"
#include "shearfront/fv/options.hpp"

namespace shearfront::fv {

/// All finite-volume solvers: u_j -= dt / dz (F_{j+1/2} - F_{j-1/2}), in two stages for muscl, with no flux
/// through the walls. On options.cells equal cells, or with options.align_cells on about as many with edges
/// on the interfaces (aligned_grid()).
///
/// Time steps: dt = cfl C dz / (s max a max |f'|), C = 1 in first order and 1/2 for muscl; the same for the
/// whole run. With options.local_steps that is the step of the fastest cells; others take steps 2, 4, 8, ...
/// times as long where their rate allows it (octaves_of()), and dt below is that of the slowest. The state at
/// a time t between n dt and (n + 1) dt comes from one shorter step that starts at n dt; the march itself
/// goes on from n dt. So (1) what comes out at t does not depend on the other times asked for; (2) it is a
/// continuous function of t and of the numbers of the scene: where n changes, the shorter step has become a
/// whole one, or nothing (equal steps, n = ceil(t / dt), would jump there). phi is constant in a cell (linear
/// for muscl), M is its integral. t = infinity gives the steady state of the grid (fv/march.hpp) without a
/// march, and a march that has come to rest stops.
///
/// The mass is that of the scene to the bit of 2^-53 per cell on equal cells, to rounding on others, where
/// what rounding leaves of a flux waits at the face between two widths.
///
/// Scenes with solid fraction: the schemes advance the share x = phi / c (fv/grid.hpp); what comes out is c x
/// (CellOutput). Several fluxes, open or periodic ends, and fluxes that do not vanish at the ends of their
/// range or have several extrema or none are left to the plain march (fv/plain_march.hpp): godunov and
/// engquist-osher only, without local steps. There dt is shortened to end at the times where a state outside
/// changes, (1) and (2) hold as above, and t = infinity is, but for walls, a march until nothing changes by
/// more than 2^-50.
///
/// Outcomes: unsupported (no cells or too many, cfl outside (0, 1], a flux with other than one
/// extremum between cells of unequal rate or solid_fraction),
/// interrupted (options.progress said so), not_converged (the rates differ so much that rounding stopped the
/// slow cells; no rest after 1000 steps per cell), budget_reached (1e15 cell updates).
/// Cost: cells * (t / dt) cell updates, with local steps each cell by its own dt; tests/bench/fv_bench.cpp.
/// The plain march, and kernels where c varies from cell to cell, take about 25 times as long per update.
/// Memory: 56 bytes per cell, 72 for muscl; 66 more where cells or steps differ; 32 per cell of a profile.
[[nodiscard]] std::unique_ptr<shearfront::Run> start(Scheme scheme, const Scene<double>& scene, SolverOptions options);
[[nodiscard]] std::string refusal(Scheme scheme, const Scene<double>& scene, const SolverOptions& options);

/// By the plain march and a rule of its own (fv/plain_march.hpp), whatever the scene.
[[nodiscard]] std::unique_ptr<shearfront::Run> start(FaceRule rule, const Scene<double>& scene, SolverOptions options);
[[nodiscard]] std::string refusal(FaceRule rule, const Scene<double>& scene, const SolverOptions& options);

/// The same with a flux and a kernel of the caller's choice, in place of the scene's flux.
[[nodiscard]] std::unique_ptr<shearfront::Run> start(Scheme scheme, const UnimodalFlux& flux,
                                                     std::shared_ptr<const Kernel> kernel, const Scene<double>& scene,
                                                     SolverOptions options);

}  // namespace shearfront::fv
