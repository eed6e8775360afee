// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "shearfront/model/depth/bagnold.hpp"
#include "shearfront/model/depth/exponential.hpp"
#include "shearfront/model/depth/kinetic.hpp"
#include "shearfront/model/depth/model.hpp"
#include "shearfront/model/depth/table.hpp"
#include "shearfront/model/field.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Shear rates du/dz that a law of segregation is applied to: depth functions of their own, or those that stand here. Each knows where its
/// slowness has its centre of mass, so that the law has a closed harmonic mean.
namespace shearfront {

/// Points (z[i], velocity[i]) of a velocity profile, linear between them: its shear rate is constant there, of either sign of the slope.
template <Real Scalar>
struct VelocityPoints {
  static constexpr std::string_view kName = "velocity";
  static constexpr std::string_view kFormula = "slope between the points (z[i], velocity[i])";

  std::vector<Scalar> z, velocity;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "z", .measure = Measure::height}, self.z);
    visit(FieldInfo{.key = "velocity"}, self.velocity);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    const std::size_t before = complaints.size();
    check_points(prefix, z, velocity.size(), bottom, top, complaints);
    if (complaints.size() > before) return;
    for (std::size_t i = 1; i < velocity.size(); ++i)
      if (velocity[i] == velocity[i - 1])
        complaints.push_back({prefix + "velocity[" + std::to_string(i) + "]", number_text(velocity[i]),
                              "must differ from the entry before it: without shear nothing segregates"});
  }
  [[nodiscard]] Scalar value(const Scalar& height) const { return slope(segment(height)); }
  [[nodiscard]] bool jumps_at(const Scalar& height) const {
    return std::binary_search(z.begin(), z.end(), height);
  }
  [[nodiscard]] EndValues<Scalar> end_values(const Scalar& lo, const Scalar& /*hi*/) const {
    return {value(lo), value(lo)};
  }
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& /*hi*/) const { return value(lo); }
  [[nodiscard]] Scalar slowness_place(const Scalar&, const Scalar&) const { return Scalar(0.5); }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& /*hi*/, AddLow&& add_low,
                             AddHigh&& add_high) const {
    const std::size_t i = segment(lo);
    const Scalar width = z[i + 1] - z[i], sign(velocity[i + 1] < velocity[i] ? -1 : 1);
    for (auto by : {std::pair{i, Scalar(slope(i) / width)}, std::pair{i + 1, Scalar(-slope(i) / width)},
                    std::pair{z.size() + i, Scalar(-sign / width)},
                    std::pair{z.size() + i + 1, Scalar(sign / width)}}) {
      add_low(by.first, by.second);
      add_high(by.first, by.second);
    }
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return z; }

  static std::vector<VelocityPoints> samples() {
    return {{{Scalar(0), Scalar(0.5), Scalar(1)}, {Scalar(0), Scalar(0.25), Scalar(1)}}};
  }

 private:
  [[nodiscard]] std::size_t segment(const Scalar& height) const {
    const auto it = std::upper_bound(z.begin() + 1, z.end() - 1, height);
    return static_cast<std::size_t>(it - z.begin()) - 1;
  }
  [[nodiscard]] Scalar slope(std::size_t i) const {
    const Scalar rise = (velocity[i + 1] - velocity[i]) / (z[i + 1] - z[i]);
    return rise < 0 ? Scalar(-rise) : rise;
  }
};

/// Shear rate of the kinetic cell: the stress is the same everywhere and viscosity is eta0 p / sqrt T, so that du/dz = amplitude
/// (w(z) / w(lid)) (p(lid) / p(z)); amplitude is the shear rate at the lid.
template <Real Scalar>
struct KineticShear : KineticBed<Scalar> {
  static constexpr std::string_view kName = "kinetic";
  static constexpr std::string_view kFormula =
      "amplitude sqrt(T(z)/T(lid)) p(lid)/p(z) of a sheared bed under a lid";

