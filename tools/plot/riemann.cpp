// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "plot/pictures.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

constexpr double kWaveResolution = 0.005;  // of a fan
constexpr std::size_t kMostWaves = 40;     // drawn

/// The only height where a, c, T or the flux jumps. Errors: InputError for a bed that is no Riemann problem there.
double interface_of(const Scene<double>& scene) {
  const auto refuse_bed = [](const std::string& why) {
    throw InputError("--riemann", "",
                     "needs a bed of two layers, one state on each side of their interface: " + why);
  };
  if (scene.has_diffusion()) refuse_bed("this one has diffusion");
  if (!scene.is_layered()) refuse_bed("a(z) or another function of height is not constant in pieces");
  if (scene.spec().initial_state) refuse_bed("the start is smooth");
  std::vector<double> jumps;
  for (const double z : scene.knots())
    if (scene.jumps_at(z)) jumps.push_back(z);
  if (jumps.size() != 1) refuse_bed(fmt::format("this one has {} interfaces", jumps.size()));
  for (const double z : scene.initial_breaks())
    if (z != jumps[0])
      refuse_bed(fmt::format("the start jumps at z = {}, not at {}", number_text(z), number_text(jumps[0])));
  return jumps[0];
}

/// A wave from the interface: it joins two states of one layer.
struct Wave {
  std::size_t layer;
  double speed, phi_below, phi_above;
};

/// From bottom to top.
std::vector<Wave> waves_from(const Scene<double>& scene, double z) {
  Method method(Method::names(&Guarantees::has_fronts).front());
  method.set("resolution", kWaveResolution);
  if (const std::string why = method.refusal(scene); !why.empty()) throw InputError("--riemann", "", why);
  SolverRequest request;
  // Long enough for every wave to leave, too short for any to come back.
  request.times = {1e-3 * (scene.top() - scene.bottom()) /
                   std::max(scene.rate_at(scene.bottom()), scene.rate_at(scene.top()))};
  request.fronts = true;
  std::vector<Wave> waves;
  for (const auto& f : solve(scene, method, request).fronts)
    if (f.t_begin == 0 && f.z_begin == z)
      waves.push_back({f.layer, (f.z_end - f.z_begin) / (f.t_end - f.t_begin), f.phi_below, f.phi_above});
  std::stable_sort(waves.begin(), waves.end(), [](const Wave& a, const Wave& b) {
    return a.layer != b.layer ? a.layer < b.layer : a.speed < b.speed;
  });
  return waves;
}

}  // namespace

int draw_riemann(const std::string& path, const Scene<double>& scene) {
  constexpr int kPoints = 400;
  const double z = interface_of(scene);
  const double height[] = {std::midpoint(scene.bottom(), z), std::midpoint(z, scene.top())};
  const std::vector<Wave> waves = waves_from(scene, z);
  const std::vector<double>& start = scene.initial_values();
  const double c[] = {scene.solid_fraction_at(height[0]), scene.solid_fraction_at(height[1])};
  const double below = c[0] * start.front(), above = c[1] * start.back();
  // The states of each layer from bottom to top.
  std::vector<double> states[2] = {{below}, {above}};
  bool has_upper = false;
  for (const Wave& wave : waves) {
    if (wave.layer == 1 && !has_upper) states[1] = {wave.phi_below}, has_upper = true;
    states[wave.layer].push_back(wave.phi_above);
  }
  double t_end = std::numeric_limits<double>::infinity();
  for (const Wave& wave : waves) {
    const double way = wave.speed < 0 ? z - scene.bottom() : scene.top() - z;
    if (wave.speed != 0) t_end = std::min(t_end, way / std::abs(wave.speed));
  }
  if (!std::isfinite(t_end)) t_end = (scene.top() - scene.bottom()) / scene.rate_at(z);
  Picture picture(path, "riemann");
  set_scene(picture, scene, "");
  picture.set("t_end", t_end);
  picture.set("z_interface", z);
  picture.set("phi_outer_below", below);
  picture.set("phi_inner_below", states[0].back());
  picture.set("phi_inner_above", states[1].front());
  picture.set("phi_outer_above", above);
  picture.set("flux_outer_below", flux_at(scene, height[0], below));
  picture.set("flux_outer_above", flux_at(scene, height[1], above));
  picture.set("flux_interface", flux_at(scene, height[0], states[0].back()));
  picture.add_file("curves.csv", [&](OutputFile& file) {
    std::string rows = "layer,phi,flux\n";
    for (const std::size_t layer : {0U, 1U}) {
      const StateRange<double> range = scene.range_at(height[layer]);
      for (int i = 0; i <= kPoints; ++i) {
        const double phi = std::lerp(range.lowest, range.highest, static_cast<double>(i) / kPoints);
        rows += fmt::format("{},{},{}\n", layer, number_text(phi),
                            number_text(flux_at(scene, height[layer], phi)));
      }
      rows += "\n\n";
    }
    file.write(rows);
  });
  picture.add_file("path.csv", [&](OutputFile& file) {
    std::string rows = "layer,phi,flux\n";
    for (const std::size_t layer : {0U, 1U}) {
      for (const double phi : states[layer])
        rows += fmt::format("{},{},{}\n", layer, number_text(phi),
                            number_text(flux_at(scene, height[layer], phi)));
      rows += "\n\n";
    }
    file.write(rows);
  });
  picture.add_file("waves.csv", [&](OutputFile& file) {
    std::string rows = "dz,phi,jump\n";
    // A fan of more lines than can be told apart is a solid area.
    const std::size_t stride = 1 + waves.size() / kMostWaves;
    for (std::size_t i = 0; i < waves.size(); ++i) {
      const Wave& wave = waves[i];
      const double jump = std::abs(wave.phi_above - wave.phi_below);
      if (i % stride != 0 && jump < 2 * kWaveResolution) continue;
      rows += fmt::format("{},{},{}\n", number_text(wave.speed * t_end),
                          number_text((wave.phi_below + wave.phi_above) / 2), number_text(jump));
    }
    file.write(rows);
  });
  return picture.draw();
}

}  // namespace shearfront::tools
