// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <any>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/solver/all.hpp"

namespace shearfront {

namespace method_detail {

template <Solver S>
struct Configured {
  using Type = S;
  typename S::Options options{};
};
template <class List>
struct VariantOf;
template <class... S>
struct VariantOf<TypeList<S...>> {
  using Type = std::variant<Configured<S>...>;
};

}  // namespace method_detail

/// A solver of SolverList with its options: what --method, [forward] and `compare` choose.
class Method {
 public:
  /// The first of the list, with its defaults.
  Method() = default;
  /// By its name, with defaults. Errors: InputError (key "method") that lists the known names.
  explicit Method(std::string_view name);
  template <Solver S>
  [[nodiscard]] static Method of(typename S::Options options = {}) {
    Method method;
    method.solver_ = method_detail::Configured<S>{std::move(options)};
    return method;
  }

  [[nodiscard]] std::string_view name() const;
  [[nodiscard]] std::string_view description() const;
  [[nodiscard]] std::string_view scenes() const;
  [[nodiscard]] Guarantees guarantees() const;

  [[nodiscard]] bool has_option(std::string_view option) const;
  /// Calls visit(OptionInfo, member) for all options.
  template <class Visit>
  void visit_options(Visit&& visit) {
    std::visit([&](auto& solver) { solver.options.fields(solver.options, visit); }, solver_);
  }
  template <class Visit>
  void visit_options(Visit&& visit) const {
    std::visit([&](const auto& solver) { solver.options.fields(solver.options, visit); }, solver_);
  }
  /// Chooses the options with which the solution depends most smoothly on the numbers of the scene: what a fit wants
  /// unless its user says otherwise.
  void prefer_smooth(const Scene<double>& scene);
  /// Chooses the options with which M is most accurate and smooth, whatever phi is.
  void prefer_amounts();

  /// Why the method cannot solve the scene, and which can; empty if it can.
  [[nodiscard]] std::string refusal(const Scene<double>& scene) const;
  /// Precondition: refusal(scene) is empty. The scene must outlive the run.
  [[nodiscard]] std::unique_ptr<Run> start(const Scene<double>& scene, const Watch& watch) const;

  /// Whether the method can differentiate its solution with respect to an entry of the scene.
  [[nodiscard]] bool has_derivative(const Scene<double>& scene, const Entry& entry) const;
  /// See DifferentiableSolver. Preconditions: refusal(scene) is empty, has_derivative() of all entries, of at least one
  /// if `entries` is empty.
  [[nodiscard]] Linearisation linearise(const Scene<double>& scene, const std::vector<Place>& places,
                                        const std::vector<std::size_t>& entries, std::any& memory) const;

  /// Names of all solvers with the property, in the order of the list.
  [[nodiscard]] static std::vector<std::string> names(bool Guarantees::*property = nullptr);

 private:
  [[nodiscard]] std::string own_refusal(const Scene<double>& scene) const;

  typename method_detail::VariantOf<SolverList>::Type solver_;
};

}  // namespace shearfront
