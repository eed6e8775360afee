// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/start/model.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A smooth step: phi = below + (above - below) / (1 + exp(-(z - centre) / width)).
///
/// Domain: width > 0, the height over which phi approaches its ends by e; any centre. Where below > above and
/// width = D / (s a |above - below|) it is a kink that travels without changing its shape.
template <Real Scalar>
struct KinkInitial {
  static constexpr std::string_view kName = "kink";
  static constexpr std::string_view kFormula = "below + (above - below) / (1 + exp(-(z - centre) / width))";

  Scalar below{1}, above{0}, centre{0}, width{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{.key = "below", .measure = Measure::state, .also = "a state of the flux"}, self.below);
    visit(FieldInfo{.key = "above", .measure = Measure::state, .also = "a state of the flux"}, self.above);
    visit(FieldInfo{.key = "centre", .measure = Measure::height}, self.centre);
    visit(FieldInfo{"width", Range::positive}, self.width);
  }
  static void check(const std::string& /*prefix*/, const Scalar& /*bottom*/, const Scalar& /*top*/,
                    Complaints&) {}
  [[nodiscard]] Scalar lowest() const { return std::min(below, above); }
  [[nodiscard]] Scalar highest() const { return std::max(below, above); }

  [[nodiscard]] Scalar value(const Scalar& z) const { return below + (above - below) * part_at(z); }
  [[nodiscard]] LogisticStep<Scalar> logistic_step() const { return {below, above, centre, width}; }
  /// int_lo^hi phi dz: width ln(1 + e^x) is the primitive of the step.
  [[nodiscard]] Scalar integral(const Scalar& lo, const Scalar& hi) const {
    return below * (hi - lo) + (above - below) * width * (softplus(hi) - softplus(lo));
  }
  [[nodiscard]] Scalar slope(const Scalar& z, const Scalar& /*middle*/) const {
    return (above - below) * steepness(z) / width;
  }
  template <class Add>
  void derivatives(const Scalar& lo, const Scalar& z, const Add& add) const {
    const Scalar one(1), rise = above - below, part = part_at(z), low_part = part_at(lo),
                         x = (z - centre) / width, low_x = (lo - centre) / width, steep = steepness(z);
    const Scalar grown = width * (softplus(z) - softplus(lo));  // int of the part
    add(0, Scalar(one - part), Scalar((z - lo) - grown));
    add(1, part, grown);
    add(2, Scalar(-rise * steep / width), Scalar(rise * (low_part - part)));
    add(3, Scalar(-rise * steep * x / width), Scalar(rise * (grown / width - (x * part - low_x * low_part))));
  }
  /// Where it is steepest.
  [[nodiscard]] std::vector<Scalar> knots(const Scalar& lo, const Scalar& hi) const {
    if (centre > lo && centre < hi) return {centre};
    return {};
  }

  static std::vector<KinkInitial> samples() {
    return {{Scalar(0.75), Scalar(0), Scalar(0.5), Scalar(0.02)},
            {Scalar(0.2), Scalar(0.9), Scalar(0.3), Scalar(0.1)}};
  }

 private:
  /// 1 / (1 + e^-x), and its slope in x.
  [[nodiscard]] Scalar part_at(const Scalar& z) const {
    using std::tanh;
    return (Scalar(1) + tanh(Scalar((z - centre) / (Scalar(2) * width)))) / Scalar(2);
  }
  [[nodiscard]] Scalar steepness(const Scalar& z) const {
    using std::exp;
    const Scalar x = (z - centre) / width, e = exp(Scalar(x < 0 ? x : Scalar(-x))), more = Scalar(1) + e;
    return e / (more * more);
  }
  /// ln(1 + e^x) at x = (z - centre) / width, for any x.
  [[nodiscard]] Scalar softplus(const Scalar& z) const {
    using std::exp;
    using std::log1p;
    const Scalar x = (z - centre) / width;
    return x > 0 ? Scalar(x + log1p(Scalar(exp(Scalar(-x))))) : Scalar(log1p(Scalar(exp(x))));
  }
};

}  // namespace shearfront
