// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/chute.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
namespace {

template <Real S>
bool is_uniform_flow(const Velocity<S>& velocity) {
  return std::visit(
      [](const auto& model) {
        if constexpr (requires { model.kIsUniform; })
          return model.kIsUniform;
        else
          return false;
      },
      velocity);
}

template <Real S>
S flow_of(const Velocity<S>& velocity, const S& lo, const S& hi) {
  return std::visit([&](const auto& model) { return S(model.flow(lo, hi)); }, velocity);
}

/// Mean of a function that runs from x to y as a straight line, harmonic.
template <Real S>
S logarithmic_mean(const S& x, const S& y) {
  using std::log;
  return x == y ? x : S((y - x) / log(S(y / x)));
}

/// A table is positive. Where the function vanishes at the end of the bed: the value there with which grains cross the last
/// piece in their time, `mean` being the harmonic mean of the function over it and `next` the value beside.
template <Real S>
S value_at_rest(const S& mean, const S& next) {
  if (!(mean > 0 && mean < next)) return next / S(2);
  S low = next * std::numeric_limits<S>::epsilon(), high = next;
  for (int i = 0; i < std::numeric_limits<S>::digits; ++i) {
    const S x = low + (high - low) / S(2);
    (logarithmic_mean(x, next) < mean ? low : high) = x;
  }
  return high;
}

}  // namespace

template <Real S>
SteadyChute<S>::SteadyChute(const Scene<S>& scene)
    : velocity_(*scene.spec().velocity),
      bottom_(scene.bottom()),
      top_(scene.top()),
      mean_velocity_(S(flow_of(velocity_, bottom_, top_) / (top_ - bottom_))),
      known_(scene.knots()),
      spec_(&scene.spec()),
      bed_(make_bed()) {
  SHEARFRONT_EXPECTS(scene.is_chute(), "a steady chute");
  spec_ = nullptr;
  known_.insert(known_.end(), {bottom_, top_});
  known_.insert(known_.end(), scene.initial_breaks().begin(), scene.initial_breaks().end());
  std::sort(known_.begin(), known_.end());
  known_in_bed_ = bed_heights(known_);
}

template <Real S>
S SteadyChute<S>::bed_height(const S& z) const {
  if (!(z > bottom_)) return bottom_;
  if (!(z < top_)) return top_;
  if (is_uniform_flow<S>(velocity_)) return z;
  return std::clamp(S(bottom_ + flow_of(velocity_, bottom_, z) / mean_velocity_), bottom_, top_);
}

template <Real S>
std::vector<S> SteadyChute<S>::bed_heights(const std::vector<S>& heights) const {
  std::vector<S> all;
  all.reserve(heights.size());
  for (const S& z : heights) all.push_back(bed_height(z));
  return all;
}

template <Real S>
S SteadyChute<S>::height(const S& zeta) const {
  if (is_uniform_flow<S>(velocity_)) return zeta;
  const auto same = std::lower_bound(known_in_bed_.begin(), known_in_bed_.end(), zeta);
  if (same != known_in_bed_.end() && *same == zeta)
    return known_[static_cast<std::size_t>(same - known_in_bed_.begin())];
  const S amount = mean_velocity_ * (zeta - bottom_);
  const S z = std::visit([&](const auto& model) { return S(model.height_of(bottom_, amount)); }, velocity_);
  return std::clamp(z, bottom_, top_);
}

template <Real S>
S SteadyChute<S>::velocity(const S& z) const {
  return std::visit([&](const auto& model) { return S(model.value(z)); }, velocity_);
}

template <Real S>
S SteadyChute<S>::flow(const S& lo, const S& hi) const {
  return flow_of(velocity_, lo, hi);
}

template <Real S>
std::vector<S> SteadyChute<S>::velocity_knots() const {
  std::vector<S> inside;
  for (const S& z : std::visit([](const auto& model) { return model.knots(); }, velocity_))
    if (z > bottom_ && z < top_) inside.push_back(z);
  return inside;
}

template <Real S>
Scene<S> SteadyChute<S>::make_bed() {
  SceneSpec<S> bed = *spec_;
  bed.velocity.reset();
  bed.scale = spec_->scale / mean_velocity_;
  const auto carry = [&](auto& optional) {
    if (optional) optional = carried(*optional);
  };
  bed.shear_rate = carried(spec_->shear_rate);
  carry(bed.solid_fraction);
  carry(bed.temperature);
  carry(bed.initial_state);
  bed.flux_breaks = bed_heights(spec_->flux_breaks);
  bed.initial_breaks = bed_heights(spec_->initial_breaks);
  if (bed.diffusion) {
    Diffusion<S>& diffusion = *bed.diffusion;
    diffusion.D = spec_->diffusion->D / mean_velocity_;
    const DepthFunction<S>* variation = diffusion.follows_shear_rate ? &spec_->shear_rate
                                        : diffusion.variation        ? &*spec_->diffusion->variation
                                                                     : nullptr;
    if (diffusion.D > 0 && !is_uniform_flow<S>(velocity_)) {
      diffusion.variation = carried_diffusivity(variation, spec_->diffusion->follows_shear_rate);
      diffusion.follows_shear_rate = false;
    }
  }
  return Scene<S>(std::move(bed));
}

/// The knots inside the bed and those of u.
template <Real S>
std::vector<S> SteadyChute<S>::cuts(std::vector<S> knots) const {
  const std::vector<S> own = std::visit([](const auto& model) { return model.knots(); }, velocity_);
  knots.insert(knots.end(), own.begin(), own.end());
  std::vector<S> all{bottom_};
  std::sort(knots.begin(), knots.end());
  for (const S& z : knots)
    if (z > all.back() && z < top_) all.push_back(z);
  all.push_back(top_);
  return all;
}

