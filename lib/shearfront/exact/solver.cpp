// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_share_integral.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/exact/timeline_derivatives.hpp"

namespace shearfront {
namespace {

class ExactField final : public Field {
 public:
  explicit ExactField(const ExactSolution<double>& solution) : solution_(solution) {}

  double t = 0;
  mutable bool has_values = false;
  mutable double worst_M = 0, worst_phi = 0;  ///< largest estimated errors so far

  [[nodiscard]] Sample at(double z) const override {
    const auto value = solution_.at(z, t);
    has_values = true;
    worst_M = std::max(worst_M, value.M_error);
    worst_phi = std::max(worst_phi, value.phi_error);
    return {value.phi, value.M};
  }
  /// In ascending order: neighbours are found from each other.
  [[nodiscard]] std::vector<Sample> at(const std::vector<double>& heights) const override {
    std::vector<std::size_t> order(heights.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
    std::vector<double> ascending;
    ascending.reserve(heights.size());
    for (const std::size_t i : order) ascending.push_back(heights[i]);
    const auto values = solution_.at(ascending, t);
    std::vector<Sample> samples(heights.size());
    for (std::size_t n = 0; n < order.size(); ++n) {
      samples[order[n]] = {values[n].phi, values[n].M};
      has_values = true;
      worst_M = std::max(worst_M, values[n].M_error);
      worst_phi = std::max(worst_phi, values[n].phi_error);
    }
    return samples;
  }
  [[nodiscard]] double integral(const ShareFunction& g) const override {
    return share_integral(solution_, t, g);
  }

 private:
  const ExactSolution<double>& solution_;
};

ExactSolution<double>::Options options_of(const ExactSolver::Options& options) {
  ExactSolution<double>::Options settings;
  settings.layers = static_cast<std::size_t>(options.layers);
  if (options.tolerance > 0) settings.tolerance = options.tolerance;
  return settings;
}

class ExactRun final : public Run {
 public:
  ExactRun(const Scene<double>& scene, const ExactSolver::Options& options, const Watch& watch)
      : tolerance_(options_of(options).tolerance),
        is_given_(options.layers > 0),
        progress_(watch.progress),
        solution_(scene, options_of(options)),
        field_(solution_) {}

  Status advance(double t) override {
    field_.t = t;
    if (progress_ && !progress_(t, 0)) status_ = Status::interrupted;
    return status_;
  }
  [[nodiscard]] const Field& field() override { return field_; }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override {
    const Timeline<double> times = exact_timeline(solution_);
    times_error_ = timeline_error(solution_, times);
    return times;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.layers = solution_.n_layers();
    summary.message = status_ != Status::ok  ? "interrupted at t = " + number_text(field_.t)
                      : solution_.is_exact() ? "exact to rounding"
                                             : approximation();
    return summary;
  }

 private:
  /// What stands for the scene, and how far what was asked for so far may be off.
  [[nodiscard]] std::string approximation() const {
    const std::string n = std::to_string(solution_.n_layers());
    std::string text = solution_.form().is_exact()
                           ? "exact for paths from a smooth start, looked for in " +
                                 std::to_string(solution_.form().n_start_parts()) + " parts of it"
                           : "exact for " + n + " pieces";
    if (!solution_.meets_tolerance())
      text += is_given_ ? ", as many as asked for"
                        : ", no more, although the tolerance of " + number_text(tolerance_) + " takes more";
    const auto rounded = [](double x) { return number_text(x, 2); };
    if (field_.has_values)
      text += "; estimated error of M " + rounded(field_.worst_M) + ", of phi " + rounded(field_.worst_phi);
    if (times_error_) text += "; estimated error of the event times " + rounded(*times_error_);
    return text;
  }

