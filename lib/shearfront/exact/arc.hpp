// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>

#include "shearfront/exact/exponential_path.hpp"
#include "shearfront/exact/rate_form.hpp"
#include "shearfront/exact/sloped_crossing.hpp"
#include "shearfront/numeric/scalar.hpp"

/// Paths that stay inside one piece, a turn included, in closed form for a given time t: no iteration.
///
/// Linear, slope b: logit p rises by x = b t in a constant state. Exponential, r'/r = -kappa = -1 / decay: p falls by H t / decay, and
/// with B = r(start) t / decay, E = exp((end - start) / decay) (exact/exponential_path.hpp)
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

/// How far the end may be above the start; a path with another rise is not wanted.
template <Real Scalar>
struct Rises {
  Scalar least = -infinity<Scalar>(), most = infinity<Scalar>();

  [[nodiscard]] bool has(const Scalar& rise) const { return rise >= least && rise <= most; }
  [[nodiscard]] Rises turned_over() const { return {Scalar(-most), Scalar(-least)}; }
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
                                            const Scalar& missing0, const Scalar& r, Ways ways,
                                            const Rises<Scalar>& rises) {
  const LinearDrift<Scalar> drift(slope, t);
  const Scalar D = p0 * drift.u + missing0 * drift.v;
  Arc<Scalar> arc;
  arc.p = p0 * drift.u / D;
  arc.missing = missing0 * drift.v / D;
  const Scalar up = r * drift.B * (p0 / D) * arc.p, down = r * drift.B * (missing0 / D) * arc.missing;
  arc.gain = ways == Ways::up ? up : down;
  arc.rise = up - down;
  arc.exists = drift.B > 0 && rises.has(arc.rise);
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

/// (artanh(w) / w - 1) / w^2 for w^2 <= 1/49.
template <Real Scalar>
[[nodiscard]] Scalar small_artanh_series(const Scalar& w2) {
  if constexpr (std::numeric_limits<Scalar>::digits == 53) {
    double sum = 1.0 / 23;  // the first term left out is 2^-61
    for (const double c :
         {1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3})
      sum = sum * w2 + c;
    return sum;
  } else {
    return artanh_series(w2);
  }
}

/// (x - log(1 + x)) / x^2; for small x by log(1 + x) = 2 artanh(w), w = x / (2 + x).
template <Real Scalar>
[[nodiscard]] Scalar log_excess(const Scalar& x) {
  using std::log1p;
  const Scalar size = x < 0 ? Scalar(-x) : x, one(1), two(2);
  if (size > Scalar(0.25)) return (x - log1p(x)) / (x * x);
  const Scalar w = x / (two + x), rest = one - w;
  return rest / two * (one - w * rest * small_artanh_series(Scalar(w * w)));
}

/// From p0 with missing0 = 1 - p0, B and log E, where r falls.
template <Real Scalar>
[[nodiscard]] Arc<Scalar> falling_exponential(const Scalar& kappa, const Scalar& B, const Scalar& log_E,
                                              const Scalar& p0, const Scalar& missing0, const Scalar& p,
                                              Ways ways) {
  using std::log1p;
  const Scalar one(1), half(0.5), x = B * p0, y = B * missing0;
  Arc<Scalar> arc;
  arc.p = p;
  arc.missing = missing0 * (one + x);
  // By parts of one sign where the logarithm is nearly what is taken from it.
  Scalar gain;
  if (ways == Ways::up)
    gain = x < half ? Scalar(x * p0 * (one - B * log_excess(x))) : Scalar(log1p(x) - x * missing0);
  else
    gain = y < half ? Scalar(y * missing0 * (one + B * log_excess(Scalar(-y))))
                    : Scalar((log1p(x) - log_E) - y * p0);
  arc.gain = gain / kappa;
  arc.rise = log_E / kappa;
  arc.start_odds = p0 / missing0;
  arc.exists = true;
  return arc;
}

template <Real Scalar>
[[nodiscard]] Arc<Scalar> exponential_from_state(const Scalar& kappa, const Scalar& t, const Scalar& p0,
                                                 const Scalar& missing0, const Scalar& r, Ways ways,
                                                 const Rises<Scalar>& rises) {
  const Scalar b = r * (t * kappa);
  const FootRoot<Scalar> root(b, p0);
  if (!root.exists || !(b > 0)) return {};
  const Scalar log_E = root.log_E();
  if (!rises.has(Scalar(log_E / kappa))) return {};
  const Scalar B = b * root.E;
  const Scalar p = missing0 == 0 ? Scalar(1) : Scalar(p0 * (root.E / (Scalar(1) + B * p0)));
  return falling_exponential<Scalar>(kappa, B, log_E, p0, missing0, p, ways);
}

template <Real Scalar>
[[nodiscard]] Arc<Scalar> exponential_from_point(const Scalar& kappa, const Scalar& t, const Scalar& d,
                                                 const Scalar& r0, Ways ways) {
  using std::expm1;
  const Scalar B = r0 * (t * kappa), log_E = d * kappa, e = expm1(log_E);
  if (!(B > 0) || e > B || B + e < 0) return {};
  const FanMomenta<Scalar> fan(B, log_E, e);
  return falling_exponential<Scalar>(kappa, B, log_E, fan.p0, fan.one_minus_p0, fan.p, ways);
}

}  // namespace arc_detail

/// The path of a constant state to where the rate is r, if its rise is wanted.
template <Real Scalar>
[[nodiscard]] Arc<Scalar> arc_from_state(RateForm form, const Scalar& bend, const Scalar& t, const Scalar& p0,
                                         const Scalar& missing0, const Scalar& r, Ways ways = Ways::up,
                                         const Rises<Scalar>& rises = {}) {
  using namespace arc_detail;
  if (form == RateForm::linear) return linear_from_state(bend, t, p0, missing0, r, ways, rises);
  if (bend < 0) return exponential_from_state<Scalar>(Scalar(-bend), t, p0, missing0, r, ways, rises);
  return exponential_from_state<Scalar>(bend, t, missing0, p0, r, turned_over(ways), rises.turned_over())
      .turned_over();
}

/// The path from a height with the rate r0 to one with the rate r, d above.
template <Real Scalar>
[[nodiscard]] Arc<Scalar> arc_from_point(RateForm form, const Scalar& bend, const Scalar& t, const Scalar& d,
                                         const Scalar& r0, const Scalar& r, Ways ways = Ways::up) {
  using namespace arc_detail;
  if (form == RateForm::linear) return linear_from_point(bend, t, d, r0, r, ways);
  if (bend < 0) return exponential_from_point<Scalar>(Scalar(-bend), t, d, r0, ways);
  return exponential_from_point<Scalar>(bend, t, Scalar(-d), r0, turned_over(ways)).turned_over();
}

}  // namespace shearfront::exact
