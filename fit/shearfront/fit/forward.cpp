// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/forward.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/io/text.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/observation.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront::fit {

using Eigen::Index;
using Eigen::VectorXd;

Forward::Forward(const Parameters& parameters, const ForwardSpec& forward, Observable observable,
                 std::vector<Place> places)
    : parameters_(&parameters),
      method_(forward.method),
      observable_(observable),
      places_(std::move(places)),
      entries_(parameters.entries()) {
  const Scene<double>& scene = parameters.start_scene();
  if (scene.is_slab())
    throw InputError("scene", quoted_text(scene.name()),
                     "must have no table slab: --method slab is no forward model of a fit");
  if (observable == Observable::bed_height)
    if (const std::string reason = BedHeight::refusal(scene); !reason.empty())
      throw InputError("misfit.quantity", quoted_text(std::string(name_of(Quantity::bed_height))),
                       "must suit the scene: " + reason);
  if (observable == Observable::M || observable == Observable::volume) method_.prefer_amounts();
  if (const std::string reason = method_.refusal(scene); !reason.empty())
    throw InputError("forward.method", quoted_text(method_.name()), "must suit the scene: " + reason);
  is_smooth_ = method_.guarantees().exact;
  if (observable == Observable::bed_height) {
    for (const Place& place : places_) times_.push_back(place.t);
    std::sort(times_.begin(), times_.end());
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
    if (!method_.has_linear_integrals()) return;
  }
  const std::vector<Entry> all = shearfront::entries(scene.spec());
  const bool is_staircase = observable == Observable::phi && method_.has_steps();
  const auto has_derivative = [&](const Entry& entry) {
    return !is_staircase && method_.has_derivative(scene, entry);
  };
  has_derivatives_ =
      std::all_of(entries_.begin(), entries_.end(), [&](std::size_t i) { return has_derivative(all[i]); });
  // Forwards four unknowns cost 1 to 1.2 times what all of them cost backwards, and leave a Jacobian; eight 1.1 to 1.7 times, by the
  // bed (tests/bench/tracking_derivatives_bench.cpp).
  constexpr std::size_t kMostForwards = 4;
  has_gradient_ =
      has_derivatives_ && entries_.size() > kMostForwards && method_.has_linear_sum() &&
      observable != Observable::bed_height &&
      std::all_of(places_.begin(), places_.end(), [](const Place& p) { return std::isfinite(p.t); });
  can_linearise_ = has_derivatives_ || std::any_of(all.begin(), all.end(), has_derivative);
  // A polygonal flux has derivatives where its levels stay, and jumps where one appears.
  is_smooth_ = is_smooth_ || (can_linearise_ && !method_.guarantees().has_fronts);
}

Prediction Forward::predict(const VectorXd& values, bool with_derivatives,
                            const shearfront::Progress& progress) const {
  Prediction prediction;
  const auto scene = parameters_->scene_at(values, prediction.failure);
  if (!scene) return prediction;
  if (observable_ == Observable::bed_height)
    predict_heights(*scene, with_derivatives && has_derivatives_, progress, prediction);
  else
    predict_samples(*scene, with_derivatives && has_derivatives_, progress, prediction);
  return prediction;
}

Prediction Forward::predict_gradient(const VectorXd& values, const ValueSlopes& slopes,
                                     const shearfront::Progress& progress) const {
  Prediction prediction;
  const auto scene = parameters_->scene_at(values, prediction.failure);
  if (!scene) return prediction;
  if (prediction.failure = method_.refusal(*scene); !prediction.is_valid()) return prediction;
  const auto weights = [&](const std::vector<Sample>& samples) {
    take(samples, prediction);
    const VectorXd by_value = slopes(prediction.values);
    std::vector<Sample> all(samples.size(), Sample{0, 0});
    for (std::size_t i = 0; i < all.size(); ++i)
      (observable_ == Observable::phi ? all[i].phi : all[i].M) = by_value[static_cast<Index>(i)];
    return all;
  };
  const LinearSum result = method_.linearise_sum(*scene, places_, weights, entries_, progress);
  if (!result.summary.usable()) {
    prediction.failure = result.summary.message;
    return prediction;
  }
  prediction.remark = result.summary.remark;
  prediction.gradient =
      Eigen::Map<const VectorXd>(result.gradient.data(), static_cast<Index>(result.gradient.size()));
  return prediction;
}

