// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/forward.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "shearfront/fit/diffusion_forward.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/exact/derivatives.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/observation.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class ForwardModel : public Forward {
 public:
  ForwardModel(const Parameters& parameters, Observable field, std::vector<Point> points)
      : parameters_(parameters), field_(field), points_(std::move(points)) {}

 protected:
  [[nodiscard]] Index n_points() const { return static_cast<Index>(points_.size()); }

  Parameters parameters_;
  Observable field_;
  std::vector<Point> points_;
};

class ExactForward final : public ForwardModel {
 public:
  ExactForward(const Parameters& parameters, const ForwardSpec& forward, Observable field,
               std::vector<Point> points)
      : ForwardModel(parameters, field, std::move(points)), layers_(forward.options.layers) {
    const std::vector<Entry> all = entries(parameters.scene().spec());
    for (const Parameter& p : parameters) {
      has_derivatives_ = has_derivatives_ && derivative_refusal(parameters.scene(), p.entry).empty();
      columns_.push_back(static_cast<std::size_t>(
          std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.name() == p.entry.name(); }) -
          all.begin()));
    }
  }

  [[nodiscard]] bool has_derivatives() const override { return has_derivatives_; }
  [[nodiscard]] double smallest_step() const override { return 1e-6; }

  [[nodiscard]] Prediction predict(const VectorXd& values, bool with_derivatives) const override {
    Prediction prediction;
    const auto found = parameters_.scene_at(values, prediction.failure);
    if (!found) return prediction;
    const Scene<double>& scene = *found;
    if (std::string reason = exact::refusal(scene); !reason.empty()) {
      prediction.failure = std::move(reason);
      return prediction;
    }
    const ExactSolution<double> solution(scene, {layers_});
    const auto derivatives = with_derivatives ? std::make_unique<Derivatives<double>>(solution) : nullptr;
    prediction.values.resize(n_points());
    if (with_derivatives) prediction.derivatives.resize(n_points(), values.size());
    for (Index i = 0; i < n_points(); ++i) {
      const Point& point = points_[static_cast<std::size_t>(i)];
      if (!with_derivatives) {
        const auto at = solution.at(point.z, point.t);
        prediction.values[i] = field_ == Observable::phi ? at.phi : at.M;
        continue;
      }
      const auto at = derivatives->at(point.z, point.t);
      prediction.values[i] = field_ == Observable::phi ? at.value.phi : at.value.M;
      const std::vector<double>& gradient = field_ == Observable::phi ? at.phi : at.M;
      for (std::size_t k = 0; k < columns_.size(); ++k)
        prediction.derivatives(i, static_cast<Index>(k)) = gradient[columns_[k]];
    }
    return prediction;
  }

 private:
  std::size_t layers_;
  std::vector<std::size_t> columns_;  ///< of each parameter among the entries of the scene
  bool has_derivatives_ = true;
};

using Solve = SolverResult (*)(const Scene<double>&, const SolverRequest&, const SolverOptions&);

/// Points of which some have the same time, or height: positions among the distinct ones.
std::size_t position(const std::vector<double>& xs, double x) {
  return static_cast<std::size_t>(std::lower_bound(xs.begin(), xs.end(), x) - xs.begin());
}
void keep_distinct(std::vector<double>& xs) {
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
}

/// Heights of the bed, by any solver.
class BedHeightForward final : public ForwardModel {
 public:
  BedHeightForward(const Parameters& parameters, const ForwardSpec& forward, Solve solve, bool is_exact,
                   std::vector<Point> points)
      : ForwardModel(parameters, Observable::bed_height, std::move(points)),
        solve_(solve),
        options_(forward.options),
        is_exact_(is_exact) {
    for (const Point& point : points_) times_.push_back(point.t);
    keep_distinct(times_);
  }

  [[nodiscard]] bool has_derivatives() const override { return false; }
  [[nodiscard]] double smallest_step() const override { return is_exact_ ? 1e-6 : 1e-3; }

