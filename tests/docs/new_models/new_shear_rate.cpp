// SPDX-License-Identifier: BSD-3-Clause
// Compiled against a copy of the library in which the shear rate that docs/tutorials/extending.md adds is listed: what
// follows from the list by itself. Nothing here but the name, its argument, knows of that shear rate.
#include <string_view>

#include "follows.hpp"

int main(int, char** argv) {
  using namespace shearfront;
  bool is_found = false, is_good = true;
  DepthFunctionList<double>::for_each([&]<class A>() {
    if (A::kName != std::string_view(argv[1])) return;
    is_found = true;
    for (const A& rate : A::samples()) {
      SceneSpec<double> bed;
      bed.shear_rate = rate;
      bed.top = 0.96875;  // no knot halfway: the bed is not symmetric
      bed.initial_breaks = {0.21875, 0.65625};
      bed.initial_values = {0.3125, 0.90625, 0.125};
      Method exact("exact");
      exact.set("layers", std::uint64_t{7});
      is_good = docs::derivatives_are_differences(bed, exact) && is_good;
      exact.set("layers", std::uint64_t{64});
      is_good = docs::is_recovered(bed, "shear_rate.", 1.1, exact) && is_good;
    }
  });
  return is_found && is_good ? 0 : 1;
}
