// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/sensitivities.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/exact/path_gradient.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {

namespace {

using exact::ExponentialMedium;
using exact::LayeredMedium;
using exact::Path;
using exact::PathKind;

/// Derivatives of int_bottom^x phi(., 0) at fixed x. A jump at x itself counts as lying at x - 0: the caller
/// adds what its own movement does to the path.
template <Real Scalar>
void add_initial_cumulative(const Scene<Scalar>& scene, const Scalar& x, bool include_jump_at_x,
                            Gradient<Scalar>& M) {
  const auto& jumps = scene.initial_breaks();
  const auto& values = scene.initial_values();
  for (std::size_t j = 0; j < values.size(); ++j) {
    const Scalar& lo = j == 0 ? scene.bottom() : jumps[j - 1];
    if (!(lo < x)) break;
    const bool last = j == jumps.size();
    const Scalar hi = last ? scene.top() : jumps[j];
    M.initial_value(j) += std::min(x, hi) - lo;
    if (!last && (hi < x || (include_jump_at_x && hi == x))) M.initial_break(j) += values[j] - values[j + 1];
  }
}

/// Index of the initial jump at height x, or n if there is none.
template <Real Scalar>
std::size_t jump_at(const Scene<Scalar>& scene, const Scalar& x) {
  const auto& jumps = scene.initial_breaks();
  const auto it = std::lower_bound(jumps.begin(), jumps.end(), x);
  return it != jumps.end() && *it == x ? static_cast<std::size_t>(it - jumps.begin()) : jumps.size();
}

template <Real Scalar>
std::size_t piece_at(const Scene<Scalar>& scene, const Scalar& x) {
  const auto& jumps = scene.initial_breaks();
  return static_cast<std::size_t>(std::upper_bound(jumps.begin(), jumps.end(), x) - jumps.begin());
}

/// The source at `path.foot` moves: an initial jump, or an interface without one.
template <Real Scalar>
void add_start(const Scene<Scalar>& scene, const Path<Scalar>& path,
               const exact::StartMomentum<Scalar>& start, const Scalar& phi_start, std::size_t boundary,
               Sensitivities<Scalar>& out) {
  const std::size_t j = jump_at(scene, path.foot);
  if (j < scene.initial_breaks().size()) {
    out.M.initial_break(j) += start.against(scene.initial_values()[j]);
    out.phi.initial_break(j) += phi_start;
  } else if (boundary > 0 && boundary <= out.M.shear_rate_breaks().size()) {
    out.M.shear_rate_break(boundary - 1) += start.against(scene.initial_values()[piece_at(scene, path.foot)]);
    out.phi.shear_rate_break(boundary - 1) += phi_start;
  }
}

/// d(harmonic mean)/d(value at one end of a layer) for a linear a, y = log(other end / this end):
/// (e^y - 1 - y) / y^2 = sum y^n / (n + 2)!.
template <Real Scalar>
Scalar mean_weight(const Scalar& y) {
  using std::expm1;
  if (y > Scalar(1) || y < Scalar(-1)) return (expm1(y) - y) / (y * y);
  Scalar term(0.5), sum(0);
  for (int n = 0; n < 200; ++n) {
    sum += term;
    term *= y / Scalar(n + 3);
    if ((term < 0 ? Scalar(-term) : term) <= unit_roundoff<Scalar>() * sum) break;
  }
  return sum;
}

/// Spreads the derivative with respect to the rate of one staircase layer over the values of the table.
template <Real Scalar>
void spread(const Table<Scalar>& table, const Scalar& lo, const Scalar& hi, const Scalar& scale,
            const Scalar& dM, const Scalar& dphi, Sensitivities<Scalar>& out) {
  using std::log;
  const Scalar middle = lo + (hi - lo) / Scalar(2);
  const auto it = std::upper_bound(table.z.begin() + 1, table.z.end() - 1, middle);
  const auto i = static_cast<std::size_t>(it - table.z.begin()) - 1;
  const Scalar width = table.z[i + 1] - table.z[i];
  const Scalar slope = (table.values[i + 1] - table.values[i]) / width;
  const Scalar w_lo = (lo - table.z[i]) / width, w_hi = (hi - table.z[i]) / width;
  const Scalar y = log(
      Scalar((table.values[i] + slope * (hi - table.z[i])) / (table.values[i] + slope * (lo - table.z[i]))));
  const Scalar by_lo = scale * mean_weight(y), by_hi = scale * mean_weight(Scalar(-y));
  const Scalar right = by_lo * w_lo + by_hi * w_hi, left = by_lo + by_hi - right;
  out.M.shear_rate_value(i) += dM * left;
  out.M.shear_rate_value(i + 1) += dM * right;
  out.phi.shear_rate_value(i) += dphi * left;
  out.phi.shear_rate_value(i + 1) += dphi * right;
}

/// A stack of layers: LayeredMedium or GeneralMedium.
template <Real Scalar, class Stack>
void add_layered_path(const Scene<Scalar>& scene, const Stack& medium, const Path<Scalar>& path,
                      const Scalar& z, const Scalar& t, Sensitivities<Scalar>& out) {
  const auto gradient = exact::path_gradient(medium, path, z, t);
  const Scalar& s = scene.scale();
  const auto& layers = medium.layers();
  const auto* table = std::get_if<Table<Scalar>>(&scene.shear_rate());
  for (std::size_t n = 0; n < gradient.rates.size(); ++n) {
    const std::size_t k = gradient.first + n;
    const auto& [dM, dphi] = gradient.rates[n];
    if (table != nullptr) {
      spread(*table, layers.boundary(k), layers.boundary(k + 1), s, dM, dphi, out);
      continue;
    }
    out.M.shear_rate_value(k) += s * dM;
    out.phi.shear_rate_value(k) += s * dphi;
    if (k > 0) {
      out.M.shear_rate_break(k - 1) += gradient.boundaries[n].M;
      out.phi.shear_rate_break(k - 1) += gradient.boundaries[n].phi;
    }
  }
  out.phi.scale = gradient.phi_log_scale / s;
  if (path.kind == PathKind::constant)
    out.phi.initial_value(piece_at(scene, medium.cells().x[path.source])) += gradient.phi_state;
  if (path.kind == PathKind::fan || path.kind == PathKind::waiting) {
    const auto& boundaries = layers.boundaries();
    const auto it = std::lower_bound(boundaries.begin(), boundaries.end(), path.foot);
    const bool on_boundary = table == nullptr && it != boundaries.end() && *it == path.foot;
    add_start(scene, path, gradient.start, gradient.phi_start,
              on_boundary ? static_cast<std::size_t>(it - boundaries.begin()) : 0, out);
  }
}

template <Real Scalar>
void add_path(const Scene<Scalar>& scene, const ExponentialMedium<Scalar>& medium, const Path<Scalar>& path,
              const Scalar& z, const Scalar& t, Sensitivities<Scalar>& out) {
  const auto gradient = exact::path_gradient(medium, path, z, t);
  const auto& rate = std::get<Exponential<Scalar>>(scene.shear_rate());
  out.M.amplitude = gradient.M_log_rate / rate.amplitude;
  out.phi.amplitude = gradient.phi_log_rate / rate.amplitude;
  out.phi.scale = gradient.phi_log_rate / scene.scale();
  out.M.decay = gradient.M_decay;
  out.phi.decay = gradient.phi_decay;
  if (path.kind == PathKind::constant)
    out.phi.initial_value(piece_at(scene, medium.cells().x[path.source])) += gradient.phi_state;
  if (path.kind == PathKind::fan) add_start(scene, path, gradient.start, gradient.phi_start, 0, out);
}

template <Real Scalar>
Gradient<Scalar> empty_gradient(const Scene<Scalar>& scene) {
  const std::size_t jumps = scene.initial_breaks().size();
  if (const auto* layered = std::get_if<Piecewise<Scalar>>(&scene.shear_rate()))
    return {layered->values.size(), layered->breaks.size(), jumps};
  if (const auto* table = std::get_if<Table<Scalar>>(&scene.shear_rate()))
    return {table->values.size(), 0, jumps};
  return {0, 0, jumps};
}

/// Whether c, T or the flux jumps at z.
template <Real Scalar>
bool material_jumps(const Scene<Scalar>& scene, const Scalar& z) {
  const auto has = [&](const std::vector<Scalar>& heights) {
    return std::find(heights.begin(), heights.end(), z) != heights.end();
  };
  const auto knots = [](const DepthFunction<Scalar>& profile) {
    return std::visit([](const auto& model) { return model.knots(); }, profile);
  };
  return has(scene.flux_breaks()) ||
         (scene.spec().solid_fraction && has(knots(*scene.spec().solid_fraction))) ||
         (scene.spec().temperature && has(knots(*scene.spec().temperature)));
}

/// One quantity's derivatives in the image, times `factor`, as derivatives in the scene.
template <Real Scalar>
void add_image(const Scene<Scalar>& scene, const exact::CanonicalForm<Scalar>& form,
               const Gradient<Scalar>& image, const Scalar& factor, Gradient<Scalar>& out) {
  const LayerStack<Scalar>& layers = form.layers();
  out.scale = factor * image.scale;
  const auto values = image.shear_rate_values();
  if (const auto* a = std::get_if<Piecewise<Scalar>>(&scene.shear_rate())) {
    const auto& rates = std::get<Piecewise<Scalar>>(form.image().shear_rate()).values;
    std::size_t i = 0;
    for (std::size_t k = 0; k < layers.n_layers(); ++k) {
      if (i < a->breaks.size() && !(layers.boundary(k) < a->breaks[i])) {
        out.shear_rate_break(i) = factor * form.stretch(k) * image.shear_rate_breaks()[k - 1];
        ++i;
      }
      out.shear_rate_value(i) += factor * values[k] * (rates[k] / a->values[i]);
    }
  } else {
    out.amplitude = factor * image.amplitude * form.rate_factor(0);
    out.decay = factor * image.decay * form.stretch(0);
    for (std::size_t i = 0; i < values.size(); ++i)
      out.shear_rate_value(i) = factor * values[i] * form.rate_factor(0);
  }
  const auto jumps = image.initial_breaks(), states = image.initial_values();
  for (std::size_t j = 0; j < states.size(); ++j)
    out.initial_value(form.initial_piece(j)) += factor * states[j] / form.state_slope(form.initial_layer(j));
  for (std::size_t j = 0; j < jumps.size(); ++j) {
    const std::size_t i = form.initial_break(j);
    if (i == form.kNone) continue;
    out.initial_break(i) = factor * jumps[j] * form.stretch(layers.layer_at(scene.initial_breaks()[i]));
  }
}

template <Real Scalar>
Sensitivities<Scalar> from_image(const ExactSolution<Scalar>& solution, const Scalar& z, const Scalar& t) {
  const Scene<Scalar>& scene = solution.scene();
  const exact::CanonicalForm<Scalar>& form = *solution.canonical_form();
  const Sensitivities<Scalar> image = sensitivities(*solution.image(), form.image_of(z), t);
  Sensitivities<Scalar> out{solution.at(z, t), empty_gradient(scene), empty_gradient(scene)};
  const std::size_t k = form.layers().layer_at(z);
  add_image(scene, form, image.M, form.sign(), out.M);
  add_image(scene, form, image.phi, Scalar(form.state_slope(k) * form.layers().solid_fraction(k)), out.phi);
  return out;
}

}  // namespace

