// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/face_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "shearfront/diffusion/extended_flux.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {
namespace {

/// What a scheme takes for D, and its derivatives; P = |r| W dz / (2 D).
struct FaceDiffusivity {
  double value, by_rate, by_diffusivity;

  static FaceDiffusivity of(Scheme scheme, double rate, double diffusivity, double fastest, double width) {
    const double upwind = 0.5 * fastest * width;
    switch (scheme) {
      case Scheme::central:
        break;
      case Scheme::raised:
        return raised(rate, diffusivity, upwind);
      case Scheme::fitted:
        return fitted(rate, diffusivity, upwind);
    }
    return {diffusivity, 0, 1};
  }

 private:
  static double sign(double rate) { return rate > 0 ? 1 : rate < 0 ? -1 : 0; }
  static FaceDiffusivity all_upwind(double rate, double upwind) {
    return {std::abs(rate) * upwind, sign(rate) * upwind, 0};
  }
  static FaceDiffusivity raised(double rate, double diffusivity, double upwind) {
    const double p = std::abs(rate) * upwind / diffusivity, share = raised_share(p);
    if (share == 1) return {diffusivity, 0, 1};
    if (share == p) return all_upwind(rate, upwind);
    const double slope = (p - kCentralUpTo) / (2 * (1 - kCentralUpTo));
    return {diffusivity * share, sign(rate) * upwind * slope, share - p * slope};
  }
  /// D P coth(P).
  static FaceDiffusivity fitted(double rate, double diffusivity, double upwind) {
    if (rate == 0 && diffusivity == 0) return {0, 0, 0};
    const double p = std::abs(rate) * upwind / diffusivity;
    // coth(P) = 1 to rounding, P / sinh(P) = 0; D may be 0 here
    if (!(p < 300)) return all_upwind(rate, upwind);
    if (p < 0x1p-9)  // next terms: P^4 / 45, P^5 2 / 945, P^4 / 15
      return {diffusivity * (1 + p * p / 3), sign(rate) * upwind * (2 * p / 3 - 4 * p * p * p / 45),
              1 - p * p / 3};
    const double coth = 1 / std::tanh(p), share = p / std::sinh(p);
    return {diffusivity * p * coth, sign(rate) * upwind * (coth - share / std::sinh(p)), share * share};
  }
};

template <class Model, Scheme scheme>
class MeanRule final : public FaceRule {
 public:
  MeanRule(const Problem& problem, const Model& flux)
      : flux_(flux), ends_(problem.ends), n_(problem.n_cells), values_(n_ + 2), slopes_(n_ + 2) {
    if (!problem.has_equal_cells()) {
      set_unequal(problem);
      return;
    }
    const double width = problem.width(), fastest = flux_.fastest();
    for (std::size_t i = 0; i <= n_; ++i) {
      const auto d = FaceDiffusivity::of(scheme, problem.rate[i], problem.diffusivity[i], fastest, width);
      half_rates_.push_back(0.5 * problem.rate[i] / width);
      diffusions_.push_back(d.value / (width * width));
      by_rate_.push_back(d.by_rate / (width * width));
      by_diffusivity_.push_back(d.by_diffusivity / (width * width));
    }
    half_per_width_ = 0.5 / width;
    if (scheme != Scheme::fitted) return;
    for (std::size_t i = 0; i < n_; ++i)
      explicit_rate_ = std::max(explicit_rate_, std::abs(half_rates_[i + 1] - half_rates_[i]) * fastest +
                                                    diffusions_[i] + diffusions_[i + 1]);
  }

  void evaluate(const double* v, FaceFluxes& out) override {
    for (std::size_t j = 0; j < n_ + 2; ++j) {
      values_[j] = flux_.value(v[j]);
      slopes_[j] = flux_.derivative(v[j]);
    }
    if (per_below_.empty()) {
      fill_equal(v, out);
    } else {
      fill_unequal(v, out);
    }
    set_ends(out);
  }
  void evaluate_tangent(const double* v, const Tangent& tangent, std::span<double> out) override {
    SHEARFRONT_EXPECTS(per_below_.empty(), "equal cells");
    for (std::size_t i = 0; i <= n_; ++i) {
      const double rise = v[i + 1] - v[i];
      out[i] = 0;
      if (!tangent.rate.empty())
        out[i] += tangent.rate[i] *
                  (half_per_width_ * (flux_.value(v[i]) + flux_.value(v[i + 1])) - by_rate_[i] * rise);
      if (!tangent.diffusivity.empty()) out[i] -= tangent.diffusivity[i] * by_diffusivity_[i] * rise;
    }
    if (ends_ == Ends::no_flux) out[0] = out[n_] = 0;
  }
  [[nodiscard]] double explicit_rate() const override { return explicit_rate_; }

