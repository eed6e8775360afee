// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "shearfront/digits/real110.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/scene/entries.hpp"
#include "soak/laws.hpp"
#include "support/scene_cast.hpp"

namespace shearfront::soak {
namespace {

// Of lengths, times and parameters: small enough for kinks and shocks to be missed and for third derivatives
// of 1e30 not to count, large enough for 50 digits.
constexpr double kStep = 1e-20;

void check_slopes(const ExactSolution<Real110>& solution, const Real110& z, const Real110& t,
                  Findings& findings) {
  const Scene<Real110>& scene = solution.scene();
  const Real110 height = scene.top() - scene.bottom(), h = kStep * height, dt = kStep * t;
  const auto value = solution.at(z, t);
  const Real110 slope = (solution.M(z + h, t) - solution.M(z - h, t)) / (2 * h),
                growth = (solution.M(z, t + dt) - solution.M(z, t - dt)) / (2 * dt);
  findings.expect_near(to_double(value.phi), to_double(slope), 1e-8, "exact: phi = dM/dz",
                       [&] { return at(to_double(z), to_double(t)); });
  findings.expect_near(to_double(Real110(value.H * t / height)), to_double(Real110(growth * t / height)),
                       1e-8 * (1 + to_double(Real110(value.H * t / height))), "exact: H = dM/dt",
                       [&] { return at(to_double(z), to_double(t)); });
}

struct PhiM {
  Real110 phi, M;
};

/// Second-order difference quotient, one-sided where a state would leave [0, 1].
PhiM quotient(const ExactSolution<Real110>& solution, std::size_t entry, const Real110& step, bool is_state,
              const Real110& z, const Real110& t) {
  SceneSpec<Real110> spec = solution.scene().spec();
  const Real110 here = *entry_places(spec)[entry];
  const auto moved = [&](int steps) {
    SceneSpec<Real110> copy = spec;
    *entry_places(copy)[entry] = here + step * steps;
    const auto value = ExactSolution<Real110>(Scene<Real110>(copy), {solution.n_layers()}).at(z, t);
    return PhiM{value.phi, value.M};
  };
  if (is_state && (here == 0 || here == 1)) {
    const int sign = here == 0 ? 1 : -1;
    const PhiM a = moved(0), b = moved(sign), c = moved(2 * sign);
    const Real110 width = 2 * step * sign;
    return {(4 * b.phi - 3 * a.phi - c.phi) / width, (4 * b.M - 3 * a.M - c.M) / width};
  }
  const PhiM a = moved(-1), b = moved(1);
  return {(b.phi - a.phi) / (2 * step), (b.M - a.M) / (2 * step)};
}

void check_derivatives(const ExactSolution<Real110>& solution, support::SceneMaker& make, const Real110& z,
                       const Real110& t, Findings& findings) {
  constexpr int kParameters = 3;
  const auto exact = Derivatives<Real110>(solution).at(z, t);
  const SceneSpec<Real110>& spec = solution.scene().spec();
  const Real110 height = spec.top - spec.bottom;
  const std::vector<Entry> all = entries(spec);
  findings.expect(exact.value.M == solution.M(z, t), "derivatives: M is that of the solution",
                  [&] { return at(to_double(z), to_double(t)); });
  for (int k = 0; k < kParameters; ++k) {
    const auto i = static_cast<std::size_t>(make.integer(0, static_cast<int>(all.size()) - 1));
    if (!derivative_refusal(solution.scene(), all[i]).empty()) continue;
    const Real110 &dM = exact.M[i], &dphi = exact.phi[i];
    SceneSpec<Real110> copy = spec;
    const bool is_state = all[i].field == "initial.values", is_height = all[i].field.ends_with(".breaks");
    const Real110 unit = is_state ? Real110(1) : is_height ? height : *entry_places(copy)[i];
    const PhiM numeric = quotient(solution, i, kStep * unit, is_state, z, t);
    const auto where = [&] { return "d/d " + all[i].name() + " at " + at(to_double(z), to_double(t)); };
    const double M_size = to_double(Real110(dM * unit / height)), phi_size = to_double(Real110(dphi * unit));
    findings.expect_near(M_size, to_double(Real110(numeric.M * unit / height)), 1e-8 * (1 + std::abs(M_size)),
                         "derivatives: dM against differences", where);
    findings.expect_near(phi_size, to_double(Real110(numeric.phi * unit)), 1e-8 * (1 + std::abs(phi_size)),
                         "derivatives: dphi against differences", where);
  }
}

/// t* in double: M is final by then up to its rounding (64 u of the height are taken for a tie), and it does
/// not come after the true t* by more than that amount needs, at the growth H just before.
void check_steady_time(const Bed& bed, const ExactSolution<Real110>& solution, Findings& findings) {
  const auto t_star = exact_timeline(bed.layered).t_star;
  const auto oracle = exact_timeline(solution.scene()).t_star;
  if (!t_star || !oracle || *oracle == 0) return;
  const double slack = bed.M_rounding() + 64 * unit_roundoff<double>() * bed.trial.height();
  const Real110 final_M = solution.mass(), after = *t_star * (1 + bed.t_rounding()),
                missing = final_M - solution.M(solution.steady_height(), after);
  findings.expect_between(to_double(missing), 0, 0, slack, "exact: M is final at t*",
                          [&] { return number_text(*t_star); });
  const Real110 before = *oracle * Real110("0.999999999999");
  const double t = to_double(*oracle), H = to_double(solution.H(solution.steady_height(), before));
  if (H > 0)
    findings.expect_between(*t_star, 0, t, bed.t_rounding() * t + slack / H,
                            "exact: t* in double and in 50 digits", [&] { return "H = " + number_text(H); });
}

}  // namespace

void check_exact_in_50_digits(const Bed& bed, Findings& findings) {
  const std::size_t size = bed.stack.n_layers() + bed.scene.initial_values().size();
  if (size > 24 ? bed.trial.seed % 32 != 0 : bed.trial.seed % 2 != 0) return;
  ++findings.n_runs;
  support::SceneMaker make(bed.trial.seed + 2);
  const bool is_smooth = std::holds_alternative<Exponential<double>>(bed.scene.shear_rate());
  const Scene<double>& scene = is_smooth ? bed.scene : bed.layered;
  const ExactSolution<double>& in_double = is_smooth ? bed.exact : bed.layered_exact;
  const ExactSolution<Real110> solution(scene_cast<Real110>(scene));
  for (const double t : {bed.trial.early, bed.trial.late}) {
    const double z = make.uniform(scene.bottom(), scene.top());
    if (!(z > scene.bottom() && z < scene.top())) continue;
    findings.expect_between(in_double.M(z, t), to_double(solution.M(z, t * (1 - bed.t_rounding()))),
                            to_double(solution.M(z, t * (1 + bed.t_rounding()))), bed.M_rounding(),
                            "exact: M in double and in 50 digits", [&] { return at(z, t); });
    check_slopes(solution, z, t, findings);
    if (bed.trial.is_generic && t == bed.trial.late && scene.is_layered() == bed.scene.is_layered())
      check_derivatives(solution, make, z, t, findings);
  }
  if (!is_smooth && size <= 12) check_steady_time(bed, solution, findings);
}

}  // namespace shearfront::soak