  Scalar amplitude{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    Kinetic<Scalar>::fields(self, visit);
  }
  [[nodiscard]] Scalar value(const Scalar& z) const {
    return amplitude * this->profile().value(z) * (this->load / this->depth(z));
  }
  /// 1 / value is (depth(hi) + hi - z) / w but for a factor.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    if (!(hi > lo)) return value(lo);
    const auto slow = this->profile().slowness(lo, hi, false).moment;
    return amplitude * this->load * ((hi - lo) / (this->depth(hi) * slow[0] + slow[1]));
  }
  [[nodiscard]] Scalar slowness_place(const Scalar& lo, const Scalar& hi) const {
    if (!(hi > lo)) return Scalar(0.5);
    const auto slow = this->profile().slowness(lo, hi, false).moment;
    const Scalar y = this->depth(hi);
    return Scalar(1) - (y * slow[1] + slow[2]) / ((hi - lo) * (y * slow[0] + slow[1]));
  }
  template <class Add>
  void add_depth(const Add& add) const {
    KineticBed<Scalar>::add_depth(1, add);
  }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const auto at = [&](const Scalar& z, auto& add) {
      const auto v = this->profile().with_derivatives(z);
      const Scalar y = this->depth(z), factor = this->load / y, a = amplitude * v.w * factor;
      add(0, Scalar(v.w * factor));
      for (std::size_t e = 0; e < this->n_numbers(); ++e) add(1 + e, Scalar(amplitude * factor * v.by[e]));
      add(2, Scalar(a / this->load));
      add_depth([&](std::size_t entry, const Scalar& by) { add(entry, Scalar(-a * by / y)); });
    };
    at(lo, add_low);
    at(hi, add_high);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  static std::vector<KineticShear> samples() {
    std::vector<KineticShear> all;
    for (const Kinetic<Scalar>& a : Kinetic<Scalar>::samples()) {
      KineticShear shear;
      static_cast<KineticBed<Scalar>&>(shear) = a;
      shear.amplitude = a.amplitude;
      all.push_back(shear);
    }
    return all;
  }
};

/// Names and formulas of the laws, made of those of their shear rates.
template <class Shear>
class ScalingText {
  template <std::size_t n_prefix, std::size_t n>
  static constexpr std::array<char, n_prefix + n> joined(std::string_view prefix, std::string_view text) {
    std::array<char, n_prefix + n> all{};
    std::copy(text.begin(), text.end(), std::copy(prefix.begin(), prefix.end(), all.begin()));
    return all;
  }
  static constexpr std::string_view kPrefix = "scaling-", kLaw = "B S d^2 F(R) / (C d + p), S = ";
  static constexpr auto kNameText = joined<kPrefix.size(), Shear::kName.size()>(kPrefix, Shear::kName);
  static constexpr auto kFormulaText = joined<kLaw.size(), Shear::kFormula.size()>(kLaw, Shear::kFormula);

 public:
  static constexpr std::string_view kName{kNameText.data(), kNameText.size()};
  static constexpr std::string_view kFormula{kFormulaText.data(), kFormulaText.size()};
};

/// Segregation rate of a flow from what a laboratory knows of it: its shear rate du/dz and the grains,
///
///     a(z) = B du/dz d^2 ((R - 1) + E (1 - share) (R - 1)^2) / (C d + packing depth(z)),
///     d = small_diameter (share + (1 - share) R),   R = size_ratio,
///
/// the speed at which a pair of pure states segregates, in the unit of height over that of time. packing depth is the pressure over density
/// times gravity: depth(z) = pressure / (packing density gravity) + lid - z, or what the shear rate knows itself (the load of `kinetic`,
/// the surface of `bagnold`). The grain size and the ratio are those of a mixture with the mean share of small grains: how the rate depends
/// on the share itself is the flux's business (cubic).
/// Domain: lengths, density and gravity in the units of the scene (SI is safe), all > 0, size_ratio > 1, 0 <= share <= 1, pressure >= 0,
/// lid not below the top of the domain (the top itself if not given). Defaults: packing 0.6, share 1/2, density 2500, gravity 9.81,
/// B = 0.3744, C = 0.2712, E = 2.0957. Source: Trewhela, Ancey & Gray (2021), J. Fluid Mech. 916, A55, whose law is fitted to
/// single intruders in a shear cell of refractive-index matched grains; their remixing is D = 0.108 du/dz d^2 (Utter & Behringer
/// 2004). Outside of dense flow of moderate inertial number it overestimates (arXiv 2507.01248).
template <class Shear>
struct Scaling {
  using Scalar = std::remove_cvref_t<decltype(Shear{}.value({}))>;
  static constexpr std::string_view kName = ScalingText<Shear>::kName;
  static constexpr std::string_view kFormula = ScalingText<Shear>::kFormula;
  static constexpr bool kIsLayered = false;
  static constexpr bool kIsGuessable = false;
  /// Whether the shear rate knows how much bed there is above a height.
  static constexpr bool kKnowsDepth = requires(const Shear& shear, Scalar z) { shear.depth(z); };

