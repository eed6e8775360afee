// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/riemann/flux_course.hpp"

namespace shearfront {

namespace {

/// Collects what is wrong with a specification, table by table.
template <Real Scalar>
class Checker {
 public:
  explicit Checker(const SceneSpec<Scalar>& spec) : spec_(spec) {}

  Complaints all() {
    domain();
    fluxes();
    depth_function("shear_rate.", spec_.shear_rate);
    check_number("shear_rate.scale", Range::positive, spec_.scale, complaints_);
    if (spec_.solid_fraction) depth_function("solid_fraction.", *spec_.solid_fraction);
    if (spec_.temperature) depth_function("temperature.", *spec_.temperature);
    if (spec_.close_packing) close_packing();
    if (complaints_.empty()) scaled_rate();
    if (complaints_.empty()) scaled_solid_fraction();
    if (spec_.diffusion) diffusion();
    if (spec_.velocity) velocity();
    if (spec_.slab) check_number("slab.length", Range::positive, spec_.slab->length, complaints_);
    if (spec_.initial_state) initial_state();
    if (spec_.initial_block) {
      block(*spec_.initial_block);
      return std::move(complaints_);
    }
    check_number("initial.breaks", Range::any, spec_.initial_breaks, complaints_);
    if (domain_ok_)
      check_breaks("initial.breaks", spec_.initial_breaks, spec_.bottom, spec_.top, complaints_);
    if (!spec_.initial_state) states("initial.", spec_.initial_values, spec_.initial_breaks);
    if (flux_ok_ && domain_ok_ && has_right_lengths()) initial_states();
    if (spec_.outside_bottom) outside("boundary.bottom.", *spec_.outside_bottom, 0);
    if (spec_.outside_top) outside("boundary.top.", *spec_.outside_top, spec_.fluxes.size() - 1);
    if (complaints_.empty()) ends();
    if (complaints_.empty() && !has_diffusion()) neighbours();
    return std::move(complaints_);
  }

 private:
  void add(std::string key, const std::string& value, std::string constraint) {
    complaints_.push_back({std::move(key), value, std::move(constraint)});
  }
  [[nodiscard]] auto field(const std::string& prefix) {
    return [this, prefix](const FieldInfo& info, const auto& member) {
      check_field(prefix + std::string(info.key), info, member, complaints_);
    };
  }

  void domain() {
    check_number("domain.bottom", Range::any, spec_.bottom, complaints_);
    check_number("domain.top", Range::any, spec_.top, complaints_);
    // Heights are subtracted, and multiplied with fractions and small numbers.
    const Scalar farthest(1e300);
    for (const auto& [key, z] :
         {std::pair("domain.bottom", spec_.bottom), std::pair("domain.top", spec_.top)})
      if (is_finite(z) && (z > farthest || z < -farthest))
        add(key, number_text(z), "must be between -1e+300 and 1e+300");
    if (is_finite(spec_.bottom) && is_finite(spec_.top) && !(spec_.top > spec_.bottom))
      add("domain.top", number_text(spec_.top),
          "must be greater than domain.bottom (" + number_text(spec_.bottom) + ")");
    domain_ok_ = complaints_.empty();
  }

  void fluxes() {
    const std::size_t before = complaints_.size();
    for (std::size_t i = 0; i < spec_.fluxes.size(); ++i) {
      const std::string prefix = flux_prefix(spec_, i);
      spec_.fluxes[i].fields(spec_.fluxes[i], field(prefix));
      spec_.fluxes[i].check(prefix, complaints_);
      if (i == 0) continue;
      const Scalar& z = spec_.flux_breaks[i - 1];
      check_number(prefix + "above", Range::any, z, complaints_);
      if (!domain_ok_ || !is_finite(z)) continue;
      if (!(z > spec_.bottom && z < spec_.top))
        add(prefix + "above", number_text(z),
            "must be inside the domain (" + number_text(spec_.bottom) + ", " + number_text(spec_.top) + ")");
      else if (i > 1 && !(z > spec_.flux_breaks[i - 2]))
        add(prefix + "above", number_text(z),
            "must be greater than that of the flux before it (" + number_text(spec_.flux_breaks[i - 2]) +
                ")");
    }
    flux_ok_ = complaints_.size() == before;
  }

  void depth_function(const std::string& prefix, const DepthFunction<Scalar>& function) {
    std::visit(
        [&](const auto& model) {
          model.fields(model, field(prefix));
          if (domain_ok_) model.check(prefix, spec_.bottom, spec_.top, complaints_);
        },
        function);
  }

