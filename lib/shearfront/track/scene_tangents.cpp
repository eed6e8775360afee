// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/scene_tangents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <variant>

namespace shearfront {
namespace {

/// Where a number of a scene is, found by its address.
class NumberOfScene {
 public:
  NumberOfScene(const Scene<double>& scene, std::size_t entry)
      : spec_(scene.spec()), number_(entry_places(spec_)[entry]) {}

  [[nodiscard]] const SceneSpec<double>& spec() const { return spec_; }
  [[nodiscard]] bool is(const double& member) const { return &member == number_; }
  /// Its place in an array; kNoEntry if it is not in there.
  [[nodiscard]] std::size_t in(const std::vector<double>& numbers) const {
    // std::less orders addresses of different arrays, too.
    const double *begin = numbers.data(), *end = begin + numbers.size();
    const std::less<const double*> before;
    if (numbers.empty() || before(number_, begin) || !before(number_, end)) return kNoEntry;
    return static_cast<std::size_t>(number_ - begin);
  }
  /// Its place among the entries of a model.
  template <class Model>
  [[nodiscard]] std::size_t of(const Model& model) const {
    std::size_t n = 0, found = kNoEntry;
    Model::fields(model, [&](const FieldInfo&, const auto& member) {
      if constexpr (requires { member.size(); }) {
        if (const std::size_t i = in(member); i != kNoEntry) found = n + i;
        n += member.size();
      } else {
        if (is(member)) found = n;
        ++n;
      }
    });
    return found;
  }
  [[nodiscard]] std::size_t of(const DepthFunction<double>& function) const {
    return std::visit([this](const auto& model) { return of(model); }, function);
  }

