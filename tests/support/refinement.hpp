// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "support/options.hpp"

/// One scene by one method at finer and finer resolutions: the error of everything that is printed.
namespace shearfront::support {

/// A method of the list, or one of its options that promises something else: what `compare` calls front-tracking:linear.
struct RefinedMethod {
  std::string solver;
  bool is_linear = false;

  [[nodiscard]] std::string name() const { return solver + (is_linear ? ":linear" : ""); }
  /// Every option that stands for a resolution halved `level` times. The tolerance of time steps is proportional to the
  /// error they make, so it falls with the square.
  [[nodiscard]] Method at(int level) const {
    const double fine = std::exp2(level);
    OptionNumbers numbers{
        {"resolution", 0.08 / fine}, {"cells", 50 * fine}, {"tolerance", 4e-3 / (fine * fine)}};
    if (solver == Method().name()) numbers = {{"layers", 8 * fine}};  // of beds that it approximates
    if (is_linear) numbers["reconstruct"] = 1;
    return method_of(solver, numbers);
  }
};

/// All of the list, with the options that change an order.
[[nodiscard]] inline std::vector<RefinedMethod> refined_methods() {
  std::vector<RefinedMethod> all;
  for (const std::string& name : Method::names()) {
    all.push_back({name});
    if (Method(name).has_option("reconstruct")) all.push_back({name, true});
  }
  return all;
}

/// What is promised for a scene; 0 where nothing is, or all is exact.
struct PromisedOrders {
  /// Whether a state of the start is within a quarter of the range of the flux from its top, but not there.
  [[nodiscard]] static bool starts_near_top(const Scene<double>& scene) {
    for (const Flux<double>& flux : scene.fluxes())
      for (const double share : scene.initial_values())
        for (const double top : flux.extrema())
          if (share != top && std::abs(share - top) < (flux.range().highest - flux.range().lowest) / 4)
            return true;
    return false;
  }
  double phi = 0, M = 0, first_wave = 0, last_wave = 0;

  PromisedOrders(const RefinedMethod& method, const Scene<double>& scene) {
    const Guarantees promised = Method(method.solver).guarantees();
    phi = promised.order_phi;
    M = Method(method.solver).order_M(scene);
    const bool is_approximated = promised.exact && !promised.diffusion && Method().refusal(scene).empty() &&
                                 !ExactSolution<double>(scene).is_exact();
    if (is_approximated) phi = 1, M = 1.5;  // pieces and layers, where paths turn
    first_wave = phi;
    last_wave = M;
    // Exact for fans in their first layer, of second order in others.
    if (method.is_linear && scene.is_layered()) phi = 2;
    // Last waves are shocks, as exact as M, where the flux bends one way; else edges of fans, as exact as first waves.
    const bool bends_both_ways =
        std::any_of(scene.fluxes().begin(), scene.fluxes().end(),
                    [](const Flux<double>& flux) { return flux.curvature() == Curvature::mixed; });
    if (bends_both_ways) last_wave = std::min(first_wave, M);
    // Levels of H are wide in phi next to the top of the flux: a start that stays there is of order 1/2 until R is less than
    // the square of its distance.
    const bool has_levels = method.solver == "front-tracking" && !scene.is_layered();
    if (has_levels && starts_near_top(scene)) phi = std::min(phi, 0.5);
  }
};

/// Errors of one quantity, level by level.
struct Convergence {
  double order = 0;     ///< promised
  double rounding = 0;  ///< errors below this are none
  double usual = 0;     ///< so large may the error be at the first level, whatever it is there
  std::vector<double> errors;

  /// Errors times h^-order do not grow: from the coarser half of the levels to the finer half by no more than `slack`,
  /// which pre-asymptotic resolutions and the logarithm of monotone schemes take. An error that is small by chance at the
  /// coarse levels (a fan narrower than a step, a change of sign) may come back to what is usual.
  [[nodiscard]] bool shows_order(double slack) const {
    const auto most = [&](std::size_t begin, std::size_t end) {
      double largest = 0;
      for (std::size_t k = begin; k < end; ++k)
        if (errors[k] > rounding)
          largest = std::max(largest, errors[k] * std::exp2(order * static_cast<double>(k)));
      return largest;
    };
    const std::size_t half = (errors.size() + 1) / 2;
    return most(half, errors.size()) <= std::max(usual, slack * most(0, half));
  }
  /// Most of the order over the last halvings, three, or two of times of events, which go down in steps: what begins late (next to an inflection of the flux, behind a fan that
  /// is narrower than a cell) is on its way, and what has half the order is not.
  [[nodiscard]] bool comes_to_order(std::size_t halvings = 3) const {
    constexpr double kMost = 0.55;
    return observed(errors.size() - 1 - halvings) >= kMost * order;
  }
  /// Observed between the level `first` and the last; `rounding` for errors below it.
  [[nodiscard]] double observed(std::size_t first = 0) const {
    return std::log2(std::max(errors[first], rounding) / std::max(errors.back(), rounding)) /
           static_cast<double>(errors.size() - 1 - first);
  }
};

/// One scene by one method. Errors are measured against the exact solution where there is one to rounding, else as the
/// change to the next level.
class Refinement {
 public:
  /// `is_of_mixing`: integrals are those of the entropy, not of the height of the bed.
  Refinement(const Scene<double>& scene, RefinedMethod method, std::vector<double> times, bool is_of_mixing)
      : scene_(scene),
        method_(std::move(method)),
        times_(std::move(times)),
        is_of_mixing_(is_of_mixing),
        orders_(method_, scene) {
    for (int i = 0; i <= kHeights; ++i)
      heights_.push_back(i == kHeights ? scene.top()
                                       : scene.bottom() + (scene.top() - scene.bottom()) * i / kHeights);
    if (Method().refusal(scene).empty()) {
      exact_ = std::make_unique<ExactSolution<double>>(scene);
      if (!exact_->is_exact()) exact_.reset();
    }
    if (exact_) {
      exact_answer_ = answer(Method());
      if (!exact_answer_.summary.usable()) exact_.reset();
    }
  }

