// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/scene.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "shearfront/numeric/instantiated.hpp"
#include "shearfront/numeric/quadrature.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront {
namespace {

constexpr unsigned kMostAmountHalvings = 12;

/// Whether the flux is positive at its first extremum: a maximum.
template <Real S>
bool rises(const Flux<S>& flux) {
  const auto extrema = flux.extrema();
  return !extrema.empty() && flux.value(extrema.front()) > flux.value(flux.range().lowest);
}

template <Real S, class Function>
S mean_of(const Function& f, const S& lo, const S& hi) {
  const S half = (hi - lo) / S(2), middle = lo + half;
  return boost::math::quadrature::gauss<S, 7>::integrate([&](const S& x) { return f(S(middle + half * x)); },
                                                         S(-1), S(1)) /
         S(2);
}

/// Of the quadrature of what is smooth over (lo, hi): above the rounding of the rule, and of z itself where that is a part of a
/// narrow interval. Less is never met, and costs every halving that is allowed.
template <Real S>
S quadrature_tolerance(const S& lo, const S& hi) {
  const S size = std::max(S(lo < 0 ? -lo : lo), S(hi < 0 ? -hi : hi)), most = S(1) / S(1000);
  return std::min(most, S((S(32) + S(4) * size / (hi - lo)) * std::numeric_limits<S>::epsilon()));
}

/// int c share dz of a smooth start, no more than there is room for its least and largest value: by its own integral where c is
/// constant, by quadrature between the knots of both where it is not.
template <Real S, class Model>
S smooth_amount(const Scene<S>& scene, const Model& model, const S& lo, const S& hi) {
  CompensatedSum<S> sum;
  const auto& c = scene.spec().solid_fraction;
  const auto bounded = [&](const S& amount, const S& room) {
    return std::clamp(amount, S(model.lowest() * room), S(model.highest() * room));
  };
  const bool is_chute = scene.is_chute();
  if (!c && !is_chute) return bounded(S(model.integral(lo, hi)), S(hi - lo));
  std::vector<S> cuts =
      c ? std::visit([](const auto& function) { return function.knots(); }, *c) : std::vector<S>{};
  const bool is_layered = !is_chute && is_constant_in_pieces<S>(*c);
  const auto u = [&](const S& z) {
    return is_chute ? std::visit([&](const auto& v) { return S(v.value(z)); }, *scene.spec().velocity) : S(1);
  };
  if (is_chute) {
    const std::vector<S> knots = std::visit([](const auto& v) { return v.knots(); }, *scene.spec().velocity);
    cuts.insert(cuts.end(), knots.begin(), knots.end());
  }
  if (!is_layered) {
    const std::vector<S> knots = model.knots(lo, hi);
    cuts.insert(cuts.end(), knots.begin(), knots.end());
    std::sort(cuts.begin(), cuts.end());
  }
  S from = lo;
  const auto add = [&](const S& to) {
    if (!(to > from)) return;
    if (is_layered)
      sum += value(*c, from) * S(model.integral(from, to));
    else
      sum += integral_of_smooth<S>(
          [&](const S& z) { return S(scene.solid_fraction_at(z) * u(z) * model.value(z)); }, from, to,
          kMostAmountHalvings, quadrature_tolerance<S>(from, to));
    from = to;
  };
  for (const S& z : cuts)
    if (z < hi) add(z);
  add(hi);
  return bounded(sum.value(), scene.solid(lo, hi));
}

}  // namespace

template <Real S>
Scene<S>::Scene(SceneSpec<S> spec) : spec_(std::move(spec)) {
  prepare(spec_);
  if (Complaints complaints = find_complaints(spec_); !complaints.empty())
    throw InputError(std::move(complaints));
  complete();
}

template <Real S>
void Scene<S>::complete() {
  spec_.units.is_chute = is_chute();
  if (!spec_.initial_block) return;
  const Block<S>& block = *spec_.initial_block;
  const S share = (block.x[1] - block.x[0]) / spec_.slab->length,
          mean = block.outside + share * (block.inside - block.outside);
  spec_.initial_breaks.clear();
  spec_.initial_values = {block.z[0] > spec_.bottom ? block.outside : mean};
  const auto add = [&](const S& z, const S& above) {
    if (!(z > spec_.bottom && z < spec_.top)) return;
    spec_.initial_breaks.push_back(z);
    spec_.initial_values.push_back(above);
  };
  add(block.z[0], mean);
  add(block.z[1], block.outside);
}

