#include <cstdio>

#include "shearfront/exact/events.hpp"
#include "shearfront/io/scene_file.hpp"

int main(int, char** argv) {
  const auto scene = shearfront::read_scene<double>(argv[1]);
  const auto times = shearfront::exact_timeline(scene);
  std::printf("first wave at the bottom %.12g, at the top %.12g\n", times.t0.value(), times.t1.value());
  for (const auto& at : times.interfaces)
    std::printf("interface z = %g: first %.12g, last %.12g\n", at.z, at.first.value(), at.last.value());
  std::printf("steady after %.12g\n", times.t_star.value());
}
