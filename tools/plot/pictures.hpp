// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "cli/method.hpp"
#include "solve/bed_course.hpp"

namespace shearfront::tools {

/// Refuses a picture whose name does not end in .svg, .png or .pdf. An empty name is no picture.
void check_picture_name(std::string_view option, const std::string& path);
/// Refuses a picture that cannot be written. Errors: FileError.
void check_picture_target(const std::string& path);

/// Fronts in the (t, z) plane, t to the right: coloured by phi, shocks thicker, interfaces dashed, event
/// times marked. Returns an exit code: without gnuplot one line on standard error and kDone.
int draw_fronts(const std::string& path, const Scene<double>& scene,
                const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline,
                double resolution);

/// Profiles phi(z) at some times, z upwards; a method that is not exact gets the exact profile as a thin line
/// on top.
int draw_profiles(const std::string& path, const Scene<double>& scene, std::string_view method,
                  const std::vector<double>& times, const SolverOptions& options);

/// phi over t (from 0) and z, in colours with 20 contours, by a method.
int draw_map(const std::string& path, const Scene<double>& scene, std::string_view method, double t_end,
             const SolverOptions& options);

/// Mixing or bed height against time: the curve up to the last time, the times asked for as points, the
/// lowest bed marked.
int draw_bed_course(const std::string& path, const Scene<double>& scene, std::string_view method,
                    const BedCourse& course, const SolverOptions& options);

/// A fit: the observations beside what the estimate predicts (profiles for few times, else maps over t and z
/// with the residuals), s a(z) with its 95 % band, and the course of the search. Without a usable estimate
/// no picture, one line on standard error and kNoResult.
int draw_fit(const std::string& path, const fit::FitSpec& spec, const fit::Estimate& estimate);

}  // namespace shearfront::tools