template <Real S>
std::variant<Scene<S>, Complaints> Scene<S>::make(SceneSpec<S> spec) {
  prepare(spec);
  if (Complaints complaints = find_complaints(spec); !complaints.empty()) return complaints;
  return Scene(std::move(spec), Checked{});
}

template <Real S>
StateRange<S> Scene<S>::range_at(const S& z) const {
  const StateRange<S> range = flux_at(z).range();
  const S c = solid_fraction_at(z);
  return {c * range.lowest, c * range.highest};
}

template <Real S>
bool Scene<S>::counts_rising_grains() const {
  return std::any_of(fluxes().begin(), fluxes().end(), rises<S>);
}

template <Real S>
bool Scene<S>::is_plain() const {
  return fluxes().size() == 1 && unit_parabola_sign(fluxes()[0]) == 1 && !spec_.solid_fraction &&
         !spec_.temperature && !spec_.velocity && !spec_.slab && has_walls() && !has_diffusion();
}

template <Real S>
S Scene<S>::diffusivity_at(const S& z) const {
  if (!has_diffusion()) return S(0);
  const Diffusion<S>& d = *spec_.diffusion;
  const auto shear_rate = [&] {
    return std::visit([&](const auto& model) { return shear_rate_of(model, z); }, spec_.shear_rate);
  };
  return d.D * (d.follows_shear_rate ? shear_rate() : d.variation ? value(*d.variation, z) : S(1));
}

template <Real S>
bool Scene<S>::is_layered() const {
  return is_constant_in_pieces<S>(spec_.shear_rate) &&
         (!spec_.solid_fraction || is_constant_in_pieces<S>(*spec_.solid_fraction)) &&
         (!spec_.temperature || is_constant_in_pieces<S>(*spec_.temperature));
}

