// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/exact_solution.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "shearfront/exact/general_medium.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

using exact::Path;
using exact::PathKind;

template <Real Scalar>
std::size_t ExactSolution<Scalar>::default_layers(const Scene<Scalar>& scene) {
  const bool is_parabolic = std::all_of(scene.fluxes().begin(), scene.fluxes().end(), [](const auto& flux) {
    return std::visit([](const auto& f) { return bool(std::remove_cvref_t<decltype(f)>::kIsParabola); },
                      flux);
  });
  return is_parabolic ? kDefaultLayers : kDefaultGeneralLayers;
}

template <Real Scalar>
ExactSolution<Scalar>::ExactSolution(const Scene<Scalar>& scene, Options options)
    : scene_(scene), mass_(scene.mass()), steady_height_(scene.bottom() + mass_) {
  const std::size_t n = options.layers > 0 ? options.layers : default_layers(scene);
  if (!scene.is_plain()) {
    SHEARFRONT_EXPECTS(exact::refusal(scene).empty(), "a scene with an exact solution");
    form_ = std::make_shared<const exact::CanonicalForm<Scalar>>(scene, n);
    image_.reset(new ExactSolution(*form_, n));
    medium_ = image_->medium_;
    n_layers_ = image_->n_layers_;
    steady_height_ = form_->height_of(image_->steady_height_);
    if (form_->keeps_model()) return;
    coarse_form_ = std::make_shared<const exact::CanonicalForm<Scalar>>(scene, (n + 1) / 2);
    coarse_image_.reset(new ExactSolution(*coarse_form_, n));
    return;
  }
  if (steady_height_ > scene.top()) steady_height_ = scene.top();
  medium_ = exact::make_medium(scene, n);
  if (const auto* layered = dynamic_cast<const exact::LayeredMedium<Scalar>*>(medium_.get()))
    n_layers_ = layered->layers().n_layers();
  if (!exact::has_exact_medium(scene)) coarse_ = exact::make_medium(scene, (n + 1) / 2);
}

template <Real Scalar>
ExactSolution<Scalar>::ExactSolution(const exact::CanonicalForm<Scalar>& form, std::size_t layers)
    : scene_(form.image()), mass_(scene_.mass()), steady_height_(scene_.bottom() + mass_) {
  if (form.is_parabolic()) {
    *this = ExactSolution(scene_, Options{layers});
    return;
  }
  if (steady_height_ > scene_.top()) steady_height_ = scene_.top();
  medium_ = std::make_shared<const exact::GeneralMedium<Scalar>>(form);
  n_layers_ = form.n_layers();
}

/// A value of the canonical form's solution as one of the scene.
template <Real Scalar>
typename ExactSolution<Scalar>::Value ExactSolution<Scalar>::value_in_scene(
    const exact::CanonicalForm<Scalar>& form, Value value, const Scalar& z) const {
  const std::size_t k = form.layers().layer_at(z);
  const Scalar slope = form.state_slope(k) * form.layers().solid_fraction(k);
  value.phi = form.phi_of(z, value.phi);
  value.M = z == scene_.top() ? mass_ : form.amount_of(z, value.M);
  value.H *= form.sign();
  value.phi_error *= slope < 0 ? Scalar(-slope) : slope;
  return value;
}

template <Real Scalar>
Path<Scalar> ExactSolution<Scalar>::best_path(const exact::Medium<Scalar>& medium, const Scalar& z,
                                              const Scalar& t) const {
  Path<Scalar> wall;
  if (medium.pure_travel_time(scene_.bottom(), z) <= t) {
    wall.value = z - scene_.bottom();
    wall.p = Scalar(1);
    wall.kind = PathKind::bottom_wall;
    wall.upward = true;
    wall.foot = scene_.bottom();
  }
  // At the top the state below the wall is asked for: the wall's own path (value m for every t) counts only
  // where it is strictly better. A path with H = 0 and p = 1 has the value m as well; rounding must not
  // decide.
  const bool at_top = z == scene_.top();
  const Scalar tie = Scalar(64) * unit_roundoff<Scalar>() * (scene_.top() - scene_.bottom());
  const bool full = at_top && wall.value <= mass_ + tie;
  if (medium.pure_travel_time(scene_.top(), z) <= t && !(mass_ > wall.value) && !full) {
    wall = Path<Scalar>{};
    wall.value = mass_;
    wall.kind = PathKind::top_wall;
    wall.foot = scene_.top();
  }
  Path<Scalar> free = medium.best_free(z, t, wall.value);
  if (at_top && free.kind != PathKind::none && free.H == 0 && free.upward && free.value <= wall.value + tie)
    return free;
  return free.better_than(wall) ? free : wall;
}

