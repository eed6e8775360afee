// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <cmath>

namespace shearfront {

template <Real Scalar>
LayerMaterial<Scalar> material_of(const Scene<Scalar>& scene, const std::vector<Scalar>& boundaries) {
  LayerMaterial<Scalar> material;
  material.fluxes = scene.fluxes();
  for (std::size_t k = 0; k + 1 < boundaries.size(); ++k) {
    if (scene.fluxes().size() > 1) material.flux_index.push_back(scene.flux_index(boundaries[k]));
    if (scene.spec().solid_fraction)
      material.solid_fraction.push_back(scene.mean_solid_fraction(boundaries[k], boundaries[k + 1]));
  }
  return material;
}

template <Real Scalar>
LayerStack<Scalar> pieces_between_knots(const Scene<Scalar>& scene) {
  const std::vector<Scalar> knots = scene.knots();
  std::vector<Scalar> boundaries{scene.bottom()}, rates;
  boundaries.insert(boundaries.end(), knots.begin(), knots.end());
  boundaries.push_back(scene.top());
  for (std::size_t k = 0; k + 1 < boundaries.size(); ++k)
    rates.push_back(scene.mean_rate(boundaries[k], boundaries[k + 1]));
  std::vector<bool> is_break;
  for (const Scalar& z : knots) is_break.push_back(scene.jumps_at(z));
  LayerMaterial<Scalar> material = material_of(scene, boundaries);
  return {std::move(boundaries), std::move(rates), scene.scale(), is_break, std::move(material)};
}

template <Real Scalar>
LayerStack<Scalar> staircase(const Scene<Scalar>& scene, std::size_t n_layers, bool is_graded) {
  using std::ceil;
  const bool thins_down = is_graded && scene.rate_at(scene.bottom()) == 0,
             thins_up = is_graded && scene.rate_at(scene.top()) == 0;
  std::vector<Scalar> cuts{scene.bottom()};
  std::vector<bool> is_break;
  for (const Scalar& z : scene.knots()) cuts.push_back(z);
  if (scene.spec().solid_fraction) {
    cuts.insert(cuts.end(), scene.initial_breaks().begin(), scene.initial_breaks().end());
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  }
  cuts.push_back(scene.top());
  const Scalar height = scene.top() - scene.bottom();
  std::vector<Scalar> boundaries{scene.bottom()}, rates;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Scalar piece = cuts[i + 1] - cuts[i];
    const double share = to_double(Scalar(piece / height)) * static_cast<double>(n_layers);
    const std::size_t n = std::max<std::size_t>(1, static_cast<std::size_t>(ceil(share - 1e-9)));
    for (std::size_t j = 1; j <= n; ++j) {
      Scalar part = Scalar(static_cast<double>(j)) / Scalar(static_cast<double>(n));
      if (thins_down && i == 0)
        part *= part;
      else if (thins_up && i + 2 == cuts.size())
        part *= Scalar(2) - part;
      const Scalar z = j == n ? cuts[i + 1] : cuts[i] + piece * part;
      if (!(z > boundaries.back())) continue;  // the piece is too thin for n distinct numbers
      rates.push_back(scene.mean_rate(boundaries.back(), z));
      boundaries.push_back(z);
      is_break.push_back(j == n && scene.jumps_at(z));
    }
  }
  is_break.pop_back();  // the top
  LayerMaterial<Scalar> material = material_of(scene, boundaries);
  return {std::move(boundaries), std::move(rates), scene.scale(), std::move(is_break), std::move(material)};
}

template LayerMaterial<Instantiated> material_of(const Scene<Instantiated>&,
                                                 const std::vector<Instantiated>&);
template LayerStack<Instantiated> pieces_between_knots(const Scene<Instantiated>&);
template LayerStack<Instantiated> staircase(const Scene<Instantiated>&, std::size_t, bool);

}  // namespace shearfront
