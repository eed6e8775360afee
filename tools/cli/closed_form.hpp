// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>

#include "shearfront/scene/scene.hpp"

namespace shearfront::tools {

/// An event time known by formula.
struct ClosedForm {
  std::string formula;
  double value = 0;
};

/// Event times of the scene of May, Shearer & Daniels (2010), Section 3: two layers with quadratic flux,
/// large grains (phi = 0) below z0 and small ones (phi = 1) above it. A member is empty where its formula
/// does not hold. With z0 above the interface zc, k0 and k1 the rates s a below and above, heights from the
/// bottom:
///
///   first_interface  (z0 - zc)/k1                     first waves run with the speed of pure states
///   t0, t1           sums of layer thickness / rate
///   last_interface   k1 t = z0 + zc + 2 sqrt(z0 zc)   the larger root of (k1 t - (z0 - zc))^2 = 4 k1 t zc
///   t_star           k1 t = h + 2 sqrt(z0 (h - z0))   2 h/k1 for z0 = h/2
///
/// The last two need k0 >= k1 (no bottleneck) and the steady height h - z0 not below zc. With z0 below the
/// interface the roles of the layers are exchanged.
struct ClosedForms {
  std::optional<ClosedForm> first_interface, t0, t1, last_interface, t_star;
};

[[nodiscard]] ClosedForms closed_forms(const Scene<double>& scene);

}  // namespace shearfront::tools