template <Real Scalar>
typename ExactSolution<Scalar>::Value ExactSolution<Scalar>::value_from(const Path<Scalar>& path,
                                                                        const Scalar& z) const {
  Value value;
  const Scalar low = std::max(Scalar(0), Scalar(mass_ - (scene_.top() - z)));
  const Scalar high = std::min(Scalar(z - scene_.bottom()), mass_);
  value.M = z == scene_.top() ? mass_ : std::max(low, std::min(high, path.value));
  value.phi = std::min(Scalar(1), std::max(Scalar(0), path.p));
  // A path may end on an interface with a flux that only the layer it comes from can carry, if it sets out
  // within rounding of the interface: no flux through it exceeds what the layer above carries.
  value.H = std::min(path.H, medium_->capacity_at(z));
  return value;
}

template <Real Scalar>
Path<Scalar> ExactSolution<Scalar>::path(const Scalar& z, const Scalar& t) const {
  if (form_) return image_->path(form_->image_of(z), t);
  if (t == Scalar(0) || !is_finite(t)) return {};
  return best_path(*medium_, z, t);
}

template <Real Scalar>
typename ExactSolution<Scalar>::Value ExactSolution<Scalar>::at(const Scalar& z, const Scalar& t) const {
  SHEARFRONT_EXPECTS(z >= scene_.bottom() && z <= scene_.top() && t >= Scalar(0), "a point of the domain");
  if (form_) {
    if (t > Scalar(0) && is_finite(t)) return value_of(path(z, t), z, t);
    Value value = value_in_scene(*form_, image_->at(form_->image_of(z), t), z);
    if (t == Scalar(0)) value.phi = scene_.initial_phi(z);
    return value;
  }
  Value value;
  if (t == Scalar(0)) {
    value.phi = scene_.initial_phi(z);
    const auto& jumps = scene_.initial_breaks();
    CompensatedSum<Scalar> sum;
    for (std::size_t i = 0; i <= jumps.size(); ++i) {
      const Scalar& lo = i == 0 ? scene_.bottom() : jumps[i - 1];
      if (!(lo < z)) break;
      sum += (std::min(z, i == jumps.size() ? scene_.top() : jumps[i]) - lo) * scene_.initial_values()[i];
    }
    value.M = z == scene_.top() ? mass_ : std::min(sum.value(), mass_);
    value.H = medium_->flux_at(z, value.phi);
    return value;
  }
  if (!is_finite(t)) {
    const bool pure_above = z >= steady_height_ && steady_height_ < scene_.top();
    value.phi = Scalar(pure_above ? 0 : 1);
    value.M = std::min(Scalar(z - scene_.bottom()), mass_);
    return value;
  }
  return value_of(best_path(*medium_, z, t), z, t);
}

template <Real Scalar>
typename ExactSolution<Scalar>::Value ExactSolution<Scalar>::value_of(const Path<Scalar>& path,
                                                                      const Scalar& z,
                                                                      const Scalar& t) const {
  const auto coarse_value = [&] {
    if (coarse_image_)
      return value_in_scene(*coarse_form_, coarse_image_->at(coarse_form_->image_of(z), t), z);
    return value_from(best_path(*coarse_, z, t), z);
  };
  Value value =
      form_ ? value_in_scene(*form_, image_->value_of(path, form_->image_of(z), t), z) : value_from(path, z);
  if (coarse_ || coarse_image_) {
    const Value coarse = coarse_value();
    // Order 3/2 leaves 1 / (2^(3/2) - 1) = 0.55 of the change on average; stairs that fit a turning point by
    // chance make the change smaller than that.
    constexpr int kSafety = 3;
    value.M_error =
        Scalar(kSafety) * (coarse.M > value.M ? Scalar(coarse.M - value.M) : Scalar(value.M - coarse.M));
    value.phi_error = coarse.phi > value.phi ? coarse.phi - value.phi : value.phi - coarse.phi;
  }
  return value;
}

template class ExactSolution<Instantiated>;

}  // namespace shearfront
