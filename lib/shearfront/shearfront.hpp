// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solution/observe.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/timeline.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/track.hpp"

/// The library in one header. Fits of a(z) to measurements: shearfront/fit.hpp.
///
///     const auto scene = shearfront::read_scene("scene.toml");                         target shearfront::io
///     const auto times = shearfront::event_times(scene);
///     const auto exact = shearfront::solve(scene, "exact", {.times = {0.5, 6}, .heights = {0.1, 0.9}});
///     const double M   = exact.M(0, 1);
///
///     auto bed = shearfront::track(scene, {.resolution = 0.01, .history = true});
///     bed.advance(0.5);
///     const double l1  = shearfront::l1_distance(bed.profile(), other_profile);
///     const auto drawn = bed.fronts();
///
/// A scene can be built by hand, too:
///
///     shearfront::SceneSpec<> bed;
///     bed.shear_rate     = shearfront::Piecewise<double>{{0.3}, {2.4, 0.3}};           breaks, values
///     bed.initial_breaks = {0.5};
///     bed.initial_values = {0, 1};
///     const shearfront::Scene<> scene(bed);
///
/// Errors of an input, all of them at once: InputError (model/complaint.hpp). What a run could not do: its Summary.
