// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "shearfront/solver/method.hpp"

namespace shearfront {

/// What to compute. Times in any order, >= 0; +infinity asks for the steady state. Heights in any order,
/// inside the domain.
struct SolverRequest {
  std::vector<double> times{};
  std::vector<double> heights{};
  bool timeline = false;      ///< event times wanted
  bool fronts = false;        ///< front segments wanted (solvers that have fronts)
  bool profiles = false;      ///< phi over the whole domain wanted (solvers that have profiles)
  ShareFunction integrand{};  ///< g, if int c g(phi / c) dz over the bed is wanted
  bool volumes = false;       ///< Field::volumes at the heights wanted
};

struct SolverResult {
  std::vector<Sample> samples;  ///< samples[i * heights.size() + j] belongs to times[i], heights[j]
  std::optional<Timeline<double>> timeline;
  std::vector<FrontSegment<double>> fronts;
  std::vector<Profile<double>> profiles;  ///< profiles[i] belongs to times[i]; the samples are its values
  std::vector<double> integrals;          ///< integrals[i], of the integrand, belongs to times[i]
  std::vector<double> volumes;            ///< Field::volumes, in the order of the samples
  Summary summary;                        ///< not usable(): all else is empty

  /// At times[i], heights[j] of the request it answers.
  [[nodiscard]] const Sample& at(std::size_t i, std::size_t j) const {
    return samples[i * (samples.size() / n_times) + j];
  }
  [[nodiscard]] double phi(std::size_t i, std::size_t j) const { return at(i, j).phi; }
  [[nodiscard]] double M(std::size_t i, std::size_t j) const { return at(i, j).M; }
  std::size_t n_times = 0;
};

/// Runs a method and samples what is asked for. A scene that the method does not solve is the outcome
/// Status::unsupported, with Method::refusal as its message. Errors: InputError for times or heights that are
/// not allowed. Cost: one run.
[[nodiscard]] SolverResult solve(const Scene<double>& scene, const Method& method,
                                 const SolverRequest& request, const Progress& progress = {});

/// The same for a solver known at compile time.
template <Solver S>
[[nodiscard]] SolverResult solve(const Scene<double>& scene, const SolverRequest& request,
                                 const typename S::Options& options = {}, const Progress& progress = {}) {
  return solve(scene, Method::of<S>(options), request, progress);
}

/// When the first and last waves reach walls and interfaces, and when all is at rest: by the method, or by
/// the first of the list that knows event times and solves the scene. Errors: InputError (key "method") if it
/// gives none.
[[nodiscard]] Timeline<double> event_times(const Scene<double>& scene);
[[nodiscard]] Timeline<double> event_times(const Scene<double>& scene, const Method& method);

/// Samples at places in any order, by one run. Not usable(): no samples. Errors: as check_places(). Cost: one run,
/// memory linear in the places.
struct PlaceSamples {
  std::vector<Sample> samples;
  std::vector<double> volumes;  ///< Field::volumes there, if asked for
  Summary summary;
};
[[nodiscard]] PlaceSamples sample(const Scene<double>& scene, const Method& method,
                                  const std::vector<Place>& places, const Progress& progress = {},
                                  bool with_volumes = false);

}  // namespace shearfront