  [[nodiscard]] Prediction predict(const VectorXd& values, bool /*with_derivatives*/) const override {
    Prediction prediction;
    const auto found = parameters_.scene_at(values, prediction.failure);
    if (!found) return prediction;
    const Scene<double>& scene = *found;
    const BedHeight bed(scene);
    SolverRequest request;
    request.times = times_;
    request.integrand = bed.integrand();
    const SolverResult result = solve_(scene, request, options_);
    if (!result.summary.usable()) {
      prediction.failure = result.summary.message;
      return prediction;
    }
    prediction.values.resize(n_points());
    for (Index i = 0; i < n_points(); ++i)
      prediction.values[i] =
          bed.height(result.integrals[position(times_, points_[static_cast<std::size_t>(i)].t)]);
    return prediction;
  }

 private:
  Solve solve_;
  SolverOptions options_;
  bool is_exact_;
  std::vector<double> times_;
};

class SolverForward final : public ForwardModel {
 public:
  SolverForward(const Parameters& parameters, const ForwardSpec& forward, Solve solve, Observable field,
                std::vector<Point> points)
      : ForwardModel(parameters, field, std::move(points)), solve_(solve), options_(forward.options) {
    // M of the states themselves is of second order and varies more smoothly than M of the lines through
    // them.
    if (field == Observable::M) options_.reconstruct = Reconstruction::constant;
    for (const Point& point : points_) {
      request_.times.push_back(point.t);
      request_.heights.push_back(point.z);
    }
    keep_distinct(request_.times);
    keep_distinct(request_.heights);
    for (const Point& point : points_)
      samples_.push_back(position(request_.times, point.t) * request_.heights.size() +
                         position(request_.heights, point.z));
  }

  [[nodiscard]] bool has_derivatives() const override { return false; }
  [[nodiscard]] double smallest_step() const override { return 1e-3; }

  [[nodiscard]] Prediction predict(const VectorXd& values, bool /*with_derivatives*/) const override {
    Prediction prediction;
    const auto scene = parameters_.scene_at(values, prediction.failure);
    if (!scene) return prediction;
    const SolverResult result = solve_(*scene, request_, options_);
    if (!result.summary.usable()) {
      prediction.failure = result.summary.message;
      return prediction;
    }
    prediction.values.resize(n_points());
    for (Index i = 0; i < n_points(); ++i) {
      const Sample& sample = result.samples[samples_[static_cast<std::size_t>(i)]];
      prediction.values[i] = field_ == Observable::phi ? sample.phi : sample.M;
    }
    return prediction;
  }

 private:
  Solve solve_;
  SolverOptions options_;
  SolverRequest request_;
  std::vector<std::size_t> samples_;  ///< of each point among the samples of the solver
};

}  // namespace

std::unique_ptr<Forward> make_forward(const Parameters& parameters, const ForwardSpec& forward, Observable field,
                                      std::vector<Point> points) {
  if (field == Observable::bed_height)
    if (const std::string reason = BedHeight::refusal(parameters.scene()); !reason.empty())
      throw InputError("misfit.quantity", quoted_text(std::string(name_of(Quantity::bed_height))),
                       "must suit the scene: " + reason);
  std::unique_ptr<Forward> model;
  SolverList::for_each([&]<class S>() {
    if (forward.method != S::kName) return;
    constexpr bool kIsExact = std::is_same_v<S, ExactSolver>;
    if constexpr (kIsExact)
      if (const std::string reason = exact::refusal(parameters.scene()); !reason.empty())
        throw InputError("forward.method", quoted_text(forward.method), "must suit the scene: " + reason);
    if (field == Observable::bed_height)
      model = std::make_unique<BedHeightForward>(parameters, forward, &S::solve, kIsExact, std::move(points));
    else if constexpr (kIsExact)
      model = std::make_unique<ExactForward>(parameters, forward, field, std::move(points));
    else if constexpr (std::is_same_v<S, CrankNicolsonSolver>)
      model = std::make_unique<DiffusionForward>(parameters, forward, field, std::move(points));
    else
      model = std::make_unique<SolverForward>(parameters, forward, &S::solve, field, std::move(points));
  });
  if (!model)
    throw InputError("forward.method", quoted_text(forward.method), "must be one of: " + SolverList::names());
  return model;
}

std::vector<std::string> forward_names() {
  std::vector<std::string> names;
  SolverList::for_each([&]<class S>() { names.emplace_back(S::kName); });
  return names;
}

}  // namespace shearfront::fit
