// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/cole_hopf_solver.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <utility>
#include <variant>

#include "shearfront/diffusion/closed_form.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

class ColeHopfField final : public Field {
 public:
  ColeHopfField(const Scene<double>& scene, diffusion::ClosedForm form)
      : scene_(scene), form_(std::move(form)) {}

  double t = 0;

  [[nodiscard]] Sample at(double z) const override {
    const diffusion::ClosedFormValue value = form_(z, t);
    return {value.phi, value.M};
  }
  /// c = 1, and phi is analytic for t > 0.
  [[nodiscard]] double integral(const ShareFunction& g) const override {
    constexpr unsigned kMostHalvings = 12;
    constexpr double kTolerance = 1e-11;
    return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
        [&](double z) { return g.value(form_(z, t).phi); }, scene_.bottom(), scene_.top(), kMostHalvings,
        kTolerance);
  }

 private:
  const Scene<double>& scene_;
  diffusion::ClosedForm form_;
};

class ColeHopfRun final : public Run {
 public:
  ColeHopfRun(const Scene<double>& scene, diffusion::ClosedForm form, Progress progress)
      : progress_(std::move(progress)), field_(scene, std::move(form)) {}

  Status advance(double t) override {
    field_.t = t;
    if (progress_ && !progress_(t, 0)) status_ = Status::interrupted;
    return status_;
  }
  [[nodiscard]] const Field& field() override { return field_; }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message =
        status_ == Status::ok ? "exact to rounding" : "interrupted at t = " + number_text(field_.t);
    return summary;
  }

 private:
  Progress progress_;
  ColeHopfField field_;
  Status status_ = Status::ok;
};

}  // namespace

std::string ColeHopfSolver::refusal(const Scene<double>& scene, const Options&) {
  const auto found = diffusion::closed_form(scene);
  const auto* why = std::get_if<std::string>(&found);
  return why ? *why : std::string();
}

std::unique_ptr<Run> ColeHopfSolver::start(const Scene<double>& scene, const Options&, const Watch& watch) {
  return std::make_unique<ColeHopfRun>(scene, std::get<diffusion::ClosedForm>(diffusion::closed_form(scene)),
                                       watch.progress);
}

}  // namespace shearfront
