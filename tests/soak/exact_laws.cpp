// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "shearfront/exact/events.hpp"
#include "soak/laws.hpp"

namespace shearfront::soak {
namespace {

void check_profile(const Bed& bed, double t, Findings& findings) {
  const auto& exact = bed.exact;
  const double bottom = bed.scene.bottom(), top = bed.scene.top(), m = exact.mass(), slack = bed.M_rounding();
  double z0 = bottom, M0 = 0;
  for (const double z : bed.heights) {
    const auto value = exact.at(z, t);
    const auto where = [&] { return at(z, t); };
    findings.expect(value.phi >= 0 && value.phi <= 1, "exact: phi in [0, 1]",
                    [&] { return number_text(value.phi) + " at " + at(z, t); });
    findings.expect(value.H >= 0 && std::isfinite(value.H), "exact: H >= 0",
                    [&] { return number_text(value.H) + " at " + at(z, t); });
    findings.expect_between(value.M, std::max(0.0, m - (top - z)), std::min(z - bottom, m), slack,
                            "exact: M between its bounds", where);
    findings.expect_between(value.M - M0, 0, z - z0, slack, "exact: M monotone and 1-Lipschitz in z", where);
    const double rate = bed.scene.scale() * bed.scene.shear_rate_at(z);
    // phi to a few u: H / rate to as many.
    if (t > 0 && std::isfinite(t) && z < top)
      findings.expect_near(value.H / rate, value.phi * (1 - value.phi), 1e-13, "exact: H = s a phi (1 - phi)",
                           where);
    z0 = z, M0 = value.M;
  }
  findings.expect(exact.M(bottom, t) == 0 && exact.M(top, t) == m, "exact: M at the walls",
                  [&] { return at(top, t); });
}

void check_growth(const Bed& bed, Findings& findings) {
  for (const double z : bed.heights) {
    double last = 0;
    for (const double t : bed.times) {
      const double M = bed.exact.M(z, t);
      findings.expect_between(M, last, infinity<double>(), bed.M_rounding(), "exact: M grows with t",
                              [&] { return at(z, t); });
      last = M;
    }
    findings.expect_near(last, std::min(z - bed.scene.bottom(), bed.exact.mass()), bed.M_rounding(),
                         "exact: steady state", [&] { return at(z, infinity<double>()); });
  }
}

void check_scaling(const Bed& bed, Findings& findings) {
  SceneSpec<double> spec = bed.scene.spec();
  const double factor = std::ldexp(1.0, static_cast<int>(bed.trial.seed % 41) - 20);
  spec.scale *= factor;
  const ExactSolution<double> scaled(Scene<double>(spec), {bed.exact.n_layers()});
  const ExactSolution<double> plain(bed.scene, {bed.exact.n_layers()});
  for (const double z : bed.heights) {
    const auto a = plain.at(z, bed.trial.late), b = scaled.at(z, bed.trial.late / factor);
    findings.expect(a.M == b.M && a.phi == b.phi, "exact: scaling by powers of two",
                    [&] { return at(z, bed.trial.late); });
  }
}

/// z -> bottom + top - z, phi -> 1 - phi. Every interface and jump is moved by a rounding of the largest
/// height; M is 1-Lipschitz in each (envelope theorem).
void check_reflection(const Bed& bed, Findings& findings) {
  if (!bed.scene.is_layered()) return;
  SceneSpec<double> mirror = upside_down(bed.scene.spec());
  if (!find_complaints(mirror).empty()) return;  // heights an ulp apart have become one
  const ExactSolution<double> mirrored{Scene<double>(std::move(mirror))};
  const double n_moved = static_cast<double>(bed.stack.n_layers() + bed.scene.initial_values().size()),
               slack =
                   2 * bed.M_rounding() + 4 * unit_roundoff<double>() * n_moved * bed.trial.largest_height();
  for (const double z : bed.heights) {
    const double reflected = bed.scene.bottom() + (bed.scene.top() - z);
    for (const double t : {bed.trial.early, bed.trial.late}) {
      const double M = (z - bed.scene.bottom()) - (mirrored.mass() - mirrored.M(reflected, t));
      findings.expect_near(bed.exact.M(z, t), M, slack, "exact: upside down", [&] { return at(z, t); });
    }
  }
}

/// Larger data: M stays larger, and the distance is largest at the top.
void check_comparison(const Bed& bed, Findings& findings) {
  support::SceneMaker make(bed.trial.seed + 1);
  SceneSpec<double> spec = bed.layered.spec();
  for (double& phi : spec.initial_values) phi = std::min(1.0, phi + make.uniform(0, 0.3));
  const ExactSolution<double> larger{Scene<double>(spec)};
  const double gap = larger.mass() - bed.layered_exact.mass();
  for (const double z : bed.heights)
    for (const double t : {bed.trial.early, bed.trial.late})
      findings.expect_between(larger.M(z, t) - bed.layered_exact.M(z, t), 0, gap, 2 * bed.M_rounding(),
                              "exact: comparison and contraction of M", [&] { return at(z, t); });
}

/// The solution at `early`, averaged over n cells, as new data: that moves M by at most height / (4 n), and
/// the maximum of |M - M'| never grows.
void check_semigroup(const Bed& bed, Findings& findings) {
  constexpr int kCells = 100;
  if (bed.trial.seed % 8 != 0 || bed.stack.n_layers() > 10) return;
  SceneSpec<double> spec = bed.layered.spec();
  spec.initial_breaks.clear(), spec.initial_values.clear();
  double M = 0, z = spec.bottom;
  for (int i = 1; i <= kCells; ++i) {
    const double end = i == kCells ? spec.top : spec.bottom + bed.trial.height() * (double(i) / kCells),
                 next = bed.layered_exact.M(end, bed.trial.early);
    if (i < kCells) spec.initial_breaks.push_back(end);
    spec.initial_values.push_back(std::clamp((next - M) / (end - z), 0.0, 1.0));
    M = next, z = end;
  }
  if (!find_complaints(spec).empty()) return;  // a domain far from 0 that has no 100 distinct heights
  const ExactSolution<double> restarted{Scene<double>(spec)};
  const double slack = bed.trial.height() / (4 * kCells) + 2 * kCells * bed.M_rounding();
  for (const double height : bed.heights)
    findings.expect_near(restarted.M(height, bed.trial.late - bed.trial.early),
                         bed.layered_exact.M(height, bed.trial.late), slack, "exact: semigroup",
                         [&] { return at(height, bed.trial.late); });
}

/// M is final from t* on.
void check_steady_time(const Bed& bed, Findings& findings) {
  const auto timeline = exact_timeline(bed.layered);
  findings.expect(timeline.t_star && *timeline.t_star >= 0 && std::isfinite(*timeline.t_star),
                  "exact: t* is a time", [] { return std::string("t*"); });
  if (!timeline.t_star || *timeline.t_star == 0) return;
  const double after = *timeline.t_star * (1 + bed.t_rounding());
  for (const double z : bed.heights)
    findings.expect_near(bed.layered_exact.M(z, after), bed.layered_exact.M(z, infinity<double>()),
                         bed.M_rounding(), "exact: steady after t*", [&] { return at(z, after); });
}

/// A staircase is slower than the bed times `slower` nowhere, and faster than it times `faster` nowhere; so
/// is its M, which comes no sooner than in the faster bed.
void check_staircase(const Bed& bed, Findings& findings) {
  if (bed.scene.is_layered()) return;
  for (const double z : bed.heights)
    for (const double t : {bed.trial.early, bed.trial.late})
      findings.expect_between(bed.layered_exact.M(z, t),
                              bed.exact.M(z, t * bed.slower * (1 - bed.t_rounding())),
                              bed.exact.M(z, t * bed.faster * (1 + bed.t_rounding())), 2 * bed.M_rounding(),
                              "exact: staircase against smooth rate", [&] { return at(z, t); });
}

}  // namespace

void check_exact(const Bed& bed, Findings& findings) {
  ++findings.n_runs;
  for (const double t : bed.times) check_profile(bed, t, findings);
  check_growth(bed, findings);
  check_scaling(bed, findings);
  check_reflection(bed, findings);
  check_comparison(bed, findings);
  check_semigroup(bed, findings);
  check_steady_time(bed, findings);
  check_staircase(bed, findings);
}

}  // namespace shearfront::soak
