// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/canonical_form.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "shearfront/exact/middle.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

namespace {

/// Whether its rate is, between its own knots, what `is_so` says of a(z): all else is constant there.
template <Real Scalar, class IsSo>
bool is_between_knots(const Scene<Scalar>& scene, const IsSo& is_so) {
  return std::visit([&](const auto& model) { return !model.kIsLayered && is_so(model); },
                    scene.shear_rate()) &&
         is_constant_in_pieces<Scalar>(scene.spec().temperature) &&
         is_constant_in_pieces<Scalar>(scene.spec().solid_fraction);
}
template <Real Scalar>
bool is_linear_scene(const Scene<Scalar>& scene) {
  return is_between_knots(scene, [](const auto& model) { return is_linear_between_knots(model); });
}
template <Real Scalar>
bool is_exponential_scene(const Scene<Scalar>& scene) {
  return is_between_knots(scene, [](const auto& model) { return is_exponential_between_knots(model); });
}

/// Whether the square of the rate is linear and the bed one piece.
template <Real Scalar>
bool is_root_scene(const Scene<Scalar>& scene) {
  return is_between_knots(scene, [](const auto& model) { return is_root_between_knots(model); }) &&
         !scene.has_smooth_start() && scene.knots().empty();
}

/// The form that comes nearer to the rate in the middle of a piece.
template <Real Scalar>
RateForm nearer_form(const Scalar& low, const Scalar& middle, const Scalar& high) {
  const auto size = [](const Scalar& x) { return x < 0 ? Scalar(-x) : x; };
  const Scalar linear = low + (high - low) / Scalar(2),
               exponential = geometric_middle(std::min(low, high), std::max(low, high));
  return size(Scalar(middle - exponential)) < size(Scalar(middle - linear)) ? RateForm::exponential
                                                                            : RateForm::linear;
}

/// |f| at its extremum.
template <Real Scalar>
Scalar depth_of(const Flux<Scalar>& flux) {
  const Scalar f = flux.value(flux.extrema().front());
  return f < 0 ? Scalar(-f) : f;
}

}  // namespace

template <Real Scalar>
CanonicalForm<Scalar>::CanonicalForm(std::shared_ptr<const Scene<Scalar>> scene, std::size_t layers)
    : scene_(std::move(scene)),
      is_identity_(scene_->is_plain()),
      is_concave_(scene_->fluxes().front().curvature() == Curvature::concave),
      is_parabolic_(std::all_of(scene_->fluxes().begin(), scene_->fluxes().end(),
                                [](const Flux<Scalar>& flux) { return flux.is_parabola(); })),
      has_pieces_(!scene_->is_layered()),
      is_exponential_(is_exponential_scene(*scene_)),
      is_root_(is_parabolic_ && is_root_scene(*scene_)),
      is_exact_(scene_->is_layered() ||
                (has_pieces_ && (is_exponential_ || is_root_ || is_linear_scene(*scene_)))),
      layers_(is_exact_ ? pieces_between_knots(*scene_) : staircase(*scene_, layers, true)),
      n_start_parts_(is_exact_ ? std::max<std::size_t>(1, layers) : kFewParts) {
  if (is_identity_) {
    for (std::size_t k = 0; k < layers_.n_layers(); ++k) rates_.push_back(layers_.rate(k));
    set_end_rates();
    if (scene_->has_smooth_start()) set_start();
    mass_ = scene_->mass();
    return;
  }
  set_layers();
  set_end_rates();
  if (scene_->has_smooth_start()) {
    set_start();
    mass_ = std::clamp(start_->total(), Scalar(0), Scalar(y_.back() - y_.front()));
    return;
  }
  set_initial_data();
  mass_ = image_mass();
}

