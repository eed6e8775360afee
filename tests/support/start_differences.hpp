// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "shearfront/exact/derivatives.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/scene/entries.hpp"
#include "support/random_scene.hpp"
#include "support/smooth_starts.hpp"

/// Derivatives of smooth starts by every entry of a scene against differences of the solution itself.
namespace shearfront::support {

/// What is compared where both sides of a difference have paths that begin as the one in the middle does.
template <Real Scalar>
struct StartDifference {
  Scalar step, bound;
  std::size_t parts;
  int compared = 0, from_start = 0, turned = 0;

  void compare(const Scene<Scalar>& scene, const Scalar& z, const Scalar& t) {
    const typename ExactSolution<Scalar>::Options options{parts, 1e-6};
    const ExactSolution<Scalar> solution(scene, options);
    const auto at = Derivatives<Scalar>(solution).at(z, t);
    const auto path = solution.path(z, t);
    const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
    const std::vector<Entry> all = entries(scene.spec());
    for (std::size_t e = 0; e < all.size(); ++e) {
      if (!derivative_refusal(scene, all[e]).empty()) continue;
      SceneSpec<Scalar> less = scene.spec(), more = scene.spec();
      *entry_places(less)[e] -= step;
      *entry_places(more)[e] += step;
      if (!find_complaints(less).empty() || !find_complaints(more).empty()) continue;
      const ExactSolution<Scalar> low{Scene<Scalar>(less), options}, high{Scene<Scalar>(more), options};
      const auto is_other = [&](const ExactSolution<Scalar>& s) {
        const auto q = s.path(z, t);
        return q.kind != path.kind || q.upward != path.upward || q.turned != path.turned ||
               q.source != path.source || size(Scalar(q.foot - path.foot)) > Scalar(1e-3);
      };
      if (is_other(low) || is_other(high)) continue;
      const Scalar M = (high.M(z, t) - low.M(z, t)) / (Scalar(2) * step),
                   phi = (high.phi(z, t) - low.phi(z, t)) / (Scalar(2) * step);
      const std::string where =
          all[e].name() + " kind " + std::to_string(int(path.kind)) + (path.turned ? " turned" : "");
      EXPECT_LT(size(Scalar(at.M[e] - M)), bound * (Scalar(1) + size(M)))
          << where << ' ' << at.M[e] << ' ' << M;
      EXPECT_LT(size(Scalar(at.phi[e] - phi)), bound * (Scalar(1) + size(phi) * size(phi)))
          << where << ' ' << at.phi[e] << ' ' << phi;
      ++compared;
      from_start += path.kind == exact::PathKind::constant ? 1 : 0;
      turned += path.turned ? 1 : 0;
    }
  }
};

/// Scenes with every model of a(z), smooth starts of each kind; `visit(spec, make)`.
template <class Visit>
void for_each_smooth_scene(std::uint64_t seed, int n_each, const Visit& visit) {
  SceneMaker make(seed);
  DepthFunctionList<double>::for_each([&]<class Rate>() {
    for (const Rate& rate : Rate::samples())
      for (int n = 0; n < n_each; ++n) {
        SceneSpec<double> spec;
        spec.shear_rate = rate;
        spec.initial_state = random_start(make, 0.05, 0.95);
        if (!find_complaints(spec).empty() || !exact::refusal(Scene<double>(spec)).empty()) continue;
        SCOPED_TRACE(std::string(Rate::kName) + " seed " + std::to_string(seed) + " start " +
                     std::to_string(n));
        visit(spec, make);
      }
  });
}

}  // namespace shearfront::support
