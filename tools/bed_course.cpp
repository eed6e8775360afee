// SPDX-License-Identifier: BSD-3-Clause
#include "bed_course.hpp"

#include <algorithm>
#include <cmath>

#include "cli/method.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"

namespace shearfront::tools {
namespace {

std::optional<LowestBed> lowest_of(const BedHeight& bed, std::string_view method, const Scene<double>& scene,
                                   double t_end, const SolverOptions& options) {
  SolverRequest request;
  request.integrand = bed.integrand();
  const auto heights = [&](const std::vector<double>& times) {
    request.times = times;
    std::vector<double> all = solve_with(method, scene, request, options).integrals;
    for (double& x : all) x = bed.height(x);
    return all;
  };
  return lowest_bed(heights, t_end);
}

}  // namespace

std::string refusal_of_course(const Scene<double>& scene) { return BedHeight::refusal(scene); }

BedCourse bed_course(SolvedQuantity quantity, std::string_view method, const Scene<double>& scene,
                     const std::vector<double>& times, const SolverOptions& options) {
  const BedHeight bed(scene);
  const bool is_mixing = quantity == SolvedQuantity::mixing;
  SolverRequest request;
  request.times = times;
  request.integrand = is_mixing ? entropy_function() : bed.integrand();
  const auto is_steady = [](double t) { return !std::isfinite(t); };
  request.timeline = guarantees_of(method).has_timeline && std::any_of(times.begin(), times.end(), is_steady);
  const SolverResult result = solve_with(method, scene, request, options);
  BedCourse course;
  course.quantity = quantity;
  course.table.columns = is_mixing ? std::vector<std::string>{"E", "Psi"} : std::vector<std::string>{"H"};
  course.table.times = times;
  if (result.timeline && result.timeline->t_star)
    std::replace_if(course.table.times.begin(), course.table.times.end(), is_steady,
                    *result.timeline->t_star);
  course.summary = result.summary;
  if (!course.summary.usable()) return course;
  const double solid = scene.solid(scene.bottom(), scene.top());
  for (const double integral : result.integrals) {
    if (is_mixing) {
      const Mixing at = mixing(integral, scene.mass(), solid);
      course.table.rows.push_back({at.entropy, at.parameter});
    } else {
      course.table.rows.push_back({bed.height(integral)});
    }
  }
  double t_end = 0;
  for (const double t : times)
    if (std::isfinite(t)) t_end = std::max(t_end, t);
  if (!is_mixing && t_end > 0) course.lowest = lowest_of(bed, method, scene, t_end, options);
  return course;
}

}  // namespace shearfront::tools