template <Real Scalar>
void CanonicalForm<Scalar>::set_layers() {
  std::vector<Scalar> depth;
  for (const Flux<Scalar>& flux : scene_->fluxes()) {
    const StateRange<Scalar> range = flux.range();
    lowest_.push_back(range.lowest);
    highest_.push_back(range.highest);
    width_.push_back(range.highest - range.lowest);
    depth.push_back(depth_of<Scalar>(flux));
  }
  CompensatedSum<Scalar> y, least, most;
  least_ = most_ = {Scalar(0)};
  for (std::size_t k = 0; k < layers_.n_layers(); ++k) {
    const std::size_t i = layers_.flux_index(k);
    const Scalar c = layers_.solid_fraction(k), height = layers_.boundary(k + 1) - layers_.boundary(k);
    stretch_.push_back(c * width_[i]);
    rate_factor_.push_back(Scalar(4) * depth[i] * c);
    rates_.push_back(layers_.scale() * (rate_factor_.back() * layers_.shear_rate(k)));
    if (k == 0) {
      y += stretch_[0] * layers_.bottom();
      y_ = {y.value()};
    }
    y += stretch_.back() * height;
    least += c * lowest_[i] * height;
    most += c * highest_[i] * height;
    y_.push_back(y.value());
    least_.push_back(least.value());
    most_.push_back(most.value());
  }
}

template <Real Scalar>
void CanonicalForm<Scalar>::set_end_rates() {
  if (!has_pieces_) return;
  const auto& c = scene_->spec().solid_fraction;
  for (std::size_t k = 0; k < layers_.n_layers(); ++k) {
    const Scalar &lo = layers_.boundary(k), &hi = layers_.boundary(k + 1);
    // A smooth c at the ends, not its mean: the rates on both sides of a boundary must be the same to the bit.
    const bool has_smooth_c = !is_constant_in_pieces<Scalar>(c);
    const Scalar factor =
        scene_->scale() *
        (has_smooth_c ? Scalar(Scalar(4) * depth_of<Scalar>(layers_.flux(k))) : rate_factor(k));
    const auto ends = [&](const Scalar& from, const Scalar& to) -> EndValues<Scalar> {
      using std::sqrt;
      EndValues<Scalar> rates = end_values_of<Scalar>(scene_->shear_rate(), from, to);
      if (scene_->spec().temperature) {
        const EndValues<Scalar> T = end_values_of<Scalar>(*scene_->spec().temperature, from, to);
        rates = {rates.low * sqrt(T.low), rates.high * sqrt(T.high)};
      }
      if (has_smooth_c) {
        const EndValues<Scalar> fraction = end_values_of<Scalar>(*c, from, to);
        rates = {rates.low * fraction.low, rates.high * fraction.high};
      }
      return {factor * rates.low, factor * rates.high};
    };
    EndValues<Scalar> rates = ends(lo, hi);
    // To a rate of 0 a linear or an exponential piece would take for ever.
    if (!is_exact_ && !(rates.low > 0 && rates.high > 0)) rates = {rates_[k], rates_[k]};
    low_rates_.push_back(rates.low);
    high_rates_.push_back(rates.high);
    if (is_exact_) {
      rate_forms_.push_back(is_exponential_ ? RateForm::exponential
                            : is_root_      ? RateForm::root
                                            : RateForm::linear);
    } else {
      rate_forms_.push_back(
          nearer_form(rates.low, ends(lo, Scalar(lo + (hi - lo) / Scalar(2))).high, rates.high));
    }
  }
}

template <Real Scalar>
Scalar CanonicalForm<Scalar>::state_of(const Scalar& share, std::size_t k) const {
  if (is_identity_) return share;
  const std::size_t i = layers_.flux_index(k);
  const Scalar u = (is_concave_ ? highest_[i] - share : share - lowest_[i]) / width_[i];
  // What is nearly pure must not be rounded to what is: traces of grains travel, pure states rest.
  const bool is_pure = share == lowest_[i] || share == highest_[i];
  return is_pure ? u : std::min(u, Scalar(Scalar(1) - unit_roundoff<Scalar>()));
}

template <Real Scalar>
Scalar CanonicalForm<Scalar>::share_of(const Scalar& u, std::size_t k) const {
  if (is_identity_) return u;
  const std::size_t i = layers_.flux_index(k);
  return is_concave_ ? highest_[i] - u * width_[i] : lowest_[i] + u * width_[i];
}

