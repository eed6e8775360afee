// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/general_first_wave.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <algorithm>

namespace shearfront::exact {

namespace {

template <Real Scalar>
class GeneralArrival {
 public:
  GeneralArrival(const GeneralMedium<Scalar>& medium, std::size_t i, const Scalar& mass)
      : medium_(medium), cells_(medium.cells()), at_(cells_.first[i]), mass_(mass), z_(cells_.x[at_]) {}

  std::optional<Scalar> find(const Scalar& last) const {
    if (!at_rest(at_)) return Scalar(0);
    const Scalar fan = std::min(edge_of_fan(true), edge_of_fan(false));
    const Scalar H0 = std::min(flux(at_ - 1), flux(at_));
    if (H0 > 0) {  // nothing is slower than H = 0
      const Scalar until = std::min(fan, Scalar(last + last));
      if (is_below(H0, until)) return first_below(H0, until);
    }
    if (!is_finite(fan)) return std::nullopt;
    return fan;
  }

 private:
  [[nodiscard]] Scalar capacity(std::size_t cell) const { return medium_.capacity(cells_.layer[cell]); }
  [[nodiscard]] const UnimodalLaw<Scalar>& law(std::size_t cell) const {
    return medium_.law(cells_.layer[cell]);
  }
  /// How far a state lies beyond the peak, on the side whose waves go up (down).
  [[nodiscard]] Scalar over(std::size_t cell, bool upward) const {
    const Scalar& phi = cells_.phi[cell];
    return upward ? Scalar(phi - law(cell).peak()) : Scalar(law(cell).peak() - phi);
  }
  [[nodiscard]] Scalar flux(std::size_t cell) const {
    if (cells_.phi[cell] == Scalar(0) || cells_.phi[cell] == Scalar(1)) return Scalar(0);
    const Scalar above = over(cell, true);
    const bool up = above > 0;
    return capacity(cell) * (Scalar(1) - law(cell).lack(up ? above : Scalar(-above), up));
  }
  /// No moving wave leaves this inner point at t = 0. Fluxes computed from the data may differ by rounding.
  [[nodiscard]] bool at_rest(std::size_t point) const {
    const std::size_t b = point - 1, a = point;
    if (cells_.layer[b] == cells_.layer[a] && cells_.phi[b] == cells_.phi[a]) return true;
    const Scalar sent = over(b, true) > 0 ? flux(b) : capacity(b);
    const Scalar taken = over(a, false) > 0 ? flux(a) : capacity(a);
    const Scalar slack = Scalar(8) * unit_roundoff<Scalar>() * std::min(capacity(a), capacity(b));
    const Scalar passing = std::min(sent, taken);
    const auto equal = [&](const Scalar& H) { return H - passing <= slack && passing - H <= slack; };
    return equal(flux(b)) && equal(flux(a));
  }
  /// When the last characteristic of the state on one side has come; infinite if it never ends.
  [[nodiscard]] Scalar edge_of_fan(bool upward) const {
    Scalar time(0);
    std::size_t point = at_;
    for (;;) {
      const std::size_t c = upward ? point - 1 : point;
      const Scalar d = over(c, upward);
      if (!(d > 0)) return infinity<Scalar>();
      time += (cells_.x[c + 1] - cells_.x[c]) / (capacity(c) * law(c).slope(d, upward));
      upward ? --point : ++point;
      const bool wall = point == 0 || point + 1 == cells_.x.size();
      if (wall && cells_.phi[c] == Scalar(upward ? 1 : 0)) return infinity<Scalar>();
      if (wall || !at_rest(point)) return time;
    }
  }
  [[nodiscard]] Scalar amount(const Scalar& t) const {
    const Scalar &bottom = cells_.x.front(), &top = cells_.x.back();
    Scalar M = medium_.best_free(z_, t, infinity<Scalar>()).value;
    if (medium_.pure_travel_time(bottom, z_) <= t) M = std::min(M, Scalar(z_ - bottom));
    if (medium_.pure_travel_time(top, z_) <= t) M = std::min(M, mass_);
    return M;
  }
  [[nodiscard]] bool is_below(const Scalar& H0, const Scalar& t) const {
    const Scalar tie = Scalar(64) * unit_roundoff<Scalar>() * (cells_.x.back() - cells_.x.front());
    return amount(t) < cells_.M[at_] + H0 * t - tie;
  }
  [[nodiscard]] Scalar first_below(const Scalar& H0, Scalar hi) const {
    Scalar lo(0);
    constexpr int kMostSteps = 400;  // more than the digits of any scalar
    for (int n = 0; n < kMostSteps && hi - lo > Scalar(4) * unit_roundoff<Scalar>() * hi; ++n) {
      const Scalar t = lo + (hi - lo) / Scalar(2);
      (is_below(H0, t) ? hi : lo) = t;
    }
    return hi;
  }

  const GeneralMedium<Scalar>& medium_;
  const Cells<Scalar>& cells_;
  std::size_t at_;
  Scalar mass_, z_;
};

}  // namespace

template <Real Scalar>
std::optional<Scalar> first_wave(const GeneralMedium<Scalar>& medium, std::size_t i, const Scalar& mass,
                                 const Scalar& last) {
  return GeneralArrival<Scalar>(medium, i, mass).find(last);
}

template std::optional<Instantiated> first_wave(const GeneralMedium<Instantiated>&, std::size_t,
                                                const Instantiated&, const Instantiated&);

}  // namespace shearfront::exact
