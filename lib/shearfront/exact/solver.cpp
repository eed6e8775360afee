// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/solver.hpp"

#include <algorithm>
#include <chrono>

#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_share_integral.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"

namespace shearfront {

namespace {

void check_request(const Scene<double>& scene, const SolverRequest& request) {
  Complaints complaints;
  for (std::size_t i = 0; i < request.times.size(); ++i)
    if (!(request.times[i] >= 0))
      complaints.push_back({"times[" + std::to_string(i) + "]", number_text(request.times[i]), "must be >= 0"});
  for (std::size_t i = 0; i < request.heights.size(); ++i)
    if (!(request.heights[i] >= scene.bottom() && request.heights[i] <= scene.top()))
      complaints.push_back({"depths[" + std::to_string(i) + "]", number_text(request.heights[i]),
                          "must be inside the domain [" + number_text(scene.bottom()) + ", " +
                              number_text(scene.top()) + "]"});
  if (!complaints.empty()) throw InputError(std::move(complaints));
}

}  // namespace

SolverResult ExactSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                const SolverOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  check_request(scene, request);
  SolverResult result;
  if (std::string reason = exact::refusal(scene); !reason.empty()) {
    result.summary.status = Status::unsupported;
    result.summary.message = std::move(reason);
    return result;
  }
  const ExactSolution<double> solution(scene, {options.layers});
  result.summary.layers = solution.n_layers();
  result.summary.status = Status::ok;
  result.summary.message = "exact to rounding";
  double worst_M = 0;
  result.samples.reserve(request.times.size() * request.heights.size());
  for (const double t : request.times) {
    if (options.progress && !options.progress(t, 0)) {
      result.summary.status = Status::interrupted;
      result.summary.message = "interrupted at t = " + number_text(t);
      result.samples.clear();
      result.integrals.clear();
      break;
    }
    for (const double z : request.heights) {
      const auto value = solution.at(z, t);
      result.samples.push_back({value.phi, value.M});
      worst_M = std::max(worst_M, value.M_error);
    }
    if (request.integrand) result.integrals.push_back(share_integral(solution, t, request.integrand));
  }
  if (result.summary.usable() && request.timeline)
    result.timeline = exact_timeline(scene, {.layers = options.layers});
  if (result.summary.usable() && !solution.is_exact())
    result.summary.message = "exact for a staircase of " + std::to_string(solution.n_layers()) +
                             " layers; estimated error of M " + number_text(worst_M);
  result.summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace shearfront
