// SPDX-License-Identifier: BSD-3-Clause
// Compiled against a copy of the library in which the flux that docs/tutorials/extending.md adds is listed: what follows
// from the list by itself. Nothing here but the name, its argument, knows of that flux.
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "follows.hpp"
#include "oracles/verify.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/track/setup.hpp"
#include "shearfront/track/unimodal_grid.hpp"
#include "support/flux_scenes.hpp"

namespace {

using namespace shearfront;

/// A jam that dissolves over a change of the speed limit.
template <class F>
SceneSpec<double> road(const F& flux) {
  SceneSpec<double> spec;
  spec.fluxes = {flux};
  spec.shear_rate = Piecewise<double>{{0.6}, {2, 1}};
  spec.initial_breaks = {0.2, 0.5};
  spec.initial_values = {0.25, 1, 0.125};
  return spec;
}

/// L1 distance of front tracking from a Godunov scheme on n cells at t = 0.3; negative if a law is broken.
double distance(const Scene<double>& scene, std::size_t n) {
  constexpr double t = 0.3;
  const TrackingSetup<double, UnimodalGrid<double>> setup(scene, 1e-3);
  Tracker<UnimodalGrid<double>> tracker(setup);
  tracker.advance_to(t);
  if (!verify(tracker, 1e-12, 1e-9).empty() || std::abs(tracker.mass() - scene.mass()) > 1e-12) return -1;
  const std::vector<double> cells = support::godunov_any_scene(scene, t, n);
  std::vector<double> z;
  for (std::size_t j = 0; j <= n; ++j) z.push_back(static_cast<double>(j) / static_cast<double>(n));
  return l1_distance(tracker.profile(), Profile<double>(z, cells, cells));
}

}  // namespace

int main(int, char** argv) {
  bool is_found = false, is_good = true;
  FluxList<double>::for_each([&]<class F>() {
    if (F::kName != std::string_view(argv[1])) return;
    is_found = true;
    for (const F& flux : F::samples()) {
      const Scene<double> scene(road(flux));
      const double coarse = distance(scene, 200), fine = distance(scene, 1600);
      std::printf("front tracking against Godunov: %.2e on 200 cells, %.2e on 1600\n", coarse, fine);
      is_good = is_good && fine >= 0 && fine < 0.005 && fine < 0.35 * coarse;
      SceneSpec<double> queue = road(flux);  // whose states can be moved to both sides
      queue.initial_values[1] = 0.875;
      is_good = docs::derivatives_are_differences(queue, "exact") && is_good;
      is_good = docs::is_recovered(road(flux), "flux.", 1.3, "exact") && is_good;
      is_good = docs::is_recovered(road(flux), "shear_rate.values", 1.3, "exact") && is_good;
    }
  });
  return is_found && is_good ? 0 : 1;
}