  [[nodiscard]] bool has_diffusion() const { return spec_.diffusion && spec_.diffusion->D > 0; }
  void diffusion() {
    check_number("diffusion.D", spec_.diffusion->D == 0 ? Range::any : Range::positive, spec_.diffusion->D,
                 complaints_);
    if (spec_.diffusion->variation) depth_function("diffusion.", *spec_.diffusion->variation);
  }
  /// Not upstream, and not at rest but on the ground: x has to go on.
  void velocity() {
    const std::size_t before = complaints_.size();
    std::visit(
        [&](const auto& model) {
          model.fields(model, field("velocity."));
          if (domain_ok_) model.check("velocity.", spec_.bottom, spec_.top, complaints_);
          if (complaints_.size() > before || !domain_ok_ || spec_.slab) return;
          std::vector<Scalar> all = model.knots();
          all.insert(all.begin(), {spec_.bottom, spec_.top});
          for (const Scalar& z : all) {
            if (z < spec_.bottom || z > spec_.top) continue;
            const Scalar u = model.value(z);
            if (u > 0 || (u == 0 && z == spec_.bottom)) continue;
            return add("velocity.model", '"' + std::string(model.kName) + '"',
                       "must give u > 0, or u = 0 at the bottom alone (u(" + number_text(z) +
                           ") = " + number_text(u) + "): nothing is carried downstream there");
          }
        },
        *spec_.velocity);
    if (spec_.is_periodic && !spec_.slab)
      add("boundary.periodic", "true", "must not be given with a velocity: top and bottom differ");
  }
  /// The rectangle of another state that a slab may start with.
  void block(const Block<Scalar>& start) {
    if (!spec_.slab) return add("initial.model", "\"block\"", "must not be given without a table slab");
    if (spec_.solid_fraction)
      return add("solid_fraction", "", "must not be given with a block, whose states are phi");
    for (const auto& [key, ends, lowest, highest] :
         {std::tuple("initial.x", &start.x, Scalar(0), spec_.slab->length),
          std::tuple("initial.z", &start.z, spec_.bottom, spec_.top)}) {
      check_number(key, Range::any, *ends, complaints_);
      if (ends->size() != 2) {
        complaints_.push_back(
            wrong_length(key, ends->size(), "must have 2 entries, where it begins and ends"));
      } else if (!((*ends)[0] >= lowest && (*ends)[0] < (*ends)[1] && (*ends)[1] <= highest)) {
        add(key, number_text((*ends)[0]) + ", " + number_text((*ends)[1]),
            "must ascend between " + number_text(lowest) + " and " + number_text(highest));
      }
    }
    if (!flux_ok_) return;
    const StateRange<Scalar> range = spec_.fluxes.front().range();
    for (const auto& [key, phi] :
         {std::pair("initial.inside", start.inside), std::pair("initial.outside", start.outside)}) {
      check_number(key, Range::any, phi, complaints_);
      if (is_finite(phi) && !(phi >= range.lowest && phi <= range.highest))
        add(key, number_text(phi),
            "must be between " + number_text(range.lowest) + " and " + number_text(range.highest));
    }
  }
  void initial_state() {
    const std::size_t before = complaints_.size();
    std::visit(
        [&](const auto& model) {
          model.fields(model, field("initial."));
          if (domain_ok_) model.check("initial.", spec_.bottom, spec_.top, complaints_);
          if (complaints_.size() > before || !flux_ok_ || !domain_ok_) return;  // the table may be empty
          for (std::size_t i = 0; i < spec_.fluxes.size(); ++i) {
            const StateRange<Scalar> range = spec_.fluxes[i].range();
            const Scalar lowest = model.lowest(), highest = model.highest();
            if (lowest >= range.lowest && highest <= range.highest) continue;
            return add("initial.model", std::string(model.kName),
                       "must stay between " + number_text(range.lowest) + " and " +
                           number_text(range.highest) + " (goes from " + number_text(lowest) + " to " +
                           number_text(highest) + ")");
          }
        },
        *spec_.initial_state);
  }

  void close_packing() {
    std::visit(
        [&](const auto& law) {
          law.fields(law, field("close_packing."));
          law.check("close_packing.", complaints_);
        },
        *spec_.close_packing);
  }

