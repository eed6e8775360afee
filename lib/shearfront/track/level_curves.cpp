// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/level_curves.hpp"

#include <utility>

#include "shearfront/numeric/contract.hpp"

namespace shearfront {
namespace {

// Below this q both functions are taken by their series: their terms cancel to third order.
constexpr double kSmallRoot = 0.1;

/// artanh q - q.
double exponential_series(double q) {
  const double x = q * q;
  return q * x *
         (1.0 / 3 + x * (1.0 / 5 + x * (1.0 / 7 + x * (1.0 / 9 + x * (1.0 / 11 + x * (1.0 / 13 + x / 15))))));
}

/// q - (1 - q^2) artanh q.
double linear_series(double q) {
  const double x = q * q;
  return 2 * q * x *
         (1.0 / 3 +
          x * (1.0 / 15 + x * (1.0 / 35 + x * (1.0 / 63 + x * (1.0 / 99 + x * (1.0 / 143 + x / 195))))));
}

/// int density(q^2) dq from a to b = a + delta, by Gauss's rule of five points: where a and b are within a factor of two the series
/// would cancel, in pieces of hardly any slope to nothing.
template <class Density>
double small_root_integral(double a, double delta, const Density& density) {
  constexpr double kNodes[2] = {0.53846931010568309, 0.90617984593866399};
  constexpr double kWeights[3] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
  const double middle = a + delta / 2, half = delta / 2;
  double sum = kWeights[0] * density(middle * middle);
  for (int i = 0; i < 2; ++i) {
    const double lower = middle - half * kNodes[i], upper = middle + half * kNodes[i];
    sum += kWeights[i + 1] * (density(lower * lower) + density(upper * upper));
  }
  return sum * half;
}
bool are_alike(double a, double b) { return 2 * a > b && 2 * b > a; }

/// log(r(b) / r(a)) in a linear piece.
double log_of_level_rates(const LevelCurves::Place& a, const LevelCurves::Place& b, double rise) {
  return b.rate < a.rate / 2 ? std::log(b.rate / a.rate) : std::log1p(rise / a.rate);
}

}  // namespace

LevelCurves::LevelCurves(std::vector<RatePiece> pieces, std::vector<double> capacities,
                         const std::vector<KnownTurn>& known)
    : pieces_(std::move(pieces)), h_(std::move(capacities)) {
  SHEARFRONT_EXPECTS(!pieces_.empty() && !h_.empty() && h_.front() == 0, "pieces, and levels from 0 on");
  for (const RatePiece& piece : pieces_) {
    std::vector<double>& turning = turning_.emplace_back(h_.size(), 0.0);
    for (std::size_t k = 1; k < h_.size(); ++k) {
      if (piece.is_constant()) {
        const double x = (piece.low - h_[k]) / piece.low;
        turning[k] = x > 1e-14 ? std::sqrt(x) : 0;
      } else {
        turning[k] = piece.height_of(h_[k]);
      }
    }
    cap_low_.push_back(cap(piece.low));
    cap_high_.push_back(cap(piece.high));
  }
  for (const KnownTurn& turn : known) {
    double& value = turning_[turn.piece][turn.level];
    const bool is_capacity = pieces_[turn.piece].is_constant() && value == 0;
    if (!is_capacity) value = turn.value;
  }
}

double LevelCurves::linear_area(const RatePiece& piece, double h, const Place& a, const Place& b) {
  const double rise = piece.bend * (b.z - a.z);
  const double delta = h * rise / (a.rate * b.rate * (a.q + b.q));
  if (a.q < kSmallRoot && b.q < kSmallRoot) {
    if (!are_alike(a.q, b.q)) return (b.rate * linear_series(b.q) - a.rate * linear_series(a.q)) / piece.bend;
    const auto density = [](double x) { return x / ((1 - x) * (1 - x)); };
    return small_root_integral(a.q, delta, density) * h * (2 / piece.bend);
  }
  return (rise * (a.rate + b.rate - h) / (a.q * a.rate + b.q * b.rate) -
          h * (std::log1p(delta / (1 + a.q)) + 0.5 * log_of_level_rates(a, b, rise))) /
         piece.bend;
}

double LevelCurves::exponential_area(const RatePiece& piece, double h, const Place& a, const Place& b) {
  const double d = b.z - a.z;
  double delta = b.q - a.q;  // at a turning height it is all of q
  if (a.q > 0 && b.q > 0) delta = -(h / a.rate) * std::expm1(-piece.bend * d) / (a.q + b.q);
  if (a.q < kSmallRoot && b.q < kSmallRoot)
    return (are_alike(a.q, b.q) ? small_root_integral(a.q, delta, [](double x) { return x / (1 - x); })
                                : exponential_series(b.q) - exponential_series(a.q)) *
           (2 / piece.bend);
  return d - (delta - std::log1p(delta / (1 + a.q))) * (2 / piece.bend);
}

double LevelCurves::area(std::size_t p, std::size_t level, Place a, Place b) const {
  if (level == 0) return b.z - a.z;
  const RatePiece& piece = pieces_[p];
  if (piece.curve == RateCurve::constant) return a.q * (b.z - a.z);
  if (!(a.q + b.q > 0)) return 0;
  const double h = h_[level];
  if (!(a.q > 0)) a = {turning_[p][level], h, 0};
  if (!(b.q > 0)) b = {turning_[p][level], h, 0};
  return piece.curve == RateCurve::linear ? linear_area(piece, h, a, b) : exponential_area(piece, h, a, b);
}

double LevelCurves::parabola_deficit(std::size_t p, std::size_t level, const Place& a, const Place& b) const {
  if (level == 0) return 0;
  const RatePiece& piece = pieces_[p];
  const double d = b.z - a.z, h = h_[level];
  if (piece.is_constant()) return h / a.rate / (1 + a.q) * d;
  constexpr double kFarFromTurn = 0.5;  // elsewhere it is not small
  if (a.q < kFarFromTurn || b.q < kFarFromTurn) return d - area(p, level, a, b);
  if (piece.curve == RateCurve::exponential) {
    const double delta = -(h / a.rate) * std::expm1(-piece.bend * d) / (a.q + b.q);
    return (delta - std::log1p(delta / (1 + a.q))) * (2 / piece.bend);
  }
  const double rise = piece.bend * d, delta = h * rise / (a.rate * b.rate * (a.q + b.q));
  const double half_log = 0.5 * log_of_level_rates(a, b, rise);
  return h / piece.bend *
         (rise * (1 - 1 / (1 + a.q) - 1 / (1 + b.q)) / (a.q * a.rate + b.q * b.rate) +
          std::log1p(delta / (1 + a.q)) + half_log);
}

double LevelCurves::branch_deficit(std::size_t p, State s, Place a, Place b) const {
  const std::size_t k = level(s);
  if (k == 0) return 0;
  const RatePiece& piece = pieces_[p];
  const FluxBranches& flux = *piece.flux;
  const bool is_upper = is_high(s);
  const double h = h_[k], spread = flux.spread(is_upper);
  if (piece.is_constant()) return (b.z - a.z) * (a.q > 0 ? flux.lack(is_upper, a.q, h / a.rate) : spread);
  if (!(a.q + b.q > 0)) return spread * (b.z - a.z);
  double dead = 0;  // the part beyond the turning height
  if (!(a.q > 0)) {
    dead = turning_[p][k] - a.z;
    a = {turning_[p][k], h, 0};
  }
  if (!(b.q > 0)) {
    dead = b.z - turning_[p][k];
    b = {turning_[p][k], h, 0};
  }
  const double d = b.z - a.z;
  double live;
  // dz = -dx / (bend x) with x = h / r, or -h dx / (bend x^2).
  if (piece.curve == RateCurve::exponential) {
    const double dx = -(h / a.rate) * std::expm1(-piece.bend * d);
    live = flux.shape_integral(is_upper, a.q, b.q, dx) / piece.bend;
  } else {
    const double rise = piece.bend * d, dx = h * rise / (a.rate * b.rate);
    live = (flux.pure_shape(is_upper) * log_of_level_rates(a, b, rise) +
            flux.rest_integral(is_upper, a.q, b.q, dx)) *
           (h / piece.bend);
  }
  return live + spread * dead;
}

double LevelCurves::characteristic_time(std::size_t p, State s, double from, double to) const {
  const std::size_t k = level(s);
  return characteristic_time(p, is_high(s), h_[k], place(p, k, std::min(from, to)),
                             place(p, k, std::max(from, to)));
}

double LevelCurves::characteristic_time(std::size_t p, bool is_high, double h, const Place& a,
                                        const Place& b) const {
  const RatePiece& piece = pieces_[p];
  const FluxBranches* flux = piece.flux.get();
  const double d = b.z - a.z;
  if (!(d > 0)) return 0;
  const double x_a = h / a.rate, x_b = h / b.rate;
  if (flux && h > 0) {
    // 2 int dlack/dx / r dz, the lack being x shape(q).
    if (piece.is_constant()) return 2 * d / a.rate * flux->lack_slope(is_high, a.q, x_a);
    if (piece.curve == RateCurve::exponential)
      return 2 * (flux->lack(is_high, a.q, x_a) - flux->lack(is_high, b.q, x_b)) / (piece.bend * h);
    const double rise = piece.bend * d, dx = h * rise / (a.rate * b.rate);
    return 2 *
           (flux->pure_shape(is_high) * log_of_level_rates(a, b, rise) +
            flux->rest_integral(is_high, a.q, b.q, dx) + flux->shape(is_high, a.q) -
            flux->shape(is_high, b.q)) /
           piece.bend;
  }
  const double share = flux ? 2 * flux->pure_shape(is_high) : 1;  // of pure states, whose speed is that of g'
  if (piece.is_constant()) return share * d / (a.rate * a.q);
  // q' = h r' / (2 q r^2): int dz / (r q) is 2 q / (h bend), and 2 artanh q / bend in a linear piece.
  if (piece.curve == RateCurve::exponential)
    return -2 * share * std::expm1(-piece.bend * d) / (a.rate * piece.bend * (a.q + b.q));
  const double rise = piece.bend * d, delta = h * rise / (a.rate * b.rate * (a.q + b.q));
  return share * (2 * std::log1p(delta / (1 + a.q)) + log_of_level_rates(a, b, rise)) / piece.bend;
}

}  // namespace shearfront
