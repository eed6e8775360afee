// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/mixing.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <variant>
#include <vector>

#include "shearfront/numeric/sum.hpp"

namespace shearfront {
namespace {

/// int e(x) c dz over [lo, hi] without a knot of c, phi linear from phi_lo to phi_hi.
double entropy_of_piece(const Scene<double>& scene, double lo, double hi, double phi_lo, double phi_hi) {
  const double mean = scene.mean_packing(lo, hi);
  const bool is_layered =
      !scene.spec().packing ||
      std::visit([](const auto& model) { return model.kIsLayered; }, *scene.spec().packing);
  if (is_layered && phi_lo == phi_hi) return entropy_of_share(phi_lo / mean) * (mean * (hi - lo));
  const double middle = lo + (hi - lo) / 2, half = (hi - lo) / 2;
  return half * boost::math::quadrature::gauss<double, 7>::integrate(
                    [&](double u) {
                      const double c = scene.packing_at(middle + half * u);
                      const double phi = phi_lo + (phi_hi - phi_lo) * ((1 + u) / 2);
                      return entropy_of_share(phi / c) * c;
                    },
                    -1.0, 1.0);
}

}  // namespace

double entropy_of_share(double x) {
  if (!(x > 0 && x < 1)) return 0;
  return -x * std::log(x) - (1 - x) * std::log1p(-x);
}

Mixing mixing(const Scene<double>& scene, const Profile<double>& profile) {
  std::vector<double> knots;
  if (scene.spec().packing)
    knots = std::visit([](const auto& model) { return model.knots(); }, *scene.spec().packing);
  CompensatedSum<double> entropy;
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
      entropy += entropy_of_piece(scene, lo, knots[next], phi(lo), phi(knots[next]));
      lo = knots[next];
    }
    entropy += entropy_of_piece(scene, lo, end, phi(lo), phi(end));
  }
  const double solid = scene.solid(profile.z().front(), profile.z().back());
  Mixing mixing;
  mixing.entropy = entropy.value();
  mixing.mixed = entropy_of_share(profile.mass() / solid) * solid;
  mixing.parameter = mixing.mixed > 0 ? std::min(mixing.entropy / mixing.mixed, 1.0) : 0;
  return mixing;
}

}  // namespace shearfront
