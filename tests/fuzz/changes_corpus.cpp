// SPDX-License-Identifier: BSD-3-Clause
#include "target.hpp"

namespace shearfront::fuzz {

std::vector<std::string> corpus() {
  return {"shear_rate.values[1]=0.4",       "shear_rate.scale=2\ninitial.breaks[0]=0.3",
          "flux.gamma=0.25\ndiffusion.D=0", "shear_rate.decay=0.5\nboundary.bottom.values[1]=0.25",
          "domain.bottom=-2\ndomain.top=3", "initial.mean=0.25\nshear_rate.z[1]=0.5"};
}

std::vector<std::string> words() {
  return {"=",
          ".",
          "[",
          "]",
          "[0]",
          "[1]",
          "[18446744073709551616]",
          "[-1]",
          "\n",
          "values",
          "1e400",
          "-inf",
          "nan",
          "1e-320",
          "0x1p3",
          "-0",
          "0.5",
          "1_0",
          "flux.",
          "initial.values[0]=2\n",
          "shear_rate.breaks[0]=1\n",
          "shear_rate.amplitude=",
          "initial.amplitude=",
          std::string("\0", 1),
          "\xff",
          "\xe2\x80\xae"};
}

}  // namespace shearfront::fuzz
