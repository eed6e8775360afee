// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bed_course.hpp"
#include "plot/picture.hpp"
#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/solver/solve.hpp"

/// The pictures of the program, each by the template of its name. All return an exit code.
namespace shearfront::tools {

/// Fronts in the (t, z) plane with the event times (fronts.gp). `resolution` is the largest step of a fan.
int draw_fronts(const std::string& path, const Scene<double>& scene,
                const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline,
                double resolution);

/// Profiles at some times, and those of other methods dashed; a method that is not exact gets the exact profile as a thin
/// line on top (profiles.gp).
int draw_profiles(const std::string& path, const Scene<double>& scene, const Method& method,
                  const std::vector<double>& times, const std::vector<Method>& others = {});

/// phi over t (from 0) and z (map.gp).
int draw_map(const std::string& path, const Scene<double>& scene, const Method& method, double t_end);

/// phi over x and z, a panel per time (slab.gp).
int draw_slab(const std::string& path, const Scene<double>& scene, const Method& method,
              const SlabSamples& frames);

/// Mixing or bed height against time up to the last time (bed.gp).
int draw_bed_course(const std::string& path, const Scene<double>& scene, const Method& method,
                    const BedCourse& course);

/// The observations beside what the estimate predicts, s a(z) with its 95 % band, and the course of the
/// search (fit.gp); with a truth its s a(z) as well. Without a usable estimate no picture, one line on standard error and kNoResult.
int draw_fit(const std::string& path, const fit::FitSpec& spec, const fit::Estimate& estimate,
             const std::optional<Scene<double>>& truth = std::nullopt);

/// "front-tracking, resolution 0.01", for the small line of a picture.
[[nodiscard]] std::string described(const Method& method);

/// All states allowed anywhere in the bed: what an axis or a colour bar of phi has to show.
[[nodiscard]] StateRange<double> states_of(const Scene<double>& scene);

}  // namespace shearfront::tools