  Shear shear;
  Scalar small_diameter{0}, size_ratio{0}, share{0.5}, packing{0.6};
  Scalar pressure{0}, density{2500}, gravity{9.81}, lid{0};
  Scalar B{0.3744}, C{0.2712}, E{2.0957};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    Shear::fields(self.shear, visit);
    visit(FieldInfo{"small_diameter", Range::positive}, self.small_diameter);
    visit(FieldInfo{.key = "size_ratio", .range = Range::positive, .also = "above 1"}, self.size_ratio);
    visit(FieldInfo{.key = "share", .is_optional = true, .also = "of all grains, 0 to 1"}, self.share);
    visit(FieldInfo{"packing", Range::positive, true}, self.packing);
    if constexpr (!kKnowsDepth) {
      visit(FieldInfo{.key = "pressure", .is_optional = true, .also = "not negative"}, self.pressure);
      visit(FieldInfo{"density", Range::positive, true}, self.density);
      visit(FieldInfo{"gravity", Range::positive, true}, self.gravity);
      visit(
          FieldInfo{
              .key = "lid", .is_optional = true, .measure = Measure::height, .also = "not below the top"},
          self.lid);
    }
    visit(FieldInfo{"B", Range::positive, true}, self.B);
    visit(FieldInfo{"C", Range::positive, true}, self.C);
    visit(FieldInfo{"E", Range::positive, true}, self.E);
  }
  void prepare(const Scalar& bottom, const Scalar& top) {
    top_ = top;
    if constexpr (requires { shear.prepare(bottom, top); }) shear.prepare(bottom, top);
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    shear.check(prefix, bottom, top, complaints);
    const auto add = [&](const char* key, const Scalar& x, const std::string& constraint) {
      complaints.push_back({prefix + key, number_text(x), constraint});
    };
    if (is_finite(size_ratio) && size_ratio > 0 && !(size_ratio > 1))
      add("size_ratio", size_ratio, "must be > 1: diameter of the large grains over that of the small ones");
    if (is_finite(share) && !(share >= 0 && share <= 1)) add("share", share, "must be between 0 and 1");
    if (is_finite(pressure) && !(pressure >= 0)) add("pressure", pressure, "must be >= 0");
    if (!kKnowsDepth && is_finite(lid) && lid != 0 && lid < top)
      add("lid", lid, "must not lie below the top of the domain (" + number_text(top) + ")");
  }

  [[nodiscard]] Scalar value(const Scalar& z) const { return shear.value(z) * strength() / resistance(z); }
  /// What diffusion proportional to the shear rate is proportional to.
  [[nodiscard]] Scalar shear_rate(const Scalar& z) const { return shear.value(z); }
  /// The resistance is linear in z: its mean over the slowness of the shear rate is its value at the centre of mass of that.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    const Scalar centre = (hi - lo) * (Scalar(1) - Scalar(shear.slowness_place(lo, hi)));
    return shear.harmonic_mean(lo, hi) * strength() / (resistance(hi) + packing * centre);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return shear.knots(); }
  [[nodiscard]] std::vector<std::size_t> knot_entries() const { return shearfront::knot_entries(shear); }
  [[nodiscard]] bool jumps_at(const Scalar& z) const { return may_jump_at_knot(z); }
  [[nodiscard]] bool vanishes_at(const Scalar& z) const {
    if constexpr (requires { shear.vanishes_at(z); })
      return shear.vanishes_at(z);
    else
      return false;
  }
  [[nodiscard]] EndValues<Scalar> end_values(const Scalar& lo, const Scalar& hi) const {
    const EndValues<Scalar> ends = shearfront::end_values(shear, lo, hi);
    return {ends.low * strength() / resistance(lo), ends.high * strength() / resistance(hi)};
  }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const EndValues<Scalar> ends = end_values(lo, hi);
    const auto scaled = [&](const Scalar& z, auto& add) {
      return [&add, factor = Scalar(strength() / resistance(z))](std::size_t entry, const Scalar& by) {
        add(entry, Scalar(factor * by));
      };
    };
    shear.end_value_derivatives(lo, hi, scaled(lo, add_low), scaled(hi, add_high));
    add_own(lo, ends.low, add_low);
    add_own(hi, ends.high, add_high);
  }

  static std::vector<Scaling> samples() {
    std::vector<Scaling> all;
    for (const Shear& shear : Shear::samples()) {
      Scaling a;
      a.shear = shear;
      a.small_diameter = Scalar(0.05), a.size_ratio = Scalar(2), a.pressure = Scalar(3000);
      all.push_back(a);
    }
    return all;
  }

 private:
  [[nodiscard]] bool may_jump_at_knot(const Scalar& z) const {
    if constexpr (requires { shear.jumps_at(z); })
      return shear.jumps_at(z);
    else
      return false;
  }
  [[nodiscard]] Scalar diameter() const {
    return small_diameter * (share + (Scalar(1) - share) * size_ratio);
  }
  /// (R - 1) + E (1 - share) (R - 1)^2.
  [[nodiscard]] Scalar disparity() const {
    const Scalar excess = size_ratio - Scalar(1);
    return excess * (Scalar(1) + E * (Scalar(1) - share) * excess);
  }
  [[nodiscard]] Scalar strength() const { return B * diameter() * diameter() * disparity(); }
  [[nodiscard]] Scalar depth(const Scalar& z) const {
    if constexpr (kKnowsDepth)
      return shear.depth(z);
    else
      return ((lid != 0 ? lid : top_) - z) + pressure / (packing * density * gravity);
  }
  [[nodiscard]] Scalar resistance(const Scalar& z) const { return C * diameter() + packing * depth(z); }

  template <class Add>
  void add_own(const Scalar& z, const Scalar& a, Add& add) const {
    const Scalar one(1), d = diameter(), F = disparity(), L = resistance(z), excess = size_ratio - one,
                         by_d = Scalar(2) / d - C / L;
    std::size_t e = model_size(shear);
    add(e++, Scalar(a * by_d * d / small_diameter));
    add(e++, Scalar(a * (by_d * small_diameter * (one - share) +
                         (one + Scalar(2) * E * (one - share) * excess) / F)));
    add(e++, Scalar(-a * (by_d * small_diameter * excess + E * excess * excess / F)));
    if constexpr (kKnowsDepth) {
      shear.add_depth(
          [&](std::size_t entry, const Scalar& by) { add(entry, Scalar(-a * packing * by / L)); });
      add(e++, Scalar(-a * depth(z) / L));
    } else {
      const Scalar load = pressure / (density * gravity);
      add(e++, Scalar(-a * ((lid != 0 ? lid : top_) - z) / L));
      add(e++, Scalar(-a / (density * gravity) / L));
      add(e++, Scalar(a * load / density / L));
      add(e++, Scalar(a * load / gravity / L));
      if (lid != 0) add(e, Scalar(-a * packing / L));
      ++e;
    }
    add(e++, Scalar(a / B));
    add(e++, Scalar(-a * d / L));
    add(e++, Scalar(a * (one - share) * excess * excess / F));
  }
  /// How many numbers the shear rate has.
  [[nodiscard]] static std::size_t model_size(const Shear& of) {
    std::size_t n = 0;
    Shear::fields(of, [&](const FieldInfo&, const auto& member) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, Scalar>)
        ++n;
      else
        n += member.size();
    });
    return n;
  }

  Scalar top_{1};
};

}  // namespace shearfront