 private:
  SceneSpec<double> spec_;
  double* number_;
};

/// Heights that make the layers of a bed, each with the entry that it is: visit(z, is_this).
template <class Visit>
void for_each_layer_height(const NumberOfScene& number, Visit&& visit) {
  const SceneSpec<double>& spec = number.spec();
  const auto knots = [&](const DepthFunction<double>& function) {
    const std::size_t entry = number.of(function);
    std::visit(
        [&](const auto& model) {
          const auto heights = model.knots();
          const auto entry_of = knot_entries(model);
          for (std::size_t i = 0; i < heights.size(); ++i)
            visit(heights[i], entry != kNoEntry && entry_of[i] == entry);
        },
        function);
  };
  visit(spec.bottom, number.is(spec.bottom));
  visit(spec.top, number.is(spec.top));
  knots(spec.shear_rate);
  if (spec.solid_fraction) knots(*spec.solid_fraction);
  if (spec.temperature) knots(*spec.temperature);
  const std::size_t above = number.in(spec.flux_breaks);
  for (std::size_t i = 0; i < spec.flux_breaks.size(); ++i) visit(spec.flux_breaks[i], i == above);
}

std::size_t number_among_entries(const Scene<double>& scene, const Entry& entry) {
  const std::vector<Entry> all = entries(scene.spec());
  const auto it = std::find_if(all.begin(), all.end(), [&](const Entry& other) {
    return other.field == entry.field && other.index == entry.index;
  });
  return it == all.end() ? kNoEntry : static_cast<std::size_t>(it - all.begin());
}

}  // namespace

std::string tangent_refusal(const Scene<double>& scene, const Entry& entry) {
  if (scene.is_chute() || scene.is_slab()) return "the bed moves along a slope";
  if (!scene.is_layered()) return "a, c or T vary inside a layer";
  if (scene.has_smooth_start()) return "the start is smooth";
  for (const Flux<double>& flux : scene.fluxes())
    if (!flux_tangent(flux)) return "flux " + std::string(flux.name()) + " is not one of the toolkit";
  for (const char* other : {"diffusion.", "close_packing."})
    if (entry.field.starts_with(other)) return entry.name() + " moves no front";
  const std::size_t i = number_among_entries(scene, entry);
  if (i == kNoEntry) return entry.name() + " is no entry of the scene";
  const NumberOfScene number(scene, i);
  // How many of the heights lie where this one does.
  std::optional<double> height;
  if (const std::size_t j = number.in(number.spec().initial_breaks); j != kNoEntry)
    height = number.spec().initial_breaks[j];
  std::size_t n_there = height ? 1 : 0;
  for_each_layer_height(number, [&](double z, bool is_this) {
    if (is_this) height = z;
  });
  if (!height) return {};
  for_each_layer_height(number, [&](double z, bool) { n_there += z == *height ? 1 : 0; });
  const auto& jumps = scene.initial_breaks();
  const bool is_jump = number.in(number.spec().initial_breaks) != kNoEntry;
  if (!is_jump && std::binary_search(jumps.begin(), jumps.end(), *height)) ++n_there;
  return n_there > 1 ? entry.name() + " lies on another height of the scene" : "";
}

SceneTangent scene_tangent(const Scene<double>& scene, const LayerStack<double>& stack,
                           const InitialPieces<double>& initial, std::size_t entry) {
  const NumberOfScene number(scene, entry);
  const SceneSpec<double>& spec = number.spec();
  const std::size_t n = stack.n_layers();
  SceneTangent by;
  by.boundary.assign(n + 1, 0.0);
  for_each_layer_height(number, [&](double z, bool is_this) {
    if (!is_this) return;
    const auto k = std::lower_bound(stack.boundaries().begin(), stack.boundaries().end(), z);
    if (k != stack.boundaries().end() && *k == z)
      by.boundary[static_cast<std::size_t>(k - stack.boundaries().begin())] = 1;
  });

  by.rate.assign(n, 0.0);
  by.solid_fraction.assign(n, 0.0);
  /// Of a function that is constant in each layer, with respect to the entry.
  const auto add_value = [&](const DepthFunction<double>& function, std::vector<double>& to,
                             const auto& factor) {
    const std::size_t own = number.of(function);
    if (own == kNoEntry) return;
    std::visit(
        [&](const auto& model) {
          for (std::size_t k = 0; k < n; ++k)
            harmonic_mean_derivatives(model, stack.boundary(k), stack.boundary(k + 1),
                                      [&](std::size_t e, double slope) {
                                        if (e == own) to[k] += factor(k) * slope;
                                      });
        },
        function);
  };
  const auto temperature = [&](std::size_t k) {
    return spec.temperature ? value(*spec.temperature, stack.boundary(k)) : 1.0;
  };
  add_value(spec.shear_rate, by.rate,
            [&](std::size_t k) { return stack.scale() * std::sqrt(temperature(k)); });
  if (number.is(spec.scale))
    for (std::size_t k = 0; k < n; ++k) by.rate[k] = stack.shear_rate(k);
  if (spec.temperature)
    add_value(*spec.temperature, by.rate,
              [&](std::size_t k) { return stack.rate(k) / (2 * temperature(k)); });
  if (spec.solid_fraction)
    add_value(*spec.solid_fraction, by.solid_fraction, [](std::size_t) { return 1.0; });

  for (std::size_t i = 0; i < spec.fluxes.size(); ++i) {
    const std::size_t own = number.of(spec.fluxes[i]);
    if (own != kNoEntry) by.moving_flux = i;
    by.fluxes.push_back(
        *flux_tangent(scene.fluxes()[i], own == kNoEntry ? std::nullopt : std::optional(own)));
  }

  const std::size_t jump = number.in(spec.initial_breaks), state = number.in(spec.initial_values);
  const auto& breaks = spec.initial_breaks;
  for (std::size_t i = 0; i < initial.states.size(); ++i) {
    const double bottom = i == 0 ? stack.bottom() : initial.tops[i - 1], top = initial.tops[i];
    const std::size_t k = initial.states[i].layer;
    const auto piece = std::upper_bound(breaks.begin(), breaks.end(), bottom) - breaks.begin();
    by.wanted.push_back(static_cast<std::size_t>(piece) == state ? 1 : 0);
    by.top.push_back(top == stack.boundary(k + 1)              ? by.boundary[k + 1]
                     : jump != kNoEntry && breaks[jump] == top ? 1
                                                               : 0);
  }
  std::vector<std::pair<double, double>> changes;  // times and their derivatives
  for (const auto* outside : {&spec.outside_bottom, &spec.outside_top}) {
    if (!*outside) continue;
    const std::size_t own_break = number.in((*outside)->breaks), own_value = number.in((*outside)->values);
    for (std::size_t i = 0; i < (*outside)->values.size(); ++i) by.wanted.push_back(i == own_value ? 1 : 0);
    for (std::size_t i = 0; i < (*outside)->breaks.size(); ++i)
      changes.emplace_back((*outside)->breaks[i], i == own_break ? 1 : 0);
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [t, dt] : changes) by.change.push_back(dt);
  return by;
}

}  // namespace shearfront
