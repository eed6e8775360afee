// SPDX-License-Identifier: BSD-3-Clause
#include <emscripten.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "method_of.hpp"
#include "shearfront/io/scene_file.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/scene/scene.hpp"

/// The scene itself: read, and drawn as curves.
using namespace shearfront;
using namespace shearfront::web;

namespace {

/// Flux through the height z at the share x of the states there.
double flux_through(const Scene<double>& scene, double z, double x) {
  return scene.scale() * scene.rate_at(z) * scene.solid_fraction_at(z) * scene.flux_at(z).value(x);
}

}  // namespace

extern "C" {

/// Reads the text of a scene file and keeps the scene. Numbers: bottom, top, least and largest state, whether it is
/// layered, has walls, diffuses, is a chute or slab; then the knots. Text: its name, then remarks, a line each.
EMSCRIPTEN_KEEPALIVE int sf_scene(const char* text, std::size_t size) {
  return answered([&](Answer& a) {
    Scene<double> scene = parse_scene<double>(std::string(text, size), "scene.toml");
    double lowest = 1e300, highest = -1e300;
    for (const auto& flux : scene.fluxes()) {
      lowest = std::min(lowest, flux.range().lowest);
      highest = std::max(highest, flux.range().highest);
    }
    for (const double x : {scene.bottom(), scene.top(), lowest, highest}) a.add(x);
    for (const bool is :
         {scene.is_layered(), scene.has_walls(), scene.has_diffusion(), scene.is_chute() || scene.is_slab()})
      a.add(is ? 1 : 0);
    a.add(scene.knots());
    a.line(scene.name());
    for (const std::string& remark : scene.spec().remarks) a.line(remark);
    work().scene.emplace(std::move(scene));
    ++work().scene_number;
  });
}

/// Why a method does not solve the scene; an empty text if it does.
EMSCRIPTEN_KEEPALIVE int sf_refusal(const char* method, std::size_t size) {
  return answered([&](Answer& a) { a.text = method_of({method, size}).refusal(*work().scene); });
}

/// Numbers: s a(z) sqrt(T(z)) at the heights, then c(z) there.
EMSCRIPTEN_KEEPALIVE int sf_rates(const double* z, std::size_t n) {
  return answered([&](Answer& a) {
    const Scene<double>& scene = *work().scene;
    for (std::size_t i = 0; i < n; ++i) a.add(scene.scale() * scene.rate_at(z[i]));
    for (std::size_t i = 0; i < n; ++i) a.add(scene.solid_fraction_at(z[i]));
  });
}

/// The flux through the height z as a function of phi. Numbers: phi, flux of n + 1 states, by turns.
EMSCRIPTEN_KEEPALIVE int sf_flux(double z, std::size_t n) {
  return answered([&](Answer& a) {
    const Scene<double>& scene = *work().scene;
    const auto range = scene.flux_at(z).range();
    for (std::size_t i = 0; i <= n; ++i) {
      const double x =
          range.lowest + (range.highest - range.lowest) * static_cast<double>(i) / static_cast<double>(n);
      a.add(x * scene.solid_fraction_at(z));
      a.add(flux_through(scene, z, x));
    }
  });
}

/// Text: a line for each flux of the toolkit, its name, formula and states, with tabs between.
EMSCRIPTEN_KEEPALIVE int sf_fluxes() {
  return answered([](Answer& a) {
    FluxList<double>::for_each([&]<class Model>() {
      a.line(std::string(Model::kName) + '\t' + std::string(Model::kFormula) + '\t' +
             std::string(Model::kStates));
    });
  });
}
}