/// The initial data, cut wherever the flux changes as well.
template <Real Scalar>
void CanonicalForm<Scalar>::set_initial_data() {
  const std::vector<Scalar>& jumps = scene_->initial_breaks();
  const Scalar &bottom = y_.front(), &top = y_.back();
  std::size_t piece = 0, k = 0;
  const auto drop_break = [&] {
    if (initial_breaks_.empty()) return;
    initial_breaks_.pop_back();
    initial_break_.pop_back();
  };
  while (true) {
    const bool is_same = !initial_piece_.empty() && initial_piece_.back() == piece &&
                         layers_.flux_index(initial_layer_.back()) == layers_.flux_index(k);
    if (is_same) {
      drop_break();  // an interface inside the piece
    } else {
      const Scalar u = state_of(scene_->initial_values()[piece], k);
      initial_values_.push_back(std::min(Scalar(1), std::max(Scalar(0), u)));
      initial_piece_.push_back(piece);
      initial_layer_.push_back(k);
    }
    const bool last_piece = piece == jumps.size(), last_layer = k + 1 == layers_.n_layers();
    if (last_piece && last_layer) return;
    const bool is_jump = !last_piece && (last_layer || !(layers_.boundary(k + 1) < jumps[piece]));
    const bool is_interface = !last_layer && (last_piece || !(jumps[piece] < layers_.boundary(k + 1)));
    const Scalar at = is_interface ? y_[k + 1] : image_of(jumps[piece]);
    if (!(at < top)) return;
    if (!(at > (initial_breaks_.empty() ? bottom : initial_breaks_.back()))) {
      initial_values_.pop_back();  // a piece too thin for two numbers of the image
      initial_piece_.pop_back();
      initial_layer_.pop_back();
      drop_break();
    }
    if (at > bottom) {
      initial_breaks_.push_back(at);
      initial_break_.push_back(is_jump ? piece : kNone);
    }
    piece += is_jump ? 1 : 0;
    k += is_interface ? 1 : 0;
  }
}

template <Real Scalar>
void CanonicalForm<Scalar>::set_start() {
  std::vector<typename StartShape<Scalar>::Layer> all;
  for (std::size_t k = 0; k < layers_.n_layers(); ++k) {
    typename StartShape<Scalar>::Layer layer{layers_.boundary(k), layers_.boundary(k + 1),
                                             boundaries()[k],     boundaries()[k + 1],
                                             stretch(k),          Scalar(0),
                                             Scalar(1),           false};
    if (!is_identity_) {
      const std::size_t i = layers_.flux_index(k);
      layer.zero = is_concave_ ? highest_[i] : lowest_[i];
      layer.width = width_[i];
      layer.is_reversed = is_concave_;
    }
    all.push_back(std::move(layer));
  }
  start_ = std::make_shared<const StartShape<Scalar>>(scene_, std::move(all), is_identity_);
}

/// No more than there is room for: where all of the bed is pure, that is the mass to the bit.
template <Real Scalar>
Scalar CanonicalForm<Scalar>::image_mass() const {
  CompensatedSum<Scalar> sum;
  for (std::size_t j = 0; j < initial_values_.size(); ++j) {
    const Scalar& lo = j == 0 ? y_.front() : initial_breaks_[j - 1];
    const Scalar& hi = j == initial_breaks_.size() ? y_.back() : initial_breaks_[j];
    sum += (hi - lo) * initial_values_[j];
  }
  const Scalar height = y_.back() - y_.front();
  const auto [least, most] = std::minmax_element(initial_values_.begin(), initial_values_.end());
  return std::clamp(sum.value(), Scalar(*least * height), Scalar(*most * height));
}

