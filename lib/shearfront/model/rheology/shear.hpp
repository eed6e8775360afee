// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/depth/bagnold.hpp"
#include "shearfront/model/depth/exponential.hpp"
#include "shearfront/model/depth/kinetic.hpp"
#include "shearfront/model/depth/model.hpp"
#include "shearfront/model/depth/table.hpp"

/// Shear rates du/dz that a law of segregation is applied to (model/depth/scaling.hpp): depth functions of their own, or those of
/// kFormula and kName only here. Each knows where its slowness has its centre of mass, so that the law has a closed harmonic mean.
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

}  // namespace shearfront
