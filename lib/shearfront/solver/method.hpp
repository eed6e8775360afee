// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <any>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/solver/solver.hpp"

namespace shearfront {

namespace method_detail {

/// What a Method asks of a solver and its options, whichever it is.
class AnySolver {
 public:
  virtual ~AnySolver() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual std::string_view description() const = 0;
  [[nodiscard]] virtual std::string_view scenes() const = 0;
  [[nodiscard]] virtual Guarantees guarantees() const = 0;
  [[nodiscard]] virtual double order_M(const Scene<double>&) const = 0;
  [[nodiscard]] virtual std::vector<Option> options() const = 0;
  [[nodiscard]] virtual std::shared_ptr<const AnySolver> with(std::string_view, const OptionValue&) const = 0;
  [[nodiscard]] virtual std::shared_ptr<const AnySolver> smooth(const Scene<double>&) const = 0;
  [[nodiscard]] virtual std::shared_ptr<const AnySolver> amounts() const = 0;
  [[nodiscard]] virtual std::string refusal(const Scene<double>&) const = 0;
  [[nodiscard]] virtual std::string forewarning(const Scene<double>&) const = 0;
  [[nodiscard]] virtual std::unique_ptr<Run> start(const Scene<double>&, const Watch&) const = 0;
  [[nodiscard]] virtual bool has_derivative(const Scene<double>&, const Entry&) const = 0;
  [[nodiscard]] virtual Linearisation linearise(const Scene<double>&, const std::vector<Place>&,
                                                const std::vector<std::size_t>&, std::any&,
                                                const Progress&) const = 0;
  [[nodiscard]] virtual bool has_linear_integrals() const = 0;
  [[nodiscard]] virtual LinearIntegrals linearise_integrals(const Scene<double>&, const std::vector<double>&,
                                                            const ShareFunction&,
                                                            const std::vector<std::size_t>&, std::any&,
                                                            const Progress&) const = 0;
  [[nodiscard]] virtual bool has_linear_timeline() const = 0;
  [[nodiscard]] virtual LinearTimeline linearise_timeline(const Scene<double>&,
                                                          const std::vector<std::size_t>&,
                                                          std::any&) const = 0;
  [[nodiscard]] virtual bool has_steps() const = 0;
  [[nodiscard]] virtual bool has_linear_sum() const = 0;
  [[nodiscard]] virtual LinearSum linearise_sum(const Scene<double>&, const std::vector<Place>&,
                                                const SumWeights&, const std::vector<std::size_t>&,
                                                const Progress&) const = 0;
};

template <Solver S>
class Configured final : public AnySolver {
 public:
  using Options = typename S::Options;
  explicit Configured(Options options) : options_(std::move(options)) {}

