// SPDX-License-Identifier: BSD-3-Clause
#include "plot/rate_band.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "cli/arguments.hpp"

namespace shearfront::tools {
namespace {

constexpr std::size_t kHeights = 201;  // of a curve
/// Relative step of central differences: error of order step^2 and rounding / step, both below 1e-9.
constexpr double kStep = 1e-5;
/// A part of log(s a) smaller than this per unit of log p is rounding, not dependence.
constexpr double kNoPart = 1e-8;

double rate_at(const SceneSpec<double>& spec, double z) {
  return spec.scale * std::visit([&](const auto& a) { return a.value(z); }, spec.shear_rate);
}

/// The number of standard errors behind the confidence intervals; that of a normal distribution if none has
/// one.
double quantile_of(const fit::Estimate& estimate, const fit::Parameters& parameters) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const fit::ParameterEstimate& p = estimate.parameters[i];
    if (!p.ci95 || !p.std_error || !(*p.std_error > 0)) continue;
    const double q = parameters[i].entry.range == Range::positive
                         ? std::log(p.ci95->high / p.estimate) * p.estimate / *p.std_error
                         : (p.ci95->high - p.estimate) / *p.std_error;
    if (std::isfinite(q) && q > 0) return q;
  }
  return 1.96;
}

/// Ends of the layers, bottom to top.
std::vector<double> layer_ends(const Scene<double>& scene) {
  std::vector<double> ends = scene.knots();
  ends.insert(ends.begin(), scene.bottom());
  ends.push_back(scene.top());
  return ends;
}

/// Heights of a curve with all its knots.
std::vector<double> heights_of(const Scene<double>& scene) {
  std::vector<double> z = equally_spaced(scene.bottom(), scene.top(), kHeights);
  const std::vector<double> knots = scene.knots();
  z.insert(z.end(), knots.begin(), knots.end());
  std::sort(z.begin(), z.end());
  return z;
}

}  // namespace

RateBand::RateBand(const fit::FitSpec& spec, const fit::Estimate& estimate)
    : estimate_(estimate),
      parameters_(spec.scene, spec.unknown),
      values_(static_cast<Eigen::Index>(parameters_.size())),
      quantile_(quantile_of(estimate, parameters_)),
      is_layered_(estimate.scene->is_layered()) {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    values_[static_cast<Eigen::Index>(i)] = estimate.parameters[i].estimate;
  if (is_layered_) {
    add_layers();
    add_breaks();
  } else {
    add_curve();
  }
  set_start();
}

bool RateBand::has(RateKind kind) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const RatePiece& p) { return p.kind == kind; });
}

bool RateBand::is_unknown() const {
  return std::any_of(parameters_.begin(), parameters_.end(),
                     [](const fit::Parameter& p) { return p.entry.field.starts_with("shear_rate."); });
}

RateBand::At RateBand::at(double z) const {
  At result;
  result.rate = result.low = result.high = rate_at(estimate_.scene->spec(), z);
  const auto n = values_.size();
  Eigen::VectorXd g = Eigen::VectorXd::Zero(n);  // times the standard error
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (is_layered_ && parameters_[k].entry.field == "shear_rate.breaks") continue;
    const double step = kStep * std::max(std::abs(values_[i]), 1e-300);
    Eigen::VectorXd above = values_, below = values_;
    above[i] += step;
    below[i] -= step;
    const double slope =
        std::log(rate_at(parameters_.scene_with(above), z) / rate_at(parameters_.scene_with(below), z)) /
        (2 * step);
    if (!(std::abs(slope * values_[i]) > kNoPart)) continue;
    const auto& error = estimate_.parameters[k].std_error;
    if (!error) {
      result.kind = RateKind::open;
      return result;
    }
    result.kind = RateKind::banded;
    g[i] = slope * *error;
  }
  if (result.kind != RateKind::banded) return result;
  double variance = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (g[i] != 0 && g[j] != 0) variance += g[i] * estimate_.correlation(i, j) * g[j];
  const double factor = std::exp(quantile_ * std::sqrt(std::max(variance, 0.0)));
  result.low = result.rate / factor;
  result.high = result.rate * factor;
  return result;
}

void RateBand::add_piece(const At& at, std::vector<double> z) {
  const std::size_t n = z.size();
  pieces_.push_back({at.kind, std::move(z), std::vector<double>(n, at.rate), std::vector<double>(n, at.low),
                     std::vector<double>(n, at.high)});
}

void RateBand::add_layers() {
  const std::vector<double> ends = layer_ends(*estimate_.scene);
  for (std::size_t i = 1; i < ends.size(); ++i)
    add_piece(at((ends[i - 1] + ends[i]) / 2), {ends[i - 1], ends[i]});
}

/// Neighbouring heights of one kind are one piece; two pieces share the height between them.
void RateBand::add_curve() {
  for (const double z : heights_of(*estimate_.scene)) {
    const At here = at(z);
    if (!pieces_.empty()) {
      RatePiece& piece = pieces_.back();
      piece.z.push_back(z);
      piece.rate.push_back(here.rate);
      piece.low.push_back(here.low);
      piece.high.push_back(here.high);
    }
    if (pieces_.empty() || pieces_.back().kind != here.kind) add_piece(here, {z});
  }
}

void RateBand::add_breaks() {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (parameters_[i].entry.field == "shear_rate.breaks" && estimate_.parameters[i].ci95)
      breaks_.push_back({parameters_[i].entry.index, *estimate_.parameters[i].ci95});
}

void RateBand::set_start() {
  const Scene<double> scene(parameters_.scene_with(parameters_.start()));
  const auto add = [&](double z, double at) {
    start_.z.push_back(z);
    start_.rate.push_back(rate_at(scene.spec(), at));
  };
  if (!is_layered_) {
    for (const double z : heights_of(scene)) add(z, z);
    return;
  }
  const std::vector<double> ends = layer_ends(scene);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    add(ends[i - 1], (ends[i - 1] + ends[i]) / 2);
    add(ends[i], (ends[i - 1] + ends[i]) / 2);
  }
}

}  // namespace shearfront::tools
