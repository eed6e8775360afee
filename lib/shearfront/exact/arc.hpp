// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>

#include "shearfront/exact/exponential_path.hpp"
#include "shearfront/exact/rate_form.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Paths that stay inside one piece, a turn included, in closed form for a given time t: no iteration.
///
/// Linear, slope b: logit p rises by x = b t in a constant state. Exponential, r'/r = -1 / decay: p falls by H t / decay, and with
/// B = r(start) t / decay, E = exp((end - start) / decay) (exact/exponential_path.hpp)
///
///     (1 - B (1 - p0)) (1 + B p0) = E,     p = p0 E / (1 + B p0),     1 - p = (1 - p0) (1 + B p0),
///     up = decay [log(1 + B p0) - B p0 (1 - p0)],      down = decay [-log(1 - B (1 - p0)) - B p0 (1 - p0)].
///
/// Where r rises the same is turned upside down.
namespace shearfront::exact {

/// Which ways of a path count: what M gains is p dz upwards, and in the bed turned upside down that is downwards.
enum class Ways : std::uint8_t { up, down };

/// A path inside one piece: p and 1 - p at its end, what it gains on the ways asked for, H t included, how far its end is above
/// its start, and p0 / (1 - p0) there.
template <Real Scalar>
struct Arc {
  Scalar p{0}, missing{0}, gain{0}, rise{0}, start_odds{0};
  bool exists = false;

  [[nodiscard]] Arc turned_over() const {
    return {missing, p, gain, Scalar(-rise), Scalar(1) / start_odds, exists};
  }
};

[[nodiscard]] constexpr Ways turned_over(Ways ways) { return ways == Ways::up ? Ways::down : Ways::up; }

/// What the linear law does to momenta in the time t.
template <Real Scalar>
struct LinearDrift {
  Scalar u, v;  ///< 1 / (1 + e^-x), 1 / (1 + e^x)
  Scalar B;     ///< (t / 2) tanh(x / 2) / (x / 2)