  [[nodiscard]] static Scalar value(const DepthFunction<Scalar>& function, const Scalar& z) {
    return std::visit([&](const auto& model) { return model.value(z); }, function);
  }
  /// Heights at which something may be largest or smallest: between them every depth function is monotone.
  [[nodiscard]] std::vector<Scalar> heights() const {
    std::vector<Scalar> all = depth_knots(spec_);
    all.insert(all.begin(), {spec_.bottom, spec_.top});
    return all;
  }

  /// s a(z) sqrt(T(z)), which every engine computes with, may not overflow or underflow.
  void scaled_rate() {
    using std::sqrt;
    for (const Scalar& z : heights()) {
      const Scalar a = value(spec_.shear_rate, z);
      Scalar scaled = spec_.scale * a;
      if (spec_.temperature) scaled *= sqrt(value(*spec_.temperature, z));
      if (scaled > 0 && is_finite(scaled)) continue;
      if (scaled == 0 && a == 0 && vanishes_at_end(z)) continue;
      return add("shear_rate.scale", number_text(spec_.scale),
                 "must keep s a(z) a positive finite number on the whole domain (a(" + number_text(z) +
                     ") = " + number_text(a) + ")");
    }
  }
  [[nodiscard]] bool vanishes_at_end(const Scalar& z) const {
    return (z == spec_.bottom || z == spec_.top) &&
           std::visit([&](const auto& model) { return may_vanish_at(model, z); }, spec_.shear_rate);
  }
  /// c(z) times the height, and times the rate, must stay numbers too.
  void scaled_solid_fraction() {
    if (!spec_.solid_fraction) return;
    const Scalar height = spec_.top - spec_.bottom;
    for (const Scalar& z : heights()) {
      const Scalar c = value(*spec_.solid_fraction, z);
      const Scalar flux = c * (spec_.scale * value(spec_.shear_rate, z));
      const bool is_flux = flux > 0 || (flux == 0 && c > 0 && vanishes_at_end(z));
      if (is_finite(Scalar(c * height)) && is_finite(flux) && is_flux) continue;
      return add(
          "solid_fraction", number_text(c),
          "must keep c(z) s a(z) a positive finite number on the whole domain (z = " + number_text(z) + ")");
    }
  }

  [[nodiscard]] static Complaint one_more_than_breaks(const std::string& prefix, std::size_t n_values,
                                                      std::size_t n_breaks) {
    return wrong_length(prefix + "values", n_values,
                        "must have one entry more than breaks (" + std::to_string(n_breaks + 1) + ")");
  }
  [[nodiscard]] bool has_right_lengths() const {
    return spec_.initial_values.size() == spec_.initial_breaks.size() + 1 &&
           std::is_sorted(spec_.initial_breaks.begin(), spec_.initial_breaks.end());
  }
  void states(const std::string& prefix, const std::vector<Scalar>& values,
              const std::vector<Scalar>& breaks) {
    if (values.size() != breaks.size() + 1)
      complaints_.push_back(one_more_than_breaks(prefix, values.size(), breaks.size()));
    if (!flux_ok_ || spec_.fluxes.size() > 1) return;
    for (std::size_t i = 0; i < values.size(); ++i) in_range(prefix, i, values[i], 0);
  }
  void in_range(const std::string& prefix, std::size_t i, const Scalar& phi, std::size_t flux) {
    const StateRange<Scalar> range = spec_.fluxes[flux].range();
    if (phi >= range.lowest && phi <= range.highest) return;
    std::string where = spec_.fluxes.size() > 1 ? " (the states of flux[" + std::to_string(flux) + "])" : "";
    add(prefix + "values[" + std::to_string(i) + "]", number_text(phi),
        "must be between " + number_text(range.lowest) + " and " + number_text(range.highest) + where);
  }
  /// Each initial state in the range of every flux it meets.
  void initial_states() {
    if (spec_.fluxes.size() == 1) return;  // done by states()
    for (std::size_t i = 0; i < spec_.initial_values.size(); ++i) {
      const Scalar& lo = i == 0 ? spec_.bottom : spec_.initial_breaks[i - 1];
      const Scalar& hi = i + 1 == spec_.initial_values.size() ? spec_.top : spec_.initial_breaks[i];
      for (std::size_t k = 0; k < spec_.fluxes.size(); ++k) {
        const Scalar& begin = k == 0 ? spec_.bottom : spec_.flux_breaks[k - 1];
        const Scalar& end = k + 1 == spec_.fluxes.size() ? spec_.top : spec_.flux_breaks[k];
        if (std::max(lo, begin) < std::min(hi, end)) in_range("initial.", i, spec_.initial_values[i], k);
      }
    }
  }

