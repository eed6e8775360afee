// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/numeric/sum.hpp"
#include "shearfront/scene/scene_complaints.hpp"
#include "shearfront/scene/scene_spec.hpp"

namespace shearfront {

/// A bed of mixed grains: flux, shear rate a(z), scale s, solid fraction c(z), granular temperature T(z), initial
/// concentration phi(z, 0), and what lies at its ends.
///
///     phi_t + (s a(z) sqrt(T(z)) c(z) f(phi / c(z)))_z = 0 on bottom < z < top.
///
/// f may differ from layer to layer; c = T = 1 unless the scene says otherwise. With diffusion the right side
/// is (D(z) phi_z)_z, and the initial data may be smooth. The ends are walls (no flux),
/// open (a state outside, in the sense of Bardos, LeRoux & Nedelec 1979), or joined (periodic).
/// Class invariant: find_complaints(spec()) is empty. Immutable after construction.
/// Errors: the constructor throws InputError that carries all complaints.
template <Real Scalar>
class Scene {
 public:
  explicit Scene(SceneSpec<Scalar> spec) : spec_(std::move(spec)) {
    if (Complaints complaints = find_complaints(spec_); !complaints.empty()) throw InputError(std::move(complaints));
  }

  [[nodiscard]] const SceneSpec<Scalar>& spec() const { return spec_; }
  [[nodiscard]] const std::string& name() const { return spec_.name; }
  [[nodiscard]] const std::vector<Flux<Scalar>>& fluxes() const { return spec_.fluxes; }
  /// Heights between the fluxes, one less.
  [[nodiscard]] const std::vector<Scalar>& flux_breaks() const { return spec_.flux_breaks; }
  [[nodiscard]] const DepthFunction<Scalar>& shear_rate() const { return spec_.shear_rate; }
  [[nodiscard]] const Scalar& scale() const { return spec_.scale; }
  [[nodiscard]] const Scalar& bottom() const { return spec_.bottom; }
  [[nodiscard]] const Scalar& top() const { return spec_.top; }
  [[nodiscard]] const std::vector<Scalar>& initial_breaks() const { return spec_.initial_breaks; }
  /// Of phi / c.
  [[nodiscard]] const std::vector<Scalar>& initial_values() const { return spec_.initial_values; }

  /// Which flux holds at z; at a break the one above.
  [[nodiscard]] std::size_t flux_index(const Scalar& z) const {
    const auto& breaks = spec_.flux_breaks;
    return static_cast<std::size_t>(std::upper_bound(breaks.begin(), breaks.end(), z) - breaks.begin());
  }
  [[nodiscard]] const Flux<Scalar>& flux_at(const Scalar& z) const { return spec_.fluxes[flux_index(z)]; }
  /// The states allowed at z: those of the flux times c(z).
  [[nodiscard]] StateRange<Scalar> range_at(const Scalar& z) const {
    const StateRange<Scalar> range = std::visit([](const auto& flux) { return flux.range(); }, flux_at(z));
    const Scalar c = solid_fraction_at(z);
    return {c * range.lowest, c * range.highest};
  }
  /// Whether all of the scene is the model of May, Shearer & Daniels: one quadratic flux, c = T = 1, walls.
  [[nodiscard]] bool is_plain() const {
    return spec_.fluxes.size() == 1 && unit_parabola_sign<Scalar>(spec_.fluxes[0]) == 1 &&
           !spec_.solid_fraction && !spec_.temperature && has_walls() && !has_diffusion();
  }
  /// Whether no grain can leave or come in.
  [[nodiscard]] bool has_walls() const {
    return !spec_.outside_bottom && !spec_.outside_top && !spec_.is_periodic && !spec_.is_neumann;
  }
  /// Whether grains diffuse: then phi is smooth, and the engines for D = 0 do not apply.
  [[nodiscard]] bool has_diffusion() const { return spec_.diffusion && spec_.diffusion->D > 0; }
  /// D(z); 0 without diffusion.
  [[nodiscard]] Scalar diffusivity_at(const Scalar& z) const {
    if (!has_diffusion()) return Scalar(0);
    const Diffusion<Scalar>& d = *spec_.diffusion;
    return d.D * (d.follows_shear_rate ? shear_rate_at(z) : d.profile ? value(*d.profile, z) : Scalar(1));
  }

