// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/solver.hpp"

#include <algorithm>
#include <optional>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/exact/exact_share_integral.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/refusal.hpp"

namespace shearfront {
namespace {

class ExactField final : public Field {
 public:
  explicit ExactField(const ExactSolution<double>& solution) : solution_(solution) {}

  double t = 0;
  mutable double worst_M = 0;  ///< largest estimated error of M so far

  [[nodiscard]] Sample at(double z) const override {
    const auto value = solution_.at(z, t);
    worst_M = std::max(worst_M, value.M_error);
    return {value.phi, value.M};
  }
  [[nodiscard]] double integral(const ShareFunction& g) const override {
    return share_integral(solution_, t, g);
  }

 private:
  const ExactSolution<double>& solution_;
};

class ExactRun final : public Run {
 public:
  ExactRun(const Scene<double>& scene, const ExactSolver::Options& options, const Watch& watch)
      : scene_(scene),
        layers_(static_cast<std::size_t>(options.layers)),
        progress_(watch.progress),
        solution_(scene, {layers_}),
        field_(solution_) {}

  Status advance(double t) override {
    field_.t = t;
    if (progress_ && !progress_(t, 0)) status_ = Status::interrupted;
    return status_;
  }
  [[nodiscard]] const Field& field() override { return field_; }
  [[nodiscard]] std::optional<Timeline<double>> timeline() override {
    return exact_timeline(scene_, {.layers = layers_});
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.layers = solution_.n_layers();
    summary.message = status_ != Status::ok ? "interrupted at t = " + number_text(field_.t)
                      : solution_.is_exact()
                          ? "exact to rounding"
                          : "exact for " + std::to_string(solution_.n_layers()) +
                                (solution_.form().is_linear() ? " linear pieces" : " layers as a staircase") +
                                "; estimated error of M " + number_text(field_.worst_M);
    return summary;
  }

 private:
  const Scene<double>& scene_;
  std::size_t layers_;
  Progress progress_;
  ExactSolution<double> solution_;
  ExactField field_;
  Status status_ = Status::ok;
};

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
                                     std::any&) {
  const ExactSolution<double> solution(scene, {static_cast<std::size_t>(options.layers)});
  std::optional<Derivatives<double>> derivatives;
  if (!wanted.empty()) derivatives.emplace(solution);
  Linearisation result;
  result.summary.status = Status::ok;
  result.samples.reserve(places.size());
  result.derivatives.reserve(places.size() * wanted.size());
  for (const Place& place : places) {
    if (!derivatives) {
      const auto value = solution.at(place.z, place.t);
      result.samples.push_back({value.phi, value.M});
      continue;
    }
    const auto at = derivatives->at(place.z, place.t);
    result.samples.push_back({at.value.phi, at.value.M});
    for (const std::size_t i : wanted) result.derivatives.push_back({at.phi[i], at.M[i]});
  }
  return result;
}

}  // namespace shearfront