  void outside(const std::string& prefix, const OutsideState<Scalar>& state, std::size_t flux) {
    check_number(prefix + "breaks", Range::positive, state.breaks, complaints_);
    for (std::size_t i = 1; i < state.breaks.size(); ++i)
      if (is_finite(state.breaks[i]) && is_finite(state.breaks[i - 1]) &&
          !(state.breaks[i] > state.breaks[i - 1]))
        add(prefix + "breaks[" + std::to_string(i) + "]", number_text(state.breaks[i]),
            "must be greater than the break before it (" + number_text(state.breaks[i - 1]) + ")");
    if (state.values.size() != state.breaks.size() + 1)
      complaints_.push_back(one_more_than_breaks(prefix, state.values.size(), state.breaks.size()));
    for (std::size_t i = 0; flux_ok_ && i < state.values.size(); ++i)
      in_range(prefix, i, state.values[i], flux);
    if (spec_.is_periodic) add(prefix + "values", "", "must not be given for a periodic bed");
  }

  [[nodiscard]] static Scalar end_flux(const Flux<Scalar>& flux, bool is_highest) {
    return flux.value(is_highest ? flux.range().highest : flux.range().lowest);
  }
  /// Walls stop a flux only if there is a state without flux on either side of the extremum.
  void ends() {
    const auto vanishes = [&](const Flux<Scalar>& flux) {
      return end_flux(flux, false) == 0 && end_flux(flux, true) == 0;
    };
    if (spec_.is_neumann &&
        (spec_.is_periodic || spec_.outside_bottom || spec_.outside_top || !has_diffusion()))
      return add(
          "boundary.neumann", "true",
          has_diffusion() ? "must not stand beside other ends" : "must not be given without diffusion");
    const bool is_inside = !spec_.is_periodic && !spec_.is_neumann;
    const bool is_bottom_wall = is_inside && !spec_.outside_bottom;
    const bool is_top_wall = is_inside && !spec_.outside_top;
    for (const bool is_top : {false, true}) {
      const std::size_t i = is_top ? spec_.fluxes.size() - 1 : 0;
      if ((is_top ? is_top_wall : is_bottom_wall) && !vanishes(spec_.fluxes[i]))
        return add(flux_prefix(spec_, i) + "model", std::string(spec_.fluxes[i].name()),
                   "must vanish at both ends of its range next to a wall; give boundary." +
                       std::string(is_top ? "top" : "bottom") + " or boundary.periodic");
    }
  }
  /// A flux with a minimum cannot face one with a maximum, and what one layer carries the next must be able
  /// to take.
  void neighbours() {
    for (std::size_t i = 0; i + 1 < spec_.fluxes.size(); ++i) {
      const FluxCourse below = course_of(spec_.fluxes[i]), above = course_of(spec_.fluxes[i + 1]);
      if (is_monotone(below) && below == above) continue;
      const auto has_one = [](FluxCourse course) {
        return course == FluxCourse::minimum || course == FluxCourse::maximum;
      };
      const std::string key = flux_prefix(spec_, i + 1) + "model";
      if (!has_one(below) || !has_one(above))
        return add(
            key, std::string(spec_.fluxes[i + 1].name()),
            "must have one extremum, like the flux beside it, or rise or fall all the way as that does");
      if (below != above)
        return add(key, std::string(spec_.fluxes[i + 1].name()),
                   "must have a " + std::string(below == FluxCourse::minimum ? "minimum" : "maximum") +
                       " like the flux below it: a minimum facing a maximum is not covered");
      for (const bool is_highest : {false, true})
        if (end_flux(spec_.fluxes[i], is_highest) != 0 || end_flux(spec_.fluxes[i + 1], is_highest) != 0)
          return add(key, std::string(spec_.fluxes[i + 1].name()),
                     "must vanish at both ends of its range, as must every flux beside another one");
    }
  }

  const SceneSpec<Scalar>& spec_;
  Complaints complaints_;
  bool domain_ok_ = false, flux_ok_ = false;
};

}  // namespace

template <Real Scalar>
Complaints find_complaints(const SceneSpec<Scalar>& spec) {
  return Checker<Scalar>(spec).all();
}

template Complaints find_complaints(const SceneSpec<Instantiated>&);

}  // namespace shearfront
