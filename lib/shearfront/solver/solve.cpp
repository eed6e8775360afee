// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solver/solve.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

using Clock = std::chrono::steady_clock;

void check(const Scene<double>& scene, const SolverRequest& request) {
  Complaints complaints;
  for (std::size_t i = 0; i < request.times.size(); ++i)
    if (!(request.times[i] >= 0))
      complaints.push_back(
          {"times[" + std::to_string(i) + "]", number_text(request.times[i]), "must be >= 0"});
  for (std::size_t i = 0; i < request.heights.size(); ++i)
    if (!(request.heights[i] >= scene.bottom() && request.heights[i] <= scene.top()))
      complaints.push_back({"heights[" + std::to_string(i) + "]", number_text(request.heights[i]),
                            "must be inside the domain [" + number_text(scene.bottom()) + ", " +
                                number_text(scene.top()) + "]"});
  if (!complaints.empty()) throw InputError(std::move(complaints));
}

Summary unsupported(std::string why) {
  Summary summary;
  summary.status = Status::unsupported;
  summary.message = std::move(why);
  return summary;
}

bool is_usable(Status status) { return status == Status::ok || status == Status::steady; }

/// Positions of `xs` in ascending order of their values.
template <class Values, class Key>
std::vector<std::size_t> ascending(const Values& xs, Key&& key) {
  std::vector<std::size_t> order(xs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(xs[a]) < key(xs[b]); });
  return order;
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

SolverResult solve(const Scene<double>& scene, const Method& method, const SolverRequest& request,
                   const Progress& progress) {
  const auto begin = Clock::now();
  check(scene, request);
  SolverResult result;
  result.n_times = request.times.size();
  if (std::string why = method.refusal(scene); !why.empty()) {
    result.summary = unsupported(std::move(why));
    return result;
  }
  double last_time = 0;
  for (const double t : request.times) last_time = std::max(last_time, t);
  const auto run = method.start(scene, {request.timeline, request.fronts, progress, last_time});
  const Guarantees guarantees = method.guarantees();
  const std::size_t n = request.heights.size();
  result.samples.resize(request.times.size() * n);
  if (request.volumes) result.volumes.resize(result.samples.size());
  if (request.integrand) result.integrals.resize(request.times.size());
  if (request.profiles && guarantees.has_profiles) result.profiles.resize(request.times.size());
  bool is_complete = true;
  for (const std::size_t i : ascending(request.times, [](double t) { return t; })) {
    is_complete = is_usable(run->advance(request.times[i]));
    if (!is_complete) break;
    const Field& field = run->field();
    const std::vector<Sample> row = field.at(request.heights);
    std::copy(row.begin(), row.end(), result.samples.begin() + static_cast<std::ptrdiff_t>(i * n));
    if (request.volumes) {
      const std::vector<double> volumes = field.volumes(request.heights);
      std::copy(volumes.begin(), volumes.end(), result.volumes.begin() + static_cast<std::ptrdiff_t>(i * n));
    }
    if (request.integrand) result.integrals[i] = field.integral(request.integrand);
    if (!result.profiles.empty()) result.profiles[i] = *field.profile();
  }
  if (is_complete && request.timeline) result.timeline = run->timeline();
  if (request.fronts) result.fronts = run->fronts();
  result.summary = run->summary();
  if (!result.summary.usable()) {
    result.samples.clear();
    result.volumes.clear();
    result.integrals.clear();
    result.profiles.clear();
    result.timeline.reset();
  }
  result.summary.wall_s = seconds_since(begin);
  return result;
}

Timeline<double> event_times(const Scene<double>& scene, const Method& method) {
  SolverRequest request;
  request.timeline = true;
  const SolverResult result = solve(scene, method, request);
  if (result.timeline) return *result.timeline;
  throw InputError(
      "method", '"' + std::string(method.name()) + '"',
      result.summary.usable() ? "must know event times" : "gives no event times: " + result.summary.message);
}

Timeline<double> event_times(const Scene<double>& scene) {
  const std::vector<std::string> names = Method::names(&Guarantees::has_timeline);
  for (const std::string& name : names)
    if (Method(name).refusal(scene).empty()) return event_times(scene, name);
  return event_times(scene, names.front());
}

PlaceSamples sample(const Scene<double>& scene, const Method& method, const std::vector<Place>& places,
                    const Progress& progress, bool with_volumes) {
  const auto begin = Clock::now();
  check_places(scene, places);
  PlaceSamples result;
  if (std::string why = method.refusal(scene); !why.empty()) {
    result.summary = unsupported(std::move(why));
    return result;
  }
  const auto order = ascending(places, [](const Place& place) { return place.t; });
  const double last_time = places.empty() ? 0 : places[order.back()].t;
  const auto run = method.start(scene, {false, false, progress, last_time});
  result.samples.resize(places.size());
  if (with_volumes) result.volumes.resize(places.size());
  std::vector<double> heights;
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    const double t = places[order[from]].t;
    heights.clear();
    for (; to < order.size() && places[order[to]].t == t; ++to) heights.push_back(places[order[to]].z);
    if (!is_usable(run->advance(t))) {
      result.samples.clear();
      result.volumes.clear();
      break;
    }
    const std::vector<Sample> row = run->field().at(heights);
    for (std::size_t k = 0; k < row.size(); ++k) result.samples[order[from + k]] = row[k];
    if (!with_volumes) continue;
    const std::vector<double> volumes = run->field().volumes(heights);
    for (std::size_t k = 0; k < volumes.size(); ++k) result.volumes[order[from + k]] = volumes[k];
  }
  result.summary = run->summary();
  result.summary.wall_s = seconds_since(begin);
  return result;
}

}  // namespace shearfront
