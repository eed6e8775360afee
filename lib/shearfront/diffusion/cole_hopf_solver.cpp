// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_solver.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <chrono>

#include "shearfront/diffusion/closed_form.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

/// int g(phi) dz over the bed, c = 1: phi is analytic for t > 0.
double integral_of(const diffusion::ClosedForm& form, const Scene<double>& scene, double t,
                   const ShareFunction& g) {
  constexpr unsigned kMostHalvings = 12;
  constexpr double kTolerance = 1e-11;
  return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
      [&](double z) { return g.value(form(z, t).phi); }, scene.bottom(), scene.top(), kMostHalvings,
      kTolerance);
}

}  // namespace

SolverResult ColeHopfSolver::solve(const Scene<double>& scene, const SolverRequest& request,
                                   const SolverOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  SolverResult result;
  const auto found = diffusion::closed_form(scene);
  if (const auto* why = std::get_if<std::string>(&found)) {
    result.summary.status = Status::unsupported;
    result.summary.message = *why;
    return result;
  }
  const auto& form = std::get<diffusion::ClosedForm>(found);
  result.summary.status = Status::ok;
  result.summary.message = "exact to rounding";
  for (const double t : request.times) {
    if (options.progress && !options.progress(t, 0)) {
      result.summary.status = Status::interrupted;
      result.summary.message = "interrupted at t = " + number_text(t);
      result.samples.clear(), result.integrals.clear();
      break;
    }
    for (const double z : request.heights) {
      const diffusion::ClosedFormValue at = form(z, t);
      result.samples.push_back({at.phi, at.M});
    }
    if (request.integrand) result.integrals.push_back(integral_of(form, scene, t, request.integrand));
  }
  result.summary.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace shearfront
