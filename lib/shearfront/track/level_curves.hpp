// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/riemann/state.hpp"
#include "shearfront/track/flux_branches.hpp"
#include "shearfront/track/rate_piece.hpp"

namespace shearfront {

/// What is known of a level in a piece without rounding of its capacity: the height at which it turns, or where the rate is
/// constant its q there.
struct KnownTurn {
  std::size_t piece;
  std::size_t level;
  double value;
};

/// Levels of the flux H = r(z) g(u) / 4 of u_t - H_z = 0 in a bed of pieces, and the states at rest that belong to them;
/// g(u) = 4 u (1 - u), or another flux with one maximum 1 (FluxBranches), one in each piece.
///
/// Level k has the flux H_k; h_k = 4 H_k is the rate that can just carry it, 0 = h_0 < h_1 < ... < h_N. Its two states are
/// steady profiles: u = (1 -+ q_k) / 2, q_k(z) = sqrt(1 - h_k / r(z)) where r > h_k, on the live side of its turning height
/// r(z_k) = h_k, and q_k = 0 beyond: there it carries more than the bed can, u = 1/2. (For other fluxes u is a function of q_k,
/// one for each side, and top() where q_k = 0.) A level may be used beyond its turning
/// height up to that of the next lower one, so that capacities are rounded up; fronts between neighbouring levels are then means
/// of characteristics also where these turn.
///
/// A State is the index of a level of one side: low(k) = k (u <= 1/2), high(k) = 2 N + 1 - k; u does not fall with the index.
/// Cost: memory of one number per piece and level.
class LevelCurves {
 public:
  using Scalar = double;

  LevelCurves(std::vector<RatePiece> pieces, std::vector<double> capacities,
              const std::vector<KnownTurn>& known);

  /// None for the parabola.
  [[nodiscard]] const FluxBranches* flux(std::size_t p) const { return pieces_[p].flux.get(); }
  /// u of the largest flux.
  [[nodiscard]] double top(std::size_t p) const { return top_of(flux(p)); }

  [[nodiscard]] std::size_t n_layers() const { return pieces_.size(); }
  [[nodiscard]] double boundary(std::size_t k) const {
    return k == 0 ? pieces_.front().z_low : pieces_[k - 1].z_high;
  }
  [[nodiscard]] const RatePiece& piece(std::size_t p) const { return pieces_[p]; }
  /// Without level 0.
  [[nodiscard]] std::size_t n_levels() const { return h_.size() - 1; }
  /// h_k = 4 H_k.
  [[nodiscard]] double capacity(std::size_t level) const { return h_[level]; }

  [[nodiscard]] State low(std::size_t level) const { return static_cast<State>(level); }
  [[nodiscard]] State high(std::size_t level) const { return static_cast<State>(2 * h_.size() - 1 - level); }
  [[nodiscard]] bool is_high(State s) const { return static_cast<std::size_t>(s) >= h_.size(); }
  [[nodiscard]] std::size_t level(State s) const {
    const auto i = static_cast<std::size_t>(s);
    return i < h_.size() ? i : 2 * h_.size() - 1 - i;
  }
  [[nodiscard]] double sign(State s) const { return is_high(s) ? 1.0 : -1.0; }

  /// The least level that r cannot carry more than: the largest one if there is none.
  [[nodiscard]] std::size_t cap(double rate) const {
    constexpr double kSlack = 1 - 1e-14;  // levels nearer to each other than that are one
    const auto it = std::lower_bound(h_.begin(), h_.end(), rate * kSlack);
    return std::min(static_cast<std::size_t>(it - h_.begin()), n_levels());
  }
  [[nodiscard]] std::size_t cap_low(std::size_t p) const { return cap_low_[p]; }
  [[nodiscard]] std::size_t cap_high(std::size_t p) const { return cap_high_[p]; }

  /// z_k in a piece whose rate is not constant; it may lie outside of it. Precondition: level > 0.
  [[nodiscard]] double turning_height(std::size_t p, std::size_t level) const { return turning_[p][level]; }

