// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/share_integral.hpp"

#include <cmath>
#include <variant>
#include <vector>

#include "shearfront/numeric/quadrature.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront {
namespace {

/// phi over [lo, hi] without a knot of c, linear between its ends.
struct SharePiece {
  double lo, hi, phi_lo, phi_hi;
};

double integral_of(const Scene<double>& scene, const SharePiece& piece, const ShareFunction& g) {
  const double width = piece.hi - piece.lo;
  const auto phi_at = [&](double z) {
    return piece.phi_lo + (piece.phi_hi - piece.phi_lo) * ((z - piece.lo) / width);
  };
  const bool is_layered = is_constant_in_pieces<double>(scene.spec().solid_fraction);
  const double mean = scene.mean_solid_fraction(piece.lo, piece.hi);
  if (is_layered && piece.phi_lo == piece.phi_hi) return g.value(piece.phi_lo / mean) * (mean * width);
  constexpr unsigned kMostHalvings = 5;
  constexpr double kTolerance = 1e-10;
  return integral_of_smooth<double>(
      [&](double z) {
        const double c = is_layered ? mean : scene.solid_fraction_at(z);
        return g.value(phi_at(z) / c) * c;
      },
      piece.lo, piece.hi, kMostHalvings, kTolerance);
}

}  // namespace

double share_integral(const Scene<double>& scene, const Profile<double>& profile, const ShareFunction& g) {
  std::vector<double> knots;
  if (scene.spec().solid_fraction)
    knots = std::visit([](const auto& model) { return model.knots(); }, *scene.spec().solid_fraction);
  CompensatedSum<double> sum;
  std::size_t next = 0;
  for (std::size_t i = 0; i < profile.n_cells(); ++i) {
    const double begin = profile.z()[i], end = profile.z()[i + 1];
    if (!(end > begin)) continue;
    const auto phi = [&](double z) {
      const double below = profile.below()[i], above = profile.above()[i];
      return below == above ? below : below + (above - below) * ((z - begin) / (end - begin));
    };
    while (next < knots.size() && knots[next] <= begin) ++next;
    double lo = begin;
    for (; next < knots.size() && knots[next] < end; ++next) {
      sum += integral_of(scene, {lo, knots[next], phi(lo), phi(knots[next])}, g);
      lo = knots[next];
    }
    sum += integral_of(scene, {lo, end, phi(lo), phi(end)}, g);
  }
  return sum.value();
}

}  // namespace shearfront
