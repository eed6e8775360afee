#include <cstdio>

#include "shearfront/shearfront.hpp"

int main(int, char** argv) {
  const auto scene = shearfront::read_scene(argv[1]);
  const auto times = shearfront::event_times(scene);
  std::printf("waves: %zu interface, bottom %.12g, top %.12g; at rest from %.12g\n", times.interfaces.size(),
              times.t0.value(), times.t1.value(), times.t_star.value());
  const auto exact = shearfront::solve(scene, "exact", {.times = {2.5}, .heights = {0.25, 0.75}});
  std::printf("at t = 2.5: phi(0.25) = %.12g, M(0.75) = %.12g\n", exact.phi(0, 0), exact.M(0, 1));
  auto bed = shearfront::track(scene, {.resolution = 0.01, .history = true});
  auto finer = shearfront::track(scene, {.resolution = 0.001});
  bed.advance(2.5), finer.advance(2.5);
  std::printf("%zu fronts and %zu collisions, L1 distance to a finer resolution %.1e\n", bed.fronts().size(),
              bed.collisions().size(), shearfront::l1_distance(bed.profile(), finer.profile()));
}
