// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/flux_motion.hpp"
#include "shearfront/track/state_motion.hpp"

namespace shearfront {

StateTangent StateMotion<OneLayerGrid<double>>::tangent(const SceneTangent& by) const {
  const Grid& grid = of_.grid;
  const std::size_t n = rows_.n();
  const Flux<Dual<1>>& flux = by.fluxes[of_.stack.flux_index(0)];
  const track_detail::FluxPlaces places(flux);
  const Dual<1> rate(of_.stack.rate(0), by.rate[0]),
      fraction(of_.stack.solid_fraction(0), by.solid_fraction[0]);
  const track_detail::FluxMotion motion{grid.flux_, track_detail::moving_flux_of(by, of_.stack.flux_index(0)),
                                        (rate * fraction).v, (rate * fraction).d[0]};
  std::vector<double> share(n, 0.0);
  std::vector<bool> is_special(n);
  Tears tears;
  const auto give = [&](State i, double dx) {
    const auto at = static_cast<std::size_t>(i);
    if (is_special[at]) tears.compare(dx, share[at]);
    tears.see(dx);
    share[at] = dx;
    is_special[at] = true;
  };
  give(0, places.range.lowest.d[0]);
  give(static_cast<State>(n) - 1, places.range.highest.d[0]);
  for (std::size_t i = 0; i < grid.extrema_.size(); ++i) give(grid.extrema_[i], places.extrema[i].d[0]);
  for (const State i : grid.zeros_) {
    // Where f is 0: it moves by -df / f', at an end or an extremum with that, or not at all.
    const double x = grid.polygon_.share(i), slope = grid.flux_.derivative(x),
                 df = flux.value(Dual<1>(x, 0.0)).d[0];
    if (is_special[static_cast<std::size_t>(i)]) {
      const double total = motion(x, share[static_cast<std::size_t>(i)]) / motion.strength;
      if (slope != 0) give(i, share[static_cast<std::size_t>(i)] - total / slope);
    } else {
      give(i, df != 0 ? -df / slope : 0);
    }
  }
  for (std::size_t w = 0; w < of_.wanted.size(); ++w) give(of_.states[w], by.wanted[w]);
  for (std::size_t lo = 0, hi = 0; lo + 1 < n; lo = hi) {
    for (hi = lo + 1; !is_special[hi]; ++hi) continue;
    const auto place = [&](std::size_t i) { return grid.polygon_.share(static_cast<State>(i)); };
    for (std::size_t i = lo + 1; i < hi; ++i)
      share[i] = share[lo] + (share[hi] - share[lo]) * ((place(i) - place(lo)) / (place(hi) - place(lo)));
  }
  StateTangent all;
  all.is_torn = tears.are_any();
  for (std::size_t i = 0; i < n; ++i) {
    const double x = grid.polygon_.share(static_cast<State>(i));
    all.phi.push_back(fraction.d[0] * x + fraction.v * share[i]);
    all.flux.push_back(motion(x, share[i]));
  }
  for (const State i : grid.zeros_) all.flux[static_cast<std::size_t>(i)] = 0;
  return all;
}

double StateMotion<OneLayerGrid<double>>::fan_rate(const SceneTangent& by, const StateTangent& states,
                                                   std::size_t layer, State l, State r) const {
  return track_detail::SharesTangent(of_, rows_, by, states.phi, layer, l, r).fan_rate();
}

double StateMotion<OneLayerGrid<double>>::speed(const SceneTangent& by, const StateTangent& states,
                                                std::size_t layer, State l, State r) const {
  return track_detail::SharesTangent(of_, rows_, by, states.phi, layer, l, r).speed();
}

}  // namespace shearfront
