// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront {

/// Profiles of one solution at ascending times, for example of a grid method that knows no events.
struct ProfileSeries {
  std::vector<double> times;
  std::vector<Profile<double>> profiles;
};

/// The event times of a scene as they can be seen in profiles (meaning of each: solution/timeline.hpp).
///
/// With h = (top - bottom) / cells of the profile, the width of a mean cell, and the mean of phi over the
/// width h next to a wall, or on either side of an interface, called the state there:
///
///   t0, t1, first  the state (of either side) has left its initial value by more than the threshold
///                  theta = sqrt(h / (top - bottom)) for the first time;
///   last           the state (of either side) differs from its final value by more than theta for the last
///                  time;
///   t_star         int |phi - steady phi| dz exceeds the content h of one cell for the last time.
///
/// Why this converges: behind the edge of a fan phi changes at a finite rate, so theta costs a delay of order
/// theta; a monotone scheme sends a foot ahead of the edge whose height is of order sqrt(h) as well (the
/// smoothed kink); a shock is a few h wide and passes theta within O(h) of time. Times of fans are thus of
/// order 1/2 in h, those of shocks and t_star of order 1 (up to a logarithm). 0 if the initial state at a
/// wall or interface is not at rest there (the state leaves at once), up to the same error. Between two times
/// of the series the quantity is interpolated linearly; what comes and goes between two is not seen. Empty: a
/// first that does not happen in the series; a last, or t_star, that may lie behind its end or does not
/// happen. Cost: O(times * cells).
[[nodiscard]] Timeline<double> observed_events(const Scene<double>& scene, const ProfileSeries& series);

}  // namespace shearfront
