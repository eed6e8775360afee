// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/track/tracker.hpp"

namespace shearfront {

/// Linear reconstruction of a front-tracking solution: fans joined through the midpoints of their fronts.
///
/// A front between grid states p, q moves with the secant of the flux, f'((p + q)/2) up to O((q - p)^2), and exactly
/// so for parabolas: in the layer where a fan starts the point (z_front, (p + q)/2) lies on the true fan, and joining
/// these points gives it back. Beside a fan step of height d the true solution is a ramp that holds delta =
/// d |d| |dz/dphi| / 8 more below the front and delta less above it than the steps do: these two triangles are put in
/// on both sides of every step, cut off where a shock or an interface is nearer. Guaranteed: M at walls, interfaces
/// and shocks is that of the steps (conservative); phi stays between the neighbouring states; exact for fans of
/// parabolas in their first layer up to the cells next to a shock; second order in L1 elsewhere, where the steps are
/// first order. Cost: O(fronts).
template <class AnyTracker>
[[nodiscard]] Profile<typename AnyTracker::Scalar> linear_profile(const AnyTracker& tracker) {
  using Scalar = typename AnyTracker::Scalar;
  const auto snapshot = tracker.snapshot();
  const auto& grid = tracker.grid();
  const std::size_t n_cells = snapshot.state.size();
  std::vector<Scalar> phi(n_cells), width(n_cells);
  for (std::size_t i = 0; i < n_cells; ++i) {
    phi[i] = grid.phi(snapshot.layer[i], snapshot.state[i]);
    width[i] = snapshot.z[i + 1] - snapshot.z[i];
  }
  // Of the front at z[i]: height of the step and the area its ramps exchange.
  std::vector<Scalar> step(n_cells + 1, Scalar(0)), delta(n_cells + 1, Scalar(0));
  for (std::size_t i = 1; i < n_cells; ++i)
    if (snapshot.is_front[i] && grid.is_fan_step(snapshot.layer[i], snapshot.state[i - 1], snapshot.state[i]))
      step[i] = phi[i] - phi[i - 1];
  const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
  const auto are_of_one_fan = [&](std::size_t i, std::size_t k) {
    return step[i] != 0 && step[k] != 0 && (step[i] > 0) == (step[k] > 0);
  };
  for (std::size_t i = 1; i < n_cells; ++i) {
    if (step[i] == 0) continue;
    // dz/dphi from the neighbouring steps; the smaller one where a fan borders on a plateau. A step without
    // neighbours has spread since its birth.
    Scalar spread = infinity<Scalar>();
    if (are_of_one_fan(i - 1, i))
      spread = std::min(spread, Scalar(Scalar(2) * width[i - 1] / size(step[i - 1] + step[i])));
    if (are_of_one_fan(i, i + 1))
      spread = std::min(spread, Scalar(Scalar(2) * width[i] / size(step[i] + step[i + 1])));
    if (!is_finite(spread))
      spread = grid.fan_rate(snapshot.layer[i], snapshot.state[i - 1], snapshot.state[i]) * snapshot.age[i];
    delta[i] = std::min(Scalar(size(step[i]) * spread / Scalar(8)),
                        Scalar(std::min(width[i - 1], width[i]) / Scalar(4))) *
               step[i];
  }

  std::vector<Scalar> z{snapshot.z.front()}, below, above;
  z.reserve(2 * n_cells), below.reserve(2 * n_cells), above.reserve(2 * n_cells);
  const auto add = [&](const Scalar& end, const Scalar& at_begin, const Scalar& at_end) {
    if (!(end > z.back()) && !below.empty()) return;
    z.push_back(end);
    below.push_back(at_begin);
    above.push_back(at_end);
  };
  for (std::size_t i = 0; i < n_cells; ++i) {
    const Scalar& end = snapshot.z[i + 1];
    const Scalar at_begin = phi[i] - step[i] / Scalar(2), at_end = phi[i] + step[i + 1] / Scalar(2);
    const Scalar ramp_begin = step[i] != 0 ? Scalar(4) * delta[i] / step[i] : Scalar(0);
    const Scalar ramp_end = step[i + 1] != 0 ? Scalar(4) * delta[i + 1] / step[i + 1] : Scalar(0);
    // A ramp that is cut off by its neighbour beyond the cell fills it but for rounding.
    const Scalar room = width[i] * (Scalar(1) + Scalar(8) * unit_roundoff<Scalar>());
    if (ramp_begin + ramp_end <= room) {
      if (ramp_begin > 0) add(std::min(Scalar(snapshot.z[i] + ramp_begin), end), at_begin, phi[i]);
      add(end - ramp_end, phi[i], phi[i]);
      if (ramp_end > 0) add(end, phi[i], at_end);
      continue;
    }
    // The ramps overlap: one line through both midpoints, shifted to carry the mass of the cell.
    const Scalar mean = phi[i] + (delta[i + 1] - delta[i]) / width[i];
    const Scalar shift = mean - (at_begin + at_end) / Scalar(2);
    const auto is_between = [](const Scalar& x, const Scalar& p, const Scalar& q) {
      return x >= std::min(p, q) && x <= std::max(p, q);
    };
    if (is_between(at_begin + shift, phi[i] - step[i], phi[i]) &&
        is_between(at_end + shift, phi[i], phi[i] + step[i + 1])) {
      add(end, at_begin + shift, at_end + shift);
    } else {
      add(end, mean, mean);
    }
  }
  return {std::move(z), std::move(below), std::move(above)};
}

}  // namespace shearfront