  [[nodiscard]] std::string_view name() const override { return S::kName; }
  [[nodiscard]] std::string_view description() const override { return S::kDescription; }
  [[nodiscard]] std::string_view scenes() const override { return S::kScenes; }
  [[nodiscard]] Guarantees guarantees() const override { return S::guarantees(); }
  [[nodiscard]] double order_M(const Scene<double>& scene) const override { return order_M_of<S>(scene); }
  [[nodiscard]] std::vector<Option> options() const override {
    std::vector<Option> all;
    Options::fields(options_, [&]<class Member>(const OptionInfo& info, const Member& member) {
      if constexpr (std::is_enum_v<Member>)
        all.push_back({info, OptionChoice{static_cast<std::size_t>(member)}});
      else
        all.push_back({info, member});
    });
    return all;
  }
  [[nodiscard]] std::shared_ptr<const AnySolver> with(std::string_view option,
                                                      const OptionValue& value) const override {
    return changed([&](Options& options) {
      Options::fields(options, [&]<class Member>(const OptionInfo& info, Member& member) {
        if (info.name != option) return;
        if constexpr (std::is_enum_v<Member>)
          member = static_cast<Member>(std::get<OptionChoice>(value).index);
        else
          member = std::get<Member>(value);
      });
    });
  }
  [[nodiscard]] std::shared_ptr<const AnySolver> smooth(const Scene<double>& scene) const override {
    return changed([&](Options& options) {
      if constexpr (requires { S::prefer_smooth(scene, options); }) S::prefer_smooth(scene, options);
    });
  }
  [[nodiscard]] std::shared_ptr<const AnySolver> amounts() const override {
    return changed([](Options& options) {
      if constexpr (requires { S::prefer_amounts(options); }) S::prefer_amounts(options);
    });
  }
  [[nodiscard]] std::string refusal(const Scene<double>& scene) const override {
    return S::refusal(scene, options_);
  }
  [[nodiscard]] std::string forewarning(const Scene<double>& scene) const override {
    if constexpr (requires { S::forewarning(scene, options_); }) return S::forewarning(scene, options_);
    return {};
  }
  [[nodiscard]] std::unique_ptr<Run> start(const Scene<double>& scene, const Watch& watch) const override {
    return S::start(scene, options_, watch);
  }
  [[nodiscard]] bool has_derivative(const Scene<double>& scene, const Entry& entry) const override {
    if constexpr (DifferentiableSolver<S>)
      return S::derivative_refusal(scene, options_, entry).empty();
    else
      return false;
  }
  [[nodiscard]] Linearisation linearise(const Scene<double>& scene, const std::vector<Place>& places,
                                        const std::vector<std::size_t>& entries, std::any& memory,
                                        const Progress& progress) const override {
    if constexpr (DifferentiableSolver<S>) {
      return S::linearise(scene, options_, places, entries, memory, progress);
    } else {
      SHEARFRONT_EXPECTS(false, "a method with derivatives");
      return {};
    }
  }
  [[nodiscard]] bool has_linear_integrals() const override { return kHasLinearIntegrals; }
  [[nodiscard]] LinearIntegrals linearise_integrals(const Scene<double>& scene,
                                                    const std::vector<double>& times, const ShareFunction& g,
                                                    const std::vector<std::size_t>& entries, std::any& memory,
                                                    const Progress& progress) const override {
    if constexpr (kHasLinearIntegrals) {
      return S::linearise_integrals(scene, options_, times, g, entries, memory, progress);
    } else {
      SHEARFRONT_EXPECTS(false, "a method with derivatives of integrals");
      return {};
    }
  }
  [[nodiscard]] bool has_linear_timeline() const override { return kHasLinearTimeline; }
  [[nodiscard]] LinearTimeline linearise_timeline(const Scene<double>& scene,
                                                  const std::vector<std::size_t>& entries,
                                                  std::any& memory) const override {
    if constexpr (kHasLinearTimeline) {
      return S::linearise_timeline(scene, options_, entries, memory);
    } else {
      SHEARFRONT_EXPECTS(false, "a method with derivatives of event times");
      return {};
    }
  }
  [[nodiscard]] bool has_steps() const override {
    if constexpr (requires { S::has_steps(options_); })
      return S::has_steps(options_);
    else
      return false;
  }
  [[nodiscard]] bool has_linear_sum() const override {
    if constexpr (kHasLinearSum)
      return S::has_linear_sum(options_);
    else
      return false;
  }
  [[nodiscard]] LinearSum linearise_sum(const Scene<double>& scene, const std::vector<Place>& places,
                                        const SumWeights& weights, const std::vector<std::size_t>& entries,
                                        const Progress& progress) const override {
    if constexpr (kHasLinearSum) {
      return S::linearise_sum(scene, options_, places, weights, entries, progress);
    } else {
      SHEARFRONT_EXPECTS(false, "a method with derivatives of sums");
      return {};
    }
  }

 private:
  static constexpr bool kHasLinearSum = requires { &S::linearise_sum; };
  static constexpr bool kHasLinearIntegrals = requires { &S::linearise_integrals; };
  static constexpr bool kHasLinearTimeline = requires { &S::linearise_timeline; };

  template <class Change>
  [[nodiscard]] std::shared_ptr<const AnySolver> changed(Change&& change) const {
    Options options = options_;
    change(options);
    return std::make_shared<const Configured>(std::move(options));
  }

  Options options_;
};

}  // namespace method_detail

/// Errors: InputError (keys "places[i].t" and ".z", the first few) for places before t = 0 or outside the bed.
void check_places(const Scene<double>& scene, const std::vector<Place>& places);

/// A solver with its options: what --method, [forward] and `compare` choose. A value. A steady chute is solved here as the
/// bed it amounts to (scene/chute.hpp), so that no solver knows of chutes.
class Method {
 public:
  /// The first of the list, with its defaults: the exact solution.
  Method();
  /// By its name, with defaults. Errors: InputError (key "method") that lists the known names.
  Method(std::string_view name);
  Method(const char* name) : Method(std::string_view(name)) {}
  Method(const std::string& name) : Method(std::string_view(name)) {}
  /// Any solver, also one that the program does not know.
  template <Solver S>
  [[nodiscard]] static Method of(typename S::Options options = {}) {
    return Method(std::make_shared<const method_detail::Configured<S>>(std::move(options)));
  }

  [[nodiscard]] std::string_view name() const { return solver_->name(); }
  [[nodiscard]] std::string_view description() const { return solver_->description(); }
  [[nodiscard]] std::string_view scenes() const { return solver_->scenes(); }
  [[nodiscard]] Guarantees guarantees() const { return solver_->guarantees(); }
  /// The order of M in the resolution that it promises for the scene; 0 if exact.
  [[nodiscard]] double order_M(const Scene<double>& scene) const;