template <Real Scalar>
Scalar CanonicalForm<Scalar>::image_of(const Scalar& z) const {
  if (is_identity_) return z;
  if (!(z > layers_.bottom())) return y_.front();
  if (!(z < layers_.top())) return y_.back();
  if (layers_.n_layers() == 1) return std::min(y_.back(), std::max(y_.front(), Scalar(stretch_[0] * z)));
  const std::size_t k = layers_.layer_at(z);
  return std::min(y_[k + 1], Scalar(y_[k] + stretch_[k] * (z - layers_.boundary(k))));
}

template <Real Scalar>
Scalar CanonicalForm<Scalar>::height_of(const Scalar& y) const {
  if (is_identity_) return y;
  const auto it = std::upper_bound(y_.begin() + 1, y_.end() - 1, y);
  const auto k = static_cast<std::size_t>(it - y_.begin()) - 1;
  const Scalar z = layers_.boundary(k) + (y - y_[k]) / stretch_[k];
  return std::min(layers_.boundary(k + 1), std::max(layers_.boundary(k), z));
}

template <Real Scalar>
Scalar CanonicalForm<Scalar>::phi_of(const Scalar& z, const Scalar& u) const {
  if (is_identity_) return u;
  const std::size_t k = layers_.layer_at(z), i = layers_.flux_index(k);
  const Scalar share = is_concave_ ? highest_[i] - width_[i] * u : lowest_[i] + width_[i] * u;
  const Scalar kept = std::min(highest_[i], std::max(lowest_[i], share));
  if (!scene_->spec().solid_fraction) return kept;
  return (scene_->is_layered() ? layers_.solid_fraction(k) : scene_->solid_fraction_at(z)) * kept;
}

template <Real Scalar>
Scalar CanonicalForm<Scalar>::amount_of(const Scalar& z, const Scalar& amount) const {
  if (is_identity_) return amount;
  const std::size_t k = layers_.layer_at(z), i = layers_.flux_index(k);
  const Scalar inside = layers_.solid_fraction(k) * (z - layers_.boundary(k));
  const Scalar least = least_[k] + inside * lowest_[i], most = most_[k] + inside * highest_[i];
  const Scalar M = is_concave_ ? most - amount : least + amount;
  return std::min(most, std::max(least, M));
}

/// c at both ends of a part of layer k: where it is smooth itself, not the layer's mean.
template <Real Scalar>
EndValues<Scalar> CanonicalForm<Scalar>::solid_fractions(std::size_t k, const Scalar& lo,
                                                         const Scalar& hi) const {
  const auto& c = scene_->spec().solid_fraction;
  if (is_constant_in_pieces<Scalar>(c)) return {layers_.solid_fraction(k), layers_.solid_fraction(k)};
  return end_values_of<Scalar>(*c, lo, hi);
}

template <Real Scalar>
Profile<Scalar> CanonicalForm<Scalar>::image_of(const Profile<Scalar>& profile) const {
  if (is_identity_) return profile;
  std::vector<Scalar> y{y_.front()}, below, above;
  std::size_t k = 0;
  for (std::size_t cell = 0; cell < profile.n_cells(); ++cell) {
    const Scalar &from = profile.z()[cell], &to = profile.z()[cell + 1];
    const auto phi = [&](const Scalar& z) {
      const Scalar rise = profile.above()[cell] - profile.below()[cell];
      return rise == 0 ? profile.below()[cell]
                       : Scalar(profile.below()[cell] + rise * ((z - from) / (to - from)));
    };
    const auto add = [&](const Scalar& lo, const Scalar& hi) {
      const EndValues<Scalar> c = solid_fractions(k, lo, hi);
      below.push_back(state_of(phi(lo) / c.low, k));
      above.push_back(state_of(phi(hi) / c.high, k));
      y.push_back(std::max(y.back(), image_of(hi)));
    };
    Scalar lo = from;
    for (; k + 1 < layers_.n_layers() && !(to < layers_.boundary(k + 1)); ++k) {
      add(lo, layers_.boundary(k + 1));
      lo = layers_.boundary(k + 1);
    }
    if (to > lo) add(lo, to);
  }
  return {std::move(y), std::move(below), std::move(above)};
}

template class CanonicalForm<Instantiated>;

}  // namespace shearfront::exact