  /// True if flux, a, c and T are constant between the knots().
  [[nodiscard]] bool is_layered() const {
    const auto layered = [](const DepthFunction<Scalar>& profile) {
      return std::visit([](const auto& model) { return model.kIsLayered; }, profile);
    };
    return layered(spec_.shear_rate) && (!spec_.solid_fraction || layered(*spec_.solid_fraction)) &&
           (!spec_.temperature || layered(*spec_.temperature));
  }
  /// Whether flux, a, c and T are the same all over the bed.
  [[nodiscard]] bool is_uniform() const { return is_layered() && knots().empty(); }
  /// Heights inside the domain where the flux, a, c, T or one of their slopes jumps; ascending.
  [[nodiscard]] std::vector<Scalar> knots() const {
    std::vector<Scalar> all = depth_knots(spec_);
    all.insert(all.end(), spec_.flux_breaks.begin(), spec_.flux_breaks.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// Whether the flux, a, c or T jumps at z: there the scene has an interface of its own.
  [[nodiscard]] bool jumps_at(const Scalar& z) const {
    const auto jumps = [&](const DepthFunction<Scalar>& profile) {
      return std::visit(
          [&](const auto& model) {
            if (!model.kIsLayered) return false;
            const auto knots = model.knots();
            return std::binary_search(knots.begin(), knots.end(), z);
          },
          profile);
    };
    return std::binary_search(spec_.flux_breaks.begin(), spec_.flux_breaks.end(), z) ||
           jumps(spec_.shear_rate) || (spec_.solid_fraction && jumps(*spec_.solid_fraction)) ||
           (spec_.temperature && jumps(*spec_.temperature));
  }

  /// a(z), without the scale s and the temperature.
  [[nodiscard]] Scalar shear_rate_at(const Scalar& z) const { return value(spec_.shear_rate, z); }
  [[nodiscard]] Scalar solid_fraction_at(const Scalar& z) const {
    return spec_.solid_fraction ? value(*spec_.solid_fraction, z) : Scalar(1);
  }
  /// a(z) sqrt(T(z)): what moves the grains, without the scale s.
  [[nodiscard]] Scalar rate_at(const Scalar& z) const {
    using std::sqrt;
    const Scalar a = shear_rate_at(z);
    return spec_.temperature ? a * sqrt(value(*spec_.temperature, z)) : a;
  }
  /// Harmonic mean of rate_at over [lo, hi], which must not contain a knot inside. To rounding for T = 1 or
  /// a layered one, else by quadrature (7 points of Gauss).
  [[nodiscard]] Scalar mean_rate(const Scalar& lo, const Scalar& hi) const {
    using std::sqrt;
    const auto mean = [&](const DepthFunction<Scalar>& profile) {
      return std::visit([&](const auto& model) { return Scalar(model.harmonic_mean(lo, hi)); }, profile);
    };
    if (!spec_.temperature) return mean(spec_.shear_rate);
    if (std::visit([](const auto& model) { return model.kIsLayered; }, *spec_.temperature))
      return mean(spec_.shear_rate) * sqrt(value(*spec_.temperature, lo));
    const auto slowness = [&](const Scalar& z) { return Scalar(Scalar(1) / rate_at(z)); };
    return Scalar(1) / mean_of(slowness, lo, hi);
  }
  /// Mean of c over [lo, hi], which must not contain a knot inside.
  [[nodiscard]] Scalar mean_packing(const Scalar& lo, const Scalar& hi) const {
    if (!spec_.solid_fraction) return Scalar(1);
    if (std::visit([](const auto& model) { return model.kIsLayered; }, *spec_.solid_fraction))
      return value(*spec_.solid_fraction, lo);
    return mean_of([&](const Scalar& z) { return value(*spec_.solid_fraction, z); }, lo, hi);
  }

  /// phi(z, 0) / c(z) of data that are constant in pieces; at a jump the value above it. Cost: O(log jumps).
  [[nodiscard]] const Scalar& initial_share(const Scalar& z) const {
    const auto& breaks = spec_.initial_breaks;
    const auto k = std::upper_bound(breaks.begin(), breaks.end(), z) - breaks.begin();
    return spec_.initial_values[static_cast<std::size_t>(k)];
  }
  /// phi(z, 0); at a jump the value above it. Cost: O(log jumps).
  [[nodiscard]] Scalar initial_phi(const Scalar& z) const {
    if (spec_.initial_state)
      return std::visit([&](const auto& model) { return Scalar(model.value(z)); }, *spec_.initial_state);
    const Scalar& share = initial_share(z);
    return spec_.solid_fraction ? solid_fraction_at(z) * share : share;
  }
  /// Amount of small grains, int phi(z, 0) dz (compensated sum). Constant in time between walls.
  [[nodiscard]] Scalar mass() const {
    if (spec_.initial_state) return initial_amount(spec_.bottom, spec_.top);
    CompensatedSum<Scalar> sum;
    const auto& breaks = spec_.initial_breaks;
    for (std::size_t i = 0; i < spec_.initial_values.size(); ++i) {
      const Scalar& lo = i == 0 ? spec_.bottom : breaks[i - 1];
      const Scalar& hi = i == breaks.size() ? spec_.top : breaks[i];
      sum += solid(lo, hi) * spec_.initial_values[i];
    }
    // No more than there is room for: where all of the bed is pure, that is the mass to the bit.
    const Scalar height = solid(spec_.bottom, spec_.top);
    const auto [least, most] = std::minmax_element(spec_.initial_values.begin(), spec_.initial_values.end());
    return std::clamp(sum.value(), Scalar(*least * height), Scalar(*most * height));
  }
  /// int_lo^hi phi(z, 0) dz. Cost: O(jumps, or points of the profile).
  [[nodiscard]] Scalar initial_amount(const Scalar& lo, const Scalar& hi) const {
    if (spec_.initial_state)
      return std::visit([&](const auto& model) { return Scalar(model.integral(lo, hi)); },
                        *spec_.initial_state);
    CompensatedSum<Scalar> sum;
    Scalar from = lo;
    for (const Scalar& z : spec_.initial_breaks) {
      if (!(z > from)) continue;
      if (!(z < hi)) break;
      sum += solid(from, z) * initial_share(from);
      from = z;
    }
    sum += solid(from, hi) * initial_share(from);
    return sum.value();
  }
  /// Height of the jump in the steady state between walls: grains of a flux with a minimum have sunk below
  /// it, those of one with a maximum have risen above it.
  [[nodiscard]] Scalar steady_height() const {
    const Scalar m = mass();
    if (is_plain()) return spec_.bottom + m;
    const bool rises =
        std::visit([](const auto& f) { return f.value(f.extrema().front()) > f.value(f.range().lowest); },
                   spec_.fluxes.front());
    // What the bed holds if the jump is at z, less what it does hold; monotone in z.
    const auto excess = [&](const Scalar& z) {
      return Scalar(amount(spec_.bottom, z, !rises) + amount(z, spec_.top, rises) - m);
    };
    Scalar lo = spec_.bottom, hi = spec_.top;
    for (int i = 0; i < std::numeric_limits<Scalar>::digits + 8 && lo < hi; ++i) {
      const Scalar z = lo + (hi - lo) / Scalar(2);
      ((excess(z) > 0) != rises ? hi : lo) = z;
    }
    return lo + (hi - lo) / Scalar(2);
  }
  /// int phi dz over [lo, hi] if phi is as high, or as low, as it can be. Cost: O(fluxes + knots of c).
  [[nodiscard]] Scalar amount(const Scalar& lo, const Scalar& hi, bool is_highest) const {
    CompensatedSum<Scalar> sum;
    for (std::size_t i = 0; i < spec_.fluxes.size(); ++i) {
      const Scalar begin = i == 0 ? lo : std::max(lo, spec_.flux_breaks[i - 1]);
      const Scalar end = i + 1 == spec_.fluxes.size() ? hi : std::min(hi, spec_.flux_breaks[i]);
      if (!(begin < end)) continue;
      const StateRange<Scalar> range = std::visit([](const auto& f) { return f.range(); }, spec_.fluxes[i]);
      sum += solid(begin, end) * (is_highest ? range.highest : range.lowest);
    }
    return sum.value();
  }
  /// int_lo^hi c dz; hi - lo without solid fraction. Cost: O(knots) with one.
  [[nodiscard]] Scalar solid(const Scalar& lo, const Scalar& hi) const {
    if (!spec_.solid_fraction) return hi - lo;
    CompensatedSum<Scalar> sum;
    Scalar from = lo;
    const auto add = [&](const Scalar& to) {
      sum += mean_packing(from, to) * (to - from);
      from = to;
    };
    for (const Scalar& z : std::visit([](const auto& model) { return model.knots(); }, *spec_.solid_fraction))
      if (z > from && z < hi) add(z);
    add(hi);
    return sum.value();
  }

 private:
  [[nodiscard]] static Scalar value(const DepthFunction<Scalar>& profile, const Scalar& z) {
    return std::visit([&](const auto& model) { return Scalar(model.value(z)); }, profile);
  }
  template <class Function>
  [[nodiscard]] static Scalar mean_of(const Function& f, const Scalar& lo, const Scalar& hi) {
    const Scalar half = (hi - lo) / Scalar(2), middle = lo + half;
    return boost::math::quadrature::gauss<Scalar, 7>::integrate(
               [&](const Scalar& x) { return f(Scalar(middle + half * x)); }, Scalar(-1), Scalar(1)) /
           Scalar(2);
  }

  SceneSpec<Scalar> spec_;
};

extern template class Scene<double>;

}  // namespace shearfront