  /// In the order in which the solver lists them.
  [[nodiscard]] std::vector<Option> options() const { return solver_->options(); }
  /// Calls visit(OptionInfo, value) with the alternative of every option's value.
  template <class Visit>
  void visit_options(Visit&& visit) const {
    for (const Option& option : options())
      std::visit([&](const auto& value) { visit(option.info, value); }, option.value);
  }
  [[nodiscard]] bool has_option(std::string_view option) const;
  /// Sets an option. Preconditions: has_option(option); the value is of the option's kind and in its range.
  void set(std::string_view option, const OptionValue& value) { solver_ = solver_->with(option, value); }
  /// Chooses the options with which the solution depends most smoothly on the numbers of the scene: what a
  /// fit wants unless its user says otherwise.
  void prefer_smooth(const Scene<double>& scene);
  /// Chooses the options with which M is most accurate and smooth, whatever phi is.
  void prefer_amounts() { solver_ = solver_->amounts(); }

  /// Why the method cannot solve the scene, and which can; empty if it can.
  [[nodiscard]] std::string refusal(const Scene<double>& scene) const;
  /// What is known before a run of the work it may become, in one clause; empty if that is little, and where there is a
  /// refusal.
  [[nodiscard]] std::string forewarning(const Scene<double>& scene) const {
    return solver_->forewarning(scene);
  }
  /// Precondition: refusal(scene) is empty. The scene must outlive the run.
  [[nodiscard]] std::unique_ptr<Run> start(const Scene<double>& scene, const Watch& watch) const;

  /// Whether the method can differentiate its solution with respect to an entry of the scene.
  [[nodiscard]] bool has_derivative(const Scene<double>& scene, const Entry& entry) const {
    return !scene.is_chute() && !scene.is_slab() && solver_->has_derivative(scene, entry);
  }
  /// See DifferentiableSolver. Preconditions: refusal(scene) is empty, has_derivative() of all entries, of at
  /// least one if `entries` is empty. Errors: as check_places().
  [[nodiscard]] Linearisation linearise(const Scene<double>& scene, const std::vector<Place>& places,
                                        const std::vector<std::size_t>& entries, std::any& memory,
                                        const Progress& progress = {}) const {
    check_places(scene, places);
    return solver_->linearise(scene, places, entries, memory, progress);
  }
  /// Whether derivatives of phi say nothing of jumps that move (DifferentiableSolver).
  [[nodiscard]] bool has_steps() const { return solver_->has_steps(); }
  /// Whether linearise_sum() does for the entries for which has_derivative().
  [[nodiscard]] bool has_linear_sum() const { return solver_->has_linear_sum(); }
  /// See DifferentiableSolver. Preconditions: as linearise(); has_linear_sum(); finite times. Errors: as check_places().
  [[nodiscard]] LinearSum linearise_sum(const Scene<double>& scene, const std::vector<Place>& places,
                                        const SumWeights& weights, const std::vector<std::size_t>& entries,
                                        const Progress& progress = {}) const {
    check_places(scene, places);
    return solver_->linearise_sum(scene, places, weights, entries, progress);
  }
  /// Whether linearise_integrals() and linearise_timeline() do for the entries for which has_derivative().
  [[nodiscard]] bool has_linear_integrals() const { return solver_->has_linear_integrals(); }
  [[nodiscard]] bool has_linear_timeline() const { return solver_->has_linear_timeline(); }
  /// See DifferentiableSolver. Preconditions: as linearise(); g.slope.
  [[nodiscard]] LinearIntegrals linearise_integrals(const Scene<double>& scene,
                                                    const std::vector<double>& times, const ShareFunction& g,
                                                    const std::vector<std::size_t>& entries, std::any& memory,
                                                    const Progress& progress = {}) const {
    return solver_->linearise_integrals(scene, times, g, entries, memory, progress);
  }
  [[nodiscard]] LinearTimeline linearise_timeline(const Scene<double>& scene,
                                                  const std::vector<std::size_t>& entries,
                                                  std::any& memory) const {
    return solver_->linearise_timeline(scene, entries, memory);
  }

  /// Names of all solvers with the property, in the order of the list.
  [[nodiscard]] static std::vector<std::string> names(bool Guarantees::*property = nullptr);

 private:
  using AnySolver = method_detail::AnySolver;
  explicit Method(std::shared_ptr<const AnySolver> solver) : solver_(std::move(solver)) {}

  std::shared_ptr<const AnySolver> solver_;  ///< never changed, so copies may share it
};

}  // namespace shearfront
