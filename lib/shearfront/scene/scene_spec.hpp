// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shearfront/model/close_packing/all.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/model/field.hpp"
#include "shearfront/model/flux/flux.hpp"
#include "shearfront/model/start/all.hpp"
#include "shearfront/model/velocity/all.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// What lies beyond an open end of the bed: the state outside, piecewise constant in time.
template <Real Scalar>
struct OutsideState {
  std::vector<Scalar> breaks;  ///< times at which it changes, ascending, > 0
  std::vector<Scalar>
      values;  ///< between them, in the units of SceneSpec::initial_values; one more than breaks
};

/// Diffusion of the grains: D(z) = D variation(z), in units of height^2 / time.
template <Real Scalar>
struct Diffusion {
  Scalar D{0};                                     ///< 0: none
  std::optional<DepthFunction<Scalar>> variation;  ///< 1 if not given
  bool follows_shear_rate =
      false;  ///< variation(z) = a(z), without the scale s, or the shear rate it is made of
};

/// The units in which the numbers of a scene are, empty where its file does not say: carried to axes, tables and files,
/// and what observations are converted to. A rate s a is then in units.z / units.t.
struct SceneUnits {
  std::string z, t;       ///< t: of what the solution goes on in, time or (a chute's) distance
  bool is_chute = false;  ///< what goes on is a distance x, and is called so
  [[nodiscard]] bool are_given() const { return !z.empty() || !t.empty(); }
  /// "t", or "x".
  [[nodiscard]] const char* symbol() const { return is_chute ? "x" : "t"; }
  friend bool operator==(const SceneUnits&, const SceneUnits&) = default;
};

/// A slab that repeats along x: phi(x, z, t) with the period `length`, carried along by the velocity.
template <Real Scalar>
struct Slab {
  Scalar length{1};
};

/// The start of a slab: phi / c is `inside` on [x[0], x[1]] x [z[0], z[1]], elsewhere `outside`.
template <Real Scalar>
struct Block {
  std::vector<Scalar> x, z;
  Scalar inside{0}, outside{1};
};

/// Everything a scene file says, unchecked. Fill it in and hand it to Scene.
template <Real Scalar = double>
struct SceneSpec {
  std::string name;
  /// What the reader of its file has to say, one line each; for the user, not part of the model.
  std::vector<std::string> remarks;
  SceneUnits units;
  std::vector<Flux<Scalar>> fluxes{Quadratic<Scalar>{}};  ///< bottom to top
  std::vector<Scalar> flux_breaks;                        ///< heights between them; one less
  DepthFunction<Scalar> shear_rate;
  Scalar scale{1};                                      ///< s, 1/time if a is dimensionless
  std::optional<DepthFunction<Scalar>> solid_fraction;  ///< c(z); 1 if not given
  std::optional<DepthFunction<Scalar>> temperature;     ///< T(z); 1 if not given
  /// Random close packing of mixtures, for the height of the bed; spheres of size ratio 2 if not given.
  std::optional<ClosePacking<Scalar>> close_packing;
  std::optional<Diffusion<Scalar>> diffusion;
  /// u(z) along the slope. Without a slab that of a steady chute: what the solution goes on in is then the distance x.
  std::optional<Velocity<Scalar>> velocity;
  std::optional<Slab<Scalar>> slab;
  /// Of a slab: breaks and values below are then the means over x, which Scene fills in.
  std::optional<Block<Scalar>> initial_block;
  /// phi / c as a smooth function, or one with kinks; breaks and values are then empty.
  std::optional<InitialState<Scalar>> initial_state;
  std::vector<Scalar> initial_breaks;  ///< heights of the initial jumps, ascending, in the domain
  std::vector<Scalar> initial_values;  ///< phi / c between them, bottom to top; one more than breaks
  Scalar bottom{0}, top{1};            ///< the domain, same unit as z
  std::optional<OutsideState<Scalar>> outside_bottom, outside_top;  ///< open ends; a wall if not given
  bool is_neumann = false;   ///< phi_z = 0 at both ends, the flux passes (beds with diffusion)
  bool is_periodic = false;  ///< what leaves at the top comes in at the bottom
};

/// Heights inside the domain where a, c, T, D or one of their slopes jumps, in no order.
template <Real Scalar>
[[nodiscard]] std::vector<Scalar> depth_knots(const SceneSpec<Scalar>& spec) {
  std::vector<Scalar> all;
  const auto take = [&](const DepthFunction<Scalar>& function) {
    for (const Scalar& z : std::visit([](const auto& model) { return model.knots(); }, function))
      if (z > spec.bottom && z < spec.top) all.push_back(z);
  };
  take(spec.shear_rate);
  if (spec.solid_fraction) take(*spec.solid_fraction);
  if (spec.temperature) take(*spec.temperature);
  if (spec.diffusion && spec.diffusion->variation) take(*spec.diffusion->variation);
  return all;
}