  double tolerance_;
  bool is_given_;
  std::optional<double> times_error_;
  Progress progress_;
  ExactSolution<double> solution_;
  ExactField field_;
  Status status_ = Status::ok;
};

/// The number of pieces is kept, so that the solution is a smooth function of the numbers of the scene.
ExactSolution<double> solution_near(const Scene<double>& scene, const ExactSolver::Options& options,
                                    std::any& memory) {
  ExactSolution<double>::Options settings = options_of(options);
  if (const auto* pieces = std::any_cast<std::size_t>(&memory)) settings.layers = *pieces;
  ExactSolution<double> solution(scene, settings);
  if (!solution.is_exact()) memory = solution.resolution();
  return solution;
}

std::vector<double> chosen_of(const std::vector<double>& all, const std::vector<std::size_t>& wanted) {
  std::vector<double> chosen;
  if (!all.empty())
    for (const std::size_t k : wanted) chosen.push_back(all[k]);
  return chosen;
}

}  // namespace

std::string ExactSolver::refusal(const Scene<double>& scene, const Options&) { return exact::refusal(scene); }

std::unique_ptr<Run> ExactSolver::start(const Scene<double>& scene, const Options& options,
                                        const Watch& watch) {
  return std::make_unique<ExactRun>(scene, options, watch);
}

std::string ExactSolver::derivative_refusal(const Scene<double>& scene, const Options&, const Entry& entry) {
  return shearfront::derivative_refusal(scene, entry);
}

Linearisation ExactSolver::linearise(const Scene<double>& scene, const Options& options,
                                     const std::vector<Place>& places, const std::vector<std::size_t>& wanted,
                                     std::any& memory, const Progress& progress) {
  constexpr std::size_t kPlacesPerCall = 64;  // a few milliseconds in large beds
  const ExactSolution<double> solution = solution_near(scene, options, memory);
  std::optional<Derivatives<double>> derivatives;
  if (!wanted.empty()) derivatives.emplace(solution);
  Linearisation result;
  result.summary.status = Status::ok;
  result.samples.resize(places.size());
  result.derivatives.resize(places.size() * wanted.size());
  // By time and height: neighbours are found from each other.
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::is_sorted(places.begin(), places.end()))
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  Derivatives<double>::At at;
  std::vector<double> heights;
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    const double t = places[order[from]].t;
    if (progress && !progress(t, from)) {
      result.summary.status = Status::interrupted;
      result.summary.message = "interrupted after " + std::to_string(from) + " places";
      return result;
    }
    heights.clear();
    for (; to < order.size() && to - from < kPlacesPerCall && places[order[to]].t == t; ++to)
      heights.push_back(places[order[to]].z);
    if (!derivatives) {
      const auto values = solution.at(heights, t);
      for (std::size_t n = 0; n < values.size(); ++n)
        result.samples[order[from + n]] = {values[n].phi, values[n].M};
      continue;
    }
    const bool is_many = heights.size() > 1 && t > 0 && std::isfinite(t);
    const auto paths = is_many ? solution.paths(heights, t) : std::vector<exact::Path<double>>{};
    for (std::size_t n = 0; n < heights.size(); ++n) {
      is_many ? derivatives->along(paths[n], heights[n], t, at) : derivatives->at(heights[n], t, at);
      const std::size_t i = order[from + n];
      result.samples[i] = {at.value.phi, at.value.M};
      for (std::size_t k = 0; k < wanted.size(); ++k)
        result.derivatives[i * wanted.size() + k] = {at.phi[wanted[k]], at.M[wanted[k]]};
    }
  }
  return result;
}

LinearIntegrals ExactSolver::linearise_integrals(const Scene<double>& scene, const Options& options,
                                                 const std::vector<double>& times, const ShareFunction& g,
                                                 const std::vector<std::size_t>& wanted, std::any& memory,
                                                 const Progress& progress) {
  const ExactSolution<double> solution = solution_near(scene, options, memory);
  const Derivatives<double> derivatives(solution);
  LinearIntegrals result;
  result.summary.status = Status::ok;
  result.mass_derivatives = chosen_of(derivatives.at(scene.top(), 0).M, wanted);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (progress && !progress(times[i], i)) {
      result.summary.status = Status::interrupted;
      result.summary.message = "interrupted after " + std::to_string(i) + " times";
      return result;
    }
    result.integrals.push_back(share_integral(solution, times[i], g));
    if (wanted.empty()) continue;
    const auto by = chosen_of(share_integral_derivatives(solution, derivatives, times[i], g), wanted);
    result.derivatives.insert(result.derivatives.end(), by.begin(), by.end());
  }
  return result;
}

LinearTimeline ExactSolver::linearise_timeline(const Scene<double>& scene, const Options& options,
                                               const std::vector<std::size_t>& wanted, std::any& memory) {
  const ExactSolution<double> solution = solution_near(scene, options, memory);
  LinearTimeline result;
  result.summary.status = Status::ok;
  result.times = exact_timeline(solution);
  const TimelineDerivatives all = timeline_derivatives(solution, result.times);
  result.derivatives.t0 = chosen_of(all.t0, wanted);
  result.derivatives.t1 = chosen_of(all.t1, wanted);
  result.derivatives.t_star = chosen_of(all.t_star, wanted);
  for (const auto& at : all.interfaces)
    result.derivatives.interfaces.push_back({chosen_of(at.first, wanted), chosen_of(at.last, wanted)});
  return result;
}

}  // namespace shearfront
