// SPDX-License-Identifier: BSD-3-Clause
#include "cli/closed_form.hpp"

#include <cmath>
#include <vector>

namespace shearfront::tools {

ClosedForms closed_forms(const Scene<double>& scene) {
  ClosedForms forms;
  const std::vector<double> breaks = scene.knots();
  if (!scene.is_layered() || breaks.size() != 1 || !scene.is_plain()) return forms;
  if (scene.initial_values() != std::vector<double>{0, 1}) return forms;
  const double h = scene.top() - scene.bottom();
  const double zc = breaks[0] - scene.bottom(), z0 = scene.initial_breaks()[0] - scene.bottom();
  const double k0 = scene.scale() * scene.shear_rate_at(scene.bottom()),
               k1 = scene.scale() * scene.shear_rate_at(breaks[0]);
  if (z0 == zc) return forms;
  if (z0 > zc) {
    forms.first_interface = {"(z0 - zc)/k1", (z0 - zc) / k1};
    forms.t0 = {"(z0 - zc)/k1 + zc/k0", (z0 - zc) / k1 + zc / k0};
    forms.t1 = {"(h - z0)/k1", (h - z0) / k1};
  } else {
    forms.first_interface = {"(zc - z0)/k0", (zc - z0) / k0};
    forms.t0 = {"z0/k0", z0 / k0};
    forms.t1 = {"(zc - z0)/k0 + (h - zc)/k1", (zc - z0) / k0 + (h - zc) / k1};
  }
  // Measured from the wall that lies behind the interface as seen from z0.
  const double far0 = z0 > zc ? z0 : h - z0, far_c = z0 > zc ? zc : h - zc;
  const double k = z0 > zc ? k1 : k0, k_behind = z0 > zc ? k0 : k1;
  const bool fills_far_layer = h - far0 >= far_c;
  if (k_behind < k || !fills_far_layer) return forms;
  forms.last_interface = {
      z0 > zc ? "(z0 + zc + 2 sqrt(z0 zc))/k1" : "(h - z0 + h - zc + 2 sqrt((h - z0) (h - zc)))/k0",
      (far0 + far_c + 2 * std::sqrt(far0 * far_c)) / k};
  const std::string sum = 2 * z0 == h ? "2 h/" : "(h + 2 sqrt(z0 (h - z0)))/";
  forms.t_star = {sum + (z0 > zc ? "k1" : "k0"), (h + 2 * std::sqrt(z0 * (h - z0))) / k};
  return forms;
}

}  // namespace shearfront::tools