/// Tells all models of a scene its ends (model/depth/model.hpp).
template <Real Scalar>
void prepare(SceneSpec<Scalar>& spec) {
  const auto with = [&](DepthFunction<Scalar>& function) {
    std::visit([&](auto& model) { prepare(model, spec.bottom, spec.top); }, function);
  };
  with(spec.shear_rate);
  if (spec.solid_fraction) with(*spec.solid_fraction);
  if (spec.temperature) with(*spec.temperature);
  if (spec.diffusion && spec.diffusion->variation) with(*spec.diffusion->variation);
}

/// "flux." or, where there are several, "flux[1].".
template <class Spec>
[[nodiscard]] std::string flux_prefix(const Spec& spec, std::size_t i) {
  return spec.fluxes.size() == 1 ? "flux." : "flux[" + std::to_string(i) + "].";
}

/// Calls visit(key, FieldInfo, member) for every numeric field of a scene file, in the order of the file; key is
/// the full name ("shear_rate.values"), member a Scalar or a vector of them, const as the specification is.
template <class Spec, class Visit>
void visit_fields(Spec& spec, Visit&& visit) {
  constexpr FieldInfo kPositive{.key = "", .range = Range::positive},
      kNotNegative{.key = "", .limits = {.low = 0, .are_included = true}},
      kScale{.key = "", .range = Range::positive, .also = "s a(z) a positive number"},
      kTimes{.key = "", .range = Range::positive, .also = "ascending"},
      kBreaks{.key = "", .measure = Measure::height, .also = "inside the domain, ascending"},
      kEnd{
          .key = "", .measure = Measure::height, .limits = {-1e300, 1e300, true}, .also = "bottom below top"},
      kState{.key = "", .measure = Measure::state, .also = "states of the flux"};
  const auto with_prefix = [&](const std::string& prefix) {
    return [&visit, prefix](const FieldInfo& info, auto& member) {
      visit(prefix + std::string(info.key), info, member);
    };
  };
  for (std::size_t i = 0; i < spec.fluxes.size(); ++i) {
    const std::string prefix = flux_prefix(spec, i);
    spec.fluxes[i].fields(spec.fluxes[i], with_prefix(prefix));
    if (i > 0) visit(prefix + "above", kBreaks, spec.flux_breaks[i - 1]);
  }
  std::visit([&](auto& rate) { rate.fields(rate, with_prefix("shear_rate.")); }, spec.shear_rate);
  visit(std::string("shear_rate.scale"), kScale, spec.scale);
  const auto optional_model = [&](auto& optional, const std::string& prefix) {
    if (optional) std::visit([&](auto& model) { model.fields(model, with_prefix(prefix)); }, *optional);
  };
  optional_model(spec.solid_fraction, "solid_fraction.");
  optional_model(spec.temperature, "temperature.");
  optional_model(spec.close_packing, "close_packing.");
  if (spec.diffusion) {
    // 0 stands for none; what is positive is found by its logarithm in a fit.
    visit(std::string("diffusion.D"), spec.diffusion->D == 0 ? kNotNegative : kPositive, spec.diffusion->D);
    optional_model(spec.diffusion->variation, "diffusion.");
  }
  optional_model(spec.velocity, "velocity.");
  if (spec.slab) visit(std::string("slab.length"), kPositive, spec.slab->length);
  optional_model(spec.initial_state, "initial.");
  if (spec.initial_block) {
    visit(std::string("initial.x"), FieldInfo{}, spec.initial_block->x);
    visit(std::string("initial.z"), kEnd, spec.initial_block->z);
    visit(std::string("initial.inside"), kState, spec.initial_block->inside);
    visit(std::string("initial.outside"), kState, spec.initial_block->outside);
  } else if (!spec.initial_state) {
    visit(std::string("initial.breaks"), kBreaks, spec.initial_breaks);
    visit(std::string("initial.values"), kState, spec.initial_values);
  }
  visit(std::string("domain.bottom"), kEnd, spec.bottom);
  visit(std::string("domain.top"), kEnd, spec.top);
  const auto outside = [&](auto& optional, const std::string& prefix) {
    if (!optional) return;
    visit(prefix + "breaks", kTimes, optional->breaks);
    visit(prefix + "values", kState, optional->values);
  };
  outside(spec.outside_bottom, "boundary.bottom.");
  outside(spec.outside_top, "boundary.top.");
}

}  // namespace shearfront