  /// q_k where the rate of piece p is r(z) = rate.
  [[nodiscard]] double q(std::size_t p, std::size_t level, double z, double rate) const {
    if (level == 0) return 1;
    const RatePiece& piece = pieces_[p];
    if (piece.curve == RateCurve::constant) return turning_[p][level];
    const double x = piece.bend * (z - turning_[p][level]);  // positive on the live side
    if (!(x > 0)) return 0;
    if (piece.curve == RateCurve::linear) return std::min(1.0, std::sqrt(x / rate));
    constexpr double kFarFromTurn = 0.75;
    const double share = h_[level] / rate;
    return share < kFarFromTurn ? std::sqrt(1 - share) : std::sqrt(-std::expm1(-x));
  }
  [[nodiscard]] double q(std::size_t p, std::size_t level, double z) const {
    return q(p, level, z, pieces_[p].rate(z));
  }
  /// u of a state, small ones to all their digits.
  [[nodiscard]] double phi(std::size_t p, State s, double z) const {
    const std::size_t k = level(s);
    if (k == 0) return is_high(s) ? 1 : 0;
    const double rate = pieces_[p].rate(z);
    return u_of(p, is_high(s), h_[k], rate, q(p, k, z, rate));
  }
  /// u on one side where the rate r carries h / 4 and q = sqrt(1 - h / r).
  [[nodiscard]] double u_of(std::size_t p, bool is_high, double h, double rate, double root) const {
    const FluxBranches* g = flux(p);
    if (!(root > 0)) return top_of(g);
    const double x = h / rate, lack = g ? g->lack(is_high, root, x) : x / (1 + root);
    return is_high ? 1 - lack / 2 : lack / 2;
  }

  /// A height with what is needed there of one level.
  struct Place {
    double z, rate, q;
  };
  [[nodiscard]] Place place(std::size_t p, std::size_t level, double z) const {
    const double rate = pieces_[p].rate(z);
    return {z, rate, q(p, level, z, rate)};
  }
  /// int q_k dz from a to b, without cancellation. Precondition: a parabola.
  [[nodiscard]] double area(std::size_t p, std::size_t level, Place a, Place b) const;
  [[nodiscard]] double area(std::size_t p, std::size_t level, double from, double to) const {
    return area(p, level, place(p, level, from), place(p, level, to));
  }
  /// Twice int |u - pure state of its side| dz of a state, from a to b: small ones, of levels far below the capacity, to all their
  /// digits.
  [[nodiscard]] double deficit(std::size_t p, State s, const Place& a, const Place& b) const {
    return flux(p) ? branch_deficit(p, s, a, b) : parabola_deficit(p, level(s), a, b);
  }
  /// int u dz of a state.
  [[nodiscard]] double amount(std::size_t p, State s, double from, double to) const {
    const std::size_t k = level(s);
    if (k == 0) return is_high(s) ? to - from : 0;
    const double half = deficit(p, s, place(p, k, from), place(p, k, to)) / 2;
    return is_high(s) ? (to - from) - half : half;
  }
  /// The time in which a characteristic of a state goes from one height to another, up or down. Precondition: its level lives
  /// all the way, ends excepted where the rate is not constant.
  [[nodiscard]] double characteristic_time(std::size_t p, State s, double from, double to) const;
  /// The same for any flux h / 4, a below b.
  [[nodiscard]] double characteristic_time(std::size_t p, bool is_high, double h, const Place& a,
                                           const Place& b) const;

 private:
  [[nodiscard]] static double linear_area(const RatePiece& piece, double h, const Place& a, const Place& b);
  [[nodiscard]] static double exponential_area(const RatePiece& piece, double h, const Place& a,
                                               const Place& b);
  [[nodiscard]] double parabola_deficit(std::size_t p, std::size_t level, const Place& a,
                                        const Place& b) const;
  [[nodiscard]] double branch_deficit(std::size_t p, State s, Place a, Place b) const;

  std::vector<RatePiece> pieces_;
  std::vector<double> h_;
  std::vector<std::vector<double>> turning_;  ///< per piece and level: z_k, in constant pieces q_k
  std::vector<std::size_t> cap_low_, cap_high_;
};

}  // namespace shearfront
