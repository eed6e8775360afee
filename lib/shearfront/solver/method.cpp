// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solver/method.hpp"

#include "shearfront/numeric/contract.hpp"

namespace shearfront {

Method::Method(std::string_view name) {
  bool is_known = false;
  SolverList::for_each([&]<class S>() {
    if (name != S::kName) return;
    solver_ = method_detail::Configured<S>{};
    is_known = true;
  });
  if (!is_known) throw InputError("method", '"' + std::string(name) + '"', "must be one of: " + SolverList::names());
}

std::string_view Method::name() const {
  return std::visit([]<class C>(const C&) -> std::string_view { return C::Type::kName; }, solver_);
}
std::string_view Method::description() const {
  return std::visit([]<class C>(const C&) -> std::string_view { return C::Type::kDescription; }, solver_);
}
std::string_view Method::scenes() const {
  return std::visit([]<class C>(const C&) -> std::string_view { return C::Type::kScenes; }, solver_);
}
Guarantees Method::guarantees() const {
  return std::visit([]<class C>(const C&) { return C::Type::guarantees(); }, solver_);
}

bool Method::has_option(std::string_view option) const {
  bool has = false;
  visit_options([&](const OptionInfo& info, const auto&) { has = has || info.name == option; });
  return has;
}

void Method::prefer_smooth(const Scene<double>& scene) {
  std::visit(
      [&]<class C>(C& solver) {
        if constexpr (requires { C::Type::prefer_smooth(scene, solver.options); })
          C::Type::prefer_smooth(scene, solver.options);
      },
      solver_);
}
void Method::prefer_amounts() {
  std::visit(
      []<class C>(C& solver) {
        if constexpr (requires { C::Type::prefer_amounts(solver.options); }) C::Type::prefer_amounts(solver.options);
      },
      solver_);
}

std::string Method::own_refusal(const Scene<double>& scene) const {
  return std::visit([&]<class C>(const C& solver) { return C::Type::refusal(scene, solver.options); }, solver_);
}

std::string Method::refusal(const Scene<double>& scene) const {
  std::string why = own_refusal(scene);
  if (why.empty()) return why;
  std::string others;
  SolverList::for_each([&]<class S>() {
    if (!S::refusal(scene, {}).empty()) return;
    others += (others.empty() ? "" : ", ") + std::string(S::kName);
  });
  // Options alone may be what is refused.
  if (others.find(name()) != std::string::npos && Method(name()).own_refusal(scene).empty()) return why;
  return why + (others.empty() ? "; no method of this program solves this scene" : "; use " + others);
}

std::unique_ptr<Run> Method::start(const Scene<double>& scene, const Watch& watch) const {
  SHEARFRONT_EXPECTS(own_refusal(scene).empty(), "a scene that the method solves");
  return std::visit([&]<class C>(const C& solver) { return C::Type::start(scene, solver.options, watch); }, solver_);
}

bool Method::has_derivative(const Scene<double>& scene, const Entry& entry) const {
  return std::visit(
      [&]<class C>(const C& solver) {
        if constexpr (DifferentiableSolver<typename C::Type>)
          return C::Type::derivative_refusal(scene, solver.options, entry).empty();
        else
          return false;
      },
      solver_);
}

Linearisation Method::linearise(const Scene<double>& scene, const std::vector<Place>& places,
                                const std::vector<std::size_t>& entries, std::any& memory) const {
  return std::visit(
      [&]<class C>(const C& solver) {
        if constexpr (DifferentiableSolver<typename C::Type>) {
          return C::Type::linearise(scene, solver.options, places, entries, memory);
        } else {
          SHEARFRONT_EXPECTS(false, "a method with derivatives");
          return Linearisation{};
        }
      },
      solver_);
}

std::vector<std::string> Method::names(bool Guarantees::* property) {
  std::vector<std::string> names;
  SolverList::for_each([&]<class S>() {
    if (property == nullptr || S::guarantees().*property) names.emplace_back(S::kName);
  });
  return names;
}

}  // namespace shearfront