template <Real S>
template <class Ends, class Value>
void SteadyChute<S>::sample(const std::vector<S>& knots, const Ends& ends, const Value& value,
                            std::vector<S>& z, std::vector<S>& values) {
  using std::ceil;
  using std::cos;
  const std::vector<S> all = cuts(knots);
  const auto add = [&](const S& height, const S& a) {
    const S zeta = bed_height(height);
    if (!z.empty() && zeta == z.back() && a == values.back()) return;
    if (!z.empty() && zeta < z.back()) return;
    z.push_back(zeta);
    values.push_back(a);
  };
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const S &lo = all[i], &hi = all[i + 1];
    const auto at_ends = ends(lo, hi);
    const double share = to_double(S((hi - lo) / (top_ - bottom_)));
    const int n = 8 + static_cast<int>(ceil(share * static_cast<double>(kPoints)));
    add(lo, at_ends.low);
    for (int k = 1; k < n; ++k) {
      constexpr double kPi = 3.14159265358979323846;  // where points are need not be exact
      const S part = S((1 - cos(kPi * k / n)) / 2), height = lo + part * (hi - lo);
      if (bed_height(height) > z.back() && bed_height(height) < bed_height(hi)) add(height, S(value(height)));
    }
    add(hi, at_ends.high);
  }
  is_sampled_ = true;
}

template <Real S>
DepthFunction<S> SteadyChute<S>::carried(const DepthFunction<S>& function) {
  if (is_uniform_flow<S>(velocity_)) return function;
  return std::visit(
      [&](const auto& model) -> DepthFunction<S> {
        std::vector<S> inside;
        for (const S& z : model.knots())
          if (z > bottom_ && z < top_) inside.push_back(z);
        if (model.kIsLayered) {
          Piecewise<S> pieces;
          pieces.breaks = bed_heights(inside);
          pieces.values = {S(model.value(bottom_))};
          for (const S& z : inside) pieces.values.push_back(S(model.value(z)));
          return pieces;
        }
        Table<S> table;
        sample(
            inside, [&](const S& lo, const S& hi) { return end_values(model, lo, hi); },
            [&](const S& z) { return model.value(z); }, table.z, table.values);
        const std::size_t last = table.z.size() - 1;
        const auto mend = [&](std::size_t at, std::size_t beside) {
          if (table.values[at] > 0) return;
          const S lo = height(table.z[std::min(at, beside)]), hi = height(table.z[std::max(at, beside)]);
          table.values[at] = value_at_rest(S(model.harmonic_mean(lo, hi)), table.values[beside]);
        };
        mend(0, 1);
        mend(last, last - 1);
        return table;
      },
      function);
}

template <Real S>
DepthFunction<S> SteadyChute<S>::carried_diffusivity(const DepthFunction<S>* function,
                                                     bool follows_shear_rate) {
  using std::abs;
  Table<S> table;
  const auto with_u = [&](const S& z, const S& a) { return S(a * velocity(z) / mean_velocity_); };
  if (function) {
    std::visit(
        [&](const auto& model) {
          const auto at = [&](const S& z) {
            return S(follows_shear_rate ? S(shear_rate_of(model, z)) : S(model.value(z)));
          };
          sample(
              model.knots(),
              [&](const S& lo, const S& hi) {
                // Right below a jump the value is that of the piece: of the shear rate a scaling starts from, as much less.
                const S low = at(lo), above = model.value(hi);
                const S high = model.kIsLayered ? low
                               : above > 0      ? S(at(hi) * (end_values(model, lo, hi).high / above))
                                                : at(hi);
                return EndValues<S>{with_u(lo, low), with_u(hi, high)};
              },
              [&](const S& z) { return with_u(z, at(z)); }, table.z, table.values);
        },
        *function);
  } else {
    sample(
        {},
        [&](const S& lo, const S& hi) {
          return EndValues<S>{with_u(lo, S(1)), with_u(hi, S(1))};
        },
        [&](const S& z) { return with_u(z, S(1)); }, table.z, table.values);
  }
  // D(z) is a table without jumps: one from one number to the next is none for the cells.
  for (std::size_t i = 1; i < table.z.size(); ++i)
    if (!(table.z[i] > table.z[i - 1]))
      table.z[i] =
          table.z[i - 1] + (abs(table.z[i - 1]) + (top_ - bottom_)) * std::numeric_limits<S>::epsilon();
  // No grain crosses the wall, so its value is no matter.
  if (!(table.values.front() > 0)) table.values.front() = table.values[1] / S(2);
  if (!(table.values.back() > 0)) table.values.back() = table.values[table.values.size() - 2] / S(2);
  return table;
}

template <Real S>
InitialState<S> SteadyChute<S>::carried(const InitialState<S>& start) {
  if (is_uniform_flow<S>(velocity_)) return start;
  return std::visit(
      [&](const auto& model) -> InitialState<S> {
        TableInitial<S> table;
        const auto value = [&](const S& z) {
          return std::clamp(S(model.value(z)), model.lowest(), model.highest());
        };
        sample(
            model.knots(bottom_, top_),
            [&](const S& lo, const S& hi) {
              return EndValues<S>{value(lo), value(hi)};
            },
            value, table.z, table.values);
        return table;
      },
      start);
}

template class SteadyChute<Instantiated>;

}  // namespace shearfront
