// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/mixing.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/solution/share_integral.hpp"

namespace shearfront {

double entropy_of_share(double x) {
  if (!(x > 0 && x < 1)) return 0;
  return -x * std::log(x) - (1 - x) * std::log1p(-x);
}

ShareFunction entropy_function() {
  // A pure state is taken to stay pure: its slope, which is infinite, does not count.
  return {entropy_of_share, {}, [](double x) { return x > 0 && x < 1 ? std::log1p(-x) - std::log(x) : 0.0; }};
}

Mixing mixing(double entropy, double amount, double solid) {
  Mixing mixing;
  mixing.entropy = entropy;
  mixing.mixed = entropy_of_share(amount / solid) * solid;
  mixing.parameter = mixing.mixed > 0 ? std::min(mixing.entropy / mixing.mixed, 1.0) : 0;
  return mixing;
}

Mixing mixing(const Scene<double>& scene, const Profile<double>& profile) {
  return mixing(share_integral(scene, profile, entropy_function()), profile.mass(),
                scene.solid(profile.z().front(), profile.z().back()));
}

}  // namespace shearfront