void Forward::predict_samples(const Scene<double>& scene, bool with_derivatives,
                              const shearfront::Progress& progress, Prediction& prediction) const {
  if (!can_linearise_) {
    const bool is_volume = observable_ == Observable::volume;
    const PlaceSamples result = sample(scene, method_, places_, progress, is_volume);
    if (!result.summary.usable()) prediction.failure = result.summary.message;
    prediction.remark = result.summary.remark;
    if (!is_volume) return take(result.samples, prediction);
    prediction.values =
        Eigen::Map<const VectorXd>(result.volumes.data(), static_cast<Index>(result.volumes.size()));
    return;
  }
  if (prediction.failure = method_.refusal(scene); !prediction.is_valid()) return;
  const std::vector<std::size_t> none;
  const Linearisation result =
      method_.linearise(scene, places_, with_derivatives ? entries_ : none, memory_, progress);
  if (!result.summary.usable()) {
    prediction.failure = result.summary.message;
    return;
  }
  prediction.remark = result.summary.remark;
  take(result.samples, prediction);
  if (!with_derivatives) return;
  prediction.order_holds = result.order_holds;
  prediction.order = result.order;
  const std::size_t n = entries_.size();
  prediction.derivatives.resize(static_cast<Index>(places_.size()), static_cast<Index>(n));
  for (std::size_t i = 0; i < places_.size(); ++i)
    for (std::size_t k = 0; k < n; ++k) {
      const Sample& d = result.derivatives[i * n + k];
      prediction.derivatives(static_cast<Index>(i), static_cast<Index>(k)) =
          observable_ == Observable::phi ? d.phi : d.M;
    }
}

void Forward::predict_heights(const Scene<double>& scene, bool with_derivatives,
                              const shearfront::Progress& progress, Prediction& prediction) const {
  const BedHeight bed(scene);
  std::vector<double> integrals;
  LinearIntegrals linear;
  if (with_derivatives) {
    if (prediction.failure = method_.refusal(scene); !prediction.is_valid()) return;
    linear = method_.linearise_integrals(scene, times_, bed.integrand(), entries_, memory_, progress);
    if (!linear.summary.usable()) prediction.failure = linear.summary.message;
    prediction.remark = linear.summary.remark;
    integrals = linear.integrals;
  } else {
    SolverRequest request;
    request.times = times_;
    request.integrand = bed.integrand();
    const SolverResult result = solve(scene, method_, request, progress);
    if (!result.summary.usable()) prediction.failure = result.summary.message;
    prediction.remark = result.summary.remark;
    integrals = result.integrals;
  }
  if (!prediction.is_valid()) return;
  const std::size_t n = entries_.size();
  prediction.values.resize(static_cast<Index>(places_.size()));
  if (with_derivatives)
    prediction.derivatives.resize(static_cast<Index>(places_.size()), static_cast<Index>(n));
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto at = static_cast<std::size_t>(std::lower_bound(times_.begin(), times_.end(), places_[i].t) -
                                             times_.begin());
    prediction.values[static_cast<Index>(i)] = bed.height(integrals[at]);
    for (std::size_t k = 0; with_derivatives && k < n; ++k)
      prediction.derivatives(static_cast<Index>(i), static_cast<Index>(k)) =
          bed.height_by(integrals[at], linear.derivatives[at * n + k], linear.mass_derivatives[k]);
  }
}

void Forward::take(const std::vector<Sample>& samples, Prediction& prediction) const {
  prediction.values.resize(static_cast<Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i)
    prediction.values[static_cast<Index>(i)] = observable_ == Observable::phi ? samples[i].phi : samples[i].M;
}

}  // namespace shearfront::fit
