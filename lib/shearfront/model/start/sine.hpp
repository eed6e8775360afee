// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/model/field.hpp"
#include "shearfront/model/start/model.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A wave: phi = mean + amplitude sin(2 pi (z - origin) / wavelength). Domain: wavelength > 0, no more than 1e5 waves in the bed.
template <Real Scalar>
struct SineInitial {
  static constexpr std::string_view kName = "sine";
  static constexpr std::string_view kFormula = "mean + amplitude sin(2 pi (z - origin) / wavelength)";

  static constexpr double kMostWaves = 1e5;

  Scalar mean{0}, amplitude{1}, wavelength{1}, origin{0};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"mean", Range::any, true, Measure::state, {}, "mean -+ amplitude states of the flux"},
          self.mean);
    visit(
        FieldInfo{
            .key = "amplitude", .measure = Measure::state, .also = "mean -+ amplitude states of the flux"},
        self.amplitude);
    visit(FieldInfo{.key = "wavelength", .range = Range::positive, .also = "at most 1e5 waves"},
          self.wavelength);
    visit(FieldInfo{"origin", Range::any, true, Measure::height}, self.origin);
  }
  /// So short a wave is not seen by any grid, and each is a piece of its own to those without one.
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    const Scalar least = (top - bottom) / Scalar(kMostWaves);
    if (wavelength < least && wavelength > 0)
      complaints.push_back(
          {prefix + "wavelength", number_text(wavelength),
           "must be at least " + number_text(least) + ", which makes " + number_text(kMostWaves) + " waves"});
  }
  [[nodiscard]] Scalar lowest() const { return mean - size(); }
  [[nodiscard]] Scalar highest() const { return mean + size(); }

  [[nodiscard]] Scalar value(const Scalar& z) const {
    using std::sin;
    return mean + amplitude * sin(angle(z));
  }
  [[nodiscard]] Wave<Scalar> wave() const { return {mean, amplitude, wavelength, origin}; }
  /// int_lo^hi phi dz, free of cancellation for short intervals.
  [[nodiscard]] Scalar integral(const Scalar& lo, const Scalar& hi) const {
    using std::sin;
    const Scalar half = (angle(hi) - angle(lo)) / Scalar(2), middle = angle(lo) + half;
    const Scalar sinc = half == 0 ? Scalar(1) : Scalar(sin(half) / half);
    return (hi - lo) * (mean + amplitude * (sin(middle) * sinc));
  }
  [[nodiscard]] Scalar slope(const Scalar& z, const Scalar& /*middle*/) const {
    using std::cos;
    return amplitude * cos(angle(z)) * number();
  }
  template <class Add>
  void derivatives(const Scalar& lo, const Scalar& z, const Add& add) const {
    using std::cos;
    using std::sin;
    const Scalar sine = sin(angle(z)), low_sine = sin(angle(lo)),
                 slope = amplitude * cos(angle(z)) * number();
    const Scalar waves = SineInitial{Scalar(0), Scalar(1), wavelength, origin}.integral(lo, z);
    add(0, Scalar(1), Scalar(z - lo));
    add(1, sine, waves);
    add(2, Scalar(-slope * (z - origin) / wavelength),
        Scalar(amplitude / wavelength * (waves - ((z - origin) * sine - (lo - origin) * low_sine))));
    add(3, Scalar(-slope), Scalar(amplitude * (low_sine - sine)));
  }
  /// Crests, troughs, and what is half way between them.
  [[nodiscard]] std::vector<Scalar> knots(const Scalar& lo, const Scalar& hi) const {
    using std::floor;
    std::vector<Scalar> all;
    if (amplitude == 0) return all;
    const Scalar quarter = wavelength / Scalar(4);
    Scalar n = floor(Scalar((lo - origin) / quarter));
    for (;; n += Scalar(1)) {
      const Scalar z = origin + n * quarter;
      if (!(z < hi)) return all;
      if (z > lo && (all.empty() || z > all.back())) all.push_back(z);
      if (n + Scalar(1) == n) return all;  // an origin so far away that waves cannot be told apart
    }
  }

  static std::vector<SineInitial> samples() {
    return {{Scalar(0.5), Scalar(0.25), Scalar(1), Scalar(0)},
            {Scalar(0.5), Scalar(-0.5), Scalar(0.5), Scalar(0.1)}};
  }

 private:
  [[nodiscard]] Scalar size() const { return amplitude < 0 ? Scalar(-amplitude) : amplitude; }
  [[nodiscard]] static Scalar two_pi() {
    using std::atan;
    return Scalar(8) * atan(Scalar(1));  // every file sees this header, few need Boost
  }
  [[nodiscard]] Scalar angle(const Scalar& z) const { return two_pi() * ((z - origin) / wavelength); }
  [[nodiscard]] Scalar number() const { return two_pi() / wavelength; }
};

}  // namespace shearfront