  LinearDrift(const Scalar& b, const Scalar& t) {
    using std::exp;
    using std::tanh;
    const Scalar one(1), x = b * t;
    const Scalar e = exp(Scalar(x < 0 ? x : Scalar(-x))), small = e / (one + e), large = one / (one + e);
    u = x < 0 ? small : large;
    v = x < 0 ? large : small;
    const Scalar half = x / Scalar(2);
    B = half == 0 ? Scalar(t / Scalar(2)) : Scalar(tanh(half) / b);
  }
};

namespace arc_detail {

template <Real Scalar>
[[nodiscard]] Arc<Scalar> linear_from_state(const Scalar& slope, const Scalar& t, const Scalar& p0,
                                            const Scalar& missing0, const Scalar& r, Ways ways) {
  const LinearDrift<Scalar> drift(slope, t);
  const Scalar D = p0 * drift.u + missing0 * drift.v;
  Arc<Scalar> arc;
  arc.exists = drift.B > 0;
  arc.p = p0 * drift.u / D;
  arc.missing = missing0 * drift.v / D;
  const Scalar up = r * drift.B * (p0 / D) * arc.p, down = r * drift.B * (missing0 / D) * arc.missing;
  arc.gain = ways == Ways::up ? up : down;
  arc.rise = up - down;
  arc.start_odds = p0 / missing0;
  return arc;
}

template <Real Scalar>
[[nodiscard]] Arc<Scalar> linear_from_point(const Scalar& slope, const Scalar& t, const Scalar& d,
                                            const Scalar& r0, const Scalar& r, Ways ways) {
  using std::sqrt;
  const LinearDrift<Scalar> drift(slope, t);
  const Scalar k = d / (r * drift.B);
  const Scalar g = sqrt(Scalar(drift.u * drift.v * (r0 / r)));
  Arc<Scalar> arc;
  arc.p = (drift.u + k * drift.u * drift.v) / (drift.u + g);
  arc.missing = (drift.v - k * drift.u * drift.v) / (drift.v + g);
  arc.gain = ways == Ways::up ? Scalar(r * drift.B * arc.p * arc.p / drift.u)
                              : Scalar(r * drift.B * arc.missing * arc.missing / drift.v);
  arc.rise = d;
  arc.start_odds = arc.p * drift.v / (arc.missing * drift.u);
  arc.exists = drift.B > 0 && arc.p >= 0 && arc.missing >= 0;
  return arc;
}

/// (x - log(1 + x)) / x^2 for small x.
template <Real Scalar>
[[nodiscard]] Scalar log_excess(const Scalar& x) {
  using std::log1p;
  const Scalar size = x < 0 ? Scalar(-x) : x;
  if (size > Scalar(0.25)) return (x - log1p(x)) / (x * x);
  Scalar power(1), sum(0);
  for (int n = 2; n < 400; ++n) {
    const Scalar term = power / Scalar(n);
    sum += term;
    const Scalar term_size = term < 0 ? Scalar(-term) : term;
    if (term_size <= unit_roundoff<Scalar>() * sum * Scalar(0.25)) break;
    power *= -x;
  }
  return sum;
}

/// From p0 with missing0 = 1 - p0, B and log E, where r falls.
template <Real Scalar>
[[nodiscard]] Arc<Scalar> falling_exponential(const Scalar& decay, const Scalar& B, const Scalar& log_E,
                                              const Scalar& p0, const Scalar& missing0, const Scalar& p,
                                              Ways ways) {
  using std::log1p;
  const Scalar one(1), half(0.5), x = B * p0, y = B * missing0;
  Arc<Scalar> arc;
  arc.p = p;
  arc.missing = missing0 * (one + x);
  // By parts of one sign where the logarithm is nearly what is taken from it.
  if (ways == Ways::up)
    arc.gain =
        decay * (x < half ? Scalar(x * p0 * (one - B * log_excess(x))) : Scalar(log1p(x) - x * missing0));
  else
    arc.gain = decay * (y < half ? Scalar(y * missing0 * (one + B * log_excess(Scalar(-y))))
                                 : Scalar((log1p(x) - log_E) - y * p0));
  arc.rise = decay * log_E;
  arc.start_odds = p0 / missing0;
  arc.exists = true;
  return arc;
}

template <Real Scalar>
[[nodiscard]] Arc<Scalar> exponential_from_state(const Scalar& decay, const Scalar& t, const Scalar& p0,
                                                 const Scalar& missing0, const Scalar& r, Ways ways) {
  const Scalar b = r * (t / decay);
  const FootRoot<Scalar> root(b, p0);
  if (!root.exists || !(b > 0)) return {};
  const Scalar B = b * root.E;
  const Scalar p = missing0 == 0 ? Scalar(1) : Scalar(p0 * (root.E / (Scalar(1) + B * p0)));
  return falling_exponential<Scalar>(decay, B, root.log_E(), p0, missing0, p, ways);
}

template <Real Scalar>
[[nodiscard]] Arc<Scalar> exponential_from_point(const Scalar& decay, const Scalar& t, const Scalar& d,
                                                 const Scalar& r0, Ways ways) {
  using std::expm1;
  const Scalar B = r0 * (t / decay), log_E = d / decay, e = expm1(log_E);
  if (!(B > 0) || e > B || B + e < 0) return {};
  const FanMomenta<Scalar> fan(B, log_E, e);
  return falling_exponential<Scalar>(decay, B, log_E, fan.p0, fan.one_minus_p0, fan.p, ways);
}

}  // namespace arc_detail

/// The path of a constant state to where the rate is r.
template <Real Scalar>
[[nodiscard]] Arc<Scalar> arc_from_state(RateForm form, const Scalar& bend, const Scalar& t, const Scalar& p0,
                                         const Scalar& missing0, const Scalar& r, Ways ways = Ways::up) {
  using namespace arc_detail;
  if (form == RateForm::linear) return linear_from_state(bend, t, p0, missing0, r, ways);
  if (bend < 0) return exponential_from_state<Scalar>(Scalar(-1) / bend, t, p0, missing0, r, ways);
  return exponential_from_state<Scalar>(Scalar(1) / bend, t, missing0, p0, r, turned_over(ways))
      .turned_over();
}

/// The path from a height with the rate r0 to one with the rate r, d above.
template <Real Scalar>
[[nodiscard]] Arc<Scalar> arc_from_point(RateForm form, const Scalar& bend, const Scalar& t, const Scalar& d,
                                         const Scalar& r0, const Scalar& r, Ways ways = Ways::up) {
  using namespace arc_detail;
  if (form == RateForm::linear) return linear_from_point(bend, t, d, r0, r, ways);
  if (bend < 0) return exponential_from_point<Scalar>(Scalar(-1) / bend, t, d, r0, ways);
  return exponential_from_point<Scalar>(Scalar(1) / bend, t, Scalar(-d), r0, turned_over(ways)).turned_over();
}

}  // namespace shearfront::exact
