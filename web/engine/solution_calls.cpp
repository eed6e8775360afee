// SPDX-License-Identifier: BSD-3-Clause
#include <emscripten.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "method_of.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/solve.hpp"
#include "shearfront/track/track.hpp"

/// Solutions of the scene: event times, phi at times and heights, fronts, errors.
using namespace shearfront;
using namespace shearfront::web;

namespace {

SolverResult solve_or_throw(const Method& method, const SolverRequest& request) {
  SolverResult result = solve(*work().scene, method, request);
  if (!result.summary.usable())
    throw InputError("method", std::string(method.name()), result.summary.message);
  return result;
}

/// The solution that errors are taken against, kept while the scene stays the same object.
const ExactSolution<double>& exact_solution() {
  static std::optional<ExactSolution<double>> kept;
  static std::uint64_t of_scene = 0;
  if (!kept || of_scene != work().scene_number) {
    kept.emplace(*work().scene);
    of_scene = work().scene_number;
  }
  return *kept;
}

}  // namespace

extern "C" {

/// Event times by the method. Numbers: t0, t1, t*, mass, steady height, then z, first, last of each interface and whether
/// the bed jumps there; NaN for a time that never comes.
EMSCRIPTEN_KEEPALIVE int sf_events(const char* method, std::size_t size) {
  return answered([&](Answer& a) {
    SolverRequest request;
    request.timeline = true;
    const SolverResult result = solve_or_throw(method_of({method, size}), request);
    if (!result.timeline) throw InputError("method", {method, size}, "must know event times of this scene");
    const Timeline<double>& timeline = *result.timeline;
    a.add(timeline.t0), a.add(timeline.t1), a.add(timeline.t_star);
    a.add(timeline.mass), a.add(timeline.steady_height);
    for (const auto& at : timeline.interfaces) {
      a.add(at.z), a.add(at.first), a.add(at.last);
      a.add(work().scene->jumps_at(at.z) ? 1 : 0);
    }
    a.text = result.summary.message;
  });
}

/// Numbers: phi at times x heights, heights running fastest, then M there. Text: the remark of the run.
EMSCRIPTEN_KEEPALIVE int sf_solve(const char* method, std::size_t size, const double* times,
                                  std::size_t n_times, const double* heights, std::size_t n_heights) {
  return answered([&](Answer& a) {
    SolverRequest request;
    request.times.assign(times, times + n_times);
    request.heights.assign(heights, heights + n_heights);
    const SolverResult result = solve_or_throw(method_of({method, size}), request);
    a.numbers.reserve(2 * result.samples.size());
    for (const Sample& sample : result.samples) a.add(sample.phi);
    for (const Sample& sample : result.samples) a.add(sample.M);
    a.text = result.summary.remark;
  });
}

/// How well the bed is mixed. Numbers: Psi at the times, 0 segregated, 1 uniform.
EMSCRIPTEN_KEEPALIVE int sf_mixing(const char* method, std::size_t size, const double* times,
                                   std::size_t n_times) {
  return answered([&](Answer& a) {
    const Scene<double>& scene = *work().scene;
    SolverRequest request;
    request.times.assign(times, times + n_times);
    request.heights = {scene.top()};
    request.integrand = entropy_function();
    const SolverResult result = solve_or_throw(method_of({method, size}), request);
    const double solid = scene.solid(scene.bottom(), scene.top());
    for (std::size_t i = 0; i < n_times; ++i)
      a.add(mixing(result.integrals[i], result.M(i, 0), solid).parameter);
  });
}

/// The solution at one time by a method whose solution is linear in pieces. Numbers: L1 distance to the exact solution (NaN
/// where there is none), work (collisions, cell updates), then z below, z above, phi below, phi above of each piece.
EMSCRIPTEN_KEEPALIVE int sf_profile(const char* method, std::size_t size, double t, int with_error) {
  return answered([&](Answer& a) {
    SolverRequest request;
    request.times = {t};
    request.profiles = true;
    const SolverResult result = solve_or_throw(method_of({method, size}), request);
    if (result.profiles.empty())
      throw InputError("method", {method, size}, "must have a solution that is linear in pieces");
    const Profile<double>& profile = result.profiles.front();
    const bool has_exact = with_error && exact::refusal(*work().scene).empty();
    a.add(has_exact ? errors_against(exact_solution(), profile, t).l1
                    : std::numeric_limits<double>::quiet_NaN());
    a.add(static_cast<double>(result.summary.collisions + result.summary.cell_updates));
    for (std::size_t i = 0; i < profile.n_cells(); ++i)
      for (const double x : {profile.z()[i], profile.z()[i + 1], profile.below()[i], profile.above()[i]})
        a.add(x);
  });
}

/// Fronts up to a time. Numbers: how many segments, seven numbers of each (layer, t and z where it begins, where it ends, phi
/// below and above it), then five of each collision (t, z, where or -1, incoming, outgoing).
EMSCRIPTEN_KEEPALIVE int sf_fronts(double resolution, double t_end) {
  return answered([&](Answer& a) {
    TrackOptions options;
    options.resolution = resolution;
    options.history = true;
    options.max_collisions = 200'000;
    if (std::string why = Tracking::refusal(*work().scene, options); !why.empty())
      throw InputError("method", "front-tracking", std::move(why));
    Tracking bed(*work().scene, options);
    bed.advance(t_end);
    if (!bed.summary().usable()) throw InputError("method", "front-tracking", bed.summary().message);
    const auto fronts = bed.fronts();
    a.add(static_cast<double>(fronts.size()));
    for (const auto& f : fronts)
      for (const double x :
           {static_cast<double>(f.layer), f.t_begin, f.z_begin, f.t_end, f.z_end, f.phi_below, f.phi_above})
        a.add(x);
    for (const Collision& c : bed.collisions())
      for (const double x : {c.t, c.z, c.boundary ? static_cast<double>(*c.boundary) : -1.0,
                             static_cast<double>(c.incoming), static_cast<double>(c.outgoing)})
        a.add(x);
  });
}
}
