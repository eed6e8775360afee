// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solver/method.hpp"

#include <algorithm>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/chute.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/chute_run.hpp"

namespace shearfront {
namespace {

/// Calls use(scene) with what a solver is to solve.
template <class Use>
auto with_bed(const Scene<double>& scene, const Use& use) {
  if (!scene.is_chute()) return use(scene);
  const SteadyChute<double> chute(scene);
  return use(chute.bed());
}

/// What none of the solvers has to say itself.
std::string kind_refusal(const Guarantees& guarantees, const Scene<double>& scene) {
  if (guarantees.has_slab == scene.is_slab()) return "";
  return scene.is_slab() ? "phi depends on x as well in a scene with a table slab"
                         : "it solves scenes with a table slab only";
}

}  // namespace

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
  return with_bed(scene, [&](const Scene<double>& bed) {
    const auto own = [&](const AnySolver& solver) {
      std::string why = kind_refusal(solver.guarantees(), bed);
      return why.empty() ? solver.refusal(bed) : why;
    };
    std::string why = own(*solver_);
    if (why.empty()) return why;
    std::string others;
    SolverList::for_each([&]<class S>() {
      if (!kind_refusal(S::guarantees(), bed).empty() || !S::refusal(bed, {}).empty()) return;
      others += (others.empty() ? "" : ", ") + std::string(S::kName);
    });
    // Options alone may be what is refused.
    if (others.find(name()) != std::string::npos && own(*Method(name()).solver_).empty()) return why;
    return why + (others.empty() ? "; no method of this program solves this scene" : "; use " + others);
  });
}

double Method::order_M(const Scene<double>& scene) const {
  return with_bed(scene, [&](const Scene<double>& bed) { return solver_->order_M(bed); });
}

void Method::prefer_smooth(const Scene<double>& scene) {
  solver_ = with_bed(scene, [&](const Scene<double>& bed) { return solver_->smooth(bed); });
}

std::unique_ptr<Run> Method::start(const Scene<double>& scene, const Watch& watch) const {
  SHEARFRONT_EXPECTS(refusal(scene).empty(), "a scene that the method solves");
  if (!scene.is_chute()) return solver_->start(scene, watch);
  return start_chute(scene, [&](const Scene<double>& bed) { return solver_->start(bed, watch); });
}

std::vector<std::string> Method::names(bool Guarantees::*property) {
  std::vector<std::string> names;
  SolverList::for_each([&]<class S>() {
    if (property == nullptr || S::guarantees().*property) names.emplace_back(S::kName);
  });
  return names;
}

}  // namespace shearfront
