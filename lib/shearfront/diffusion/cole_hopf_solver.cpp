// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_solver.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "shearfront/diffusion/closed_form.hpp"
#include "shearfront/diffusion/steady_logistic.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/quadrature.hpp"

namespace shearfront {
namespace {

class ColeHopfField final : public Field {
 public:
  ColeHopfField(const Scene<double>& scene, diffusion::ClosedForm form)
      : scene_(scene), form_(std::move(form)) {}

  double t = 0;

  [[nodiscard]] double effect_of_ends(double at) const { return form_.effect_of_ends(at); }
  [[nodiscard]] Sample at(double z) const override {
    const diffusion::ClosedFormValue value = form_.value(z, t);
    return {value.phi, value.M};
  }
  /// c = 1, and phi is analytic for t > 0.
  [[nodiscard]] double integral(const ShareFunction& g) const override {
    constexpr unsigned kMostHalvings = 12;
    constexpr double kTolerance = 1e-11;
    return integral_of_smooth<double>([&](double z) { return g.value(form_.value(z, t).phi); },
                                      scene_.bottom(), scene_.top(), kMostHalvings, kTolerance);
  }

 private:
  const Scene<double>& scene_;
  diffusion::ClosedForm form_;
};

/// Of phi: beyond, a form is not given; below, it is exact to rounding.
constexpr double kMostEndEffect = 1e-5, kEndRounding = 1e-15;

class ColeHopfRun final : public Run {
 public:
  ColeHopfRun(const Scene<double>& scene, diffusion::ClosedForm form, bool is_steady, const Watch& watch)
      : progress_(watch.progress),
        last_time_(watch.last_time),
        is_steady_(is_steady),
        field_(scene, std::move(form)) {}

  Status advance(double t) override {
    field_.t = t;
    if (is_steady_ && std::isfinite(t)) return status_ = Status::unsupported;
    const double last = std::max(t, last_time_);
    effect_ = field_.effect_of_ends(t);
    if (field_.effect_of_ends(last) > kMostEndEffect) {
      too_late_ = last;
      return status_ = Status::unsupported;
    }
    if (progress_ && !progress_(t, 0)) status_ = Status::interrupted;
    return status_;
  }
  [[nodiscard]] const Field& field() override { return field_; }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message = message();
    return summary;
  }

 private:
  [[nodiscard]] std::string message() const {
    if (status_ == Status::interrupted) return "interrupted at t = " + number_text(field_.t);
    if (status_ == Status::unsupported && is_steady_)
      return "the option steady gives the steady state only: ask for that time, steady";
    if (status_ == Status::unsupported)
      return "the closed form is that of an endless bed, and its phi_z at the ends of this one is no longer "
             "0 at "
             "t = " +
             number_text(too_late_);
    if (effect_ <= kEndRounding) return "exact to rounding";
    return "exact for an endless bed; the ends change phi by at most " + number_text(effect_, 2);
  }

  Progress progress_;
  double last_time_, too_late_ = 0, effect_ = 0;
  bool is_steady_;
  ColeHopfField field_;
  Status status_ = Status::ok;
};

}  // namespace

std::string ColeHopfSolver::refusal(const Scene<double>& scene, const Options& options) {
  if (options.steady) return diffusion::SteadyLogistic::refusal(scene);
  const auto found = diffusion::closed_form(scene);
  const auto* why = std::get_if<std::string>(&found);
  return why ? *why : std::string();
}

std::unique_ptr<Run> ColeHopfSolver::start(const Scene<double>& scene, const Options& options,
                                           const Watch& watch) {
  if (options.steady) {
    const auto state = std::make_shared<const diffusion::SteadyLogistic>(scene);
    diffusion::ClosedForm form{[state](double z, double) { return state->at(z); }};
    return std::make_unique<ColeHopfRun>(scene, std::move(form), true, watch);
  }
  return std::make_unique<ColeHopfRun>(scene, std::get<diffusion::ClosedForm>(diffusion::closed_form(scene)),
                                       false, watch);
}

}  // namespace shearfront