template <Real S>
std::vector<S> Scene<S>::knots() const {
  std::vector<S> all = depth_knots(spec_);
  all.insert(all.end(), spec_.flux_breaks.begin(), spec_.flux_breaks.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

template <Real S>
bool Scene<S>::jumps_at(const S& z) const {
  const auto jumps = [&](const DepthFunction<S>& function) {
    return std::visit(
        [&](const auto& model) {
          const auto knots = model.knots();
          return std::binary_search(knots.begin(), knots.end(), z) && may_jump_at(model, z);
        },
        function);
  };
  return std::binary_search(spec_.flux_breaks.begin(), spec_.flux_breaks.end(), z) ||
         jumps(spec_.shear_rate) || (spec_.solid_fraction && jumps(*spec_.solid_fraction)) ||
         (spec_.temperature && jumps(*spec_.temperature));
}

template <Real S>
S Scene<S>::shear_rate_at(const S& z) const {
  return value(spec_.shear_rate, z);
}

template <Real S>
S Scene<S>::solid_fraction_at(const S& z) const {
  return spec_.solid_fraction ? value(*spec_.solid_fraction, z) : S(1);
}

template <Real S>
S Scene<S>::rate_at(const S& z) const {
  using std::sqrt;
  const S a = shear_rate_at(z);
  return spec_.temperature ? S(a * sqrt(value(*spec_.temperature, z))) : a;
}

template <Real S>
S Scene<S>::mean_rate(const S& lo, const S& hi) const {
  using std::sqrt;
  const auto mean = [&] {
    return std::visit([&](const auto& model) { return S(model.harmonic_mean(lo, hi)); }, spec_.shear_rate);
  };
  if (!spec_.temperature) return mean();
  if (is_constant_in_pieces<S>(*spec_.temperature)) return mean() * sqrt(value(*spec_.temperature, lo));
  return S(1) / mean_of([&](const S& z) { return S(S(1) / rate_at(z)); }, lo, hi);
}

template <Real S>
S Scene<S>::mean_solid_fraction(const S& lo, const S& hi) const {
  if (!spec_.solid_fraction) return S(1);
  if (is_constant_in_pieces<S>(*spec_.solid_fraction)) return value(*spec_.solid_fraction, lo);
  return mean_of([&](const S& z) { return value(*spec_.solid_fraction, z); }, lo, hi);
}

template <Real S>
S Scene<S>::initial_phi(const S& z) const {
  const S share = initial_share(z);
  return spec_.solid_fraction ? S(solid_fraction_at(z) * share) : share;
}

template <Real S>
S Scene<S>::mass() const {
  if (spec_.initial_state) return initial_amount(bottom(), top());
  CompensatedSum<S> sum;
  const auto& breaks = initial_breaks();
  const auto& values = initial_values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const S& lo = i == 0 ? bottom() : breaks[i - 1];
    const S& hi = i == breaks.size() ? top() : breaks[i];
    sum += solid(lo, hi) * values[i];
  }
  // No more than there is room for: where all of the bed is pure, that is the mass to the bit.
  const S height = solid(bottom(), top());
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return std::clamp(sum.value(), S(*least * height), S(*most * height));
}

template <Real S>
S Scene<S>::initial_amount(const S& lo, const S& hi) const {
  if (spec_.initial_state)
    return std::visit([&](const auto& model) { return smooth_amount(*this, model, lo, hi); },
                      *spec_.initial_state);
  CompensatedSum<S> sum;
  S from = lo;
  for (const S& z : initial_breaks()) {
    if (!(z > from)) continue;
    if (!(z < hi)) break;
    sum += solid(from, z) * initial_share(from);
    from = z;
  }
  sum += solid(from, hi) * initial_share(from);
  return sum.value();
}

template <Real S>
S Scene<S>::steady_height() const {
  const S m = mass();
  if (is_plain()) return bottom() + m;
  const bool is_above = rises<S>(fluxes().front());
  // What the bed holds if the jump is at z, less what it does hold; monotone in z.
  const auto excess = [&](const S& z) {
    return S(amount(bottom(), z, !is_above) + amount(z, top(), is_above) - m);
  };
  S lo = bottom(), hi = top();
  for (int i = 0; i < std::numeric_limits<S>::digits + 8 && lo < hi; ++i) {
    const S z = lo + (hi - lo) / S(2);
    ((excess(z) > 0) != is_above ? hi : lo) = z;
  }
  return lo + (hi - lo) / S(2);
}

template <Real S>
S Scene<S>::amount(const S& lo, const S& hi, bool is_highest) const {
  CompensatedSum<S> sum;
  for (std::size_t i = 0; i < fluxes().size(); ++i) {
    const S begin = i == 0 ? lo : std::max(lo, flux_breaks()[i - 1]);
    const S end = i + 1 == fluxes().size() ? hi : std::min(hi, flux_breaks()[i]);
    if (!(begin < end)) continue;
    const StateRange<S> range = fluxes()[i].range();
    sum += solid(begin, end) * (is_highest ? range.highest : range.lowest);
  }
  return sum.value();
}

template <Real S>
S Scene<S>::solid(const S& lo, const S& hi) const {
  if (!spec_.solid_fraction) return flow(lo, hi);
  CompensatedSum<S> sum;
  S from = lo;
  const auto add = [&](const S& to) {
    const bool is_constant = !is_chute() || is_constant_in_pieces<S>(*spec_.solid_fraction);
    const auto passing = [&](const S& z) {
      return S(value(*spec_.solid_fraction, z) *
               std::visit([&](const auto& u) { return S(u.value(z)); }, *spec_.velocity));
    };
    sum += is_constant ? S(mean_solid_fraction(from, to) * flow(from, to))
                       : integral_of_smooth<S>(passing, from, to, kMostAmountHalvings,
                                               quadrature_tolerance<S>(from, to));
    from = to;
  };
  std::vector<S> cuts = std::visit([](const auto& model) { return model.knots(); }, *spec_.solid_fraction);
  if (is_chute()) {
    const std::vector<S> own = std::visit([](const auto& u) { return u.knots(); }, *spec_.velocity);
    cuts.insert(cuts.end(), own.begin(), own.end());
    std::sort(cuts.begin(), cuts.end());
  }
  for (const S& z : cuts)
    if (z > from && z < hi) add(z);
  add(hi);
  return sum.value();
}

template class Scene<Instantiated>;

}  // namespace shearfront
