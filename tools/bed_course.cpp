// SPDX-License-Identifier: BSD-3-Clause
#include "bed_course.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"

namespace shearfront::tools {

double last_time(const std::vector<double>& times) {
  double last = 0;
  for (const double t : times)
    if (std::isfinite(t)) last = std::max(last, t);
  return last;
}

std::optional<double> steady_time_of(const SolverResult& result) {
  if (result.timeline && result.timeline->t_star) return result.timeline->t_star;
  return result.summary.rest_time;
}

namespace {

/// The numbers of a bed whose integral of the quantity's function is this.
std::vector<double> row_of(SolvedQuantity quantity, const Scene<double>& scene, const BedHeight& bed,
                           double integral) {
  if (quantity != SolvedQuantity::mixing) return {bed.height(integral)};
  const Mixing at = mixing(integral, scene.mass(), scene.solid(scene.bottom(), scene.top()));
  return {at.entropy, at.parameter};
}

SolverRequest request_of_bed(SolvedQuantity quantity, const BedHeight& bed,
                             const std::vector<double>& times) {
  SolverRequest request;
  request.times = times;
  request.integrand = quantity == SolvedQuantity::mixing ? entropy_function() : bed.integrand();
  return request;
}

}  // namespace

BedCourse bed_course(SolvedQuantity quantity, const Scene<double>& scene, const Method& method,
                     const std::vector<double>& times, const Progress& progress) {
  const BedHeight bed(scene);
  const bool is_mixing = quantity == SolvedQuantity::mixing;
  const auto is_steady = [](double t) { return !std::isfinite(t); };
  SolverRequest request = request_of_bed(quantity, bed, times);
  request.timeline = method.guarantees().has_timeline && std::any_of(times.begin(), times.end(), is_steady);
  const SolverResult result = solve(scene, method, request, progress);
  BedCourse course{quantity, {{"H"}, times, {}}, {}, result.summary};
  if (is_mixing) course.table.columns = {"E", "Psi"};
  if (const auto rest = steady_time_of(result))
    std::replace_if(course.table.times.begin(), course.table.times.end(), is_steady, *rest);
  if (!course.summary.usable()) return course;
  for (const double integral : result.integrals)
    course.table.rows.push_back(row_of(quantity, scene, bed, integral));
  const double t_end = last_time(times);
  if (is_mixing || !(t_end > 0)) return course;
  const auto heights = [&](const std::vector<double>& at) {
    request.times = at;
    request.timeline = false;
    std::vector<double> all = solve(scene, method, request, progress).integrals;
    for (double& x : all) x = bed.height(x);
    return all;
  };
  course.lowest = lowest_bed(heights, t_end);
  return course;
}

}  // namespace shearfront::tools