template <Real Scalar>
std::string sensitivity_refusal(const ExactSolution<Scalar>& solution) {
  const auto& rate = solution.scene().shear_rate();
  if (!std::holds_alternative<Piecewise<Scalar>>(rate) && !std::holds_alternative<Table<Scalar>>(rate) &&
      !std::holds_alternative<Exponential<Scalar>>(rate))
    return "the entries of this shear rate: derivatives by differences only";
  const exact::CanonicalForm<Scalar>* form = solution.canonical_form();
  if (!form) return {};
  const Scene<Scalar>& scene = solution.scene();
  if (!form->keeps_model())
    return "a, c or T vary smoothly in a bed of other fluxes: derivatives by differences only";
  if (const auto* a = std::get_if<Piecewise<Scalar>>(&scene.shear_rate()))
    for (const Scalar& z : a->breaks)
      if (material_jumps(scene, z))
        return "shear_rate.breaks = " + number_text(z) +
               " lies on a jump of packing, temperature or flux: derivatives by differences only";
  return {};
}

template <Real Scalar>
Sensitivities<Scalar> sensitivities(const ExactSolution<Scalar>& solution, const Scalar& z, const Scalar& t) {
  SHEARFRONT_EXPECTS(sensitivity_refusal(solution).empty(), "a solution with exact derivatives");
  if (solution.image()) return from_image(solution, z, t);
  const Scene<Scalar>& scene = solution.scene();
  Sensitivities<Scalar> out{{}, empty_gradient(scene), {}};
  out.phi = out.M;
  if (t == Scalar(0) || !is_finite(t)) {
    out.value = solution.at(z, t);
    const bool initial = t == Scalar(0);
    if (initial) out.phi.initial_value(piece_at(scene, z)) = Scalar(1);
    const bool below = !initial && z < solution.steady_height();
    if (!below) add_initial_cumulative(scene, initial ? z : scene.top(), true, out.M);
    return out;
  }
  const Path<Scalar> path = solution.path(z, t);
  out.value = solution.value_of(path, z, t);
  out.M.scale = path.H * t / scene.scale();
  add_initial_cumulative(scene, path.foot, path.kind == PathKind::constant, out.M);
  if (const auto* layered = dynamic_cast<const LayeredMedium<Scalar>*>(&solution.medium())) {
    add_layered_path(scene, *layered, path, z, t, out);
  } else if (const auto* general = dynamic_cast<const exact::GeneralMedium<Scalar>*>(&solution.medium())) {
    add_layered_path(scene, *general, path, z, t, out);
  } else {
    add_path(scene, dynamic_cast<const ExponentialMedium<Scalar>&>(solution.medium()), path, z, t, out);
  }
  return out;
}

template Sensitivities<Instantiated> sensitivities(const ExactSolution<Instantiated>&, const Instantiated&,
                                                   const Instantiated&);
template std::string sensitivity_refusal(const ExactSolution<Instantiated>&);

}  // namespace shearfront
