// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/closed_form.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <memory>
#include <utility>

#include "shearfront/diffusion/cole_hopf_burgers.hpp"
#include "shearfront/diffusion/cole_hopf_kink.hpp"
#include "shearfront/diffusion/cole_hopf_uniform.hpp"

namespace shearfront::diffusion {
namespace {

using Result = std::variant<ClosedForm, std::string>;

/// How far a width or a number of waves may be from the one meant: rounding of decimal numbers.
constexpr double kRounding = 1e-12;

bool is_close(double x, double y) {
  return std::abs(x - y) <= kRounding * std::max(std::abs(x), std::abs(y));
}

/// Whether s a sqrt(T) and D are the same everywhere.
bool has_constant_coefficients(const Scene<double>& scene) {
  if (!scene.is_layered()) return false;
  const double rate = scene.rate_at(scene.bottom()), D = scene.diffusivity_at(scene.bottom());
  const std::vector<double> knots = scene.knots();
  return std::all_of(knots.begin(), knots.end(),
                     [&](double z) { return scene.rate_at(z) == rate && scene.diffusivity_at(z) == D; });
}

Result uniform_start(const Scene<double>& scene, double rate) {
  const auto& values = scene.initial_values();
  if (scene.spec().initial_state || !scene.has_walls() ||
      std::any_of(values.begin(), values.end(), [&](double phi) { return phi != values.front(); }))
    return std::string("only beds that start uniform between walls, and kinks, have a closed form");
  const auto form = std::make_shared<UniformStart<double>>(
      scene.bottom(), scene.top(), rate, scene.diffusivity_at(scene.bottom()), values.front());
  return [form](double z, double t) {
    const auto at = form->at(z, t);
    return ClosedFormValue{at.phi, at.cumulative};
  };
}

Result travelling_kink(const Scene<double>& scene, const KinkInitial<double>& kink, double rate) {
  const double D = scene.diffusivity_at(scene.bottom());
  if (!scene.spec().is_neumann || rate < 0 || kink.above != 0 || !(kink.below > 0) ||
      !is_close(kink.width, D / (rate * kink.below)))
    return std::string(
        "a kink has a closed form between Neumann ends, with above = 0 and width = D / (s a below)");
  const auto form =
      std::make_shared<Kink<double>>(scene.bottom(), rate, D, kink.centre, rate * (kink.below - 1));
  return [form](double z, double t) {
    const auto at = form->at(z, t);
    return ClosedFormValue{at.phi, at.cumulative};
  };
}

Result periodic_burgers(const Scene<double>& scene, double rate) {
  const auto* sine = scene.spec().initial_state
                         ? std::get_if<SineInitial<double>>(&*scene.spec().initial_state)
                         : nullptr;
  const double height = scene.top() - scene.bottom();
  const double waves = sine ? height / sine->wavelength : 0;
  if (!sine || !scene.spec().is_periodic || !(waves > 0.5) || !is_close(waves, std::round(waves)))
    return std::string("Burgers' flux has a closed form in a periodic domain of whole waves of a sine");
  // v = r u obeys Burgers' equation, in the frame that moves with the mean.
  const double wave_number = boost::math::constants::two_pi<double>() / sine->wavelength;
  const auto form = std::make_shared<PeriodicBurgers<double>>(scene.diffusivity_at(scene.bottom()),
                                                              rate * sine->amplitude, wave_number);
  const double bottom = scene.bottom(), origin = sine->origin, mean = sine->mean;
  return [form, bottom, origin, mean, rate](double z, double t) {
    const double shift = origin + rate * mean * (std::isfinite(t) ? t : 0);
    const auto at = form->at(z - shift, t), below = form->at(bottom - shift, t);
    return ClosedFormValue{mean + at.value / rate,
                           mean * (z - bottom) + (at.cumulative - below.cumulative) / rate};
  };
}

}  // namespace

Result closed_form(const Scene<double>& scene) {
  if (!scene.has_diffusion())
    return std::string("grains do not diffuse in this bed (no D > 0)");
  if (scene.fluxes().size() > 1 || scene.spec().solid_fraction || !has_constant_coefficients(scene))
    return std::string("a closed form needs one flux, c = 1, and constant s a(z), T(z) and D(z)");
  const double rate = scene.scale() * scene.rate_at(scene.bottom());
  const Flux<double>& flux = scene.fluxes()[0];
  if (const auto* burgers = std::get_if<Burgers<double>>(&flux); burgers)
    return periodic_burgers(scene, rate);
  const auto* packed = std::get_if<Packed<double>>(&flux);
  if (!packed && !std::holds_alternative<Quadratic<double>>(flux))
    return std::string("no closed form is known for this flux with diffusion");
  const double signed_rate = packed && packed->grains == Grains::large ? -rate : rate;
  if (scene.spec().initial_state)
    if (const auto* kink = std::get_if<KinkInitial<double>>(&*scene.spec().initial_state))
      return travelling_kink(scene, *kink, signed_rate);
  return uniform_start(scene, signed_rate);
}

}  // namespace shearfront::diffusion