 private:
  void set_unequal(const Problem& problem) {
    const double fastest = flux_.fastest();
    const bool is_periodic = ends_ == Ends::periodic;
    for (auto* faces : {&rates_below_, &rates_above_, &diffusions_, &per_below_, &per_above_})
      faces->reserve(n_ + 1);
    for (std::size_t i = 0; i <= n_; ++i) {
      const double below = problem.width(i > 0 ? i - 1 : is_periodic ? n_ - 1 : 0);
      const double above = problem.width(i < n_ ? i : is_periodic ? 0 : n_ - 1);
      const double distance = 0.5 * (below + above), rate = problem.rate[i];
      const double share = scheme == Scheme::fitted ? 0.5 : above / (below + above);
      const double width = scheme == Scheme::fitted ? distance : std::max(below, above);
      const double d = FaceDiffusivity::of(scheme, rate, problem.diffusivity[i], fastest, width).value;
      rates_below_.push_back(share * rate);
      rates_above_.push_back((1 - share) * rate);
      diffusions_.push_back(d / distance);
      per_below_.push_back(1 / below);
      per_above_.push_back(1 / above);
    }
    if (scheme != Scheme::fitted) return;
    for (std::size_t i = 0; i < n_; ++i)
      explicit_rate_ = std::max(explicit_rate_, (std::abs(rates_below_[i + 1] - rates_above_[i]) * fastest +
                                                 diffusions_[i] + diffusions_[i + 1]) *
                                                    per_above_[i]);
  }
  // From the fluxes and slopes of the cells:
  void fill_equal(const double* __restrict v, FaceFluxes& out) const {
    double* __restrict const value = out.value.data();
    double* __restrict const by_below = out.by_below.data();
    double* __restrict const by_above = out.by_above.data();
    for (std::size_t i = 0; i <= n_; ++i) {
      const double half = half_rates_[i], d = diffusions_[i];
      value[i] = half * (values_[i] + values_[i + 1]) - d * (v[i + 1] - v[i]);
      by_below[i] = half * slopes_[i] + d;
      by_above[i] = half * slopes_[i + 1] - d;
    }
  }
  void fill_unequal(const double* __restrict v, FaceFluxes& out) const {
    double* __restrict const value = out.value.data();
    double* __restrict const by_below = out.by_below.data();
    double* __restrict const by_above = out.by_above.data();
    for (std::size_t i = 0; i <= n_; ++i) {
      const double below = rates_below_[i], above = rates_above_[i], d = diffusions_[i];
      value[i] = below * values_[i] + above * values_[i + 1] - d * (v[i + 1] - v[i]);
      by_below[i] = (below * slopes_[i] + d) * per_below_[i];
      by_above[i] = (above * slopes_[i + 1] - d) * per_above_[i];
    }
  }
  void set_ends(FaceFluxes& out) const {
    if (ends_ == Ends::no_flux)
      for (const std::size_t i : {std::size_t{0}, n_}) out.value[i] = out.by_below[i] = out.by_above[i] = 0;
    if (ends_ != Ends::neumann) return;
    // The states beyond the ends are those of the end cells.
    out.by_above[0] += out.by_below[0];
    out.by_below[n_] += out.by_above[n_];
    out.by_below[0] = out.by_above[n_] = 0;
  }

  ExtendedFlux<Model, scheme != Scheme::fitted> flux_;
  Ends ends_;
  std::size_t n_;
  double half_per_width_ = 0, explicit_rate_ = 0;
  std::vector<double> half_rates_, diffusions_;   ///< r / (2 dz) and the scheme's D / dz^2; unequal: D / dz
  std::vector<double> by_rate_, by_diffusivity_;  ///< derivatives of the latter
  /// Unequal cells: r times the weights of f(l) and f(u), 1 / dz of the cells.
  std::vector<double> rates_below_, rates_above_, per_below_, per_above_;
  std::vector<double> values_, slopes_;  ///< of the cells
};

}  // namespace

std::unique_ptr<FaceRule> FaceRule::make(const Problem& problem, Scheme scheme) {
  return with_model(problem.flux, [&]<class Model>(const Model& flux) -> std::unique_ptr<FaceRule> {
    switch (scheme) {
      case Scheme::central:
        return std::make_unique<MeanRule<Model, Scheme::central>>(problem, flux);
      case Scheme::raised:
        return std::make_unique<MeanRule<Model, Scheme::raised>>(problem, flux);
      case Scheme::fitted:
        break;
    }
    return std::make_unique<MeanRule<Model, Scheme::fitted>>(problem, flux);
  });
}

double largest_cell_peclet(const Problem& problem) {
  const double fastest = fastest_slope(problem.flux);
  const std::size_t n = problem.n_cells;
  const bool has_walls = problem.ends == Ends::no_flux;
  double largest = 0;
  for (std::size_t i = has_walls ? 1 : 0; i < (has_walls ? n : n + 1); ++i) {
    const double width = std::max(problem.width(i > 0 ? i - 1 : 0), problem.width(i < n ? i : n - 1));
    largest = std::max(largest, std::abs(problem.rate[i]) * fastest * width / (2 * problem.diffusivity[i]));
  }
  return largest;
}

}  // namespace shearfront::diffusion
