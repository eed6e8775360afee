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

/// Fronts that a method tracked in the (t, z) plane with the event times, pure regions tinted (fronts.gp).
int draw_fronts(const std::string& path, const Scene<double>& scene, const Method& method,
                const std::vector<FrontSegment<double>>& fronts, const Timeline<double>& timeline);

/// Profiles at some times, and those of other methods dashed; a method that is not exact gets the exact profile as a thin
/// line on top (profiles.gp).
int draw_profiles(const std::string& path, const Scene<double>& scene, const Method& method,
                  const std::vector<double>& times, const std::vector<Method>& others = {});

/// Where a map has contours: at these states, or at round ones.
struct Contours {
  bool are_round = true;
  std::vector<double> states;
};

/// phi over t (from 0) and z, with contours and their states, and shocks as lines where they can be tracked (map.gp).
int draw_map(const std::string& path, const Scene<double>& scene, const Method& method, double t_end,
             const Contours& contours = {});

/// The Riemann problem at the only interface of a bed of two layers whose start jumps there or nowhere: flux curves of
/// both layers, the states from bottom to top on them, and the waves (riemann.gp). Errors: InputError (--riemann) for
/// another bed.
int draw_riemann(const std::string& path, const Scene<double>& scene);

/// phi over x and z, a panel per time (slab.gp).
int draw_slab(const std::string& path, const Scene<double>& scene, const Method& method,
              const SlabSamples& frames);

/// Mixing or bed height against time up to the last time (bed.gp).
int draw_bed_course(const std::string& path, const Scene<double>& scene, const Method& method,
                    const BedCourse& course);

/// Another model of the same data.
struct OtherModel {
  std::string name;
  Scene<double> scene;
};

/// The observations beside what the estimate predicts, s a(z) with its 95 % band, and the course of the
/// search (fit.gp); with a truth its s a(z) as well; with other models theirs, and the residuals in place of the search.
/// Without a usable estimate no picture, one line on standard error and kNoResult.
int draw_fit(const std::string& path, const fit::FitSpec& spec, const fit::Estimate& estimate,
             const std::string& title, const std::optional<Scene<double>>& truth = std::nullopt,
             const std::vector<OtherModel>& others = {});

/// "front-tracking, resolution 0.01", for the small line of a picture; a method that chooses its cells is asked for them.
[[nodiscard]] std::string described(const Method& method, const Scene<double>& scene);

/// What every picture of a bed shows.
void set_scene(Picture& picture, const Scene<double>& scene, const std::string& subtitle);

/// c a f(phi / c) at a height: what a front keeps on its way through the layers.
[[nodiscard]] double flux_at(const Scene<double>& scene, double z, double phi);

/// Whether waves spread from the two sides of a front: it is one of a fan, however far apart its states are. Shocks and
/// contacts do not.
[[nodiscard]] bool is_of_fan(const Scene<double>& scene, const FrontSegment<double>& front);

/// All states allowed anywhere in the bed: what an axis or a colour bar of phi has to show.
[[nodiscard]] StateRange<double> states_of(const Scene<double>& scene);

}  // namespace shearfront::tools