  [[nodiscard]] bool has_exact() const { return bool(exact_); }
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  /// Of the finest run yet.
  [[nodiscard]] std::uint64_t collisions() const { return answers_.back().summary.collisions; }

  /// Errors of all quantities over `levels` levels; empty if a run does not end (trouble()).
  [[nodiscard]] std::map<std::string, Convergence> errors(int levels) {
    while (static_cast<int>(answers_.size()) < levels + (has_exact() ? 0 : 1)) {
      answers_.push_back(answer(method_.at(static_cast<int>(answers_.size()))));
      trouble_ = answers_.back().summary.usable() ? "" : answers_.back().summary.message;
      if (!trouble_.empty()) return {};
    }
    std::map<std::string, Convergence> all;
    for (int k = 0; k < levels; ++k) add(all, k);
    return all;
  }

 private:
  static constexpr int kHeights = 32;

  [[nodiscard]] SolverResult answer(const Method& method) const {
    SolverRequest request{times_, heights_};
    request.timeline = method.guarantees().has_timeline && has_walls();
    request.profiles = method.guarantees().has_profiles;
    if (BedHeight::refusal(scene_).empty())
      request.integrand = is_of_mixing_ ? entropy_function() : BedHeight(scene_).integrand();
    return solve(scene_, method, request);
  }
  [[nodiscard]] bool has_walls() const {
    return !scene_.spec().is_periodic && !scene_.spec().outside_bottom && !scene_.spec().outside_top;
  }

  void add(std::map<std::string, Convergence>& all, int level) {
    const SolverResult& coarse = answers_[static_cast<std::size_t>(level)];
    const SolverResult& fine = has_exact() ? exact_answer_ : answers_[static_cast<std::size_t>(level) + 1];
    const double height = scene_.top() - scene_.bottom(), states = largest_state();
    const auto note = [&](const std::string& what, double order, double unit, double error) {
      Convergence& convergence = all[what];
      convergence.order = order;
      convergence.rounding = 1e-11 * unit;
      convergence.usual = 0.25 * unit * std::pow(first_step(), order);
      convergence.errors.push_back(error);
    };
    for (std::size_t i = 0; i < times_.size(); ++i) {
      const std::string when = i == 0 ? " early" : " late";
      double largest = 0;
      for (std::size_t j = 0; j < heights_.size(); ++j)
        largest = std::max(largest, std::abs(coarse.M(i, j) - fine.M(i, j)));
      note("M" + when, orders_.M, height * states, largest);
      if (!coarse.profiles.empty())
        note("phi" + when, orders_.phi, height * states,
             has_exact() ? errors_against(*exact_, coarse.profiles[i], times_[i]).l1
                         : l1_distance(coarse.profiles[i], fine.profiles[i]));
      if (!coarse.integrals.empty())
        note((is_of_mixing_ ? "mixing" : "bed height") + when, std::min(1.0, orders_.phi), height,
             std::abs(coarse.integrals[i] - fine.integrals[i]));
    }
    if (coarse.timeline && fine.timeline) add_events(*coarse.timeline, *fine.timeline, note);
  }

  template <class Note>
  void add_events(const Timeline<double>& coarse, const Timeline<double>& fine, Note&& note) {
    const auto time = [&](const char* what, double order, const std::optional<double>& a,
                          const std::optional<double>& b) {
      if (a.has_value() != b.has_value()) {
        note(what, order, 1, 1e300);  // never or not must not be a matter of resolution
      } else if (a) {
        note(what, order, 1 + *b, std::abs(*a - *b));
      }
    };
    time("t_0", orders_.first_wave, coarse.t0, fine.t0);
    time("t_1", orders_.first_wave, coarse.t1, fine.t1);
    time("t*", orders_.last_wave, coarse.t_star, fine.t_star);
    for (std::size_t i = 0; i < std::min(coarse.interfaces.size(), fine.interfaces.size()); ++i) {
      const std::string number = "(" + std::to_string(i) + ")";
      time(("t_c" + number).c_str(), orders_.first_wave, coarse.interfaces[i].first,
           fine.interfaces[i].first);
      time(("t^_c" + number).c_str(), orders_.last_wave, coarse.interfaces[i].last, fine.interfaces[i].last);
    }
  }
  /// The resolution of the first level, in the range of the states or the height of the bed.
  [[nodiscard]] double first_step() const {
    double step = 1;
    method_.at(0).visit_options([&](const OptionInfo& info, const auto& value) {
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
        if (info.name == "resolution") step = static_cast<double>(value);
        if (info.name == "cells" || info.name == "layers") step = 1 / static_cast<double>(value);
      }
    });
    return step;
  }
  [[nodiscard]] double largest_state() const {
    double most = 0;
    for (const double phi : scene_.spec().initial_values) most = std::max(most, std::abs(phi));
    return most == 0 ? 1 : most;
  }

  const Scene<double>& scene_;
  RefinedMethod method_;
  std::string trouble_;
  std::vector<double> times_, heights_;
  bool is_of_mixing_;
  PromisedOrders orders_;
  std::unique_ptr<ExactSolution<double>> exact_;
  SolverResult exact_answer_;
  std::vector<SolverResult> answers_;
};

}  // namespace shearfront::support
