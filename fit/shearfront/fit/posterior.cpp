// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/misfit/all.hpp"
#include "shearfront/fit/misfit_function.hpp"
#include "shearfront/fit/noise_reml.hpp"
#include "shearfront/fit/unbounded_coordinates.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// One for each unknown, flat where none is given.
std::vector<Prior> prior_of_each(const std::vector<Prior>& priors, const Parameters& parameters) {
  std::vector<std::string> names;
  Complaints complaints;
  for (const Prior& prior : priors) {
    names.push_back(prior.parameter);
    if (std::string why = prior.refusal(); !why.empty())
      complaints.push_back({"prior." + prior.parameter, prior.text(), std::move(why)});
  }
  if (!complaints.empty()) throw InputError(std::move(complaints));
  std::vector<Prior> of_each;
  for (const auto& place : parameters.last_named_by(names)) {
    of_each.push_back(place ? priors[*place]
                            : Prior{"", PriorKind::uniform, -infinity<double>(), infinity<double>()});
    of_each.back().parameter = parameters[of_each.size() - 1].name();
  }
  return of_each;
}

/// The bounds of the unknowns, narrowed by their priors.
std::pair<VectorXd, VectorXd> narrowed_bounds(const Parameters& parameters,
                                              const std::vector<Prior>& priors) {
  const auto n = static_cast<Index>(parameters.size());
  std::pair<VectorXd, VectorXd> bounds{VectorXd(n), VectorXd(n)};
  Complaints complaints;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto j = static_cast<Index>(i);
    bounds.first[j] = std::max(parameters[i].lower, priors[i].low());
    bounds.second[j] = std::min(parameters[i].upper, priors[i].high());
    if (!(bounds.first[j] < bounds.second[j]))
      complaints.push_back(
          {"prior", priors[i].parameter, "must leave room between the bounds of the unknown"});
  }
  if (!complaints.empty()) throw InputError(std::move(complaints));
  return bounds;
}

UnboundedCoordinates unbounded_coordinates(const Parameters& parameters,
                                           const std::pair<VectorXd, VectorXd>& bounds) {
  std::vector<Entry> entries;
  for (const Parameter& p : parameters) entries.push_back(p.entry);
  return {entries, bounds.first, bounds.second, parameters.shape()};
}

FitSpec with_known_noise(FitSpec spec, const Estimate& found) {
  if (spec.noise.model != NoiseModel::independent) spec.noise = known_noise(spec, found);
  return spec;
}

}  // namespace

struct Posterior::Parts {
  explicit Parts(const FitSpec& spec)
      : residuals(spec),
        priors(prior_of_each(spec.priors, residuals.parameters())),
        bounds(narrowed_bounds(residuals.parameters(), priors)),
        coordinates(unbounded_coordinates(residuals.parameters(), bounds)),
        has_sigma(spec.observations.has_sigma()),
        has_steps(quantity_of(spec) == PointMisfit::kName &&
                  !residuals.parameters().start_scene().has_diffusion()) {
    for (const Prior& prior : priors) names.push_back(prior.parameter);
  }

  void expect_size(const char* key, const VectorXd& numbers) const {
    if (numbers.size() == coordinates.size()) return;
    throw InputError(key, "(" + std::to_string(numbers.size()) + " entries)",
                     "must have one number per unknown (" + std::to_string(coordinates.size()) + ")");
  }

  /// Precondition: p is inside the bounds.
  [[nodiscard]] LogDensity inside(const VectorXd& p, bool with_gradient) const {
    LogDensity density;
    if (with_gradient) density.gradient = VectorXd::Zero(p.size());
    double value = 0;
    VectorXd slopes(p.size());
    for (Index i = 0; i < p.size(); ++i) {
      const PriorDensity prior = priors[static_cast<std::size_t>(i)].log_density(p[i]);
      value += prior.log;
      slopes[i] = prior.slope;
    }
    const MisfitFunction::Value at = with_gradient ? residuals.with_gradient(p) : residuals.at(p, false);
    density.failure = at.failure;
    if (!at.is_valid()) return density;
    const double squares = at.residuals.squaredNorm(), m = static_cast<double>(residuals.size());
    density.value = value - (has_sigma ? squares / 2 : m / 2 * std::log(squares));
    if (with_gradient && std::isfinite(density.value))
      density.gradient = slopes - (has_sigma ? 1 : m / squares) * at.gradient;
    return density;
  }

  MisfitFunction residuals;
  std::vector<Prior> priors;
  std::pair<VectorXd, VectorXd> bounds;
  UnboundedCoordinates coordinates;
  std::vector<std::string> names;
  bool has_sigma = false, has_steps = false;
};

Posterior::Posterior(const FitSpec& spec) : parts_(std::make_unique<const Parts>(spec)) {}
Posterior::Posterior(const FitSpec& spec, const Estimate& found) : Posterior(with_known_noise(spec, found)) {}
Posterior::~Posterior() = default;
Posterior::Posterior(Posterior&& other) noexcept = default;
Posterior& Posterior::operator=(Posterior&& other) noexcept = default;

const std::vector<std::string>& Posterior::names() const { return parts_->names; }
const std::vector<Prior>& Posterior::priors() const { return parts_->priors; }
const VectorXd& Posterior::lower() const { return parts_->bounds.first; }
const VectorXd& Posterior::upper() const { return parts_->bounds.second; }
std::size_t Posterior::n_residuals() const { return static_cast<std::size_t>(parts_->residuals.size()); }
bool Posterior::sigma_is_given() const { return parts_->has_sigma; }
bool Posterior::has_steps() const { return parts_->has_steps; }

LogDensity Posterior::at(const VectorXd& p, bool with_gradient) const {
  parts_->expect_size("p", p);
  if (parts_->coordinates.contains(p)) return parts_->inside(p, with_gradient);
  LogDensity outside;
  if (with_gradient) outside.gradient = VectorXd::Zero(p.size());
  outside.failure = "outside the bounds";
  return outside;
}

LogDensity Posterior::at_coordinates(const VectorXd& x, bool with_gradient) const {
  parts_->expect_size("x", x);
  const auto point = parts_->coordinates.at(x);
  LogDensity density;
  if (with_gradient) density.gradient = VectorXd::Zero(x.size());
  density.failure = "no room between the bounds at these coordinates";
  if (!point) return density;
  density = parts_->inside(point->p, with_gradient);
  density.value += point->log_volume;
  if (with_gradient && std::isfinite(density.value))
    density.gradient = (point->derivative.transpose() * density.gradient + point->slope).eval();
  return density;
}

std::optional<VectorXd> Posterior::values(const VectorXd& x) const {
  parts_->expect_size("x", x);
  const auto point = parts_->coordinates.at(x);
  if (!point) return std::nullopt;
  return point->p;
}

VectorXd Posterior::coordinates(const VectorXd& p) const {
  parts_->expect_size("p", p);
  return parts_->coordinates.coordinates(p);
}

std::optional<MatrixXd> Posterior::curvature(const VectorXd& x) const {
  parts_->expect_size("x", x);
  const auto point = parts_->coordinates.at(x);
  if (!point) return std::nullopt;
  const MisfitFunction::Value at = parts_->residuals.at(point->p, true);
  if (!at.is_valid()) return std::nullopt;
  const MatrixXd jacobian = at.jacobian * point->derivative;
  const double variance =
      parts_->has_sigma ? 1 : at.residuals.squaredNorm() / static_cast<double>(at.residuals.size());
  return jacobian.transpose() * jacobian / variance;
}

}  // namespace shearfront::fit
