// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/closed_form.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <memory>
#include <optional>
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
  return ClosedForm{[form](double z, double t) {
    const auto at = form->at(z, t);
    return ClosedFormValue{at.phi, at.cumulative};
  }};
}

Result travelling_kink(const Scene<double>& scene, const LogisticStep<double>& step, double rate) {
  const double D = scene.diffusivity_at(scene.bottom());
  if (!scene.spec().is_neumann || rate < 0 || step.above != 0 || !(step.below > 0) ||
      !is_close(step.width, D / (rate * step.below)))
    return std::string(
        "a kink has a closed form between Neumann ends, with above = 0 and width = D / (s a below)");
  const auto form =
      std::make_shared<Kink<double>>(scene.bottom(), rate, D, step.centre, rate * (step.below - 1));
  return ClosedForm{[form](double z, double t) {
                      const auto at = form->at(z, t);
                      return ClosedFormValue{at.phi, at.cumulative};
                    },
                    [form, top = scene.top()](double t) { return form->end_effect(top, t); }};
}

/// f = f(m) + bend / 2 (phi - m)^2 for all phi.
struct Polynomial {
  double m, bend;
};

/// v = r bend (phi - m) obeys Burgers' equation, in the frame that moves with the mean of v.
Result periodic_wave(const Scene<double>& scene, const Wave<double>& wave, const Polynomial& f, double rate) {
  const double waves = (scene.top() - scene.bottom()) / wave.wavelength;
  if (!scene.spec().is_periodic || !(waves > 0.5) || !is_close(waves, std::round(waves)))
    return std::string("a sine has a closed form in a periodic domain of whole wavelengths");
  const double wave_number = boost::math::constants::two_pi<double>() / wave.wavelength;
  const double factor = rate * f.bend;
  const auto form = std::make_shared<PeriodicBurgers<double>>(scene.diffusivity_at(scene.bottom()),
                                                              factor * wave.amplitude, wave_number);
  const double bottom = scene.bottom(), origin = wave.origin, mean = wave.mean,
               speed = factor * (wave.mean - f.m);
  return ClosedForm{[form, bottom, origin, mean, factor, speed](double z, double t) {
    const double shift = origin + speed * (std::isfinite(t) ? t : 0);
    const auto at = form->at(z - shift, t), below = form->at(bottom - shift, t);
    return ClosedFormValue{mean + at.value / factor,
                           mean * (z - bottom) + (at.cumulative - below.cumulative) / factor};
  }};
}

std::optional<Polynomial> polynomial_of(const Flux<double>& flux) {
  if (!flux.is_quadratic_polynomial()) return {};
  const auto [lowest, highest] = flux.range();
  return Polynomial{flux.extrema().front(),
                    (flux.derivative(highest) - flux.derivative(lowest)) / (highest - lowest)};
}

}  // namespace

Result closed_form(const Scene<double>& scene) {
  if (!scene.has_diffusion()) return std::string("grains do not diffuse in this bed (no D > 0)");
  if (scene.fluxes().size() > 1 || scene.spec().solid_fraction || !has_constant_coefficients(scene))
    return std::string("a closed form needs one flux, c = 1, and constant s a(z), T(z) and D(z)");
  const double rate = scene.scale() * scene.rate_at(scene.bottom());
  const Flux<double>& flux = scene.fluxes()[0];
  const auto& start = scene.spec().initial_state;
  const auto wave =
      start ? std::visit([](const auto& m) { return shearfront::wave<double>(m); }, *start) : std::nullopt;
  const auto polynomial = polynomial_of(flux);
  if (wave && polynomial) return periodic_wave(scene, *wave, *polynomial, rate);
  const int sign = unit_parabola_sign(flux);
  if (sign == 0) return std::string("no closed form is known for this flux with diffusion from this start");
  if (start)
    if (const auto step = std::visit([](const auto& m) { return logistic_step<double>(m); }, *start))
      return travelling_kink(scene, *step, sign * rate);
  return uniform_start(scene, sign * rate);
}

}  // namespace shearfront::diffusion
