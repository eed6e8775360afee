// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solver/method.hpp"

#include <algorithm>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront {

void check_places(const Scene<double>& scene, const std::vector<Place>& places) {
  constexpr std::size_t kMost = 10;  // of a million places one line each is no help
  Complaints complaints;
  for (std::size_t i = 0; i < places.size() && complaints.size() < kMost; ++i) {
    const auto& [t, z] = places[i];
    const auto complain = [&](const char* which, double value, std::string constraint) {
      complaints.push_back(
          {"places[" + std::to_string(i) + "]." + which, number_text(value), std::move(constraint)});
    };
    if (!(t >= 0)) complain("t", t, "must be >= 0");
    if (!(z >= scene.bottom() && z <= scene.top()))
      complain("z", z,
               "must be inside the domain [" + number_text(scene.bottom()) + ", " + number_text(scene.top()) +
                   "]");
  }
  if (!complaints.empty()) throw InputError(std::move(complaints));
}

Method::Method() : Method(names().front()) {}

Method::Method(std::string_view name) {
  SolverList::for_each([&]<class S>() {
    if (name == S::kName)
      solver_ = std::make_shared<const method_detail::Configured<S>>(typename S::Options{});
  });
  if (!solver_)
    throw InputError("method", '"' + std::string(name) + '"', "must be one of: " + SolverList::names());
}

bool Method::has_option(std::string_view option) const {
  const std::vector<Option> all = options();
  return std::any_of(all.begin(), all.end(), [&](const Option& o) { return o.info.name == option; });
}

std::string Method::refusal(const Scene<double>& scene) const {
  std::string why = solver_->refusal(scene);
  if (why.empty()) return why;
  std::string others;
  SolverList::for_each([&]<class S>() {
    if (!S::refusal(scene, {}).empty()) return;
    others += (others.empty() ? "" : ", ") + std::string(S::kName);
  });
  // Options alone may be what is refused.
  if (others.find(name()) != std::string::npos && Method(name()).solver_->refusal(scene).empty()) return why;
  return why + (others.empty() ? "; no method of this program solves this scene" : "; use " + others);
}

std::unique_ptr<Run> Method::start(const Scene<double>& scene, const Watch& watch) const {
  SHEARFRONT_EXPECTS(solver_->refusal(scene).empty(), "a scene that the method solves");
  return solver_->start(scene, watch);
}

std::vector<std::string> Method::names(bool Guarantees::*property) {
  std::vector<std::string> names;
  SolverList::for_each([&]<class S>() {
    if (property == nullptr || S::guarantees().*property) names.emplace_back(S::kName);
  });
  return names;
}

}  // namespace shearfront
