// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/refusal.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <type_traits>
#include <variant>

namespace shearfront::exact {

namespace {

/// "cubic with gamma = 0.9".
template <Real Scalar>
std::string description(const Flux<Scalar>& flux) {
  std::string text(flux.name());
  const char* glue = " with ";
  flux.fields(flux, [&](const FieldInfo& info, const auto& member) {
    if constexpr (Real<std::remove_cvref_t<decltype(member)>>) {
      text += glue + std::string(info.key) + " = " + number_text(member);
      glue = ", ";
    }
  });
  return text;
}

template <Real Scalar>
std::string refusal_of(const Flux<Scalar>& flux) {
  const auto range = flux.range();
  const std::size_t extrema = flux.extrema().size();
  if (flux.curvature() == Curvature::mixed) return description(flux) + " is neither convex nor concave";
  if (!(flux.value(range.lowest) == 0) || !(flux.value(range.highest) == 0))
    return description(flux) + " does not vanish at both ends of its range";
  if (extrema != 1) return description(flux) + " has " + std::to_string(extrema) + " extrema instead of one";
  return {};
}

}  // namespace

template <Real Scalar>
std::string refusal(const Scene<Scalar>& scene) {
  if (scene.is_plain()) return {};
  if (scene.has_diffusion()) return "grains diffuse in this bed";
  for (const Flux<Scalar>& flux : scene.fluxes()) {
    if (std::string text = refusal_of(flux); !text.empty()) return text;
    if (flux.curvature() != scene.fluxes().front().curvature())
      return std::string("a convex flux beside a concave one has no exact solution");
  }
  if (!scene.has_walls()) return std::string("open and periodic ends have no exact solution");
  return {};
}

template std::string refusal<Instantiated>(const Scene<Instantiated>&);

}  // namespace shearfront::exact
